// Programs printed as ps.1.1 mean the same again, wherever the language can say it.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"

namespace ninebit {
namespace {

using test::Random;

std::string random_source(Random& random, bool alpha) {
  const std::string reg = random.pick({"t0", "t1", "v0", "v1", "r0", "r1", "c1", "c3"});
  const std::string suffix = random.one_in(4) ? ".a" : alpha && random.one_in(4) ? ".b" : "";
  switch (random.below(8)) {
    case 0:
      return "1-" + reg + suffix;
    case 1:
      return "-" + reg + suffix;
    case 2:
      return reg + "_bx2" + suffix;
    case 3:
      return "-" + reg + "_bias" + suffix;
    default:
      return reg + suffix;
  }
}

// An instruction for a mask: "", ".rgb" or ".a".
std::string random_instruction(Random& random, const std::string& mask) {
  struct Op {
    const char* name;
    int sources;
  };
  const bool alpha = mask == ".a";
  const Op op =
      random.pick({Op{"mov", 1}, Op{"add", 2}, Op{"sub", 2}, Op{"mul", 2}, Op{"mad", 3}, Op{"cnd", 2}, Op{"dp3", 2}});
  if (alpha && std::string_view(op.name) == "dp3") return random_instruction(random, mask);
  std::string text =
      op.name + random.pick<std::string>({"", "", "_x2", "_x4", "_d2"}) + (random.one_in(4) ? "_sat" : "");
  text += " " + random.pick<std::string>({"r0", "r1", "t0"}) + mask;
  if (std::string_view(op.name) == "cnd") text += ", r0.a";
  for (int i = 0; i < op.sources; ++i) text += ", " + random_source(random, alpha);
  return text + "\n";
}

std::string random_shader(Random& random) {
  std::string text =
      "ps.1.1\ndef c1, 0.25, 1, 0, 0.5\ndef c3, 1, 0.125, 0.75, 0.25\ntex t0\ntex t1\nmov r0, v0\nmov r1, t1\n";
  for (int i = random.between(1, 5); i > 0; --i) {
    if (random.one_in(2)) {
      text += random_instruction(random, random.pick<std::string>({"", ".rgb", ".a"}));
    } else {
      text += random_instruction(random, ".rgb") + "+" + random_instruction(random, ".a");
    }
  }
  return text;
}

TEST(PixelShaderRoundTrip, RandomShadersMeanTheSame) {
  constexpr std::uint64_t kSeed = 2001;
  int read = 0, printed = 0;
  for (std::uint64_t i = 0; i < (test::kSlowBuild ? 600U : 6000U); ++i) {
    Random random(kSeed, i);
    const HardwareProfile& profile = profiles::nv2a;
    const std::string text = random_shader(random);
    const auto parsed = parse_pixel_shader({text, ""}, profile);
    if (!parsed) continue;  // three constants, a saturated register that is negated
    ++read;
    ASSERT_TRUE(validate(*parsed, profile).empty()) << text;
    const auto again = print_pixel_shader(*parsed, profile);
    ASSERT_TRUE(again) << "seed " << kSeed << " case " << i << ": " << again.error().message << "\n" << text;
    const auto back = parse_pixel_shader({*again, ""}, profile);
    ASSERT_TRUE(back) << "seed " << kSeed << " case " << i << "\n" << *again << test::all_faults(back);
    ASSERT_TRUE(normalize(*back, profile) == normalize(*parsed, profile)) << "seed " << kSeed << " case " << i << "\n"
                                                                          << text << *again;
    const auto tokens = print_shader_tokens(*parsed, profile);
    ASSERT_TRUE(tokens && is_shader_tokens(*tokens)) << *again;
    const auto assembled = parse_shader_tokens({*tokens, ""}, profile);
    ASSERT_TRUE(assembled) << "seed " << kSeed << " case " << i << "\n" << *tokens << test::all_faults(assembled);
    ASSERT_TRUE(normalize(*assembled, profile) == normalize(*back, profile)) << *again << *tokens;
    ++printed;
  }
  EXPECT_GT(read, test::kSlowBuild ? 300 : 3000);
  EXPECT_EQ(printed, read);
}

TEST(PixelShaderRoundTrip, ConstantsWithMixedSignsNormalizeToTheSame) {
  for (const HardwareProfile& profile : {profiles::nv2a, profiles::geforce2}) {
    const std::string shader = "ps.1.1\ndef c0, 1, -0.5, 0, 0.25\ntex t0\nmul r0, t0, c0\n";
    const auto parsed = parse_pixel_shader({shader, ""}, profile);
    ASSERT_TRUE(parsed) << test::all_faults(parsed);
    const auto text = print_pixel_shader(*parsed, profile);
    ASSERT_TRUE(text) << text.error().message;
    const auto back = parse_pixel_shader({*text, ""}, profile);
    ASSERT_TRUE(back) << *text << test::all_faults(back);
    EXPECT_EQ(normalize(*back, profile), normalize(*parsed, profile)) << *text;
  }
}

// Makes much of a random state expressible.
void simplify_for_shaders(Random& random, CombinerState& state) {
  state.mux_by_lowest_bit = false;
  state.final_combiner = {};
  state.final_combiner.a = state.final_combiner.b = state.final_combiner.c = {};
  state.final_combiner.d.reg =
      random.pick({Register::spare0, Register::spare0, Register::texture0, Register::constant1});
  state.num_general_combiners = std::min(state.num_general_combiners, random.between(1, 3));
  const CombinerInput one{Register::zero, InputMapping::unsigned_invert, ComponentUsage::rgb};
  for (GeneralCombiner& stage : state.general) {
    for (Portion* const portion : {&stage.rgb, &stage.alpha}) {
      const bool rgb = portion == &stage.rgb;
      const ComponentUsage usage = rgb ? ComponentUsage::rgb : ComponentUsage::alpha;
      PortionOutput& out = portion->out;
      const Register to = random.pick({Register::spare0, Register::spare1});
      out = {.sum = Register::discard, .scale = out.bias == Bias::none ? out.scale : Scale::none};
      (random.one_in(2) ? out.sum : random.one_in(2) ? out.ab : out.cd) = to;
      if (random.one_in(2)) portion->d = {one.reg, one.mapping, usage};
      if (random.one_in(2)) portion->b = {one.reg, one.mapping, usage};
      if (random.one_in(3)) portion->c = {Register::zero, InputMapping::unsigned_identity, usage};
      for (CombinerInput Portion::*const in : {&Portion::a, &Portion::b, &Portion::c, &Portion::d}) {
        CombinerInput& input = portion->*in;
        if (input.reg == Register::fog || input.reg == Register::spare1) input.reg = Register::primary;
        if (input.reg == Register::spare0 && random.one_in(2)) input.reg = Register::secondary;
      }
    }
  }
}

TEST(PixelShaderRoundTrip, RandomProgramsComputeTheSame) {
  constexpr std::uint64_t kSeed = 2002;
  int expressible = 0, refused = 0;
  for (std::uint64_t i = 0; i < (test::kSlowBuild ? 2000U : 20000U); ++i) {
    Random random(kSeed, i);
    const HardwareProfile& profile = random.one_in(2) ? profiles::nv2a : profiles::geforce2;
    CombinerState state = test::random_state(random, profile);
    simplify_for_shaders(random, state);
    ASSERT_TRUE(validate(state, profile).empty());
    const auto text = print_pixel_shader(state, profile);
    if (!text) {
      ++refused;
      continue;
    }
    ++expressible;
    const auto back = parse_pixel_shader({*text, ""}, profile);
    ASSERT_TRUE(back) << "seed " << kSeed << " case " << i << "\n" << *text << test::all_faults(back);
    const Program before = normalize(state, profile), after = normalize(*back, profile);
    for (int k = 0; k < 4; ++k) {
      RegisterFile registers = test::random_registers(random, profile);
      // Vertex colours, and texels of the older chips, have no sign; spares begin as 0 and texture 0's alpha.
      for (const Register reg : {Register::primary, Register::secondary, Register::texture0, Register::texture1}) {
        if (is_texture(reg) && profile.per_stage_constants) continue;
        for (auto& code : registers[reg]) code = std::max<std::int16_t>(code, 0);
      }
      registers[Register::spare0] = {0, 0, 0, registers[Register::texture0][3]};
      registers[Register::spare1] = {};
      ASSERT_EQ(evaluate_fragment(after, registers).color, evaluate_fragment(before, registers).color)
          << "seed " << kSeed << " case " << i << "\n"
          << *text << *print_gl_calls(state, profile);
    }
    const auto again = print_pixel_shader(*back, profile);
    ASSERT_TRUE(again) << *text << again.error().message;
    const auto third = parse_pixel_shader({*again, ""}, profile);
    ASSERT_TRUE(third);
    ASSERT_TRUE(normalize(*third, profile) == after) << "seed " << kSeed << " case " << i << "\n" << *text << *again;
  }
  EXPECT_GT(expressible, test::kSlowBuild ? 150 : 1500);
  EXPECT_GT(refused, test::kSlowBuild ? 150 : 1500);
}

TEST(PixelShaderRoundTrip, PrintsTheShortestText) {
  const std::string text =
      "ps.1.1\ndef c0, 0.25, 1, 0, 0.5\ntex t0\ntex t1\nsub_x2 r1, c0, 1-t0\nmul_sat r0.rgb, t0, 1-r1.a\n+mov_d2 r0.a, "
      "-v0_bias\nlrp r0.rgb, r0.a, r0, v0\ncnd r0, r0.a, t1_bx2, r1\n";
  const auto parsed = parse_pixel_shader({text, ""}, profiles::nv2a);
  ASSERT_TRUE(parsed) << test::all_faults(parsed);
  const auto printed = print_pixel_shader(*parsed, profiles::nv2a);
  ASSERT_TRUE(printed) << printed.error().message;
  EXPECT_EQ(*printed, text);
}

TEST(PixelShaderRoundTrip, SaysWhatTheLanguageLacks) {
  const std::pair<const char*, const char*> cases[] = {
      {"{ rgb { discard = tex0 * tex1; discard = col0 * col1; spare0 = sum(); } } out.rgb = spare0;",
       "general combiner 0, RGB portion: the sum of two products"},
      {"{ rgb { spare0 = tex0; spare1 = tex1; } } out.rgb = spare0;",
       "general combiner 0, RGB portion: several outputs"},
      {"{ alpha { spare0 = tex0; bias_by_negative_one_half(); } } out.rgb = tex0; out.a = spare0;",
       "general combiner 0, alpha portion: a bias of -1/2"},
      {"{ rgb { col0 = tex0; } } out.rgb = col0;",
       "general combiner 0, RGB portion: primary_color is written, and v0 and v1 cannot be"},
      {"{ rgb { spare0 = fog; } } out.rgb = spare0;", "general combiner 0, RGB portion: the register fog"},
      {"{ rgb { spare0 = spare1; } } out.rgb = spare0;", "general combiner 0: spare1 is read before it is written"},
      {"out.rgb = color_sum;", "a final combiner that computes; it may output spare0 or another register"},
      {"{ rgb { spare0 = half_bias(zero); } } out.rgb = spare0;",
       "general combiner 0, RGB portion: a half from the register zero"},
  };
  for (const auto& [text, why] : cases) {
    const auto state = parse_rc10({std::string("!!RC1.0\n") + text + "\n", ""}, profiles::geforce2);
    ASSERT_TRUE(state) << text << test::all_faults(state);
    const auto printed = print_pixel_shader(*state, profiles::geforce2);
    ASSERT_FALSE(printed) << text << *printed;
    EXPECT_EQ(printed.error().message, std::string("ps.1.1 cannot express this: ") + why);
  }
}

}  // namespace
}  // namespace ninebit
