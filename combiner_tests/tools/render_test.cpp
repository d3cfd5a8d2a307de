// `ninebit render` on real scenes: what it answers and what it writes.
#include <gtest/gtest.h>

#include <sstream>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

struct RealScene {
  const char* name;
  std::string file;
  int triangles;  // the floor's two included
};

void PrintTo(const RealScene& scene, std::ostream* out) {
  *out << scene.name;
}

class RealScenes : public testing::TestWithParam<RealScene> {};

INSTANTIATE_TEST_SUITE_P(All, RealScenes,
                         testing::Values(RealScene{"room", kRoom, 2096}, RealScene{"bunny", kBunny, 69666 + 2},
                                         RealScene{"engine", kEngine, 121496}),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(RealScenes, AnswersWithTheContractsKeys) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const TempFolder folder;
  const RealScene& scene = GetParam();
  const std::string out = folder / "new/out";
  const Outcome outcome = ninebit({"render", scene.file, "-o", out, "--json", "--size", "200x150", "--map-size", "64"});
  const Json answer = json_of(outcome);
  EXPECT_EQ(keys_of(answer),
            (Words{"command", "version", "technique", "profile", "scene", "triangles", "size", "supersample",
                   "map_size", "settings", "index", "pixels", "time_ms", "facts", "ignored", "files", "hash"}));
  EXPECT_EQ(keys_of(answer["index"]), (Words{"format", "scope", "step", "used", "capacity", "scales", "order"}));
  EXPECT_EQ(keys_of(answer["pixels"]), (Words{"background", "lit", "shadowed"}));
  EXPECT_EQ(keys_of(answer["time_ms"]),
            (Words{"load", "transform", "maps", "camera", "compare", "shade", "write", "total"}));
  EXPECT_EQ(keys_of(answer["hash"]), (Words{"color", "stencil", "index_map"}));

  EXPECT_EQ(answer["command"], "render");
  EXPECT_EQ(answer["technique"], "index-cube");
  EXPECT_EQ(answer["profile"], "geforce2");
  EXPECT_EQ(answer["scene"], scene.file);
  EXPECT_EQ(answer["triangles"], scene.triangles);
  EXPECT_EQ(answer["size"], (Json{200, 150}));
  EXPECT_EQ(answer["map_size"], 64);
  EXPECT_EQ(answer["index"], (Json{{"format", "rgb"},
                                   {"scope", "polygon"},
                                   {"step", 2},
                                   {"used", scene.triangles},
                                   {"capacity", 1 << 21},
                                   {"scales", "both-x4"},
                                   {"order", "file"}}));
  EXPECT_EQ(keys_of(answer["facts"]), (Words{"vanished_polygons", "vanished_texels", "vanished_pixels"}));
  EXPECT_GT(answer["facts"]["vanished_polygons"], 0);
  EXPECT_LT(answer["facts"]["vanished_polygons"], scene.triangles);
  EXPECT_GT(answer["facts"]["vanished_texels"], 0.0);
  EXPECT_LE(answer["facts"]["vanished_pixels"], answer["pixels"]["shadowed"]);
  const Json& pixels = answer["pixels"];
  EXPECT_EQ(pixels["background"].get<int>() + pixels["lit"].get<int>() + pixels["shadowed"].get<int>(), 200 * 150);
  EXPECT_GT(pixels["lit"], 0);
  EXPECT_GT(pixels["shadowed"], 0);
  double passes = 0;
  for (const auto& [pass, ms] : answer["time_ms"].items()) {
    EXPECT_GT(ms.get<double>(), 0.0) << pass;
    if (pass != "total") passes += ms.get<double>();
  }
  EXPECT_LE(passes, answer["time_ms"]["total"].get<double>() * 1.001);
  for (const auto& [plane, hash] : answer["hash"].items()) EXPECT_EQ(hash.get<std::string>().size(), 64U) << plane;

  Words wanted;
  Words named;
  for (const char* name : {"color.png", "shadow.png", "index_cube.png", "render.json"}) {
    wanted.push_back(out + "/" + name);
    named.push_back("wrote " + wanted.back());
    EXPECT_GT(std::filesystem::file_size(wanted.back()), 60U);
  }
  EXPECT_EQ(answer["files"], Json(wanted));
  EXPECT_EQ(lines_of(outcome.err), named);
  EXPECT_EQ(files_in(out).size(), wanted.size());
}

TEST_P(RealScenes, TheSameBitsForAnyNumberOfThreadsAndWithLayers) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  const TempFolder folder;
  const Words words =
      small_render(GetParam().file, folder / "out", {"--json", "--quiet", "--size", "160x120", "--map-size", "128"});
  const Json first = json_of(ninebit(words + Words{"--threads", "1"}));
  const Files files = files_in(folder / "out");
  const Json again = json_of(ninebit(words + Words{"--threads", "7", "--layers"}));
  EXPECT_EQ(again["hash"], first["hash"]);
  EXPECT_EQ(again["pixels"], first["pixels"]);
  Files others = files_in(folder / "out");
  for (const char* name : {"layers.exr", "index_cube.exr"}) EXPECT_EQ(others.erase(name), 1U) << name;
  others["render.json"] = files.at("render.json");
  EXPECT_EQ(others, files);
}

// The comparison above could tell renderings apart: another light changes all planes, another camera two of them.
TEST(Render, HashesTellRenderingsApart) {
  const TempFolder folder;
  const auto hash = [&](const Words& more) {
    return json_of(ninebit(small_render(kRoom, folder / "out", Words{"--json", "--quiet"} + more))).at("hash");
  };
  const Json plain = hash({}), light = hash({"--light", "1,2,1"}), camera = hash({"--camera", "1,3,4"});
  for (const char* plane : {"color", "stencil", "index_map"}) EXPECT_NE(light[plane], plain[plane]) << plane;
  EXPECT_NE(camera["color"], plain["color"]);
  EXPECT_NE(camera["stencil"], plain["stencil"]);
  EXPECT_EQ(camera["index_map"], plain["index_map"]);
  EXPECT_EQ(hash({}), plain);
}

// The result goes to stdout; what goes with it, to stderr.
TEST(Render, TellsPeopleTheResultAndTheFiles) {
  const TempFolder folder;
  const Outcome people = ninebit(small_render(kRoom, folder / "out", {"--layers"}));
  EXPECT_EQ(people.code, 0);
  EXPECT_TRUE(people.out.starts_with("2096 triangles; pixels: ")) << people.out;
  EXPECT_EQ(lines_of(people.out).size(), 1U) << people.out;
  const Words lines = lines_of(people.err);
  ASSERT_EQ(lines.size(), 6U) << people.err;
  EXPECT_EQ(lines[0], "wrote " + (folder / "out/color.png"));
  EXPECT_EQ(lines[4], "wrote " + (folder / "out/layers.exr"));
  EXPECT_EQ(lines[5], "wrote " + (folder / "out/render.json"));
  EXPECT_EQ(people.err.find('\r'), std::string::npos) << "progress is for terminals";

  const Outcome quiet = ninebit(small_render(kRoom, folder / "out", {"--quiet"}));
  EXPECT_EQ(quiet.code, 0);
  EXPECT_EQ(quiet.err, "");
  EXPECT_EQ(lines_of(quiet.out).size(), 1U) << quiet.out;
  EXPECT_TRUE(quiet.out.starts_with("2096 triangles; pixels: ")) << quiet.out;
}

TEST(Render, IndexSaysFormatScopeAndCapacity) {
  const TempFolder folder;
  const auto index = [&](const Words& more) {
    return json_of(ninebit(small_render(kRoom, folder / "out", Words{"--json", "--quiet"} + more))).at("index");
  };
  const auto expected = [](const char* format, const char* scope, int step, int used, int capacity) {
    return Json{{"format", format},     {"scope", scope},      {"step", step},   {"used", used},
                {"capacity", capacity}, {"scales", "both-x4"}, {"order", "file"}};
  };
  EXPECT_EQ(index({"--index-format", "la"}), expected("la", "polygon", 2, 2096, 1 << 14));
  const Json l = index({"--index-format", "l", "--index-scope", "object", "--index-step", "4"});
  EXPECT_EQ(l, expected("l", "object", 4, l["used"], 64));
  EXPECT_EQ(index({"--index-format", "a", "--index-scope", "object"}), expected("a", "object", 2, l["used"], 128));
  const Json sections = index({"--index-scope", "section", "--section-size", "64"});
  EXPECT_EQ(sections, expected("rgb", "section", 2, sections["used"], 1 << 21));
  EXPECT_GE(sections["used"], 2096 / 64);
  EXPECT_LT(sections["used"], 2096 / 8);
}

// Pixel 420,560 of this picture is on the floor, in the sphere's shadow: the example of docs/techniques/index-cube.md.
TEST(Render, PickTellsPolygonAndObject) {
  const TempFolder folder;
  const auto pick = [&](const char* pixel, const Words& more) {
    return ninebit(Words{"render", kRoom, "-o", folder / "out", "--size", "800x600", "--map-size", "64", "--pick",
                         pixel, "--quiet"} +
                   more);
  };
  const auto json = [&](const char* pixel, Words more) {
    more.emplace_back("--json");
    return json_of(pick(pixel, more)).at("pick");
  };
  const Json polygon = json("420,560", {});
  EXPECT_EQ(keys_of(polygon), (Words{"x", "y", "index", "polygon", "section", "object", "object_name"}));
  EXPECT_EQ(polygon["x"], 420);
  EXPECT_EQ(polygon["y"], 560);
  EXPECT_EQ(polygon["index"], 348);
  EXPECT_EQ(polygon["polygon"], 348);
  EXPECT_TRUE(polygon["section"].is_null());
  const std::string name = polygon["object_name"];
  EXPECT_TRUE(pick("420,560", {})
                  .out.ends_with("\npixel 420,560: index 348, polygon 348 of object " +
                                 std::to_string(polygon["object"].get<int>()) + " '" + name + "'\n"));
  const Json object = json("420,560", {"--index-scope", "object", "--index-format", "l"});
  EXPECT_EQ(object["index"], polygon["object"]);
  EXPECT_EQ(object["object_name"], name);
  EXPECT_TRUE(object["polygon"].is_null());
  const Json section = json("420,560", {"--index-scope", "section"});
  EXPECT_EQ(section["section"], section["index"]);
  EXPECT_EQ(section["object"], polygon["object"]);
  EXPECT_TRUE(section["polygon"].is_null());
  const Outcome words = pick("420,560", {"--index-scope", "section"});
  expect_parts(words.out, {"does not identify a single polygon"});
  // The camera turned away.
  const Words away{"--camera", "0,1,40", "--look-at", "0,1,80"};
  const Json nothing = json("5,5", away);
  EXPECT_EQ(nothing["index"], 0);
  for (const char* key : {"polygon", "section", "object", "object_name"}) EXPECT_TRUE(nothing[key].is_null()) << key;
  EXPECT_TRUE(pick("5,5", away).out.ends_with("\npixel 5,5: background\n"));
}

// A floor of the user's, and none: two triangles more or fewer.
TEST(Render, FloorFlags) {
  const TempFolder folder;
  const auto triangles = [&](const std::string& scene, const std::string& floor) {
    return json_of(ninebit(small_render(scene, folder / "out", {"--json", "--floor", floor}))).at("triangles");
  };
  EXPECT_EQ(triangles(kBunny, "none"), 69666);
  EXPECT_EQ(triangles(kRoom, "auto"), 2096);
  EXPECT_EQ(triangles(kRoom, "0.5"), 2098);
}

}  // namespace
}  // namespace tools_test
