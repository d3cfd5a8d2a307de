// The kit decides the fields of a card: our own engine plays cards with all kinds of values.
#include "ninebit/study/chip_kit.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/study/proof_support.h"
#include "combiner_tests/support/slow_build.h"

namespace ninebit::test {
namespace {

const ChipKit& kit_of(const HardwareProfile& family) {
  if (family.name == profiles::nv2a.name) {
    static const auto nv2a = make_chip_kit(profiles::nv2a);
    return *nv2a;
  }
  static const auto geforce2 = make_chip_kit(profiles::geforce2);
  return *geforce2;
}

// The picture of a card with this profile.
std::vector<int> play(const ChipKit& kit, const HardwareProfile& card) {
  std::vector<int> shown;
  for (const Discriminator& program : kit.programs) shown.push_back(shown_by(program, card));
  return shown;
}

class ChipKits : public testing::TestWithParam<const HardwareProfile*> {};

TEST_P(ChipKits, DecideWhatNobodyHasMeasured) {
  if (kSanitized && GetParam() == &profiles::geforce2) GTEST_SKIP() << "its kit takes half a minute";
  const ChipKit& kit = kit_of(*GetParam());
  EXPECT_TRUE(kit.is_complete);
  std::size_t combinations = 1;
  for (const CombinerField& field : kit.fields) {
    EXPECT_TRUE(field.is_open() || field.evidence == Evidence::seed) << field.name;
    combinations *= field.values.size();
  }
  EXPECT_EQ(kit.combinations.size(), combinations);
  for (std::size_t i = 0; i < combinations; ++i) {
    EXPECT_EQ(play(kit, kit.profile_with(kit.combinations[i])), kit.shown[i]) << i;
  }
}

TEST_P(ChipKits, NoProgramIsSuperfluous) {
  if (kSanitized && GetParam() == &profiles::geforce2) GTEST_SKIP() << "its kit takes half a minute";
  const ChipKit& kit = kit_of(*GetParam());
  for (std::size_t i = 0; i < kit.programs.size(); ++i) {
    ChipKit fewer = kit;
    for (auto& shown : fewer.shown) shown.erase(shown.begin() + static_cast<std::ptrdiff_t>(i));
    EXPECT_LT(fewer.classes(), kit.classes()) << kit.programs[i].rc10;
  }
}

// A card with each combination: the verdict is exactly the combinations that no program tells from the card.
TEST_P(ChipKits, FindTheAssignmentOfACard) {
  if (kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const ChipKit& kit = kit_of(*GetParam());
  for (std::size_t card = 0; card < kit.combinations.size(); ++card) {
    const std::vector<std::size_t>& values = kit.combinations[card];
    const KitVerdict verdict = decide(kit, play(kit, kit.profile_with(values)));
    EXPECT_EQ(std::count(verdict.fitting.begin(), verdict.fitting.end(), card), 1);
    for (const std::size_t other : verdict.fitting) {
      if (other <= card || card % 8 != 0) continue;  // no pair twice, and a share of them
      const auto same = discriminate(kit.profile_with(values), kit.profile_with(kit.combinations[other]));
      EXPECT_EQ(same->answer, ProofAnswer::proved);
    }
    for (std::size_t field = 0; field < kit.fields.size(); ++field) {
      EXPECT_TRUE(verdict.fields[field].fits[values[field]]) << kit.fields[field].name;
      const bool is_invisible = kit.fields[field].name == "lowest";
      for (std::size_t value = 0; value < kit.fields[field].values.size(); ++value) {
        const bool fits = verdict.fields[field].fits[value];
        EXPECT_EQ(fits, value == values[field] || is_invisible) << kit.fields[field].name;
        EXPECT_EQ(verdict.fields[field].excluded_by[value].empty(), fits);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Families, ChipKits, testing::Values(&profiles::geforce2, &profiles::nv2a),
                         [](const auto& family) { return std::string(family.param->name); });

TEST(ChipKit, ContradictionsNameTheirPrograms) {
  const ChipKit& kit = kit_of(profiles::nv2a);
  auto shown = kit.shown.front();
  shown[0] = 254;  // no value of any field shows it
  ASSERT_TRUE(std::none_of(kit.shown.begin(), kit.shown.end(), [](const auto& all) { return all[0] == 254; }));
  const KitVerdict one = decide(kit, shown);
  EXPECT_TRUE(one.fitting.empty());
  EXPECT_EQ(one.contradiction, std::vector<std::size_t>{0});
  EXPECT_TRUE(one.fields.empty());
  if (kSanitized) return;  // the kit below takes half a minute
  // Colours that occur, but never together.
  std::size_t found = 0;
  const ChipKit& geforce2 = kit_of(profiles::geforce2);
  for (const auto& other : geforce2.shown) {
    shown = geforce2.shown.front();
    shown.back() = other.back();
    const KitVerdict verdict = decide(geforce2, shown);
    if (!verdict.fitting.empty()) continue;
    ++found;
    EXPECT_GT(verdict.contradiction.size(), 1U);
    for (const std::size_t program : verdict.contradiction) EXPECT_LT(program, geforce2.programs.size());
  }
  EXPECT_GT(found, 0U);
}

TEST(ChipKit, IsForCards) {
  const auto refused = make_chip_kit(profiles::ideal);
  ASSERT_FALSE(refused);
  EXPECT_EQ(refused.error().message, "the arithmetic of profile ideal is not integer: no card has it");
  EXPECT_EQ(make_chip_kit(profiles::nv2a, [](double) { return false; }).error().fault, Fault::cancelled);
}

}  // namespace
}  // namespace ninebit::test
