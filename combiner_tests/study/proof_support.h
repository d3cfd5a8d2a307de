// Shared by the tests of proofs.
#pragma once

#include <array>
#include <stdexcept>
#include <string>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/rc10.h"
#include "ninebit/numerics/fixed9.h"
#include "ninebit/study/discriminate.h"
#include "ninebit/study/equivalence.h"

namespace ninebit::test {

// A program in RC1.0, with its heading.
inline CombinerState rc10(const std::string& body, const HardwareProfile& profile = profiles::geforce2) {
  auto parsed = parse_rc10({"!!RC1.0\n" + body, "test"}, profile);
  if (!parsed) throw std::runtime_error(parsed.faults().front().text());
  return *parsed;
}

// The index comparison of the article, and of the same with one thing changed.
inline CombinerState index_compare(const std::string& first_scale = "scale_by_four();",
                                   const std::string& second = "spare0 . spare0",
                                   const HardwareProfile& profile = profiles::geforce2) {
  return rc10("{ rgb { discard = unsigned(col0); discard = -tex0; spare0 = sum(); " + first_scale +
                  " } }\n{ rgb { spare1 = " + second + "; scale_by_four(); } }\nout.rgb = zero; out.a = spare1.b;\n",
              profile);
}

// The registers of an input, by the library's own table of initial registers; inputs that are not named are 0.
inline RegisterFile registers_of(const HardwareProfile& profile, const std::vector<ProofInput>& inputs) {
  FragmentInputs fragment;
  fragment.fog_factor = 0;
  for (auto& texel : fragment.texture) texel = Texel{};
  for (const ProofInput& input : inputs) {
    const auto i = static_cast<std::size_t>(input.component);
    if (input.reg == Register::primary) fragment.primary[i] = input.byte;
    if (input.reg == Register::secondary) fragment.secondary[i] = input.byte;
    if (input.reg == Register::fog && i < 3) fragment.fog_color[i] = input.byte;
    if (input.reg == Register::fog && i == 3) fragment.fog_factor = input.byte;
    if (is_texture(input.reg))
      fragment.texture[static_cast<std::size_t>(texture_unit_of(input.reg))]->value[i] = input.byte;
  }
  return initial_registers(profile, fragment);
}

// The result of a search's program, from its text alone, by the library's own table of initial registers.
inline int shown_by(const Discriminator& program, const HardwareProfile& profile) {
  const auto parsed = parse_rc10({program.rc10, "test"}, profile);
  if (!parsed) throw std::runtime_error(parsed.faults().front().text());
  FragmentInputs inputs;
  inputs.primary.fill(program.bytes[2]);
  if (!program.fog_off) inputs.fog_factor = 0;
  for (std::size_t unit = 0; unit < 2; ++unit) {
    const std::uint8_t byte = program.bytes[unit];
    if (!program.texture_off[unit]) inputs.texture[unit] = Texel{.value = {byte, byte, byte, byte}};
  }
  const auto fragment = evaluate_fragment(normalize(*parsed, profile), initial_registers(profile, inputs));
  if (fragment.color[kRed] != fragment.color[kGreen] || fragment.color[kRed] != fragment.color[kBlue]) {
    throw std::runtime_error("no grey: " + program.rc10);
  }
  return to_byte(profile, fragment.color[kRed]);
}

}  // namespace ninebit::test
