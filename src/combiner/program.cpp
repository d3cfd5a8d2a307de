#include "ninebit/combiner/program.h"

#include <algorithm>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/state.h"

namespace ninebit {
namespace {

constexpr ConstantName kStageNames = kConstantNames - 2 * kMaxGeneralCombiners;

}  // namespace

std::string name_of_constant(ConstantName name) {
  if (name < kStageNames) return "const" + std::to_string(name);
  const int at = name - kStageNames;
  return "stage" + std::to_string(at / 2) + ".const" + std::to_string(at % 2);
}

std::optional<ConstantName> constant_called(std::string_view name) {
  for (std::size_t i = 0; i < kConstantNames; ++i) {
    if (name_of_constant(static_cast<ConstantName>(i)) == name) return static_cast<ConstantName>(i);
  }
  return std::nullopt;
}

ByConstant<bool> constants_read(const CombinerState& state) {
  ByConstant<bool> all{};
  const auto stages = static_cast<std::size_t>(std::clamp(state.num_general_combiners, 0, kMaxGeneralCombiners));
  for (std::size_t which = 0; which < 2; ++which) {
    const Register reg = which == 0 ? Register::constant0 : Register::constant1;
    for (std::size_t i = 0; i < stages; ++i) {
      const GeneralCombiner& stage = state.general[i];
      all[i][which] = detail::reads(detail::normalize_portion(stage.rgb), reg) ||
                      detail::reads(detail::normalize_portion(stage.alpha), reg);
    }
    all[kFinalConstants][which] = detail::final_reads(detail::normalize_final(state.final_combiner), reg);
  }
  return all;
}

std::vector<ConstantName> unset_constants(const Program& program) {
  std::vector<ConstantName> names;
  const auto add = [&](const std::array<std::optional<ConstantName>, 2>& unset) {
    for (const auto& name : unset) {
      if (name && std::find(names.begin(), names.end(), *name) == names.end()) names.push_back(*name);
    }
  };
  for (const ProgramStage& stage : program.general) add(stage.unset);
  add(program.unset);
  return names;
}

bool free_constant(CombinerState& state, ConstantName name) {
  const ByConstant<bool> read = constants_read(state);
  bool found = false;
  for (std::size_t place = 0; place <= kFinalConstants; ++place) {
    for (std::size_t which = 0; which < 2; ++which) {
      if (!read[place][which] || constant_name(state, place, which) != name) continue;
      state.origin[place][which].unset = found = true;
    }
  }
  return found;
}

bool is_shared_constant_unset(const CombinerState& state, std::size_t which) {
  bool unset = state.origin[kFinalConstants][which].unset;
  for (std::size_t i = 0; i < kFinalConstants && !state.per_stage_constants; ++i) {
    unset = unset || state.origin[i][which].unset;
  }
  return unset;
}

void mark_unset_constants(CombinerState& state, const ByConstant<bool>& given) {
  const ByConstant<bool> read = constants_read(state);
  for (std::size_t place = 0; place <= kFinalConstants; ++place) {
    const std::size_t from = state.per_stage_constants ? place : kFinalConstants;
    for (std::size_t which = 0; which < 2; ++which) {
      state.origin[place][which].unset = read[place][which] && !given[from][which];
    }
  }
}

Result<Program> compile(const CombinerState& state, const HardwareProfile& profile) {
  const std::vector<StateDiagnostic> faults = validate(state, profile);
  if (faults.empty()) return normalize(state, profile);
  std::string message;
  for (const StateDiagnostic& fault : faults) {
    if (!message.empty()) message += '\n';
    message += fault.message;
  }
  return Diagnostic{.message = message};
}

}  // namespace ninebit
