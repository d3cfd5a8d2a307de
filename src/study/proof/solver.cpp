#include "src/study/proof/solver.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/language/smt_lib.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/system/child_program.h"

namespace ninebit::proof {
namespace {

SmtProgram question_side(const ProofSide& side) {
  SmtProgram program{&side.program, {}, {}};
  for (const int i : side.components) {
    const Source& from = side.start[static_cast<std::size_t>(i)];
    const ProofInput named = input_at(i, 0);
    auto& group = named.constant ? program.unset[*named.constant] : program.start[static_cast<std::size_t>(named.reg)];
    SmtSource& to = group[static_cast<std::size_t>(named.component)];
    to.code = from.code;
    to.byte_shift = side.profile.byte_shift;
    if (from.input >= 0) to.input = input_at(from.input, 0).name();
  }
  return program;
}

// The values of a line "((|tex0.r| #x10) (|tex1.r| #b00000001))", in the order of the question's inputs.
std::optional<InputBytes> values_of(std::string_view text, const SmtQuestion& question) {
  InputBytes bytes{};
  for (int i = 0; i < kComponents; ++i) {
    const std::string name = '|' + input_at(i, 0).name() + "| ";
    const auto at = text.find(name);
    if (at == std::string_view::npos) continue;
    const std::string_view value = text.substr(at + name.size());
    if (value.size() < 3 || value[0] != '#') return std::nullopt;
    const int base = value[1] == 'x' ? 16 : 2;
    const auto read =
        std::from_chars(value.data() + 2, value.data() + value.size(), bytes[static_cast<std::size_t>(i)], base);
    if (read.ec != std::errc{}) return std::nullopt;
  }
  return question.inputs.empty() || text.find("((") != std::string_view::npos ? std::optional(bytes) : std::nullopt;
}

SolverAnswer unknown(std::string reason) {
  return {ProofAnswer::unknown, {}, std::move(reason)};
}

}  // namespace

bool has_formulas(const std::array<ProofSide, 2>& sides, const ProofTarget& target) {
  return sides[0].is_integer() && sides[1].is_integer() && !target.reg &&
         sides[0].profile.byte_shift.value == sides[1].profile.byte_shift.value;
}

bool same_formula(const std::array<ProofSide, 2>& sides, const ProofTarget& target) {
  if (!has_formulas(sides, target)) return false;
  const auto question = emit_smt_lib(question_side(sides[0]), question_side(sides[1]), target.component);
  return question.ok() && question->trivial;
}

Result<SolverAnswer> solve(const std::array<ProofSide, 2>& sides, const ProofTarget& target, const std::string& solver,
                           double timeout_s, const std::function<bool()>& go_on) {
  const auto question = emit_smt_lib(question_side(sides[0]), question_side(sides[1]), target.component);
  if (!question) return question.error();
  const posix::ProgramResult run = posix::run_program({solver, "-in"}, question->text, timeout_s, go_on);
  switch (run.end) {
    case posix::ProgramEnd::ended:
      break;
    case posix::ProgramEnd::stopped:
      return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    case posix::ProgramEnd::out_of_time:
      return unknown("the solver found no answer in time");
    case posix::ProgramEnd::not_found:
      return unknown(
          fmt::format("too many cases to run, and the PATH has no solver {0}; install the package {0}", solver));
    case posix::ProgramEnd::crashed:
    case posix::ProgramEnd::failed:
      return unknown(fmt::format("the solver {} ended without an answer", solver));
  }
  const std::string_view output = run.output;
  if (output.substr(0, 6) == "unsat\n") return SolverAnswer{ProofAnswer::proved, {}, {}};
  if (output.substr(0, 4) == "sat\n") {
    if (const auto bytes = values_of(output, *question)) return SolverAnswer{ProofAnswer::refuted, *bytes, {}};
  }
  return unknown(fmt::format("the solver {} answered neither sat nor unsat", solver));
}

namespace {

using HardwareProfiles = std::array<const HardwareProfile*, 2>;
using Datapaths = std::array<Datapath, 2>;

// The registers at the start of a fragment whose bytes are all the same.
RegisterFile registers_of_byte(const HardwareProfile& profile, std::uint8_t byte, int texture_off, bool fog) {
  FragmentInputs inputs;
  inputs.primary.fill(byte);
  inputs.secondary.fill(byte);
  inputs.fog_color.fill(byte);
  if (fog) inputs.fog_factor = byte;
  for (int unit = 0; unit < profile.texture_units.value; ++unit) {
    if (unit == texture_off) continue;
    inputs.texture[static_cast<std::size_t>(unit)] = Texel{.value = {byte, byte, byte, byte}};
  }
  return initial_registers(profile, inputs);
}

bool same_start(const HardwareProfiles& p, std::uint64_t& cases) {
  const int units = std::min(p[0]->texture_units.value, p[1]->texture_units.value);
  for (int byte = 0; byte < 256; ++byte) {
    for (int off = -1; off <= units; ++off) {  // `units`: fog is off
      ++cases;
      std::array<RegisterFile, 2> registers;
      for (std::size_t side = 0; side < 2; ++side) {
        registers[side] =
            registers_of_byte(*p[side], static_cast<std::uint8_t>(byte), off == units ? -1 : off, off != units);
        // Units that one of them alone has are no part of a program for both.
        for (int unit = units; unit < 4; ++unit) registers[side][texture_register(unit)] = {};
      }
      if (registers[0] != registers[1]) return false;
    }
  }
  return true;
}

bool same_final_combiner(const HardwareProfiles& p, const Datapaths& d, std::uint64_t& cases) {
  const int one = d[0].one;
  for (int code = 0; code <= one; ++code) {
    if (to_byte(*p[0], static_cast<s9>(code)) != to_byte(*p[1], static_cast<s9>(code))) return false;
  }
  // Mappings, colour sum and clamps contain nothing but `one`. E·F is narrowed as the mix is, of fewer values.
  const int most = 2 * one * one;
  cases += static_cast<std::uint64_t>(most + 1);
  for (int mix = 0; mix <= most; ++mix) {
    if (reference::narrow_mix(d[0], mix) != reference::narrow_mix(d[1], mix)) return false;
  }
  for (int e = 0; e <= one; ++e) {
    for (int f = 0; f <= one; ++f) {
      if (reference::e_times_f(d[0], e, f) != reference::e_times_f(d[1], e, f)) return false;
    }
  }
  cases += static_cast<std::uint64_t>((one + 1) * (one + 1));
  return true;
}

// Whether the mappings and the mux agree for codes in [low, one].
bool same_inputs(const Datapaths& d, int low, std::uint64_t& cases) {
  for (int code = low; code <= d[0].one; ++code) {
    for (const InputMapping mapping : kInputMappings) {
      ++cases;
      if (reference::map_input(d[0], mapping, code) != reference::map_input(d[1], mapping, code)) return false;
    }
    for (const bool by_lowest_bit : {false, true}) {
      ++cases;
      if (reference::mux(d[0], by_lowest_bit, code, 0, 1) != reference::mux(d[1], by_lowest_bit, code, 0, 1))
        return false;
    }
  }
  return true;
}

struct OutputAgreement {
  bool all = true;
  bool visible = true;  // as far as an output is above 0
};

// Whether a general combiner's output agrees for every wide value.
OutputAgreement same_outputs(const Datapaths& d, std::uint64_t& cases) {
  // A factor's magnitude is at most one + 1; a dot product has three products, a sum two.
  const int most = 3 * (d[0].one + 1) * (d[0].one + 1);
  OutputAgreement agree;
  for (const Bias bias : {Bias::none, Bias::by_negative_one_half}) {
    for (const Scale scale : {Scale::none, Scale::by_two, Scale::by_four, Scale::by_one_half}) {
      for (int wide = -most; wide <= most && agree.visible; ++wide) {
        ++cases;
        const int x = reference::combiner_output(d[0], scale, bias, wide),
                  y = reference::combiner_output(d[1], scale, bias, wide);
        agree.all = agree.all && x == y;
        agree.visible = std::max(x, 0) == std::max(y, 0);
      }
    }
  }
  agree.all = agree.all && agree.visible;
  return agree;
}

}  // namespace

StepAgreement compare_steps(const HardwareProfile& a, const HardwareProfile& b) {
  StepAgreement agreement;
  if (a.one.value != b.one.value) return agreement;  // other codes altogether
  const HardwareProfiles p{&a, &b};
  const Datapaths d{datapath_of(a), datapath_of(b)};
  std::uint64_t& cases = agreement.cases;
  agreement.start = same_start(p, cases);
  if (d[0] == d[1]) {
    agreement.final_combiner = agreement.byte_stage = agreement.any_stage = true;
    return agreement;
  }
  if (a.arithmetic != Arithmetic::integer || b.arithmetic != Arithmetic::integer) return agreement;
  agreement.final_combiner = same_final_combiner(p, d, cases);
  const OutputAgreement outputs = same_outputs(d, cases);
  agreement.byte_stage = same_inputs(d, 0, cases) && outputs.visible;
  // Registers hold initial codes, which are not negative, or outputs.
  const int low = std::min(d[0].lowest_output, d[1].lowest_output);
  agreement.any_stage = outputs.all && same_inputs(d, low, cases);
  return agreement;
}

}  // namespace ninebit::proof
