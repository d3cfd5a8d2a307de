#include "src/combiner/given_registers.h"

#include <algorithm>

#include "ninebit/combiner/initial_registers.h"

namespace ninebit {

RegisterFile default_registers(const HardwareProfile& profile) {
  RegisterFile file = initial_registers(profile, {});
  file[Register::spare0][kAlpha] = file[Register::texture0][kAlpha];
  return file;
}

void replace_constant(Program& program, Register constant, int component, s9 code) {
  const auto i = static_cast<std::size_t>(component);
  const bool first = constant == Register::constant0;
  for (ProgramStage& stage : program.general) (first ? stage.constant0 : stage.constant1)[i] = code;
  (first ? program.constant0 : program.constant1)[i] = code;
}

std::vector<UnsetComponent> unset_components(const Program& program) {
  std::vector<UnsetComponent> all;
  const auto add = [&](const CombinerInput& in, const std::array<std::optional<ConstantName>, 2>& unset) {
    if (in.reg != Register::constant0 && in.reg != Register::constant1) return;
    const auto& name = unset[in.reg == Register::constant0 ? 0 : 1];
    for (int channel = kRed; name && channel < kAlpha; ++channel) {
      const UnsetComponent one{*name, in.reg, reference::component_of(in.usage, channel)};
      if (std::find(all.begin(), all.end(), one) == all.end()) all.push_back(one);
    }
  };
  for (const ProgramStage& stage : program.general) {
    for (const Portion* p : {&stage.rgb, &stage.alpha}) {
      for (const CombinerInput& in : {p->a, p->b, p->c, p->d}) add(in, stage.unset);
    }
  }
  const FinalCombiner& f = program.final_combiner;
  for (const CombinerInput& in : {f.a, f.b, f.c, f.d, f.e, f.f, f.g}) add(in, program.unset);
  return all;
}

std::optional<std::array<std::optional<ConstantName>, 2>> varying_constants(const Program& program) {
  std::array<std::optional<ConstantName>, 2> varying;
  for (std::size_t which = 0; which < 2; ++which) {
    const Register reg = which == 0 ? Register::constant0 : Register::constant1;
    bool is_set = false;  // somewhere
    const auto add = [&](bool read, const std::optional<ConstantName>& unset) {
      const bool fits = !read || (unset ? !is_set && (!varying[which] || varying[which] == unset) : !varying[which]);
      if (read && unset) varying[which] = unset;
      is_set = is_set || (read && !unset);
      return fits;
    };
    for (const ProgramStage& stage : program.general) {
      if (!add(detail::stage_reads(stage, reg), stage.unset[which])) return std::nullopt;
    }
    if (!add(detail::final_reads(program.final_combiner, reg), program.unset[which])) return std::nullopt;
  }
  return varying;
}

void replace_unset_constant(Program& program, ConstantName name, int component, s9 code) {
  const auto i = static_cast<std::size_t>(component);
  const auto replace = [&](const std::array<std::optional<ConstantName>, 2>& unset, Rgba9& constant0,
                           Rgba9& constant1) {
    if (unset[0] == name) constant0[i] = code;
    if (unset[1] == name) constant1[i] = code;
  };
  for (ProgramStage& stage : program.general) replace(stage.unset, stage.constant0, stage.constant1);
  replace(program.unset, program.constant0, program.constant1);
}

}  // namespace ninebit
