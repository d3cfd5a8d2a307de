// Renderings that are ended by a signal, at many moments: older files stay whole, SIGINT leaves nothing behind.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <optional>
#include <stdexcept>
#include <thread>
#include <utility>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

using Clock = std::chrono::steady_clock;

// When to send: as soon as the folder holds a temporary file for an output of this name ("" as soon as there is the
// folder), or after a share of the time that a rendering takes.
struct Moment {
  const char* file = nullptr;
  double share = 0.0;
};

bool has_come(const Moment& moment, const std::string& folder) {
  if (*moment.file == 0) return std::filesystem::exists(folder);
  const std::string start = std::string(".") + moment.file + ".ninebit-";
  return has_file(folder, [&](const std::string& name) { return name.starts_with(start); });
}

// Once nothing changes any more: the process that gives several files their names goes on where its parent is killed.
Files settled_files_in(const std::string& folder) {
  for (std::optional<Files> last;;) {
    try {
      Files now = files_in(folder);
      if (last == now) return now;
      last = std::move(now);
    } catch (const std::runtime_error&) {  // a file got another name meanwhile
      last.reset();
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

// The folder has an older rendering before each test.
class Interrupt : public testing::Test {
 protected:
  static Words long_render(const std::string& folder) {
    return small_render(kBunny, folder, {"--quiet", "--layers", "--size", "480x360", "--map-size", "256"});
  }

  // What both renderings write, and how long the newer one takes.
  static void SetUpTestSuite() {
    const TempFolder folder;
    ASSERT_EQ(ninebit(small_render(kBunny, folder / "old", {"--layers"})).code, 0);
    older_ = files_in(folder / "old");
    ASSERT_EQ(older_.size(), 6U);
    const auto start = Clock::now();
    ASSERT_EQ(ninebit(long_render(folder / "new")).code, 0);
    duration_ = Clock::now() - start;
    newer_ = files_in(folder / "new");
  }

  void SetUp() override { restore(); }
  void restore() const {
    std::filesystem::create_directory(out_);
    for (const auto& [name, bytes] : older_) write_bytes(out_ + '/' + name, bytes);
  }

  // Renders into the folder and sends the signals, one shortly after the other.
  static Outcome interrupted(const Moment& moment, const std::vector<int>& signals, const std::string& folder) {
    Child child(long_render(folder));
    if (moment.file == nullptr) {
      std::this_thread::sleep_for(duration_ * moment.share);
    } else {
      child.until([&] { return has_come(moment, folder); });
    }
    for (const int signal : signals) {
      child.send(signal);
      std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
    return child.wait();
  }

  TempFolder folder_;
  std::string out_ = folder_ / "out";
  static inline Files older_, newer_;
  static inline Clock::duration duration_{};
};

TEST_F(Interrupt, TheFirstSigintEndsCleanly) {
  bool while_writing = false;
  for (const Moment moment :
       {Moment{"color"}, {"index_cube"}, {"layers"}, {nullptr, 0.05}, {nullptr, 0.4}, {nullptr, 0.7}}) {
    SCOPED_TRACE(moment.file != nullptr ? moment.file : std::to_string(moment.share));
    const Outcome outcome = interrupted(moment, {SIGINT}, out_);
    if (outcome.code == 0) {
      EXPECT_EQ(files_in(out_), newer_) << "it was over before the signal came";
      restore();
      continue;
    }
    EXPECT_EQ(outcome.code, 130) << outcome.err;
    EXPECT_EQ(files_in(out_), older_);
    // Before the program has begun to work, the signal ends it without a word.
    if (!outcome.err.empty()) expect_error(outcome, 130, {"interrupted"});
    while_writing |= moment.file != nullptr && !outcome.err.empty();
  }
  EXPECT_TRUE(while_writing) << "no signal came while files were being written";
}

TEST_F(Interrupt, WhileDrawingRemovesTheFolderThatWasMade) {
  for (const int signal : {SIGINT, SIGTERM, SIGHUP}) {
    expect_error(interrupted({""}, {signal}, folder_ / "made/for/this"), 128 + signal, {"interrupted"});
    EXPECT_FALSE(std::filesystem::exists(folder_ / "made"));
  }
}

// An end that cannot be cleaned up after: temporary files may stay, but every file of an output's name is whole.
TEST_F(Interrupt, ASecondSignalEndsInNoHalfWrittenFile) {
  int killed = 0;
  for (const Moment moment : {Moment{"shadow"}, {"layers"}, {nullptr, 0.9}}) {
    SCOPED_TRACE(moment.file != nullptr ? moment.file : std::to_string(moment.share));
    killed += static_cast<int>(interrupted(moment, {SIGINT, SIGINT}, out_).code != 0);
    const Files files = settled_files_in(out_);
    for (const auto& [name, bytes] : older_) {
      ASSERT_TRUE(files.contains(name)) << name;
      EXPECT_TRUE(files.at(name) == bytes || files.at(name) == newer_.at(name)) << name;
    }
    for (const auto& [name, bytes] : files) {
      EXPECT_TRUE(older_.contains(name) || name.starts_with('.')) << name;
      // A temporary file that stays would be the next moment's.
      if (name.starts_with('.')) std::filesystem::remove(out_ + '/' + name);
    }
  }
  EXPECT_GE(killed, 1);
  EXPECT_EQ(ninebit(long_render(out_)).code, 0) << "and the next rendering is none the worse for it";
  EXPECT_EQ(files_in(out_), newer_);
}

// As `nohup` starts a program, or a shell one in the background.
TEST_F(Interrupt, WhatWasIgnoredStaysIgnored) {
  for (const int signal : {SIGHUP, SIGINT, SIGTERM}) {
    SCOPED_TRACE(signal);
    Child child(long_render(out_), {.ignored = {signal}});
    child.until([&] { return has_come({"color"}, out_); });
    for (int i = 0; i < 3; ++i) child.send(signal);
    EXPECT_EQ(child.wait().code, 0);
    EXPECT_EQ(files_in(out_), newer_);
    restore();
  }
}

// While a page's traces are made, which the progress line says: nothing is left but what a study keeps of its points.
TEST(InterruptOfTraces, LeavesNoPage) {
  const TempFolder folder;
  const std::string compared = folder / "compared", swept = folder / "swept";
  struct Case {
    Words words;
    std::string folder, shown;
    std::size_t kept;
  };
  const std::vector<Case> cases{
      {{"compare", kRoom, "--vary", "index-step=1,2", "-o", compared}, compared, ": traces", 0},
      {{"study", "shadows", kRoom, "--map-sizes", "64", "-o", swept}, swept, "maps and files", 1}};
  ::setenv("TERM", "xterm", 1);
  for (const Case& c : cases) {
    SCOPED_TRACE(c.words[0]);
    const Terminal terminal;
    Child child(c.words, {.err = terminal.name()});
    const std::string seen = terminal.seen_until(c.shown);
    ASSERT_NE(seen.find(c.shown), std::string::npos) << seen;
    child.send(SIGINT);
    EXPECT_EQ(child.wait().code, 130);
    EXPECT_EQ(files_in(c.folder).size(), c.kept);
    expect_parts(terminal.seen_until("interrupted"), {"interrupted"});
    EXPECT_EQ(ninebit(c.words + Words{"--quiet"}).code, 0) << "and the next one is none the worse for it";
    EXPECT_GE(files_in(c.folder).size(), 2U);
  }
}

}  // namespace
}  // namespace tools_test
