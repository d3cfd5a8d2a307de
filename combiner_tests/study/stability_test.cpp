// The changes if a field that nobody has measured has another value.
#include "ninebit/study/stability.h"

#include <gtest/gtest.h>

#include <map>

#include "combiner_tests/study/proof_support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

StabilityAnswer ask(const CombinerState& state, const HardwareProfile& profile = profiles::geforce2) {
  auto answer = prove_stable(state, profile);
  if (!answer) throw std::runtime_error(answer.error().text());
  return *answer;
}

std::map<std::string, ProofAnswer> effects(const StabilityAnswer& answer) {
  std::map<std::string, ProofAnswer> all;
  for (const FieldEffect& effect : answer.fields) all[std::string(effect.field.name)] = effect.answer;
  return all;
}

TEST(Stability, TheFieldsOfAProfile) {
  for (const HardwareProfile* profile : {&profiles::geforce2, &profiles::nv2a, &profiles::geforce256_8bit}) {
    for (const auto& table : {arithmetic_fields(*profile), register_fields(*profile)}) {
      for (const CombinerField& field : table) {
        ASSERT_GE(field.values.size(), 2U) << field.name;
        HardwareProfile same = *profile, other = *profile;
        field.values[0].set(same);
        EXPECT_EQ(datapath_of(same), datapath_of(*profile)) << field.name;
        field.values[1].set(other);
        const bool differs =
            !(datapath_of(other) == datapath_of(*profile)) ||
            other.spare0_alpha_without_texture0.value != profile->spare0_alpha_without_texture0.value ||
            other.disabled_texture_alpha.value != profile->disabled_texture_alpha.value ||
            other.secondary_alpha.value != profile->secondary_alpha.value ||
            other.fog_alpha_without_fog.value != profile->fog_alpha_without_fog.value;
        EXPECT_TRUE(differs) << field.name;
      }
    }
  }
  EXPECT_TRUE(arithmetic_fields(profiles::ideal).empty());
}

TEST(Stability, TheArticlesProgram) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const StabilityAnswer answer = ask(index_compare());
  EXPECT_EQ(answer.answer, ProofAnswer::proved) << answer.reason;
  for (const auto& [name, effect] : effects(answer)) EXPECT_EQ(effect, ProofAnswer::proved) << name;
}

TEST(Stability, EachFieldHasAProgramThatSeesIt) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const std::map<std::string, std::string> programs{
      {"expand_offset", "{ alpha { spare0 = expand(tex0.a); } }\nout.rgb = zero; out.a = spare0.a;\n"},
      {"half", "{ alpha { spare0 = half_bias(tex0.a); } }\nout.rgb = zero; out.a = spare0.a;\n"},
      {"final_narrowing", "out.rgb = lerp(tex0, tex1, zero); out.a = zero;\n"},
      {"secondary_alpha", "{ alpha { spare0 = col1.a; } }\nout.rgb = zero; out.a = spare0.a;\n"},
      {"disabled_texture_alpha", "{ alpha { spare0 = tex1.a; } }\nout.rgb = zero; out.a = spare0.a;\n"},
      {"spare0_alpha_without_texture0", "{ alpha { spare1 = spare0.a; } }\nout.rgb = zero; out.a = spare1.a;\n"}};
  for (const auto& [name, body] : programs) {
    const StabilityAnswer answer = ask(rc10(body));
    EXPECT_EQ(answer.answer, ProofAnswer::refuted) << name;
    EXPECT_EQ(effects(answer).at(name), ProofAnswer::refuted) << name;
    for (const FieldEffect& effect : answer.fields)
      EXPECT_EQ(effect.example.has_value(), effect.answer == ProofAnswer::refuted);
  }
  // -256 is seen where it is not clamped away: 256 - 255, times four. The extension decides that no output is so low.
  const CombinerState sums = rc10(
      "{ alpha { discard = -tex0.a; discard = -tex1.a; spare0 = sum(); } }\n"
      "{ alpha { discard = -spare0.a; discard = expand(zero); spare0 = sum(); scale_by_four(); } }\n"
      "out.rgb = zero; out.a = spare0.a;\n");
  EXPECT_EQ(effects(ask(sums)).count("lowest_output"), 0U);
  HardwareProfile undecided = profiles::geforce2;
  undecided.lowest_output.evidence = Evidence::inferred;
  const StabilityAnswer lowest = ask(sums, undecided);
  EXPECT_EQ(effects(lowest).at("lowest_output"), ProofAnswer::refuted);
  EXPECT_EQ(lowest.answer, ProofAnswer::refuted);
}

// The extension decides fog's alpha without fog; a profile file leaves it open.
TEST(Stability, FogThatIsOff) {
  const CombinerState program = rc10("out.rgb = fog.a; out.a = zero;\n");
  EXPECT_EQ(effects(ask(program)).count("fog_alpha_without_fog"), 0U);
  HardwareProfile undecided = profiles::geforce2;
  undecided.fog_alpha_without_fog = {255, Evidence::assumed, "test"};
  const StabilityAnswer answer = ask(program, undecided);
  EXPECT_EQ(effects(answer).at("fog_alpha_without_fog"), ProofAnswer::refuted);
  for (const FieldEffect& effect : answer.fields) {
    EXPECT_EQ(effect.fog_off, effect.field.name == "fog_alpha_without_fog") << effect.field.name;
  }
  EXPECT_EQ(effects(ask(rc10("out.rgb = fog; out.a = zero;\n"), undecided)).at("fog_alpha_without_fog"),
            ProofAnswer::proved);
}

TEST(Stability, RealNumbersHaveNoOpenFields) {
  const auto refused =
      prove_stable(index_compare("scale_by_four();", "spare0 . spare0", profiles::ideal), profiles::ideal);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "the arithmetic of profile ideal is not integer: none of its fields is open");
}

}  // namespace
}  // namespace ninebit::test
