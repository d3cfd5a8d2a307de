// The same program in another form, its trace, and what it makes of pictures.
#include <algorithm>
#include <utility>

#include "ninebit/combiner/evaluate_arrays.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/numerics/fixed9.h"
#include "src/combiner/given_registers.h"
#include "src/effect/traced_pixel.h"
#include "src/playground/texts.h"

namespace ninebit::playground {
namespace {

// The registers of a trace, and which of them were given.
struct RequestRegisters {
  RegisterFile file{};
  std::array<bool, kRegisterCount> given{};
};

std::optional<Register> register_called(std::string_view name, const HardwareProfile& profile) {
  const std::optional<Register> reg = register_named(name);
  if (reg && is_texture(*reg) && texture_unit_of(*reg) >= profile.texture_units) return std::nullopt;
  return reg;
}

RequestRegisters request_registers(Request& request, const HardwareProfile& profile) {
  RequestRegisters out{.file = default_registers(profile)};
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
void set_given_constants(const RequestRegisters& registers, Program& program) {
  for (const Register constant : {Register::constant0, Register::constant1}) {
    if (!registers.given[static_cast<std::size_t>(constant)]) continue;
    for (std::size_t c = 0; c < 4; ++c)
      replace_constant(program, constant, static_cast<int>(c), registers.file[constant][c]);
  }
}

}  // namespace

Reply convert_text(Request& request) {
  request.allow({"text", "profile", "to", "name", "files", "choice"});
  const std::string text = request.word("text"), to = request.word("to"), name = request.word_or("name", "text");
  const FileTexts files = request.texts("files");
  const SourceSelection choice = request.choice();
  const ChosenProfile chosen = request.profile("profile");
  const Form* const form = find_form(to);
  if (!request.failed() && (form == nullptr || form->print == nullptr)) {
    std::string names;
    for (const std::string& one : written_form_names()) names += (names.empty() ? "" : ", ") + one;
    request.reader().fault(request.find("to")->offset,
                           json::in_quotes(to) + " is not a form to write; expected one of " + names);
  }
  if (request.failed()) return request.refused();
  const HardwareProfile& profile = chosen.profile();
  const auto program = valid_program({text, name}, profile, files, choice);
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
  const RequestRegisters registers = request_registers(request, profile);
  if (request.failed()) return request.refused();
  const auto parsed = valid_program({text, "text"}, profile);
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

Reply evaluate_pictures(Request& request, std::span<const std::uint8_t> buffer, std::vector<std::uint8_t>& bytes) {
  request.allow({"text", "profile", "pictures", "registers"});
  const std::string text = request.word("text");
  const ChosenProfile chosen = request.profile("profile");
  const json::Value* const named = request.value("pictures");
  if (request.failed()) return request.refused();
  const HardwareProfile& profile = chosen.profile();
  const RequestRegisters registers = request_registers(request, profile);
  std::vector<Register> pictures;
  if (named->type != json::Type::array || named->children.empty()) {
    request.reader().wrong_type(*named, "an array of registers");
    return request.refused();
  }
  for (const json::Value& child : named->children) {
    const std::string name = request.inner(child);
    const auto reg = register_called(name, profile);
    constexpr std::array kNoPictures{Register::zero, Register::constant0, Register::constant1};
    const auto is_in = [&](const auto& list) { return std::find(list.begin(), list.end(), *reg) != list.end(); };
    if (!reg || is_in(kNoPictures) || is_in(pictures)) {
      request.reader().fault(child.offset, json::in_quotes(name) + " is not a register for a picture; expected fog, " +
                                               "primary, secondary, spare0, spare1 or a texture, each once");
      continue;
    }
    pictures.push_back(*reg);
  }
  if (request.failed()) return request.refused();
  const std::size_t pixel = 4 * pictures.size();
  if (buffer.empty() || buffer.size() % pixel != 0) {
    return refusal("the buffer has " + std::to_string(buffer.size()) + " bytes; expected " +
                   std::to_string(pictures.size()) + " pictures of the same size, four bytes a pixel");
  }
  const auto parsed = valid_program({text, "text"}, profile);
  if (!parsed) return refusals(parsed.faults(), text);
  Program program = normalize(parsed->state, profile);
  set_given_constants(registers, program);

  std::vector<s9> codes(buffer.size());
  std::transform(buffer.begin(), buffer.end(), codes.begin(),
                 [&](std::uint8_t byte) { return from_byte(profile, byte); });
  FragmentArrays arrays{.count = buffer.size() / pixel, .otherwise = registers.file};
  constexpr std::ptrdiff_t kStride = 4 * sizeof(s9);
  for (std::size_t i = 0; i < pictures.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const s9* const first = codes.data() + 4 * arrays.count * i + c;
      arrays.input[static_cast<std::size_t>(pictures[i])][c] = {first, kStride, ElementType::code};
    }
  }
  // As in `ninebit eval`, spare0's alpha starts as texture 0's, unless it is given.
  const auto& texture0 = arrays.input[static_cast<std::size_t>(Register::texture0)];
  auto& spare0 = arrays.input[static_cast<std::size_t>(Register::spare0)];
  const bool is_given = registers.given[static_cast<std::size_t>(Register::spare0)] || spare0[kAlpha].first != nullptr;
  if (!is_given) spare0[kAlpha] = texture0[kAlpha];
  std::vector<s9> colors(4 * arrays.count);
  for (std::size_t c = 0; c < 4; ++c) arrays.color[c] = {colors.data() + c, kStride, ElementType::code};
  evaluate(BatchProgram(program), arrays, 0, arrays.count);
  bytes.resize(colors.size());
  std::transform(colors.begin(), colors.end(), bytes.begin(), [&](s9 code) { return to_byte(profile, code); });
  return Json{{"pixels", arrays.count}, {"bytes", bytes.size()}};
}

}  // namespace ninebit::playground
