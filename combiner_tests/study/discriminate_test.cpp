// The shortest program that tells two profiles apart, or a proof that there is none.
#include "ninebit/study/discriminate.h"

#include <gtest/gtest.h>

#include <map>

#include "combiner_tests/study/proof_support.h"
#include "ninebit/study/combiner_fields.h"

namespace ninebit::test {
namespace {

Discrimination ask(const HardwareProfile& a, const HardwareProfile& b) {
  auto answer = discriminate(a, b);
  if (!answer) throw std::runtime_error(answer.error().text());
  return *answer;
}

// The profile with the rival of a field.
HardwareProfile rival_of(const HardwareProfile& profile, const std::string& name) {
  for (const auto& table : {arithmetic_fields(profile), register_fields(profile)}) {
    for (const CombinerField& field : table) {
      if (field.name != name) continue;
      HardwareProfile rival = profile;
      field.values[1].set(rival);
      return rival;
    }
  }
  throw std::runtime_error("no field " + name);
}

TEST(Discriminate, EachFieldByTheFewestGeneralCombiners) {
  const std::map<std::string, int> combiners{{"lowest_output", 2},
                                             {"half", 1},
                                             {"expand_offset", 1},
                                             {"general_narrowing", 1},
                                             {"narrowing_point", 1},
                                             {"final_narrowing", 0},
                                             {"spare0_alpha_without_texture0", 0},
                                             {"disabled_texture_alpha", 0},
                                             {"secondary_alpha", 0}};
  for (const HardwareProfile* profile : {&profiles::geforce2, &profiles::nv2a}) {
    for (const auto& [name, count] : combiners) {
      const HardwareProfile rival = rival_of(*profile, name);
      const Discrimination answer = ask(*profile, rival);
      ASSERT_EQ(answer.answer, ProofAnswer::refuted) << name;
      EXPECT_TRUE(answer.shortest) << name;
      EXPECT_EQ(answer.found->general_combiners, count) << answer.found->rc10;
      EXPECT_NE(answer.a, answer.b);
      EXPECT_EQ(answer.a, shown_by(*answer.found, *profile)) << answer.found->rc10;
      EXPECT_EQ(answer.b, shown_by(*answer.found, rival)) << answer.found->rc10;
    }
  }
}

// No input of these programs is negative, and outputs have a field of their own.
TEST(Discriminate, ProvesThatTheLowestInputIsInvisible) {
  const Discrimination answer = ask(profiles::geforce2, rival_of(profiles::geforce2, "lowest"));
  EXPECT_EQ(answer.answer, ProofAnswer::proved);
  EXPECT_FALSE(answer.found);
  EXPECT_GT(answer.cases, 1'000'000U);
}

TEST(Discriminate, ProfilesThemselves) {
  EXPECT_EQ(ask(profiles::nv2a, profiles::nv2a).answer, ProofAnswer::proved);
  for (const HardwareProfile* other :
       {&profiles::nv2a, &profiles::geforce256_8bit, &profiles::geforce2_early_truncation}) {
    const Discrimination answer = ask(profiles::geforce2, *other);
    ASSERT_TRUE(answer.found) << other->name;
    EXPECT_EQ(answer.a, shown_by(*answer.found, profiles::geforce2));
    EXPECT_EQ(answer.b, shown_by(*answer.found, *other));
  }
}

// Without integers no step is compared, but programs are searched.
TEST(Discriminate, RealNumbersAreSearchedToo) {
  EXPECT_TRUE(ask(profiles::geforce2, profiles::ideal).found);
  EXPECT_EQ(ask(profiles::ideal, profiles::ideal).answer, ProofAnswer::proved);
  HardwareProfile with_alpha = profiles::ideal;
  with_alpha.disabled_texture_alpha.value = 255 - with_alpha.disabled_texture_alpha.value;
  EXPECT_TRUE(ask(profiles::ideal, with_alpha).found);
}

TEST(Discriminate, CanBeCancelled) {
  const auto answer =
      discriminate(profiles::geforce2, rival_of(profiles::geforce2, "half"), [](double) { return false; });
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().fault, Fault::cancelled);
}

}  // namespace
}  // namespace ninebit::test
