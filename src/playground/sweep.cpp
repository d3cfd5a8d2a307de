// An output of the combiners for each byte of one input: what a pixel's fragment would give if that input had it.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/combiner/trace.h"
#include "ninebit/numerics/fixed9.h"
#include "src/playground/drawing.h"
#include "src/playground/texts.h"

namespace ninebit::playground {
namespace {

constexpr std::string_view kComponents = "rgba";
constexpr std::size_t kMostProfiles = 4;
// The final combiner's result, beside the registers' names.
constexpr std::string_view kFinalName = "out";

// A register, or the final colour, with some of its components: "tex0.r", "out.a", "const0.rgb".
struct Place {
  std::optional<Register> reg{};  // empty: the final colour
  std::vector<std::size_t> components{};
};

std::optional<Place> place_named(std::string_view text) {
  const std::size_t dot = text.find('.');
  if (dot == std::string_view::npos || dot + 1 == text.size()) return std::nullopt;
  Place place;
  const std::string_view name = text.substr(0, dot);
  if (name != kFinalName) {
    place.reg = register_named(name);
    if (!place.reg) return std::nullopt;
  }
  for (const char c : text.substr(dot + 1)) {
    const std::size_t component = kComponents.find(c);
    if (component == std::string_view::npos) return std::nullopt;
    place.components.push_back(component);
  }
  return place;
}

// A stage, or the final combiner after all of them.
struct Output {
  Place place{};
  std::optional<int> stage{};  // empty: the last one
};

Rgba9& constant_of(auto& holder, Register reg) {
  return reg == Register::constant0 ? holder.constant0 : holder.constant1;
}

// Gives the input a code; a constant in all combiners. The hardware loads spare0's alpha from texture 0's, so it has
// the code, too, if it was loaded here.
void set_input(const Place& input, s9 code, Program& program, RegisterFile& registers) {
  const bool is_loaded =
      input.reg == Register::texture0 && registers[Register::spare0][kAlpha] == registers[Register::texture0][kAlpha];
  for (const std::size_t c : input.components) {
    if (!is_constant(*input.reg)) {
      if (is_loaded && c == kAlpha) registers[Register::spare0][c] = code;
      registers[*input.reg][c] = code;
      continue;
    }
    for (ProgramStage& stage : program.general) constant_of(stage, *input.reg)[c] = code;
    constant_of(program, *input.reg)[c] = code;
  }
}

// The input's codes in this fragment; of a constant in the first combiner that reads it.
Rgba9 codes_of_input(Register reg, const Program& program, const RegisterFile& registers) {
  if (!is_constant(reg)) return registers[reg];
  for (const ProgramStage& stage : program.general) {
    if (detail::stage_reads(stage, reg)) {
      return reg == Register::constant0 ? stage.constant0 : stage.constant1;
    }
  }
  return reg == Register::constant0 ? program.constant0 : program.constant1;
}

// The code that all swept components have in this fragment; empty: they differ, and no byte of the sweep is the input.
std::optional<s9> code_of_input(const Place& input, const Program& program, const RegisterFile& registers) {
  const Rgba9 codes = codes_of_input(*input.reg, program, registers);
  const s9 first = codes[input.components[0]];
  const auto has_it = [&](std::size_t c) { return codes[c] == first; };
  return std::all_of(input.components.begin(), input.components.end(), has_it) ? std::optional(first) : std::nullopt;
}

TracedCode value_of_output(const Output& output, const Trace& traced) {
  const std::size_t c = output.place.components[0];
  if (!output.place.reg) {
    return c == kAlpha ? traced.final_combiner.alpha : traced.final_combiner.rgb[c].written;
  }
  const TracedRegisters& after =
      output.stage ? traced.stage[static_cast<std::size_t>(*output.stage)].after : traced.registers();
  const Register reg = *output.place.reg;
  return {after.codes[reg][c], after.real[reg][c], after.ideal[reg][c]};
}

// The output for each byte of the input, under one profile.
Json curve_of(const Program& program, const HardwareProfile& profile, const RegisterFile& registers, const Place& input,
              const Output& output) {
  Json codes = Json::array(), values = Json::array(), exact = Json::array(), at;
  const std::optional<s9> now = code_of_input(input, program, registers);
  for (int byte = 0; byte < 256; ++byte) {
    Program swept = program;
    RegisterFile given = registers;
    const s9 code = from_byte(profile, static_cast<std::uint8_t>(byte));
    if (code == now && at.is_null()) at = byte;
    set_input(input, code, swept, given);
    const TracedCode value = value_of_output(output, trace(swept, profile, given));
    codes.push_back(value.code);
    values.push_back(value.real);
    exact.push_back(value.ideal);
  }
  return {{"profile", profile.name},   {"one", program.datapath.one}, {"at", std::move(at)},
          {"codes", std::move(codes)}, {"values", std::move(values)}, {"exact", std::move(exact)}};
}

Json inputs_of(const Program& program) {
  Json names = Json::array();
  for (const Register reg :
       {Register::texture0, Register::texture1, Register::texture2, Register::texture3, Register::primary,
        Register::secondary, Register::fog, Register::constant0, Register::constant1}) {
    const bool summed = reg == Register::secondary && detail::program_reads(program, Register::spare0_plus_secondary);
    if (summed || detail::program_reads(program, reg)) names.push_back(short_name(reg));
  }
  return names;
}

// What the stages write, in their order, and the final colour.
Json outputs_of(const Program& program) {
  Json all = Json::array();
  const auto add = [&](int stage, const Portion& portion, std::string_view components) {
    for (const Register reg : {portion.out.ab, portion.out.cd, portion.out.sum}) {
      if (reg == Register::discard) continue;
      all.push_back({{"stage", stage}, {"register", short_name(reg)}, {"components", components}});
    }
  };
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    add(i, stage.rgb, "rgb");
    add(i, stage.alpha, "a");
  }
  all.push_back({{"stage", nullptr}, {"register", kFinalName}, {"components", kComponents}});
  return all;
}

// The place under a key, with one component if it is an output.
Place asked_place(Request& request, std::string_view key, bool is_output) {
  const std::string text = request.word(key);
  if (request.failed()) return {};
  if (auto place = place_named(text); place && (is_output ? place->components.size() == 1 : place->reg.has_value())) {
    return std::move(*place);
  }
  const std::string_view expected = is_output ? "out or a register with one component, such as out.r or spare0.a"
                                              : "a register with components, such as tex0.r or const0.rgb";
  request.reader().fault(request.find(key)->offset, std::string(key) + " " + json::in_quotes(text) +
                                                        " is not valid; expected " + std::string(expected));
  return {};
}

Output asked_output(Request& request) {
  Output output{.place = asked_place(request, "output", true)};
  if (request.has("stage")) output.stage = request.number("stage", 0, kMaxGeneralCombiners - 1);
  return output;
}

}  // namespace

Reply Engine::sweep(Request& request) {
  request.allow({"x", "y", "pass", "input", "output", "stage", "profiles"});
  if (!last_) return refusal("nothing was drawn yet");
  const int x = request.number("x", 0, last_->effect.width - 1), y = request.number("y", 0, last_->effect.height - 1);
  const std::string pass = request.word_or("pass", "");
  const Place input = asked_place(request, "input", false);
  const Output output = asked_output(request);
  std::vector<LastDrawing> drawings;
  const json::Value* const profiles = request.find("profiles");
  if (profiles == nullptr) {
    drawings.push_back(*last_);
  } else if (profiles->type != json::Type::array || profiles->children.empty() ||
             profiles->children.size() > kMostProfiles) {
    request.reader().fault(profiles->offset,
                           "profiles must be an array of 1 to " + std::to_string(kMostProfiles) + " profiles");
  } else {
    for (const json::Value& wanted : profiles->children) {
      drawings.push_back(*last_);
      drawings.back().profile = request.profile_in(wanted);
    }
  }
  if (request.failed()) return request.refused();
  Json curves = Json::array(), inputs, outputs;
  for (const LastDrawing& drawing : drawings) {
    const HardwareProfile& profile = drawing.profile.profile();
    KeptDrawing own;
    const bool is_last = drawing.profile.is_same(last_->profile);
    const Probed probed = probe_pixel(drawing, shelf_, {x, y}, pass, is_last ? kept_ : own);
    if (!probed.pixel) return *probed.refused;
    if (probed.program() == nullptr) {
      return refusal("no program drew pixel (" + std::to_string(x) + ", " + std::to_string(y) + ") under profile " +
                     std::string(profile.name));
    }
    const Program& program = *probed.program();
    if (output.stage && *output.stage >= program.num_general_combiners) {
      return refusal("stage " + std::to_string(*output.stage) + " is not there: the program has " +
                     std::to_string(program.num_general_combiners) + " general combiners, counted from 0");
    }
    if (curves.empty()) {
      inputs = inputs_of(program);
      outputs = outputs_of(program);
    }
    curves.push_back(curve_of(program, profile, *probed.registers(), input, output));
  }
  return Json{{"inputs", std::move(inputs)}, {"outputs", std::move(outputs)}, {"curves", std::move(curves)}};
}

}  // namespace ninebit::playground
