// Verbs that write over older files, ended by a signal at any moment or without room: the folder holds the older output
// or the newer one, never some files of either, and the next run is not disturbed by what a killed one left.
#include <gtest/gtest.h>
#include <sys/prctl.h>
#include <sys/syscall.h>
#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <functional>
#include <map>
#include <set>
#include <thread>

#include "combiner_tests/support/random.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/program_support.h"
#include "combiner_tests/tools/small_disk.h"

namespace tools_test {
namespace {

using Clock = std::chrono::steady_clock;
// A verb's two commands that write the same files with other bytes: what they write, in the folder "out", and how long
// the newer one takes.
struct Prepared {
  TempFolder folder;
  Words words;
  Files older, newer;
  Clock::duration duration{};
};

Words study_of(const std::string& steps, const std::string& folder) {
  return {"study", "shadows", kRoom, "--map-sizes", "32", "--size", "48x36", "--steps", steps, "--quiet", "-o", folder};
}

Words merge_of(const TempFolder& folder, const std::string& steps) {
  const std::string parts = folder / ("steps-" + steps);
  EXPECT_EQ(ninebit(study_of(steps, parts)).code, 0);
  return {"study", "merge", parts + "/part-1-of-1.jsonl", "--allow-outside", "--quiet", "-o", folder / "out"};
}

Words eval_of(const TempFolder& folder, const std::string& row) {
  std::string table = "tex0.r,primary.r\n";
  for (int i = 0; i < 10000; ++i) table += row + ",100\n";
  return {"eval",
          kArticle,
          "--inputs",
          write_bytes(folder / ("rows-" + row), table),
          "--quiet",
          "-o",
          folder / "out/table.csv"};
}

std::pair<Words, Words> commands_of(const std::string& verb, const TempFolder& folder) {
  const std::string out = folder / "out";
  if (verb == "render") {
    return {small_render(kRoom, out, {"--layers", "--quiet", "--light", "1,2,1"}),
            small_render(kRoom, out, {"--layers", "--quiet"})};
  }
  if (verb == "merge") return {merge_of(folder, "2"), merge_of(folder, "1")};
  if (verb == "study") {
    // Its part is whole, and beside another one's report: that one is written over.
    const Words study = study_of("1", out);
    EXPECT_EQ(ninebit(study).code, 0);
    return {merge_of(folder, "2"), study};
  }
  if (verb == "eval") return {eval_of(folder, "100"), eval_of(folder, "200")};
  const auto conversion = [&](const char* form) {
    return Words{"convert", kArticle, "--to", form, "--quiet", "-o", out + "/article"};
  };
  return {conversion("gl"), conversion("rc10")};
}

// Prepared once for all tests of a verb.
const Prepared& prepared(const std::string& verb) {
  static std::map<std::string, Prepared> known;
  const auto [found, is_new] = known.try_emplace(verb);
  Prepared& one = found->second;
  if (!is_new) return one;
  const auto [older, newer] = commands_of(verb, one.folder);
  one.words = newer;
  EXPECT_EQ(ninebit(older).code, 0);
  one.older = files_in(one.folder / "out");
  const auto start = Clock::now();
  EXPECT_EQ(ninebit(newer).code, 0);
  one.duration = Clock::now() - start;
  one.newer = files_in(one.folder / "out");
  EXPECT_NE(one.older, one.newer);
  EXPECT_EQ(one.older.size(), one.newer.size());
  for (const auto& [name, bytes] : one.older) EXPECT_TRUE(one.newer.contains(name)) << name;
  return one;
}

// The folder has the older files before each test.
class OverOlder : public testing::TestWithParam<const char*> {
 protected:
  void SetUp() override {
    ASSERT_EQ(::prctl(PR_SET_CHILD_SUBREAPER, 1), 0);
    restore();
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
      SCOPED_TRACE(testing::Message() << "at " << share << " of " << prepared_.duration / std::chrono::milliseconds(1)
                                      << " ms");
      Child child(words_);
      std::this_thread::sleep_for(prepared_.duration * share);
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

  const Prepared& prepared_ = prepared(GetParam());
  const std::string out_ = prepared_.folder / "out";
  const Words& words_ = prepared_.words;
  const Files &older_ = prepared_.older, &newer_ = prepared_.newer;
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
// from the first that touches an older file on. Others than these change nothing that is seen from outside, so that to
// be killed there is to be killed at the next of these.
TEST_P(OverOlder, AtEachStepOfTheRenaming) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "the leak sanitizer does not work in a traced program";
  const std::set<std::uint64_t> naming{
#ifdef SYS_link
      SYS_link, SYS_rename,
#endif
      SYS_linkat, SYS_renameat2};
  std::set<std::uint64_t> changing{
#ifdef SYS_unlink
      SYS_unlink,   SYS_fork,  SYS_vfork,
#endif
      SYS_unlinkat, SYS_clone, SYS_clone3, SYS_wait4, SYS_write, SYS_ftruncate, SYS_exit_group};
  changing.insert(naming.begin(), naming.end());
  int older = 0, newer = 0;
  for (int step = 0;; ++step) {
    SCOPED_TRACE(step);
    Child child(words_, {.traced = true});
    int left = -1;
    const bool held = child.run_to([&](std::uint64_t call) {
      if (left < 0 && naming.contains(call)) left = step;
      return left >= 0 && changing.contains(call) && left-- == 0;
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

// Each file in turn is the one that finds no room.
TEST_P(OverOlder, WithoutRoom) {
  std::set<std::uint64_t> limits{0, 1, 100};
  for (const auto& [name, bytes] : newer_) limits.insert(bytes.size() - 1);
  for (const std::uint64_t limit : limits) {
    SCOPED_TRACE(limit);
    // Messages would fall under the limit as well, unless they go to no file.
    EXPECT_EQ(ninebit(words_, {.file_size_limit = limit, .err = "/dev/null"}).code, 4);
    EXPECT_EQ(files_in(out_), older_);
  }
  expect_next_run_undisturbed();
}

// Nothing at all, and only a little, can be written.
TEST_P(OverOlder, OnAFullDisk) {
  const SmallDisk disk(out_);
  if (!disk.mounted()) GTEST_SKIP() << "mounting is not allowed here: " << disk.error();
  for (const auto& [name, bytes] : older_) write_bytes(out_ + '/' + name, bytes);
  disk.fill("ballast");
  const auto expect_no_room = [&] {
    const Files before = files_in(out_);
    expect_error(ninebit(words_), 4, {out_, "No space left on device"});
    EXPECT_EQ(files_in(out_), before);
  };
  expect_no_room();
  std::size_t most = 0;
  for (const auto& [name, bytes] : newer_) most = std::max(most, bytes.size());
  if (most > 8192) {
    std::filesystem::resize_file(out_ + "/ballast", std::filesystem::file_size(out_ + "/ballast") - 4096);
    expect_no_room();
  }
  std::filesystem::remove(out_ + "/ballast");
  expect_next_run_undisturbed();
}

INSTANTIATE_TEST_SUITE_P(Verbs, OverOlder, testing::Values("render", "study", "merge", "eval", "convert"),
                         [](const auto& verb) { return std::string(verb.param); });

}  // namespace
}  // namespace tools_test
