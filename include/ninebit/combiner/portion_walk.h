// The walk through a portion of a general combiner, defined once for every kind of value: fetch, map, product or dot
// product, sum or mux, output, write. The arithmetic of each step belongs to a value domain; that of codes is
// in arithmetic.inl.
//
// A domain is a class with these members:
//
//   Input, Wide, Output         types: a mapped input; a product or sum; what a register gets. Default constructible.
//   Input input(const CombinerInput& in, int component)       Fetches a register component and maps it.
//   Wide product(const Input& x, const Input& y)
//   Wide sum(const Wide& x, const Wide& y)
//   Wide mux(const Wide& ab, const Wide& cd)                  The choice of rule 11.
//   Output output(const Target& target, const Wide& wide)     Bias, scale, narrowing, clamp: rules 3 to 8.
//   void write(Register to, int component, const Output& value)
//   void name_dot_product(Variable first, Wide& total)        Optional. `first` is the product's first factor, A or C.
//
// The domains:
//
//   codes                       evaluate.h, the reference; src/combiner/trace.cpp; src/study/vectors/mistaken_codes.h
//   exact fractions, floats     src/combiner/real_rules.h
//   values with their ranges    src/combiner/batch_compiler.cpp, which makes vector operations of them
//   text                        src/language/emit/emit_program.cpp
//   sets of inputs              src/study/datapath/color_inputs.cpp
//   sets of an index's digits   src/study/digits/digit_flow.cpp
#pragma once

#include <array>
#include <cstddef>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {
namespace detail {

// The register component that an input with this usage reads for channel `channel` of its portion: 0 to 2 of an RGB
// portion, 0 of an alpha portion.
constexpr int component_of(ComponentUsage usage, int channel) {
  return usage == ComponentUsage::rgb ? channel : usage == ComponentUsage::alpha ? kAlpha : kBlue;
}

// The components [first, end) that a portion writes: one for each of its channels.
constexpr int first_component(PortionName name) {
  return name == PortionName::rgb ? kRed : kAlpha;
}
constexpr int end_component(PortionName name) {
  return name == PortionName::rgb ? kAlpha : kAlpha + 1;
}

// One of a portion's outputs in one of its channels.
struct Target {
  const PortionOutput& out;
  std::size_t k;  // 0 AB, 1 CD, 2 the third: sum or mux
  int component;  // that the channel writes
};

// The register of output k of a portion.
constexpr Register register_of(const PortionOutput& out, std::size_t k) {
  return k == 0 ? out.ab : k == 1 ? out.cd : out.sum;
}

// Whether output k also goes to the alpha of its register in this channel: its blue, with blue to alpha (rule 23).
constexpr bool copies_to_alpha(const PortionOutput& out, std::size_t k, int component) {
  return component == kBlue && (k == 0 ? out.ab_blue_to_alpha : k == 1 && out.cd_blue_to_alpha);
}

// Calls put(register, component) for everything that an output writes in its channel: the channel's component and, with
// blue to alpha, the alpha. Calls nothing for a discarded output.
template <class Put>
constexpr void for_each_write(const Target& target, const Put& put) {
  const Register to = register_of(target.out, target.k);
  if (to == Register::discard) return;
  put(to, target.component);
  if (copies_to_alpha(target.out, target.k, target.component)) put(to, kAlpha);
}

// The values of one channel on the walk. Outputs that are discarded are not touched.
template <class Domain>
struct ChannelSteps {
  std::array<typename Domain::Input, 4> input{};    // A to D
  std::array<typename Domain::Wide, 3> wide{};      // AB, CD and the third
  std::array<typename Domain::Output, 3> output{};  // of these
};
// By component: red, green and blue are the RGB portion's channels, alpha is the alpha portion's.
template <class Domain>
using StageSteps = std::array<ChannelSteps<Domain>, 4>;

// Computes product k, A·B or C·D, in all channels of its portion. `kName` is a template argument because the compiler
// then unrolls the channels, which makes the reference faster by a tenth.
template <PortionName kName, class Domain>
constexpr void compute_product(Domain& domain, std::size_t k, const CombinerInput& x, const CombinerInput& y, bool dot,
                               StageSteps<Domain>& steps) {
  constexpr int kFirst = first_component(kName), kEnd = end_component(kName);
  for (int c = kFirst; c < kEnd; ++c) {
    ChannelSteps<Domain>& at = steps[static_cast<std::size_t>(c)];
    at.input[2 * k] = domain.input(x, component_of(x.usage, c - kFirst));
    at.input[2 * k + 1] = domain.input(y, component_of(y.usage, c - kFirst));
    at.wide[k] = domain.product(at.input[2 * k], at.input[2 * k + 1]);
  }
  if (!dot) return;
  typename Domain::Wide total = steps[static_cast<std::size_t>(kFirst)].wide[k];
  for (int c = kFirst + 1; c < kEnd; ++c) total = domain.sum(total, steps[static_cast<std::size_t>(c)].wide[k]);
  if constexpr (requires { domain.name_dot_product(Variable::a, total); }) {
    domain.name_dot_product(k == 0 ? Variable::a : Variable::c, total);
  }
  for (int c = kFirst; c < kEnd; ++c) steps[static_cast<std::size_t>(c)].wide[k] = total;
}

// Computes a portion's outputs. A portion that writes nothing leaves `steps` unchanged.
template <PortionName kName, class Domain>
constexpr void compute_portion(Domain& domain, const Portion& portion, StageSteps<Domain>& steps) {
  const PortionOutput& out = portion.out;
  if (!is_live(out)) return;
  compute_product<kName>(domain, 0, portion.a, portion.b, out.ab_dot_product, steps);
  compute_product<kName>(domain, 1, portion.c, portion.d, out.cd_dot_product, steps);
  for (int c = first_component(kName); c < end_component(kName); ++c) {
    ChannelSteps<Domain>& at = steps[static_cast<std::size_t>(c)];
    if (out.ab != Register::discard) at.output[0] = domain.output(Target{out, 0, c}, at.wide[0]);
    if (out.cd != Register::discard) at.output[1] = domain.output(Target{out, 1, c}, at.wide[1]);
    if (out.sum == Register::discard) continue;
    at.wide[2] = out.mux_sum ? domain.mux(at.wide[0], at.wide[1]) : domain.sum(at.wide[0], at.wide[1]);
    at.output[2] = domain.output(Target{out, 2, c}, at.wide[2]);
  }
}

// Writes a portion's outputs.
template <PortionName kName, class Domain>
constexpr void write_portion(Domain& domain, const PortionOutput& out, const StageSteps<Domain>& steps) {
  for (int c = first_component(kName); c < end_component(kName); ++c) {
    const ChannelSteps<Domain>& at = steps[static_cast<std::size_t>(c)];
    for (std::size_t k = 0; k < 3; ++k) {
      const Register to = register_of(out, k);
      if (to == Register::discard) continue;
      domain.write(to, c, at.output[k]);
      if (copies_to_alpha(out, k, c)) domain.write(to, kAlpha, at.output[k]);
    }
  }
}

// Runs a general combiner. Both portions read all of their inputs before either writes (rule 12).
template <class Domain>
constexpr void walk_stage(Domain& domain, const ProgramStage& stage, StageSteps<Domain>& steps) {
  compute_portion<PortionName::rgb>(domain, stage.rgb, steps);
  compute_portion<PortionName::alpha>(domain, stage.alpha, steps);
  write_portion<PortionName::rgb>(domain, stage.rgb.out, steps);
  write_portion<PortionName::alpha>(domain, stage.alpha.out, steps);
}

}  // namespace detail
}  // namespace ninebit
