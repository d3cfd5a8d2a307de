// Parts of studies that somebody altered, that name files, and that two runs want.
#include <gtest/gtest.h>

#include <chrono>
#include <functional>

#include "combiner_tests/tools/support.h"
#include "ninebit/study/study_part.h"
#include "src/study/part/part_text.h"
#include "src/system/file_lock.h"
#include "src/system/hashing/openssl.h"

namespace tools_test {
namespace {

using namespace ninebit;
Outcome merge_parts(const Words& parts, const std::string& folder, const ChildSettings& settings = {}) {
  return ninebit(Words{"study", "merge", "--quiet", "-o", folder} + parts, settings);
}

// The lines of a part as a run writes them.
std::string written(const StudyPart& part) {
  std::string text = header_line(part.header);
  for (const FinishedUnit& unit : part.units) text += unit_line(unit);
  return text + end_line(part.units.size(), sha256(text));
}

class AlteredPart : public testing::Test {
 protected:
  // Each study in its smallest form; the part stands in the folder "out".
  void make(const Words& study) {
    const Outcome outcome = ninebit(Words{"study"} + study + Words{"--quiet", "-o", folder_ / "out"});
    ASSERT_EQ(outcome.code, 0) << outcome.err;
    auto part = read_part(folder_ / "out/part-1-of-1.jsonl");
    ASSERT_TRUE(part) << part.error().text();
    part_ = *part;
  }

  // With hashes that fit, merged: refused by a line that holds the words, within seconds.
  void expect_refused(const std::function<void(StudyPart&)>& alter, const Words& words) const {
    StudyPart part = part_;
    alter(part);
    const std::string file = write_bytes(folder_ / "evil.jsonl", written(part));
    const auto begin = std::chrono::steady_clock::now();
    const Outcome outcome = merge_parts({file}, folder_ / "merged");
    const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
    expect_error(outcome, 3, words + Words{"evil.jsonl:"});
    EXPECT_LT(seconds.count(), 10.0);
    EXPECT_FALSE(std::filesystem::exists(folder_ / "merged"));
  }

  static StudyValue& value(StudyPart& part, std::size_t unit, const std::string& name) {
    for (auto& [field, found] : part.units.at(unit).rows.at(0).fields) {
      if (field == name) return found;
    }
    throw std::runtime_error("no field " + name);
  }

  TempFolder folder_;
  StudyPart part_;
};

// Every value of every study: combiner_tests/study/row_rules_test.cpp.
TEST_F(AlteredPart, IsRefused) {
  make({"depth-packing", "--packings", "rgba8-mod", "--depths", "16", "--storages", "round"});
  expect_refused([](auto& p) { value(p, 0, "packing") = std::string("x"); },
                 {":2: unit 0", "row 1", "packing is 'x'; expected 'rgba8-mod'"});
  expect_refused([](auto& p) { value(p, 0, "max_error") = 1e308; }, {"max_error is 1e+308"});
  expect_refused([](auto& p) { p.units[1].rows.pop_back(); }, {"has 255 rows; expected 256"});
  expect_refused([](auto& p) { std::swap(p.units[0].rows, p.units[1].rows); }, {"unit 0"});
  expect_refused([](auto& p) { p.header.units = std::size_t{1} << 24; }, {":1: ", "expected 2"});
  expect_refused([](auto& p) { p.header.units = ~std::size_t{0}; }, {":1: ", "expected 1 to 16777216"});
  expect_refused([](auto& p) { p.header.shard = {3, 3}; }, {":1: shard 3/3 of 2 units"});
  expect_refused([](auto& p) { p.header.question.study = "none"; }, {":1: its command"});
  expect_refused([](auto& p) { p.header.question.options[0].second = "rgba8-mod,rgba8-mod"; }, {"given twice"});
}

TEST_F(AlteredPart, OfShadowsIsRefused) {
  make({"shadows", kRoom, "--size", "16x12", "--map-sizes", "8,16"});
  const Words outside{"--allow-outside"};
  StudyPart part = part_;
  value(part, 0, "point") = std::uint64_t{1} << 40;
  const std::string file = write_bytes(folder_ / "evil.jsonl", written(part));
  expect_error(merge_parts({file, "--allow-outside"}, folder_ / "merged"), 3, {"evil.jsonl:2", "point", "expected 0"});
}

// A name that its command holds is opened only below the working folder.
TEST_F(AlteredPart, NamesFilesBelowTheWorkingFolderAlone) {
  const std::string compare = NINEBIT_SOURCE_DIR "/docs/programs/index_compare.gl";
  std::filesystem::create_directory(folder_ / "work");
  std::filesystem::copy_file(compare, folder_ / "work/compare.gl");
  std::filesystem::copy_file(compare, folder_ / "compare.gl");
  const ChildSettings in_work{.folder = folder_ / "work"};
  const auto make_part = [&](const std::string& program, const std::string& out) {
    return ninebit({"study", "index-steps", "--program", program, "--formats", "channel", "--steps", "1", "--profile",
                    "geforce2", "--quiet", "-o", out},
                   in_work);
  };
  ASSERT_EQ(make_part("compare.gl", "inside").code, 0);
  EXPECT_EQ(merge_parts({"inside/part-1-of-1.jsonl"}, "merged", in_work).code, 0);
  for (const std::string& name : {std::string("../compare.gl"), compare, std::string("link.gl")}) {
    SCOPED_TRACE(name);
    if (name == "link.gl") std::filesystem::create_symlink("../compare.gl", folder_ / "work/link.gl");
    std::filesystem::remove_all(folder_ / "work/outside");
    ASSERT_EQ(make_part(name, "outside").code, 0);
    const Outcome refused = merge_parts({"outside/part-1-of-1.jsonl"}, "merged2", in_work);
    expect_error(refused, 3, {"part-1-of-1.jsonl:1", "'" + name + "'", "--allow-outside"});
    EXPECT_EQ(merge_parts({"outside/part-1-of-1.jsonl", "--allow-outside"}, "merged3", in_work).code, 0);
  }
}

// So are the files that its scene names, whatever the part says.
TEST_F(AlteredPart, ItsSceneNamesFilesBelowItsFolderAlone) {
  std::filesystem::create_directory(folder_ / "work");
  const ChildSettings in_work{.folder = folder_ / "work"};
  const std::string corners = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";
  write_bytes(folder_ / "work/s.obj", "mtllib ../outside.mtl\n" + corners + "usemtl red\nf 1 2 3\n");
  write_bytes(folder_ / "outside.mtl", "newmtl red\nKd 1 0 0\n");
  const Words run{"study", "shadows", "s.obj", "--size", "8x8", "--map-sizes", "8", "--quiet", "-o", "run"};
  const Words allowed = run + Words{"--allow-outside"};
  expect_error(ninebit(run, in_work), 3, {"'../outside.mtl'", "--allow-outside"});
  ASSERT_EQ(ninebit(allowed, in_work).code, 0);
  expect_error(merge_parts({"run/part-1-of-1.jsonl"}, "merged", in_work), 3, {"'../outside.mtl'", "--allow-outside"});
  EXPECT_EQ(merge_parts({"run/part-1-of-1.jsonl", "--allow-outside"}, "merged", in_work).code, 0);
  auto part = read_part(folder_ / "work/run/part-1-of-1.jsonl");
  ASSERT_TRUE(part) << part.error().text();
  part->header.question.options.emplace_back("--allow-outside", "");
  write_bytes(folder_ / "work/evil.jsonl", written(*part));
  expect_error(merge_parts({"evil.jsonl"}, "merged2", in_work), 3, {"evil.jsonl:1", "its command has --allow-outside"});
}

// A part as it is while another run writes it.
TEST_F(AlteredPart, ASecondRunIsToldOfTheFirst) {
  const Words study{"index-steps", "--formats", "la", "--steps", "2", "--profile", "geforce2"};
  make(study);
  const std::string file = folder_ / "out/part-1-of-1.jsonl", bytes = read_bytes(file);
  Words words{"study", "--quiet", "-o", folder_ / "out"};
  words.insert(words.begin() + 1, study.begin(), study.end());
  {
    const posix::FileLock lock(file);
    ASSERT_EQ(lock.outcome(), posix::FileLock::Outcome::held);
    expect_error(ninebit(words), 4, {file, "another run is writing this part"});
  }
  EXPECT_EQ(read_bytes(file), bytes);
  EXPECT_EQ(ninebit(words).code, 0);
}

// Many runs at once: one does the work, the others say so, and the part is that of one run.
TEST_F(AlteredPart, RunsAtOnceLeaveAWholePart) {
  const Words study{"study",          "index-steps", "--profile", "geforce2", "--formats",
                    "channel,la,l,a", "--steps",     "1-4",       "--quiet",  "-o"};
  Words alone = study, together = study;
  alone.push_back(folder_ / "alone");
  together.push_back(folder_ / "together");
  ASSERT_EQ(ninebit(alone).code, 0);
  {
    std::vector<std::unique_ptr<Child>> runs;
    for (int i = 0; i < 4; ++i) runs.push_back(std::make_unique<Child>(together));
    int done = 0;
    for (const auto& run : runs) {
      const Outcome outcome = run->wait();
      done += outcome.code == 0 ? 1 : 0;
      if (outcome.code != 0) expect_error(outcome, 4, {"another run is writing this part"});
    }
    EXPECT_GE(done, 1);
  }
  ASSERT_EQ(ninebit(together).code, 0);
  EXPECT_EQ(files_in(folder_ / "together"), files_in(folder_ / "alone"));
}

// The file that two runs at once left before there was a lock: the same lines twice.
TEST_F(AlteredPart, LinesThatStandTwiceHeal) {
  const Words study{"index-steps", "--formats", "la", "--steps", "2", "--profile", "geforce2"};
  make(study);
  const Files whole = files_in(folder_ / "out");
  const std::string header = header_line(part_.header), first = unit_line(part_.units[0]);
  const std::string file = folder_ / "out/part-1-of-1.jsonl";
  Words words{"study", "--quiet", "-o", folder_ / "out"};
  words.insert(words.begin() + 1, study.begin(), study.end());
  write_bytes(file, header + header + first + first + "{\"unit\":1,\"ro");
  const Outcome outcome = ninebit(words);
  ASSERT_EQ(outcome.code, 0) << outcome.err;
  EXPECT_TRUE(read_bytes(file).starts_with(header + header + first + first + "{\"unit\":1,\"rows\""));
  Files healed = files_in(folder_ / "out");
  healed["part-1-of-1.jsonl"] = whole.at("part-1-of-1.jsonl");
  EXPECT_EQ(healed, whole);
  ASSERT_EQ(merge_parts({file}, folder_ / "merged").code, 0);
  // Twice with other rows is not two runs of one study.
  FinishedUnit other = part_.units[0];
  other.rows[0].fields.back().second = std::uint64_t{3};
  write_bytes(file, header + first + unit_line(other));
  expect_error(ninebit(words), 3, {file + ":3", "unit 0 is repeated with other rows"});
}

}  // namespace
}  // namespace tools_test
