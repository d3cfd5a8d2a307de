#include "src/study/proof/solver.h"

#include <fmt/format.h>

#include <charconv>

#include "ninebit/language/smt_lib.h"
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

}  // namespace ninebit::proof
