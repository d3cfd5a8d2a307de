// Memory that is not there: a run in an address space of any size does its work, or says in one line that it could not
// and ends with exit code 5, whatever library and thread asked for the memory; and leaves no file.
#include <gtest/gtest.h>

#include "combiner_tests/combiner/sanitized.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20U;

class Memory : public testing::Test {
 protected:
  void SetUp() override {
    if (ninebit::test::kSanitized) GTEST_SKIP() << "sanitizers map more than any limit";
    // The least that the program's libraries are loaded into.
    while (start_ < 4096 * kMebibyte && ninebit({"--help"}, {.address_space = start_}).code != 0)
      start_ += 4 * kMebibyte;
    ASSERT_LT(start_, 4096 * kMebibyte);
  }

  // Runs with ever more memory, until it is enough twice.
  void expect_result_or_error(const std::vector<std::string>& arguments, std::uint64_t step) const {
    int lacked = 0, done = 0;
    for (std::uint64_t more = 0; more < 4096 * kMebibyte && done < 2; more += step) {
      SCOPED_TRACE(testing::Message() << start_ + more << " bytes");
      const std::filesystem::path out = folder_.path() / "out";
      const Outcome outcome = ninebit(arguments, {.address_space = start_ + more});
      if (outcome.code == 0) {
        ++done;
      } else {
        ++lacked;
        expect_error(outcome, 5, {"out of memory"});
        const Files left = files_in(out);
        for (const auto& [name, bytes] : left) EXPECT_TRUE(name.ends_with(".jsonl")) << name;
      }
      std::filesystem::remove_all(out);
    }
    EXPECT_EQ(done, 2);
    EXPECT_GT(lacked, 2);
  }

  TempFolder folder_;
  std::uint64_t start_ = 8 * kMebibyte;
};

TEST_F(Memory, OfARendering) {
  expect_result_or_error(
      small_render(kRoom, folder_ / "out", {"--quiet", "--ground-truth", "--layers", "--threads", "6"}), 4 * kMebibyte);
}

TEST_F(Memory, OfALargerScene) {
  expect_result_or_error(small_render(kBunny, folder_ / "out",
                                      {"--quiet", "--ground-truth", "--layers", "--size", "200x150", "--threads", "3"}),
                         16 * kMebibyte);
}

TEST_F(Memory, OfAStudy) {
  expect_result_or_error({"study", "index-steps", "--formats", "channel", "--steps", "1-4", "--quiet", "--threads", "6",
                          "-o", folder_ / "out"},
                         4 * kMebibyte);
}

TEST_F(Memory, OfAStudyOfRenderings) {
  expect_result_or_error({"study", "shadows", kRoom, "--map-sizes", "32", "--steps", "2", "--size", "48x36", "--quiet",
                          "--threads", "6", "-o", folder_ / "out"},
                         4 * kMebibyte);
}

}  // namespace
}  // namespace tools_test
