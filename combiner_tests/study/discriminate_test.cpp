// The shortest program that tells two profiles apart, or a proof that there is none.
#include "ninebit/study/discriminate.h"

#include <gtest/gtest.h>

#include <functional>
#include <map>

#include "combiner_tests/study/proof_support.h"
#include "combiner_tests/support/slow_build.h"
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
  if (test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const std::map<std::string, int> combiners{{"lowest_output", 2},
                                             {"half", 1},
                                             {"expand_offset", 1},
                                             {"general_narrowing", 1},
                                             {"narrowing_point", 1},
                                             {"final_narrowing", 0},
                                             {"spare0_alpha_without_texture0", 0},
                                             {"disabled_texture_alpha", 0},
                                             {"secondary_alpha", 0},
                                             {"fog_alpha_without_fog", 0}};
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

// A difference in any one field of the combiners is shown by a program or proved invisible.
TEST(Discriminate, NoSingleFieldIsUnknown) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  using P = HardwareProfile;
  struct Change {
    const char* name;
    std::function<void(P&)> make;
    bool is_visible;
  };
  const auto byte = [](Choice<int> P::*field, int value) { return [=](P& p) { (p.*field).value = value; }; };
  const std::vector<Change> changes{
      {"lowest", byte(&P::lowest, -256), false},
      {"half", byte(&P::half, 126), true},
      {"half 1", byte(&P::half, 129), true},
      {"half 0", byte(&P::half, 0), true},
      {"spare0_alpha_without_texture0", byte(&P::spare0_alpha_without_texture0, 254), true},
      {"disabled_texture_alpha", byte(&P::disabled_texture_alpha, 254), true},
      {"fog_alpha_without_fog", byte(&P::fog_alpha_without_fog, 254), true},
      {"fog_alpha_without_fog 0", byte(&P::fog_alpha_without_fog, 0), true},
      {"secondary_alpha", [](P& p) { p.secondary_alpha.value = SecondaryAlpha::as_given; }, true},
      {"byte_shift", byte(&P::byte_shift, 1), true},
      {"expand_offset", byte(&P::expand_offset, 256), true},
      {"lowest_output", [](P& p) { p.lowest.value = p.lowest_output.value = -256; }, true},
      {"general_narrowing", [](P& p) { p.general_narrowing.value = Narrowing::nearest_halves_up; }, true},
      {"narrowing_point", [](P& p) { p.narrowing_point.value = NarrowingPoint::before_scale; }, true},
      {"final_narrowing", [](P& p) { p.final_narrowing.value = Narrowing::toward_zero; }, true},
      // Features of one chip alone are not part of a program for both.
      {"general_combiners", byte(&P::general_combiners, 8), false},
      {"texture_units", byte(&P::texture_units, 4), false},
      {"per_stage_constants", [](P& p) { p.per_stage_constants.value = true; }, false},
      {"blue_to_alpha", [](P& p) { p.blue_to_alpha.value = true; }, false},
      {"mux_by_lowest_bit", [](P& p) { p.mux_by_lowest_bit.value = true; }, false},
      {"color_sum_inverts", [](P& p) { p.color_sum_inverts.value = true; }, false}};
  for (const Change& change : changes) {
    HardwareProfile other = profiles::geforce2;
    change.make(other);
    const Discrimination answer = ask(profiles::geforce2, other);
    ASSERT_EQ(answer.answer, change.is_visible ? ProofAnswer::refuted : ProofAnswer::proved) << change.name;
    if (!change.is_visible) continue;
    EXPECT_EQ(answer.a, shown_by(*answer.found, profiles::geforce2)) << answer.found->rc10;
    EXPECT_EQ(answer.b, shown_by(*answer.found, other)) << answer.found->rc10;
  }
}

TEST(Discriminate, CanBeCancelled) {
  const auto answer =
      discriminate(profiles::geforce2, rival_of(profiles::geforce2, "half"), [](double) { return false; });
  ASSERT_FALSE(answer);
  EXPECT_EQ(answer.error().fault, Fault::cancelled);
}

}  // namespace
}  // namespace ninebit::test
