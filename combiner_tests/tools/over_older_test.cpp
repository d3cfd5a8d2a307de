// Verbs that write over older files, ended by a signal at any moment or without room: the folder holds the older output
// or the newer one, never some files of either, and the next run is not disturbed by what a killed one left.
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <functional>
#include <thread>

#include "combiner_tests/support/random.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/program_support.h"
#include "combiner_tests/tools/small_disk.h"

namespace tools_test {
namespace {

using Clock = std::chrono::steady_clock;
using Words = std::vector<std::string>;

class OverOlder : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
    const auto [older, newer] = commands();
    words_ = newer;
    ASSERT_EQ(ninebit(older).code, 0);
    older_ = files_in(out_);
    const auto start = Clock::now();
    ASSERT_EQ(ninebit(words_).code, 0);
    duration_ = Clock::now() - start;
    newer_ = files_in(out_);
    ASSERT_NE(older_, newer_);
    ASSERT_EQ(older_.size(), newer_.size());
    for (const auto& [name, bytes] : older_) ASSERT_TRUE(newer_.contains(name)) << name;
    restore();
  }

  // Two that write the same files with other bytes.
  [[nodiscard]] std::pair<Words, Words> commands() const {
    const std::string verb = GetParam();
    if (verb == "render") {
      return {small_render(kRoom, out_, {"--layers", "--quiet", "--light", "1,2,1"}),
              small_render(kRoom, out_, {"--layers", "--quiet"})};
    }
    if (verb == "merge") return {merge_of("2"), merge_of("1")};
    if (verb == "study") {
      // Its part is whole, and beside another one's report: that one is written over.
      const Words study = study_of("1", out_);
      EXPECT_EQ(ninebit(study).code, 0);
      return {merge_of("2"), study};
    }
    if (verb == "eval") return {eval_of("100"), eval_of("200")};
    const auto conversion = [this](const char* form) {
      return Words{"convert", kArticle, "--to", form, "--quiet", "-o", out_ + "/article"};
    };
    return {conversion("gl"), conversion("rc10")};
  }

  [[nodiscard]] Words eval_of(const std::string& row) const {
    std::string table = "tex0.r,primary.r\n";
    for (int i = 0; i < 50000; ++i) table += row + ",100\n";
    return {"eval",    kArticle, "--inputs",         write_bytes(folder_ / ("rows-" + row), table),
            "--quiet", "-o",     out_ + "/table.csv"};
  }

  static Words study_of(const std::string& steps, const std::string& folder) {
    return {"study", "shadows", kRoom, "--map-sizes", "32", "--size",
            "48x36", "--steps", steps, "--quiet",     "-o", folder};
  }

  [[nodiscard]] Words merge_of(const std::string& steps) const {
    const std::string parts = folder_ / ("steps-" + steps);
    EXPECT_EQ(ninebit(study_of(steps, parts)).code, 0);
    return {"study", "merge", parts + "/part-1-of-1.jsonl", "--allow-outside", "--quiet", "-o", out_};
  }

  void restore() const {
    std::filesystem::remove_all(out_);
    std::filesystem::create_directory(out_);
    for (const auto& [name, bytes] : older_) write_bytes(out_ + '/' + name, bytes);
  }

  // All but the hidden files, which a killed program may leave.
  [[nodiscard]] Files outputs() const {
    Files files = files_in(out_);
    std::erase_if(files, [](const auto& file) { return file.first.starts_with('.'); });
    return files;
  }

  void expect_one_or_the_other() const {
    // The process that renames goes on when the program is killed, and is then this one's child.
    while (::waitpid(-1, nullptr, 0) > 0) {
    }
    const Files found = outputs();
    if (found == older_ || found == newer_) return;
    ADD_FAILURE() << found.size() << " files of " << newer_.size() << ", of both runs or of neither";
    for (const auto& [name, bytes] : found) {
      const bool is_older = older_.contains(name) && older_.at(name) == bytes;
      const bool is_newer = newer_.contains(name) && newer_.at(name) == bytes;
      ADD_FAILURE() << name << ": " << (is_newer ? "newer" : is_older ? "older" : "neither");
    }
  }

  void expect_next_run_undisturbed() const {
    EXPECT_EQ(ninebit(words_).code, 0);
    EXPECT_EQ(outputs(), newer_);
  }

  // Runs five times, and up to `most` times until a run is ended, and sends the signal after a random share of the time
  // that a run takes; gives how many it ended.
  int end_at_moments(int signal, int most) const {
    ninebit::test::Random random(std::hash<std::string>()(GetParam()), static_cast<std::uint64_t>(signal));
    int ended = 0;
    for (int i = 0; i < 5 || (ended == 0 && i < most); ++i) {
      const double share = static_cast<double>(random.below(1000)) / 1000.0;
      SCOPED_TRACE(testing::Message() << "at " << share << " of " << duration_ / std::chrono::milliseconds(1) << " ms");
      Child child(words_);
      std::this_thread::sleep_for(duration_ * share);
      child.send(signal);
      const Outcome outcome = child.wait();
      expect_one_or_the_other();
      if (outcome.code != 0) {
        EXPECT_EQ(outcome.code, 128 + signal);
        ++ended;
      }
      // A program that reports an interruption has cleaned up.
      if (outcome.err.find("interrupted") != std::string::npos) {
        EXPECT_EQ(files_in(out_), older_) << outcome.err;
      }
      if (outcome.code == 0) restore();
    }
    return ended;
  }

  TempFolder folder_;
  std::string out_ = folder_ / "out";
  Words words_;
  Files older_, newer_;
  Clock::duration duration_{};
};

TEST_P(OverOlder, ByKillAtMoments) {
  EXPECT_GE(end_at_moments(SIGKILL, 60), 1);
  expect_next_run_undisturbed();
}

TEST_P(OverOlder, ByInterruptAtMoments) {
  const std::string verb = GetParam();
  const bool finishes = verb == "merge" || verb == "study";  // a report that is begun
  const int ended = end_at_moments(SIGINT, finishes ? 5 : 60);
  EXPECT_TRUE(ended >= 1 || finishes);
  expect_next_run_undisturbed();
}

// Where files get their names, no moment is left to chance: the program is killed as it enters each of its system calls
// from the first that touches an older file on.
TEST_P(OverOlder, AtEachStepOfTheRenaming) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "the leak sanitizer does not work in a traced program";
  constexpr std::array kNaming{
#ifdef SYS_link
      SYS_link,
      SYS_rename,
#endif
      SYS_linkat,
      SYS_renameat2,
  };
  int older = 0, newer = 0;
  for (int step = 0;; ++step) {
    SCOPED_TRACE(step);
    Child child(words_, {.traced = true});
    int left = -1;
    const bool held = child.run_to([&](std::uint64_t call) {
      if (left < 0 && std::find(kNaming.begin(), kNaming.end(), static_cast<long>(call)) != kNaming.end()) left = step;
      return left >= 0 && left-- == 0;
    });
    if (!held) {
      const Outcome outcome = child.wait();
      if (outcome.code == 126) GTEST_SKIP() << "tracing is not allowed here";
      ASSERT_EQ(outcome.code, 0) << outcome.err;
      break;
    }
    child.send(SIGKILL);
    EXPECT_EQ(child.wait().code, 128 + SIGKILL);
    expect_one_or_the_other();
    ++(outputs() == newer_ ? newer : older);
    ASSERT_LT(step, 2000);
    restore();
  }
  EXPECT_GE(older, 1);
  EXPECT_GE(newer, 1);
  expect_next_run_undisturbed();
}

TEST_P(OverOlder, WithoutRoom) {
  std::size_t largest = 0;
  for (const auto& [name, bytes] : newer_) largest = std::max(largest, bytes.size());
  for (const std::uint64_t limit : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{largest - 1}}) {
    SCOPED_TRACE(limit);
    EXPECT_EQ(ninebit(words_, {.file_size_limit = limit, .err = "/dev/null"}).code, 4);
    EXPECT_EQ(files_in(out_), older_);
  }
  expect_next_run_undisturbed();
}

TEST_P(OverOlder, OnAFullDisk) {
  const SmallDisk disk(out_);
  if (!disk.mounted()) GTEST_SKIP() << "mounting is not allowed here: " << disk.error();
  for (const auto& [name, bytes] : older_) write_bytes(out_ + '/' + name, bytes);
  disk.fill("ballast");
  const Files before = files_in(out_);
  expect_error(ninebit(words_), 4, {out_, "No space left on device"});
  EXPECT_EQ(files_in(out_), before);
  std::filesystem::remove(out_ + "/ballast");
  expect_next_run_undisturbed();
}

INSTANTIATE_TEST_SUITE_P(Verbs, OverOlder, testing::Values("render", "study", "merge", "eval", "convert"),
                         [](const auto& verb) { return std::string(verb.param); });

}  // namespace
}  // namespace tools_test
