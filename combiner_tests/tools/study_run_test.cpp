// How the program runs a study: parts, merging, going on after an interruption, and what it refuses.
#include <gtest/gtest.h>

#include <chrono>
#include <csignal>
#include <cstdlib>
#include <thread>

#include "combiner_tests/tools/small_disk.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

// A study of some units that is over in a moment.
Words small_study(const std::string& folder, const Words& more = {}) {
  const Words words{"study", "index-steps", "--profile", "geforce2", "--formats", "l,a", "--steps", "1-16", "--quiet"};
  return (folder.empty() ? words : words + Words{"-o", folder}) + more;
}

// One that takes half a second, in 29 units.
Words long_study(const std::string& folder) {
  return {"study", "index-steps", "--profile", "float-shader", "--threads", "1", "--quiet", "-o", folder};
}

Files without_parts(Files files) {
  std::erase_if(files, [](const auto& file) { return file.first.ends_with(".jsonl"); });
  return files;
}

// Without what a killed program had written of its report: nothing can take it away after SIGKILL, and as the names are
// random, it is in nobody's way.
Files without_temporaries(Files files) {
  std::erase_if(files, [](const auto& file) {
    return file.first.starts_with(".") && file.first.find(".ninebit-") != std::string::npos;
  });
  return files;
}

Outcome merge(const Words& parts, const std::string& folder) {
  return ninebit(Words{"study", "merge", "--quiet", "-o", folder} + parts);
}

TEST(StudyRun, WritesAReportAndItsRows) {
  const TempFolder folder;
  const Outcome outcome = ninebit(small_study(folder / "out"));
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  const Files files = files_in(folder / "out");
  for (const char* name : {"report.html", "rows.json", "rows.csv", "part-1-of-1.jsonl"}) {
    EXPECT_TRUE(files.contains(name)) << name;
  }
  expect_parts(files.at("report.html"), {"ninebit study index-steps"});
  // Again, and with other threads: the same bytes.
  ASSERT_EQ(ninebit(small_study(folder / "out")).code, 0);
  EXPECT_EQ(files_in(folder / "out"), files);
  ASSERT_EQ(ninebit(small_study(folder / "other", {"--threads", "3"})).code, 0);
  EXPECT_EQ(files_in(folder / "other"), files);
  // The rows of the file are those of stdout.
  EXPECT_EQ(Json::parse(files.at("rows.json")), json_of(ninebit(small_study("", {"--json"}))));
}

// One whole run and three parts, each test's own copy of those of the first.
class StudyParts : public testing::Test {
 protected:
  void SetUp() override {
    static const TempFolder made;
    if (!std::filesystem::exists(made / "whole")) {
      ASSERT_EQ(ninebit(small_study(made / "whole")).code, 0);
      for (const char* shard : {"1/3", "2/3", "3/3"}) {
        ASSERT_EQ(ninebit(small_study(made / "parts", {"--shard", shard})).code, 0);
      }
      ASSERT_EQ(files_in(made / "parts").size(), 3U) << "a part alone makes no report";
    }
    std::filesystem::copy(made.path(), folder_.path(), std::filesystem::copy_options::recursive);
    for (int i = 1; i <= 3; ++i) part_.push_back(parts_ + "/part-" + std::to_string(i) + "-of-3.jsonl");
  }

  void expect_refused(const Words& parts, const Words& words) const {
    expect_error(merge(parts, merged_), 3, words);
    EXPECT_FALSE(std::filesystem::exists(merged_));
  }

  TempFolder folder_;
  std::string whole_ = folder_ / "whole", parts_ = folder_ / "parts", merged_ = folder_ / "merged";
  Words part_;
};

TEST_F(StudyParts, MergeToTheBytesOfOneRun) {
  const Outcome outcome = merge({part_[2], part_[0], part_[1]}, merged_);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_EQ(files_in(merged_), without_parts(files_in(whole_)));
}

TEST_F(StudyParts, ThatDoNotBelongTogetherAreRefused) {
  expect_refused({part_[0], part_[1]}, {"shard 3/3", "missing"});
  expect_refused({part_[0], part_[1], part_[2], part_[1]}, {part_[1], "repeats shard"});
  ASSERT_EQ(ninebit(small_study(folder_ / "foreign", {"--shard", "3/3", "--steps", "1-5"})).code, 2)
      << "a flag may stand once";
  const Words foreign{"study",   "index-steps", "--profile", "geforce2", "--formats",        "l,a", "--steps", "1-5",
                      "--quiet", "--shard",     "3/3",       "-o",       folder_ / "foreign"};
  ASSERT_EQ(ninebit(foreign).code, 0);
  const std::string other = folder_ / "foreign/part-3-of-3.jsonl";
  expect_refused({part_[0], part_[1], other}, {other, "another question", "1-5"});
  expect_refused({part_[0], part_[1], folder_ / "none.jsonl"}, {"none.jsonl", "cannot be read"});
  expect_refused({part_[0], part_[1], kRoom}, {kRoom + ": this is a glTF scene; `ninebit render` draws it"});
}

TEST_F(StudyParts, DamageIsRefused) {
  const std::string bytes = read_bytes(part_[1]);
  std::string damaged = bytes;
  damaged[bytes.size() / 2] = damaged[bytes.size() / 2] == '1' ? '2' : '1';
  write_bytes(part_[1], damaged);
  expect_refused(part_, {part_[1] + ":", "SHA-256"});
  // Nor does a run go on in it, or touch it.
  expect_error(ninebit(small_study(parts_, {"--shard", "2/3"})), 3, {part_[1] + ":", "SHA-256"});
  EXPECT_EQ(read_bytes(part_[1]), damaged);
  // A part that was cut off is read: merging prints how much there is, and the run goes on to the same bytes.
  write_bytes(part_[1], bytes.substr(0, bytes.size() / 2));
  expect_refused(part_, {part_[1], "not complete"});
  ASSERT_EQ(ninebit(small_study(parts_, {"--shard", "2/3"})).code, 0);
  EXPECT_EQ(read_bytes(part_[1]), bytes);
}

TEST_F(StudyParts, ByGnuParallel) {
  if (std::system("command -v parallel >/dev/null") != 0) GTEST_SKIP() << "GNU parallel is not installed";
  const std::string command = "PATH=" NINEBIT_BINARY_DIR ":$PATH " NINEBIT_SOURCE_DIR
                              "/docs/scaling/with_parallel.sh 3 " +
                              merged_ + " index-steps --profile geforce2 --formats l,a --steps 1-16 >/dev/null 2>&1";
  ASSERT_EQ(std::system(command.c_str()), 0);
  EXPECT_EQ(without_parts(files_in(merged_)), without_parts(files_in(whole_)));
}

TEST(StudyRun, AQuestionGoesIntoAFolderOfItsOwn) {
  const TempFolder folder;
  ASSERT_EQ(ninebit(small_study(folder / "out")).code, 0);
  const Files before = files_in(folder / "out");
  expect_error(ninebit({"study", "datapath", "--quiet", "-o", folder / "out"}), 3,
               {"part-1-of-1.jsonl", "another question", "index-steps", "datapath"});
  EXPECT_EQ(files_in(folder / "out"), before);
}

TEST(StudyRun, WrongUsage) {
  const TempFolder folder;
  for (const Words& wrong : {Words{"--shard", "2/3"}, Words{"--budget", "3"}}) {
    EXPECT_EQ(ninebit(small_study("", wrong)).code, 2) << wrong[0];
  }
  for (const char* shard : {"0/3", "4/3", "1", "a/b", "1/0", "-1/2"}) {
    expect_error(ninebit(small_study(folder / "out", {"--shard", shard})), 2, {"--shard"});
  }
  expect_error(ninebit(small_study(folder / "out", {"--shard", "1/100000"})), 3, {"shard", "units"});
  expect_error(ninebit({"study", "merge", "-o", folder / "out"}), 2, {"parts"});
  EXPECT_FALSE(std::filesystem::exists(folder / "out"));
}

// Killed at moments spread over the run, it goes on each time, and ends with the bytes of a run that nobody killed.
TEST(StudyRun, KilledAndGoneOnGivesTheSameBytes) {
  const TempFolder folder;
  ASSERT_EQ(ninebit(long_study(folder / "whole")).code, 0);
  int killed = 0;
  for (int i = 0; i < 10; ++i) {
    Child child(long_study(folder / "killed"));
    std::this_thread::sleep_for(std::chrono::milliseconds(30 + 30 * i));
    child.send(i % 2 == 0 ? SIGKILL : SIGINT);
    const Outcome outcome = child.wait();
    if (outcome.code == 0) break;
    ASSERT_EQ(outcome.code, i % 2 == 0 ? 137 : 130) << outcome.err;
    if (std::filesystem::exists(folder / "killed/report.html")) break;  // killed when all was written
    ++killed;
  }
  EXPECT_GE(killed, 2);
  ASSERT_EQ(ninebit(long_study(folder / "killed")).code, 0);
  EXPECT_EQ(without_temporaries(files_in(folder / "killed")), files_in(folder / "whole"));
}

TEST(StudyRun, ABudgetEndsARunThatGoesOnLater) {
  const TempFolder folder;
  const Outcome first = ninebit(long_study(folder / "out") + Words{"--budget", "0"});
  ASSERT_EQ(first.code, 0) << first.err;
  const std::string part = folder / "out/part-1-of-1.jsonl";
  const std::string begun = read_bytes(part);
  EXPECT_EQ(std::count(begun.begin(), begun.end(), '\n'), 1) << "nothing is begun after no time";
  EXPECT_TRUE(std::filesystem::exists(folder / "out/report.html"));
}

TEST(StudyRun, NoRoomKeepsWhatWasFinished) {
  const TempFolder folder;
  ASSERT_EQ(ninebit(small_study(folder / "whole")).code, 0);
  const std::uint64_t size = read_bytes(folder / "whole/part-1-of-1.jsonl").size();
  const std::string out = folder / "out", part = out + "/part-1-of-1.jsonl";
  for (const std::uint64_t limit : {std::uint64_t{0}, std::uint64_t{100}, size / 3, size - 1}) {
    SCOPED_TRACE(limit);
    EXPECT_EQ(ninebit(small_study(out), {.file_size_limit = limit, .err = "/dev/null"}).code, 4);
    EXPECT_LE(files_in(out).size(), 1U);
  }
  // The part has room, the report has none: nothing of it is there.
  EXPECT_EQ(ninebit(small_study(out), {.file_size_limit = size + 1, .err = "/dev/null"}).code, 4);
  EXPECT_EQ(files_in(out).size(), 1U);
  ASSERT_EQ(ninebit(small_study(out)).code, 0);
  EXPECT_EQ(files_in(out), files_in(folder / "whole"));
}

// Room for a little more of the part each time, then for all of it and not for the report, at last for both.
TEST(StudyRun, AFullDiskKeepsWhatWasFinished) {
  const TempFolder folder;
  ASSERT_EQ(ninebit(small_study(folder / "whole")).code, 0);
  const Files whole = files_in(folder / "whole");
  const std::string name = "part-1-of-1.jsonl", out = folder / "out", ballast = out + "/ballast";
  const SmallDisk disk(out);
  if (!disk.mounted()) GTEST_SKIP() << "mounting is not allowed here: " << disk.error();
  // The older report, on nothing yet.
  ASSERT_EQ(ninebit(small_study(out, {"--budget", "0"})).code, 0);
  const Files older = without_parts(files_in(out));
  ASSERT_TRUE(older.contains("report.html"));
  disk.fill("ballast");
  const auto expect_no_room = [&] {
    const std::uint64_t filled = std::filesystem::file_size(ballast);
    expect_error(ninebit(small_study(out)), 4, {out, "No space left on device"});
    Files found = files_in(out);
    EXPECT_TRUE(whole.at(name).starts_with(found[name]));
    const std::size_t kept = found[name].size();
    EXPECT_EQ(found["ballast"].size(), filled);
    found.erase("ballast");
    EXPECT_EQ(without_parts(found), older);
    return kept;
  };
  std::size_t kept = expect_no_room();
  for (int i = 0; i < 2; ++i) {
    std::filesystem::resize_file(ballast, std::filesystem::file_size(ballast) - 4096);
    const std::size_t more = expect_no_room();
    EXPECT_GT(more, kept);
    EXPECT_LT(more, whole.at(name).size());
    kept = more;
  }
  std::filesystem::resize_file(ballast, std::filesystem::file_size(ballast) - whole.at(name).size());
  EXPECT_EQ(expect_no_room(), whole.at(name).size());
  std::filesystem::remove(ballast);
  ASSERT_EQ(ninebit(small_study(out)).code, 0);
  EXPECT_EQ(files_in(out), whole);
}

}  // namespace
}  // namespace tools_test
