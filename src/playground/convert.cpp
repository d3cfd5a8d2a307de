// The same program in another form, and its trace.
#include <algorithm>
#include <utility>

#include "ninebit/combiner/trace.h"
#include "src/combiner/given_registers.h"
#include "src/effect/traced_pixel.h"
#include "src/playground/texts.h"

namespace ninebit::playground {
namespace {

// The registers of a trace, and which of them were given.
struct GivenRegisters {
  RegisterFile file{};
  std::array<bool, kRegisterCount> given{};
};

std::optional<Register> register_called(std::string_view name, const HardwareProfile& profile) {
  const std::optional<Register> reg = register_named(name);
  if (reg && is_texture(*reg) && texture_unit_of(*reg) >= profile.texture_units) return std::nullopt;
  return reg;
}

GivenRegisters given_registers(Request& request, const HardwareProfile& profile) {
  GivenRegisters out{.file = default_registers(profile)};
  const json::Value* const registers = request.find("registers");
  if (registers != nullptr && registers->type != json::Type::object) {
    request.reader().wrong_type(*registers, "an object");
    return out;
  }
  for (std::size_t i = 0; registers != nullptr && i < registers->children.size(); ++i) {
    const json::Value& child = registers->children[i];
    const auto reg = register_called(child.key, profile);
    if (!reg) {
      request.reader().fault(child.key_offset, "unknown register " + json::in_quotes(child.key) +
                                                   "; expected const0, const1, fog, primary, secondary, spare0, "
                                                   "spare1 or tex0 to tex" +
                                                   std::to_string(profile.texture_units.value - 1));
      continue;
    }
    if (child.type != json::Type::array || child.children.size() != 4) {
      request.reader().fault(child.offset, child.key + " must be an array of four codes: red, green, blue, alpha");
      continue;
    }
    const auto at = static_cast<std::size_t>(*reg);
    out.given[at] = true;
    for (std::size_t c = 0; c < 4; ++c) {
      int code = 0;
      request.reader().integer(child.children[c], profile.lowest, profile.one, code);
      out.file.value[at][c] = static_cast<s9>(code);
    }
  }
  const bool has_spare0 = out.given[static_cast<std::size_t>(Register::spare0)];
  if (!has_spare0) out.file[Register::spare0][kAlpha] = out.file[Register::texture0][kAlpha];
  return out;
}

// Constants that were given replace the program's own.
void set_given_constants(const GivenRegisters& registers, Program& program) {
  for (const Register constant : {Register::constant0, Register::constant1}) {
    if (!registers.given[static_cast<std::size_t>(constant)]) continue;
    for (std::size_t c = 0; c < 4; ++c)
      replace_constant(program, constant, static_cast<int>(c), registers.file[constant][c]);
  }
}

}  // namespace

Reply convert_text(Request& request) {
  request.allow({"text", "profile", "to"});
  const std::string text = request.word("text"), to = request.word("to");
  const ChosenProfile chosen = request.profile("profile");
  const Form* const form = find_form(to);
  if (!request.failed() && (form == nullptr || form->print == nullptr)) {
    std::string names;
    for (const std::string& name : written_form_names()) names += (names.empty() ? "" : ", ") + name;
    request.reader().fault(request.find("to")->offset,
                           json::in_quotes(to) + " is not a form to write; expected one of " + names);
  }
  if (request.failed()) return request.refused();
  const HardwareProfile& profile = chosen.profile();
  const auto program = valid_program(text, "text", profile);
  if (!program) return refusals(program.faults(), text);
  const auto printed = form->print(*program, chip_of(profile), profile);
  if (!printed) return refusal("cannot be written as " + to + ": " + printed.error().message, "text");
  return Json{{"form", to}, {"text", *printed}};
}

Reply trace_text(Request& request) {
  request.allow({"text", "profile", "registers", "name"});
  const std::string text = request.word("text"), name = request.word_or("name", "");
  const ChosenProfile chosen = request.profile("profile");
  if (request.failed()) return request.refused();
  const HardwareProfile& profile = chosen.profile();
  const GivenRegisters registers = given_registers(request, profile);
  if (request.failed()) return request.refused();
  const auto parsed = valid_program(text, "text", profile);
  if (!parsed) return refusals(parsed.faults(), text);
  Program program = normalize(parsed->state, profile);
  set_given_constants(registers, program);
  RegisterFile file = registers.file;
  // The program has the constants; the trace's registers have none.
  for (const Register reg : {Register::zero, Register::constant0, Register::constant1}) {
    file[reg] = {};
  }
  const Trace traced = trace(program, profile, file);
  return trace_answer({.profile = std::string(profile.name), .program = name, .pixel = nullptr}, &program, &traced);
}

}  // namespace ninebit::playground
