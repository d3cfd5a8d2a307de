// Wrong models of the combiners: the second writing of the arithmetic, and what is not run because it changes nothing.
#include <gtest/gtest.h>

#include <numeric>
#include <string>
#include <vector>

#include "combiner_tests/support/slow_build.h"
#include "ninebit/study/vectors.h"
#include "src/study/vectors/vector_mistakes.h"

namespace ninebit::vectors {
namespace {

struct Case {
  VectorPack pack;
  std::vector<Mistake> mistakes;
  std::vector<std::size_t> programs;
};

Case case_of(const char* profile, int programs) {
  Case made{*make_vector_pack(*find_profile(profile), {programs, 4, 11}), mistakes_of(*find_profile(profile)), {}};
  made.programs.resize(made.pack.programs.size());
  std::iota(made.programs.begin(), made.programs.end(), std::size_t{0});
  return made;
}

std::size_t index_of(const std::vector<Mistake>& mistakes, const std::string& name) {
  std::size_t m = 0;
  while (mistakes.at(m).name != name) ++m;
  return m;
}

// Also with the fields of other profiles, and with floats.
TEST(VectorModels, WithoutBrokenRulesIsTheReference) {
  for (const char* profile : {"nv2a", "geforce2", "geforce2-early-truncation", "geforce256-8bit"}) {
    const Case made = case_of(profile, test::kSanitized ? 100 : 500);
    std::vector<std::vector<std::size_t>> sets{{}};
    for (std::size_t m = 0; m < made.mistakes.size(); ++m) {
      const Mistake& one = made.mistakes[m];
      if (one.set && one.in_general.none() && one.in_final.none()) sets.push_back({m});
    }
    EXPECT_GT(sets.size(), 5U);
    for (const std::vector<std::size_t>& set : sets) {
      const Model model(made.pack.profile, made.mistakes, set);
      const ModelColors colors(made.pack, model, made.programs);
      for (const std::size_t p : made.programs) {
        AskedRules asked;
        ASSERT_EQ(colors(p, &asked), colors(p))
            << profile << ", program " << p << ", " << (set.empty() ? "" : made.mistakes[set[0]].name);
      }
    }
  }
}

// A mistake that a program does not depend on is not run: here it is.
TEST(VectorModels, MistakesThatMayNotChangeAProgramDoNot) {
  const Case made = case_of("nv2a", test::kSanitized ? 80 : 600);
  std::size_t skipped = 0;
  for (const char* before : {"", "arithmetic = float32", "outputs of general combiners are not clamped",
                             "a shift by 8 instead of a division by 255", "half = 127.5", "no bias"}) {
    std::vector<std::size_t> set;
    if (*before != '\0') set.push_back(index_of(made.mistakes, before));
    const Model model(made.pack.profile, made.mistakes, set);
    const ModelColors colors(made.pack, model, made.programs);
    std::vector<AskedRules> asked(made.programs.size());
    std::vector<std::vector<Bytes4>> shown;
    for (const std::size_t p : made.programs) shown.push_back(colors(p, &asked[p]));
    set.emplace_back();
    for (std::size_t m = 0; m < made.mistakes.size(); ++m) {
      if (made.mistakes[m].set || made.mistakes[m].edit != nullptr) continue;
      set.back() = m;
      const Model more(made.pack.profile, made.mistakes, set);
      const ModelColors changed(made.pack, more, made.programs);
      for (const std::size_t p : made.programs) {
        if (may_change(made.mistakes[m], asked[p])) continue;
        ++skipped;
        ASSERT_EQ(changed(p), shown[p]) << before << " and " << made.mistakes[m].name << ", program " << p;
      }
    }
  }
  EXPECT_GT(skipped, made.programs.size() * 60);
}

}  // namespace
}  // namespace ninebit::vectors
