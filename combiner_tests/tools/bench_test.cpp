// `ninebit bench`: every part runs and answers in the form that cli.md promises. No number is judged.
#include <gtest/gtest.h>

#include <set>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

Json bench(const Words& arguments) {
  const Outcome outcome = ninebit(Words{"bench"} + arguments + Words{"--quick", "--json", "--threads", "2"});
  EXPECT_EQ(outcome.err, "");
  return json_of(outcome);
}

TEST(Bench, CombinerHasARowForEachProgramEngineAndThreadCount) {
  const Json out = bench({"combiner"});
  EXPECT_EQ(keys_of(out), (Words{"command", "version", "profile", "rows", "ratio", "memory_read_gb_per_s"}));
  EXPECT_EQ(out["command"], "bench combiner");
  std::set<std::string> rows;
  for (const Json& row : out["rows"]) {
    EXPECT_EQ(keys_of(row), (Words{"program", "engine", "target", "threads", "batch", "mpixels_per_s", "profile"}));
    EXPECT_GT(row["mpixels_per_s"], 0.0);
    EXPECT_GT(row["batch"], 0);
    EXPECT_EQ(row["target"] == "scalar", row["engine"] != "simd");
    EXPECT_EQ(row["profile"], row["program"] == "eight" ? "nv2a" : "geforce2");
    rows.insert(row["program"].get<std::string>() + ' ' + row["engine"].get<std::string>() + ' ' +
                row["threads"].dump());
  }
  std::set<std::string> expected;
  for (const std::string program : {"index", "heavy", "eight", "default"}) {
    EXPECT_GT(out["ratio"][program], 0.0);
    for (const std::string engine : {"simd", "reference", "scalar-float"}) {
      for (const std::string threads : {"1", "2"}) expected.insert(program + ' ' + engine + ' ' + threads);
    }
  }
  EXPECT_EQ(rows, expected);
  EXPECT_EQ(out["rows"].size(), expected.size());
  EXPECT_GT(out["memory_read_gb_per_s"], 0.0);
}

TEST(Bench, CombinerMeasuresEveryTarget) {
  const Json out = json_of(ninebit({"bench", "combiner", "--every-target", "--quick", "--json", "--threads", "1"}));
  std::set<std::string> targets;
  for (const Json& row : out["rows"]) {
    if (row["program"] == "index" && row["engine"] == "simd") targets.insert(row["target"]);
  }
  const Json info = json_of(ninebit({"info", "--json"}));
  EXPECT_TRUE(targets.contains(info["rows"][0]["simd_target"]));
  EXPECT_GE(targets.size(), 2U);
}

TEST(Bench, CombinerPrintsItsPrograms) {
  const TempFolder folder;
  for (const char* program : {"index", "heavy", "eight", "default"}) {
    const std::string file =
        write_bytes(folder / "program.gl", out_of(ninebit({"bench", "combiner", "--print", program})));
    EXPECT_EQ(ninebit({"validate", file, "--profile", "nv2a"}).code, 0) << program;
  }
}

TEST(Bench, RasterHasARowForEachWorkloadAndThreadCount) {
  const Json out = bench({"raster"});
  EXPECT_EQ(keys_of(out), (Words{"command", "version", "profile", "size", "rows"}));
  EXPECT_EQ(out["command"], "bench raster");
  ASSERT_EQ(out["rows"].size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    const Json& row = out["rows"][i];
    Words keys{"workload", "threads", "mtriangles_per_s", "mpixels_per_s", "covered_pixels", "triangles"};
    if (row["workload"] == "large") keys = keys + Words{"written_gb_per_s", "memset_gb_per_s"};
    EXPECT_EQ(keys_of(row), keys);
    EXPECT_EQ(row["workload"], (Words{"legs-1", "legs-4", "legs-16", "large"}[i / 2]));
    EXPECT_EQ(row["threads"], i % 2 + 1);
    EXPECT_GT(row["mtriangles_per_s"], 0.0);
    EXPECT_GT(row["mpixels_per_s"], 0.0);
    EXPECT_GT(row["covered_pixels"], 0);
  }
}

TEST(Bench, RasterGrowthHasARowForEachNumberOfTrianglesSizeAndCall) {
  const Json out = bench({"raster", "--growth"});
  EXPECT_EQ(keys_of(out), (Words{"command", "version", "profile", "rows"}));
  EXPECT_EQ(out["command"], "bench raster --growth");
  ASSERT_EQ(out["rows"].size(), 8U);
  for (std::size_t i = 0; i < 8; ++i) {
    const Json& row = out["rows"][i];
    EXPECT_EQ(keys_of(row), (Words{"workload", "call", "threads", "triangles", "covered_pixels", "ms",
                                   "ns_per_triangle", "bytes_per_triangle"}));
    EXPECT_EQ(row["workload"], i / 2 % 2 == 0 ? "legs-1" : "legs-4");
    EXPECT_EQ(row["call"], i % 2 == 0 ? "rasterize" : "prepare");
    EXPECT_EQ(row["threads"], 2);
    const double triangles = i < 4 ? 1e3 : 1e4;
    EXPECT_GT(row["triangles"], 0.7 * triangles);
    EXPECT_LT(row["triangles"], 1.3 * triangles);
    const double pixels_per_triangle = row["covered_pixels"].get<double>() / row["triangles"].get<double>();
    EXPECT_GT(pixels_per_triangle, i / 2 % 2 == 0 ? 0.4 : 6.0);
    EXPECT_LT(pixels_per_triangle, i / 2 % 2 == 0 ? 0.6 : 10.0);
    EXPECT_NEAR(row["ns_per_triangle"].get<double>() * row["triangles"].get<double>(), row["ms"].get<double>() * 1e6,
                1.0);
    EXPECT_GE(row["bytes_per_triangle"], 0.0);
  }
}

void expect_frame(const Json& out, const Words& more = {}) {
  const Words keys{"command", "version",  "profile",      "scene",  "triangles", "threads",
                   "size",    "map_size", "ms_per_frame", "passes", "frames",    "setup_ms"};
  EXPECT_EQ(keys_of(out), keys + more);
  EXPECT_EQ(out["command"], "bench frame");
  EXPECT_EQ(keys_of(out["ms_per_frame"]), (Words{"median", "min", "max"}));
  EXPECT_EQ(keys_of(out["passes"]), (Words{"maps", "depth", "compare", "lit", "shadow"}));
  EXPECT_GT(out["ms_per_frame"]["min"], 0.0);
  EXPECT_LE(out["ms_per_frame"]["min"], out["ms_per_frame"]["median"]);
  EXPECT_LE(out["ms_per_frame"]["median"], out["ms_per_frame"]["max"]);
  EXPECT_GE(out["frames"], 3);
  EXPECT_EQ(out["threads"], 2);
}

TEST(Bench, FrameOfAFileTakesTheFlagsOfRender) {
  const Json out = bench({"frame", kRoom, "--size", "48x36", "--map-size", "32", "--camera", "-3,4,2.5"});
  expect_frame(out);
  EXPECT_EQ(out["scene"], kRoom);
  EXPECT_EQ(out["triangles"], 2096);
  EXPECT_EQ(out["size"], (Json{48, 36}));
  EXPECT_EQ(out["map_size"], 32);
}

TEST(Bench, FrameOfAGeneratedScene) {
  const Json out = bench({"frame", "--triangles", "2000", "--size", "48x36", "--map-size", "32"});
  expect_frame(out);
  EXPECT_EQ(out["scene"], "generated");
  EXPECT_EQ(out["triangles"], 1920);
}

// The answer beside the rival; null where it is not available.
Json beside_llvmpipe(const Words& arguments) {
  const Outcome outcome =
      ninebit(Words{"bench"} + arguments + Words{"--threads", "2", "--quick", "--json", "--rival", "llvmpipe"});
  if (outcome.code != 2) return json_of(outcome);
  expect_error(outcome, 2, {"--rival llvmpipe is not available: "});
  return {};
}

// The rival draws the same picture, but for a few pixels along edges.
TEST(Bench, FrameBesideLlvmpipe) {
  const Json out = beside_llvmpipe({"frame", kRoom, "--size", "320x240", "--map-size", "256"});
  if (out.is_null()) GTEST_SKIP() << "no llvmpipe";
  expect_frame(out, {"rival"});
  const Json& rival = out["rival"];
  EXPECT_EQ(keys_of(rival),
            (Words{"name", "renderer", "threads", "ms_per_frame", "ratio", "shadow_pixels_that_differ"}));
  EXPECT_EQ(rival["name"], "llvmpipe");
  expect_parts(rival["renderer"].get<std::string>(), {"llvmpipe"});
  EXPECT_EQ(rival["threads"], 2);
  EXPECT_EQ(keys_of(rival["ms_per_frame"]), (Words{"median", "min", "max"}));
  EXPECT_GT(rival["ratio"], 0.0);
  EXPECT_LT(rival["shadow_pixels_that_differ"], 320 * 240 / 50);
}

TEST(Bench, Effects) {
  const Json out = bench({"effect"});
  EXPECT_EQ(keys_of(out), (Words{"command", "version", "profile", "size", "threads", "rows"}));
  EXPECT_EQ(out["command"], "bench effect");
  ASSERT_EQ(out["rows"].size(), 5U);
  for (const Json& row : out["rows"]) {
    EXPECT_EQ(keys_of(row), (Words{"effect", "ms", "mpixels_per_s"}));
    EXPECT_GT(row["mpixels_per_s"], 0.0);
  }
}

// The rival's floats give nearly the same pictures.
TEST(Bench, EffectsBesideLlvmpipe) {
  const Json out = beside_llvmpipe({"effect"});
  if (out.is_null()) GTEST_SKIP() << "no llvmpipe";
  EXPECT_EQ(out["rival"]["name"], "llvmpipe");
  for (const Json& row : out["rows"]) {
    EXPECT_EQ(keys_of(row), (Words{"effect", "ms", "mpixels_per_s", "rival"}));
    EXPECT_EQ(keys_of(row["rival"]), (Words{"ms", "mpixels_per_s", "ratio", "largest_difference"}));
    EXPECT_LE(row["rival"]["largest_difference"], 8) << row["effect"];
  }
}

TEST(Bench, Programs) {
  const Json alone = bench({"draw"});
  EXPECT_EQ(alone["command"], "bench draw");
  ASSERT_EQ(alone["rows"].size(), 3U);
  for (const Json& row : alone["rows"]) EXPECT_EQ(keys_of(row), (Words{"program", "ms", "mpixels_per_s"}));
}

// The rival runs the program as GLSL of whole numbers: it draws the same bytes.
TEST(Bench, ProgramsBesideLlvmpipe) {
  const Json out = beside_llvmpipe({"draw"});
  if (out.is_null()) GTEST_SKIP() << "no llvmpipe";
  for (const Json& row : out["rows"]) EXPECT_EQ(row["rival"]["largest_difference"], 0) << row["program"];
}

TEST(Bench, RunsOnAGivenTarget) {
  for (const Words& part :
       std::vector<Words>{{"raster"}, {"draw"}, {"effect"}, {"frame", kRoom, "--size", "48x36", "--map-size", "32"}}) {
    const Outcome wrong = ninebit(Words{"bench"} + part + Words{"--target", "MMX"});
    expect_error(wrong, 2, {"--target", "MMX"});
    const std::size_t begin = wrong.err.find('{') + 1;
    bench(part + Words{"--target", wrong.err.substr(begin, wrong.err.find_first_of(",}", begin) - begin)});
  }
}

TEST(Bench, TablesForPeople) {
  for (const auto& [part, shown] : std::vector<std::pair<Words, std::string>>{
           {{"combiner"}, "times as fast as scalar-float"},
           {{"raster"}, "legs-4"},
           {{"raster", "--growth"}, "bytes/triangle"},
           {{"frame", kRoom, "--size", "48x36", "--map-size", "32"}, "ms per frame"},
           {{"effect"}, "light_map_detail"}}) {
    SCOPED_TRACE(shown);
    expect_parts(out_of(ninebit(Words{"bench"} + part + Words{"--quick", "--threads", "1"})), {shown});
  }
}

TEST(Bench, WrongUsage) {
  struct Case {
    Words arguments;
    int code;
    Words words;
  };
  const std::vector<Case> cases{
      {{}, 2, {"a command is required", "combiner, raster, frame, draw, effect", "ninebit bench --help"}},
      {{"gpu"}, 2, {"unknown command 'gpu'", "combiner, raster, frame, draw, effect"}},
      {{"raster", "extra"}, 2, {"not expected", "extra", "ninebit bench raster --help"}},
      {{"combiner", "--seconds", "0"}, 2, {"--seconds", "ninebit bench combiner --help"}},
      {{"combiner", "--print", "light"}, 2, {"--print", "light", "index,heavy,eight,default"}},
      {{"frame", "--triangles", "99"}, 2, {"--triangles", "99", "100"}},
      {{"frame", kRoom, "--triangles", "2000"}, 2, {"--triangles", "excludes"}},
      {{"frame", "--rival", "voodoo"}, 2, {"--rival", "voodoo", "llvmpipe"}},
      {{"frame", "--rival", "llvmpipe", "--light-facing"}, 2, {"--rival", "excludes", "--light-facing"}},
      {{"frame", "--rival", "llvmpipe", "--index-order", "neighbour"}, 2, {"--rival", "excludes", "--index-order"}},
      {{"frame", "--rival", "llvmpipe", "--index-scales", "no-scale"}, 2, {"--rival", "excludes", "--index-scales"}},
      {{"effect", "--rival", "voodoo"}, 2, {"--rival", "voodoo", "llvmpipe"}},
      {{"frame", "/nowhere/scene.obj"}, 3, {"/nowhere/scene.obj"}},
      {{"frame", "--triangles", "3000000"}, 3, {"too many polygons", "index step 1"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::PrintToString(c.arguments));
    expect_error(ninebit(Words{"bench"} + c.arguments), c.code, c.words);
  }
}

}  // namespace
}  // namespace tools_test
