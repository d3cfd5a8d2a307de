// Memory that is not there: a run in an address space of any size does its work, or says in one line that it could not
// and ends with exit code 5, whatever library and thread asked for the memory; and leaves no file but the older ones.
#include <gtest/gtest.h>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

constexpr std::uint64_t kMebibyte = std::uint64_t{1} << 20U;

class Memory : public testing::Test {
 protected:
  void SetUp() override {
    if (ninebit::test::kSanitized) GTEST_SKIP() << "sanitizers map more than any limit";
    // The least that the program's libraries are loaded into; the same in all tests.
    while (start_ < 4096 * kMebibyte && ninebit({"--help"}, {.address_space = start_}).code != 0)
      start_ += 4 * kMebibyte;
    ASSERT_LT(start_, 4096 * kMebibyte);
  }

  // Runs with ever more memory, until it is enough twice; each time over the files that the folder has at first.
  void expect_result_or_error(const Words& arguments, std::uint64_t step) const {
    const Files older = files_in(out_);
    int lacked = 0, done = 0;
    for (std::uint64_t more = 0; more < 4096 * kMebibyte && done < 2; more += step) {
      SCOPED_TRACE(testing::Message() << start_ + more << " bytes");
      const Outcome outcome = ninebit(arguments, {.address_space = start_ + more});
      if (outcome.code == 0) {
        ++done;
      } else {
        ++lacked;
        expect_error(outcome, 5, {"out of memory"});
        Files left = files_in(out_);
        std::erase_if(left, [](const auto& file) { return file.first.ends_with(".jsonl"); });
        EXPECT_EQ(left, older);
      }
      std::filesystem::remove_all(out_);
      if (!older.empty()) std::filesystem::create_directory(out_);
      for (const auto& [name, bytes] : older) write_bytes(out_ + '/' + name, bytes);
    }
    EXPECT_EQ(done, 2);
    EXPECT_GT(lacked, 2);
  }

  // The article's program, its calls made again and again: one that takes more memory than the start did.
  [[nodiscard]] std::string long_program() const {
    const std::string calls = article_calls();
    std::string text;
    while (text.size() < 2 * kMebibyte) text += calls;
    return write_bytes(folder_ / "long.gl", text);
  }
  void put_older_file(const std::string& name) const {
    std::filesystem::create_directory(out_);
    write_bytes(out_ + '/' + name, "the older one");
  }

  TempFolder folder_;
  std::string out_ = folder_ / "out";
  static inline std::uint64_t start_ = 8 * kMebibyte;
};

TEST_F(Memory, OfARendering) {
  expect_result_or_error(small_render(kRoom, out_, {"--quiet", "--ground-truth", "--layers", "--threads", "6"}),
                         4 * kMebibyte);
}

TEST_F(Memory, OfALargerScene) {
  expect_result_or_error(
      small_render(kBunny, out_, {"--quiet", "--ground-truth", "--layers", "--size", "200x150", "--threads", "3"}),
      32 * kMebibyte);
}

TEST_F(Memory, OfAStudy) {
  expect_result_or_error({"study", "index-steps", "--profile", "geforce2", "--formats", "channel", "--steps", "1-4",
                          "--quiet", "--threads", "6", "-o", out_},
                         4 * kMebibyte);
}

TEST_F(Memory, OfAStudyOfRenderings) {
  expect_result_or_error({"study", "shadows", kRoom, "--map-sizes", "32", "--steps", "2", "--size", "48x36", "--quiet",
                          "--threads", "6", "-o", out_},
                         4 * kMebibyte);
}

TEST_F(Memory, OfAMergedStudy) {
  const auto study = [this](const char* name, const char* steps) {
    const std::string folder = folder_ / name;
    EXPECT_EQ(ninebit({"study", "index-steps", "--profile", "geforce2", "--formats", "channel", "--steps", steps,
                       "--quiet", "-o", folder})
                  .code,
              0);
    return folder + "/part-1-of-1.jsonl";
  };
  ASSERT_EQ(ninebit({"study", "merge", study("older", "2"), "--quiet", "-o", out_}).code, 0);
  expect_result_or_error({"study", "merge", study("newer", "1-2"), "--quiet", "-o", out_}, 2 * kMebibyte);
}

TEST_F(Memory, OfAnEvaluatedTable) {
  std::string rows = "tex0.r,primary.r\n";
  for (int i = 0; i < 20000; ++i) rows += "200,100\n";
  const std::string table = write_bytes(folder_ / "rows.csv", rows);
  for (const char* engine : {"simd", "reference"}) {
    put_older_file("table.csv");
    expect_result_or_error({"eval", long_program(), "--inputs", table, "--registers", "--engine", engine, "--quiet",
                            "-o", out_ + "/table.csv"},
                           2 * kMebibyte);
  }
}

TEST_F(Memory, OfAConversion) {
  const std::string program = long_program();
  for (const char* form : {"gl", "json"}) {  // what any form needs is little beside what the text does
    SCOPED_TRACE(form);
    put_older_file("program");
    expect_result_or_error({"convert", program, "--to", form, "--quiet", "-o", out_ + "/program"}, 4 * kMebibyte);
  }
}

}  // namespace
}  // namespace tools_test
