// `ninebit study shadows` and `ninebit study depth-packing` as people call them: the same numbers as other verbs give,
// and wrong grids refused.
#include <gtest/gtest.h>

#include "combiner_tests/tools/support.h"
#include "ninebit/frame/depth_packing.h"

namespace tools_test {
namespace {

Words small_sweep(const Words& more) {
  return Words{"study", "shadows", kRoom, "--size", "80x60"} + more;
}

TEST(StudyShadows, RowsAreWhatRenderCounts) {
  const Json answer = json_of(ninebit(small_sweep({"--map-sizes", "32,64", "--steps", "1,2", "--json"})));
  EXPECT_EQ(answer["command"], "study shadows");
  EXPECT_EQ(answer["profile"], "geforce2");
  ASSERT_EQ(answer["rows"].size(), 4U);
  const TempFolder folder;
  const Json render = json_of(ninebit({"render", kRoom, "-o", folder / "out", "--size", "80x60", "--map-size", "64",
                                       "--index-step", "1", "--ground-truth", "--json"}));
  const Json& row = answer["rows"][2];
  EXPECT_EQ(row["map_size"], 64);
  EXPECT_EQ(row["index_step"], 1);
  for (const char* count : {"lit", "shadowed"}) EXPECT_EQ(row[count], render["pixels"][count]) << count;
  for (const char* count : {"false_lit", "false_shadowed"}) EXPECT_EQ(row[count], render["errors"][count]) << count;
  for (const auto& [cause, count] : render["errors"]["by_cause"].items()) EXPECT_EQ(row[cause], count) << cause;
}

TEST(StudyShadows, WithoutAxesMapSizesAreSwept) {
  const Json rows = json_of(ninebit(small_sweep({"--json"})))["rows"];
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0]["map_size"], 128);
  EXPECT_EQ(rows[3]["map_size"], 1024);
  EXPECT_EQ(json_of(ninebit(small_sweep({"--technique", "shadow-volume", "--json"})))["rows"].size(), 1U);
}

TEST(StudyShadows, TheQuestionIsACommandThatAsksTheSame) {
  const Words flags{"--technique", "shadow-map", "--light",           "-1,4,2",   "--light-facing", "--map-sizes", "64",
                    "--cull",      "none",       "--polygon-offsets", "0,0;1,16", "--json"};
  const Json answer = json_of(ninebit(small_sweep(flags)));
  const std::string question = answer["question"];
  EXPECT_EQ(question, "ninebit study shadows " + kRoom +
                          " --technique shadow-map --size 80x60 --light-facing --light -1,4,2 --map-sizes 64 "
                          "--polygon-offsets '0,0;1,16' --profile geforce2");
  EXPECT_EQ(json_of(ninebit({"study", "shadows", kRoom, "--technique", "shadow-map", "--size", "80x60",
                             "--light-facing", "--light", "-1,4,2", "--map-sizes", "64", "--polygon-offsets",
                             "0,0;1,16", "--profile", "geforce2", "--json"})),
            answer);
}

// The single value of a setting, default or not, is the only point, and the question asks for it.
TEST(StudyShadows, AGivenMapSizeIsTheOnlyOne) {
  for (const std::string size : {"64", "512"}) {
    const Json answer = json_of(ninebit(small_sweep({"--map-size", size, "--json"})));
    ASSERT_EQ(answer["rows"].size(), 1U) << size;
    EXPECT_EQ(answer["rows"][0]["map_size"].dump(), size);
    EXPECT_EQ(answer["question"], "ninebit study shadows " + kRoom +
                                      " --technique index-cube --size 80x60 --map-sizes " + size +
                                      " --profile geforce2");
    EXPECT_EQ(json_of(ninebit(small_sweep({"--map-sizes", size, "--json"}))), answer);
  }
  const Json beside = json_of(ninebit(small_sweep({"--map-size", "64", "--steps", "1,2", "--json"})));
  ASSERT_EQ(beside["rows"].size(), 2U);
  for (const Json& row : beside["rows"]) EXPECT_EQ(row["map_size"], 64);
}

// The report's pictures have traces, which are what their commands print.
TEST(StudyShadows, TheReportHasTheTracesOfListedPixels) {
  const TempFolder folder;
  const Words flags{"--technique", "shadow-map", "--map-sizes", "32,128", "-o", folder / "out", "--json", "--quiet"};
  const Json answer = json_of(ninebit(small_sweep(flags)));
  const Json data = data_of(read_bytes(folder / "out/report.html"));
  ASSERT_EQ(data["pictures"].size(), 2U);
  std::size_t texts = 0;
  for (const Json& picture : data["pictures"]) expect_traces(picture["traces"], texts);
  EXPECT_GT(texts, 2U);
  EXPECT_EQ(texts, answer["worst"].size());
}

// A study reads no textures. The traces do, so that a missing one leaves the page with the commands.
TEST(StudyShadows, WithoutATextureThePageHasCommands) {
  const TempFolder folder;
  write_bytes(folder / "wall.mtl", "newmtl brick\nmap_Kd missing.png\n");
  write_bytes(folder / "wall.obj",
              "mtllib wall.mtl\nusemtl brick\nv -4 0 4\nv 4 0 4\nv 4 0 -4\nv -4 0 -4\nv 0 0 1\nv 0 2 1\nv 0 2 -1\n"
              "v 0 0 -1\nvt 0 0\nvt 1 0\nvt 1 1\nf 1/1 2/2 3/3\nf 1/1 3/3 4/2\nf 5/1 6/2 7/3\nf 5/1 7/3 8/2\n");
  const Outcome done = ninebit({"study", "shadows", folder / "wall.obj", "--size", "80x60", "--map-sizes", "32",
                                "--technique", "shadow-map", "--floor", "none", "-o", folder / "out", "--json"});
  const Json answer = json_of(done);
  ASSERT_FALSE(answer["worst"].empty());
  expect_parts(done.err, {"warning: the report has no traces, and their commands fail, too: ", "missing.png"});
  const Json data = data_of(read_bytes(folder / "out/report.html"));
  ASSERT_EQ(data["pictures"][0]["traces"].size(), answer["worst"].size());
  for (const Json& one : data["pictures"][0]["traces"]) EXPECT_EQ(one["text"], "") << one;
}

TEST(StudyShadows, WrongGrids) {
  struct Case {
    Words flags;
    int code;
    Words words;
  };
  const std::vector<Case> cases{
      {{"--map-sizes", "100"}, 2, {"--map-sizes", "invalid list '100'", "powers of two"}},
      {{"--map-sizes="}, 2, {"--map-sizes"}},
      {{"--map-sizes", "64,,128"}, 2, {"--map-sizes", "64,,128"}},
      {{"--steps", "0,1"}, 2, {"--steps", "from 1 to 16"}},
      {{"--steps", "2.5"}, 2, {"--steps", "'2.5'; expected a list of whole numbers from 1 to 16"}},
      {{"--scopes", "polygon,pixel"},
       2,
       {"--scopes", "unknown name 'pixel'; expected a list of polygon, object, section"}},
      {{"--orders", "file,neighbor"}, 2, {"--orders", "unknown name 'neighbor'; expected a list of file, neighbour"}},
      {{"--orders="}, 2, {"--orders"}},
      {{"--scales", "x4"},
       2,
       {"--scales", "unknown name 'x4'; expected a list of both-x4, first-x4, second-x4, no-scale"}},
      {{"--orders", "file", "--index-order", "file"}, 2, {"excludes"}},
      {{"--technique", "shadow-map", "--orders", "file", "--scales", "no-scale"},
       2,
       {"technique shadow-map does not support --orders, --scales"}},
      {{"--formats="}, 2, {"--formats"}},
      {{"--technique", "depth-cube", "--depth-bits", "8,12"},
       2,
       {"--depth-bits", "unknown name '12'; expected a list of 8, 16, float"}},
      {{"--technique", "depth-cube", "--biases", "0,-1"}, 2, {"--biases", "from 0 to 1e12"}},
      {{"--technique", "shadow-map", "--polygon-offsets", "0,0;1"}, 2, {"--polygon-offsets", "FACTOR,UNITS"}},
      {{"--technique", "shadow-map", "--polygon-offsets", "0,nan"}, 2, {"--polygon-offsets", "FACTOR,UNITS"}},
      {{"--technique", "shadow-map", "--find-offset", "--polygon-offsets", "0,0"}, 2, {"excludes"}},
      {{"--map-sizes", "64", "--map-size", "64"}, 2, {"excludes"}},
      {{"--technique", "shadow-map", "--steps", "1,2"}, 2, {"technique shadow-map does not support --steps"}},
      {{"--polygon-offsets", "0,0"}, 2, {"technique index-cube does not support --polygon-offsets"}},
      {{"--technique", "reflective"}, 2, {"technique reflective draws no shadows"}},
      {{"--formats", "l"}, 3, {"no point can be drawn"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::PrintToString(c.flags));
    expect_error(ninebit(small_sweep(c.flags)), c.code, c.words);
  }
  expect_error(ninebit({"study", "shadows", "missing.gltf"}), 3, {"missing.gltf"});
}

TEST(StudyDepthPacking, AnswersItsQuestion) {
  const Json answer = json_of(ninebit({"study", "depth-packing", "--packings", "rgba8-mod,rgba8-fract", "--storages",
                                       "round", "--depths", "16", "--json"}));
  EXPECT_EQ(answer["command"], "study depth-packing");
  ASSERT_EQ(answer["rows"].size(), 2U);
  EXPECT_EQ(answer["rows"][1]["packing"], "rgba8-fract");
  EXPECT_EQ(answer["rows"][1]["one_reads_as"], 0.0);
  EXPECT_EQ(answer["second_digit"].size(), 512U);
}

TEST(StudyDepthPacking, NamesWherePackingsAndStoragesAreFound) {
  const Json rows = json_of(ninebit({"study", "depth-packing", "--packings", "rgba8-base255-2007", "--storages",
                                     "floor-256,half", "--depths", "16", "--json"}))["rows"];
  ASSERT_EQ(rows.size(), 2U);
  EXPECT_EQ(rows[0]["source"], "aras-p.info, 29 June 2007, with 255^3 as corrected since");
  EXPECT_EQ(rows[1]["storage"], "half");
  EXPECT_NE(rows[0]["max_error"], rows[1]["max_error"]);
  const std::string help = ninebit({"study", "depth-packing", "--help"}).out;
  for (const ninebit::DepthPacking& packing : ninebit::depth_packings()) {
    expect_parts(help, {std::string(packing.name) + ' ', std::string(packing.source)});
  }
  for (const ninebit::StorageRule& rule : ninebit::storage_rules()) expect_parts(help, {std::string(rule.formula)});
}

TEST(StudyDepthPacking, WrongGrids) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"--packings=rgba8", "unknown name 'rgba8'; expected a list of rgba8-fract"},
      {"--packings=", "--packings"},
      {"--storages=cut", "round"},
      {"--depths=32", "16, 24, floats"},
      {"--float-step=0", "--float-step"},
      {"--float-step=1.5", "--float-step"}};
  for (const auto& [flag, words] : cases) {
    SCOPED_TRACE(flag);
    expect_error(ninebit({"study", "depth-packing", flag}), 2, {words});
  }
}

}  // namespace
}  // namespace tools_test
