// --index-order, --patch-angle, --index-scales and --check-order: what is drawn and answered, and the warnings where
// the order has no effect.
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <sstream>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

const std::string kLabels = NINEBIT_SOURCE_DIR "/scenes/cookies/labels.dds";

Words room_render(const TempFolder& folder, const Words& more) {
  return small_render(kRoom, folder / "out", Words{"--size", "160x120", "--map-size", "64", "--light-facing"} + more);
}

Json answer_of(const TempFolder& folder, Words more) {
  return json_of(ninebit(room_render(folder, more + Words{"--json", "--quiet"})));
}

bool has_text(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(IndexOrder, TheFilesIsTheDefault) {
  const TempFolder folder;
  const Json plain = answer_of(folder, {});
  EXPECT_EQ(keys_of(plain["index"]), (Words{"format", "scope", "step", "used", "capacity", "scales", "order"}));
  EXPECT_EQ(plain["index"]["order"], "file");
  EXPECT_EQ(plain["index"]["scales"], "both-x4");
  const Json given =
      answer_of(folder, {"--index-order", "file", "--index-scales", "both-x4", "--patch-angle", "20", "--check-order"});
  EXPECT_EQ(given["hash"], plain["hash"]);
  EXPECT_EQ(given["index"], plain["index"]);
  EXPECT_EQ(answer_of(folder, {"--patch-angle", "90"})["hash"], plain["hash"]) << "only neighbour reads the angle";
}

TEST(IndexOrder, NeighbourAnswersItsCounts) {
  const TempFolder folder;
  const Json answer = answer_of(folder, {"--index-order", "neighbour"});
  const Json& index = answer["index"];
  EXPECT_EQ(keys_of(index), (Words{"format", "scope", "step", "used", "capacity", "scales", "order", "patches",
                                   "borders", "broken_borders", "broken_share", "false_neighbours"}));
  EXPECT_EQ(index["order"], "neighbour");
  EXPECT_GT(index["patches"], 0);
  EXPECT_GT(index["borders"], 0);
  EXPECT_LE(index["broken_borders"].get<int>(), index["borders"].get<int>());
  EXPECT_GE(index["broken_share"].get<double>(), 0.0);
  EXPECT_LE(index["broken_share"].get<double>(), 1.0);
  EXPECT_EQ(index["false_neighbours"], 0);
  const Json plain = answer_of(folder, {});
  EXPECT_LT(answer["pixels"]["shadowed"], plain["pixels"]["shadowed"]) << "joints that are gone";
  EXPECT_EQ(answer["pixels"]["background"], plain["pixels"]["background"]);
  EXPECT_NE(answer["hash"]["index_map"], plain["hash"]["index_map"]);
}

TEST(IndexOrder, PatchAngleCutsPatches) {
  const TempFolder folder;
  const auto patches = [&](const char* degrees) {
    return answer_of(folder, {"--index-order", "neighbour", "--patch-angle", degrees})["index"]["patches"].get<int>();
  };
  EXPECT_GT(patches("0"), patches("90"));
}

TEST(IndexOrder, ScalesChangeWhatTheComparisonLoses) {
  const TempFolder folder;
  const auto shadowed = [&](const char* scales) {
    const Json answer = answer_of(folder, {"--index-scales", scales});
    EXPECT_EQ(answer["index"]["scales"], scales);
    EXPECT_EQ(answer["index"]["order"], "file");
    return answer["pixels"]["shadowed"].get<int>();
  };
  const int both = shadowed("both-x4"), first = shadowed("first-x4"), none = shadowed("no-scale");
  EXPECT_LE(first, both);
  EXPECT_LT(none, first) << "differences below 16 are lost";
  EXPECT_LE(shadowed("second-x4"), first);
}

TEST(IndexOrder, CheckOrderPassesWithoutFalseNeighbours) {
  const TempFolder folder;
  const Outcome checked = ninebit(room_render(folder, {"--index-order", "neighbour", "--check-order"}));
  EXPECT_EQ(checked.code, 0) << checked.err;
  EXPECT_FALSE(has_text(checked.err, "ninebit:")) << checked.err;
  const Json index = answer_of(folder, {"--index-order", "neighbour", "--check-order"})["index"];
  const std::string line = "index order: " + index["patches"].dump() + " patches, " + index["borders"].dump() +
                           " borders, " + index["broken_borders"].dump() + " broken (";
  EXPECT_TRUE(has_text(checked.out, line)) << checked.out;
  EXPECT_TRUE(has_text(checked.out, " % of their length), 0 false neighbours\n")) << checked.out;
  // The same lines without the check, but for the time; none of them for the order of the file.
  EXPECT_TRUE(has_text(ninebit(room_render(folder, {"--index-order", "neighbour"})).out, line));
  EXPECT_FALSE(has_text(ninebit(room_render(folder, {})).out, "index order"));
  const Outcome quiet = ninebit(room_render(folder, {"--index-order", "neighbour", "--check-order", "--quiet"}));
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.err, "");
  expect_parts(quiet.out, {" shadowed, "});  // the result
}

TEST(IndexOrder, CheckOrderWithoutNeighbourIsAWarning) {
  const TempFolder folder;
  EXPECT_TRUE(has_text(err_of(ninebit(room_render(folder, {"--check-order"}))),
                       "ninebit: warning: --check-order has no effect without --index-order neighbour\n"));
}

// The codes of a register line of a trace: "  primary   136    8    8  255".
std::vector<int> codes_of(const std::string& text, const std::string& name) {
  std::istringstream line(text.substr(text.find("\n  " + name + " ") + 3 + name.size()));
  std::vector<int> codes(3);
  for (int& code : codes) line >> code;
  return codes;
}

TEST(IndexOrder, TraceOfAFormerJointShowsWhereTheDifferenceIsLost) {
  const auto traced = [](const char* order) {
    return out_of(ninebit({"trace", "--scene", kRoom, "--size", "800x600", "--pixel", "427,393", "--light-facing",
                           "--index-order", order}));
  };
  const std::string joint = traced("file"), lost = traced("neighbour");
  EXPECT_TRUE(has_text(joint, " shadowed\n"));
  EXPECT_FALSE(has_text(joint, "<- everything"));
  EXPECT_TRUE(has_text(lost, " lit\n"));
  EXPECT_TRUE(has_text(lost, "<- everything"));
  const std::vector<int> own = codes_of(lost, "primary"), other = codes_of(lost, "tex0");
  EXPECT_NE(own, other);
  for (std::size_t c = 0; c < 3; ++c) EXPECT_LE(std::abs(own[c] - other[c]), 1);
}

// The settings that a technique reads stand in its table: combiner_tests/shadow/technique_settings_test.cpp.
TEST(IndexOrder, IsRefusedByTechniquesWithoutIndices) {
  const TempFolder folder;
  const Words other{"--technique", "shadow-map", "--index-order", "neighbour"};
  const std::string refused = "--index-order: technique shadow-map does not read it";
  expect_error(ninebit(small_render(kRoom, folder / "out", other)), 2, {refused});
  expect_error(ninebit(Words{"trace", "--scene", kRoom, "--pixel", "80,60", "--size", "160x120"} + other), 2,
               {refused, "--polygon-offset"});
  expect_error(ninebit(Words{"study", "shadows", kRoom, "--size", "80x60", "--map-sizes", "32"} + other), 2, {refused});
  EXPECT_EQ(answer_of(folder, {"--technique", "light-cookie", "--cookie", kLabels, "--index-order",
                               "neighbour"})["index"]["order"],
            "neighbour");
}

Words sweep_words(const Words& more) {
  return Words{"study", "shadows", kRoom, "--size", "80x60", "--map-sizes", "32", "--json"} + more;
}

TEST(IndexOrder, SweptRowsAreWhatRenderCounts) {
  const TempFolder folder;
  const Json answer = json_of(ninebit(sweep_words({"--orders", "file,neighbour", "--scales", "both-x4,no-scale"})));
  ASSERT_EQ(answer["rows"].size(), 4U);
  EXPECT_TRUE(has_text(answer["question"], "--orders file,neighbour --scales both-x4,no-scale"));
  for (const std::size_t point : {1U, 2U}) {
    const Json& row = answer["rows"][point];
    const std::string order = point < 2 ? "file" : "neighbour", scales = point == 2 ? "both-x4" : "no-scale";
    EXPECT_EQ(row["index_order"], order);
    EXPECT_EQ(row["index_scales"], scales);
    const Json render =
        json_of(ninebit({"render", kRoom, "-o", folder / "out", "--size", "80x60", "--map-size", "32", "--index-order",
                         order, "--index-scales", scales, "--ground-truth", "--json"}));
    for (const char* count : {"lit", "shadowed"}) EXPECT_EQ(row[count], render["pixels"][count]) << count;
    for (const char* count : {"false_lit", "false_shadowed"}) EXPECT_EQ(row[count], render["errors"][count]) << count;
  }
}

}  // namespace
}  // namespace tools_test
