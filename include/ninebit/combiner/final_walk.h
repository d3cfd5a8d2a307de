// The walk through the final combiner, defined once for every kind of value: E·F and the colour sum, then
// A·B + (1 - A)·C + D and G. The arithmetic of each step belongs to a value domain; that of codes is
// in arithmetic.inl.
//
// A domain is a class with these members:
//
//   Input, Code                 types: a mapped input; E·F, a colour sum, a result. Default constructible.
//   kEveryStep                  bool: whether E·F and the colour sum are computed even if no variable reads them
//   Input input(const CombinerInput& in, int component)       Fetches a register component and maps it.
//   Input map(InputMapping mapping, const Code& code)         Maps E·F or the colour sum.
//   Code product(const Input& e, const Input& f)              Rule 10.
//   Input sum_part(bool inverted, Register r, int component)  spare0 or the secondary colour in the colour sum.
//   Code sum(bool clamp, const Input& spare0, const Input& secondary)                      Rule 13.
//   Code rgb(int channel, const Input& a, const Input& b, const Input& c, const Input& d)  Rules 9 and 14.
//   Code alpha(const Input& g)                                                             Rule 14.
//
// The domains:
//
//   codes                       evaluate.h, the reference; src/study/vectors/mistaken_codes.h
//   exact fractions, floats     src/combiner/real_rules.h
//   values with their ranges    src/combiner/batch_compiler.cpp, which makes vector operations of them
//   text                        src/language/emit/emit_program.cpp
//   sets of inputs              src/study/datapath/color_inputs.cpp
#pragma once

#include <array>
#include <cstddef>

#include "ninebit/combiner/portion_walk.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {
namespace detail {

// The values of the final combiner on the walk, by component. What is not computed is untouched.
template <class Domain>
struct FinalSteps {
  std::array<std::array<typename Domain::Input, 4>, 6> input{};   // A to F; no alpha
  std::array<typename Domain::Code, 4> e_times_f{}, color_sum{};  // no alpha
  typename Domain::Input g{};
  std::array<typename Domain::Code, 4> color{};
};

// Returns a variable's value in a channel: a register's component, E·F or the colour sum, mapped.
template <class Domain>
constexpr typename Domain::Input final_input(Domain& domain, const CombinerInput& in, int channel,
                                             const FinalSteps<Domain>& steps) {
  const int component = component_of(in.usage, channel);
  const auto i = static_cast<std::size_t>(component);
  if (in.reg == Register::e_times_f) return domain.map(in.mapping, steps.e_times_f[i]);
  if (in.reg == Register::spare0_plus_secondary) return domain.map(in.mapping, steps.color_sum[i]);
  return domain.input(in, component);
}

// The components of a colour that are wanted where all are.
inline constexpr std::array<bool, 4> kWholeColor{true, true, true, true};

// Computes the wanted components of the colour.
template <class Domain>
constexpr void walk_final(Domain& domain, const Program& program, FinalSteps<Domain>& steps,
                          const std::array<bool, 4>& wanted = kWholeColor) {
  const FinalCombiner& f = program.final_combiner;
  if (Domain::kEveryStep || reads_directly(f, Register::e_times_f)) {
    for (int channel = 0; channel < 3; ++channel) {
      const auto c = static_cast<std::size_t>(channel);
      steps.input[4][c] = domain.input(f.e, component_of(f.e.usage, channel));
      steps.input[5][c] = domain.input(f.f, component_of(f.f.usage, channel));
      steps.e_times_f[c] = domain.product(steps.input[4][c], steps.input[5][c]);
    }
  }
  if (Domain::kEveryStep || reads_directly(f, Register::spare0_plus_secondary)) {
    for (int channel = 0; channel < 3; ++channel) {
      steps.color_sum[static_cast<std::size_t>(channel)] = domain.sum(
          program.color_sum_clamp, domain.sum_part(program.color_sum_invert_spare0, Register::spare0, channel),
          domain.sum_part(program.color_sum_invert_secondary, Register::secondary, channel));
    }
  }
  for (int channel = 0; channel < 3; ++channel) {
    const auto c = static_cast<std::size_t>(channel);
    if (!wanted[c]) continue;
    steps.input[0][c] = final_input(domain, f.a, channel, steps);
    steps.input[1][c] = final_input(domain, f.b, channel, steps);
    steps.input[2][c] = final_input(domain, f.c, channel, steps);
    steps.input[3][c] = final_input(domain, f.d, channel, steps);
    steps.color[c] = domain.rgb(channel, steps.input[0][c], steps.input[1][c], steps.input[2][c], steps.input[3][c]);
  }
  if (!wanted[kAlpha]) return;
  steps.g = final_input(domain, f.g, kAlpha, steps);
  steps.color[kAlpha] = domain.alpha(steps.g);
}

}  // namespace detail
}  // namespace ninebit
