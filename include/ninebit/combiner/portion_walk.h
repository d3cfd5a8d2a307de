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
//   sets of an index's digits   src/study/digits/digit_flow.cpp
#pragma once

#include <array>
#include <cstddef>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/registers.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {
namespace detail {

// The register component that an input with this usage reads for channel `channel` of its portion: 0 to 2 of an RGB
// portion, 0 of an alpha portion.
constexpr int component_of(ComponentUsage usage, int channel) {
  return usage == ComponentUsage::rgb ? channel : usage == ComponentUsage::alpha ? kAlpha : kBlue;
}

// The components [first, end) that a portion writes: one for each of its channels.
struct Components {
  int first = kRed, end = kAlpha;
};
constexpr Components components_of(PortionName name) {
  return name == PortionName::rgb ? Components{kRed, kAlpha} : Components{kAlpha, kAlpha + 1};
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

// Calls put(register, component) for everything that an output writes in its channel: the channel's component and, with
// blue to alpha, the blue also to the alpha (rule 23). Calls nothing for a discarded output.
template <class Put>
constexpr void for_each_write(const Target& target, const Put& put) {
  const PortionOutput& out = target.out;
  const Register to = register_of(out, target.k);
  if (to == Register::discard) return;
  put(to, target.component);
  const bool blue_to_alpha = target.k == 0 ? out.ab_blue_to_alpha : target.k == 1 && out.cd_blue_to_alpha;
  if (blue_to_alpha && target.component == kBlue) put(to, kAlpha);
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

// Computes a portion's outputs. A portion that writes nothing leaves `steps` unchanged. `kName` is a template argument
// because the compiler then unrolls the channels, which makes the reference faster by a tenth.
template <PortionName kName, class Domain>
constexpr void compute_portion(Domain& domain, const Portion& portion, StageSteps<Domain>& steps) {
  const PortionOutput& out = portion.out;
  if (!is_live(out)) return;
  constexpr int kFirst = components_of(kName).first, kEnd = components_of(kName).end;
  const auto at = [&](int component) -> ChannelSteps<Domain>& { return steps[static_cast<std::size_t>(component)]; };

  const auto products = [&](std::size_t k, const CombinerInput& x, const CombinerInput& y, bool dot) {
    for (int c = kFirst; c < kEnd; ++c) {
      auto& input = at(c).input;
      input[2 * k] = domain.input(x, component_of(x.usage, c - kFirst));
      input[2 * k + 1] = domain.input(y, component_of(y.usage, c - kFirst));
      at(c).wide[k] = domain.product(input[2 * k], input[2 * k + 1]);
    }
    if (!dot) return;
    typename Domain::Wide total = at(kFirst).wide[k];
    for (int c = kFirst + 1; c < kEnd; ++c) total = domain.sum(total, at(c).wide[k]);
    if constexpr (requires { domain.name_dot_product(Variable::a, total); }) {
      domain.name_dot_product(k == 0 ? Variable::a : Variable::c, total);
    }
    for (int c = kFirst; c < kEnd; ++c) at(c).wide[k] = total;
  };
  products(0, portion.a, portion.b, out.ab_dot_product);
  products(1, portion.c, portion.d, out.cd_dot_product);

  for (int c = kFirst; c < kEnd; ++c) {
    auto& wide = at(c).wide;
    auto& output = at(c).output;
    if (out.ab != Register::discard) output[0] = domain.output({out, 0, c}, wide[0]);
    if (out.cd != Register::discard) output[1] = domain.output({out, 1, c}, wide[1]);
    if (out.sum == Register::discard) continue;
    wide[2] = out.mux_sum ? domain.mux(wide[0], wide[1]) : domain.sum(wide[0], wide[1]);
    output[2] = domain.output({out, 2, c}, wide[2]);
  }
}

// Writes a portion's outputs.
template <PortionName kName, class Domain>
constexpr void write_portion(Domain& domain, const PortionOutput& out, const StageSteps<Domain>& steps) {
  constexpr int kFirst = components_of(kName).first, kEnd = components_of(kName).end;
  for (int c = kFirst; c < kEnd; ++c) {
    const auto& channel = steps[static_cast<std::size_t>(c)];
    for (std::size_t k = 0; k < 3; ++k) {
      for_each_write({out, k, c}, [&](Register to, int i) { domain.write(to, i, channel.output[k]); });
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
