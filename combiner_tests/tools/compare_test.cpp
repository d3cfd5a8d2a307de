// `ninebit compare`: which techniques and settings, their figures, the page, wrong usage.
#include <gtest/gtest.h>

#include <csignal>
#include <optional>

#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

Words small_compare(const std::string& scene, const std::string& folder, const Words& more = {}) {
  return Words{"compare", scene, "-o", folder, "--size", "64x48", "--map-size", "32", "--quiet"} + more;
}

Json compared(const std::string& folder, const Words& more) {
  return json_of(ninebit(small_compare(kRoom, folder, Words{"--json"} + more)));
}

Words names_of_rows(const Json& object) {
  Words names;
  for (const Json& row : object["rows"]) names.push_back(row["name"]);
  return names;
}

TEST(Compare, AllTechniquesThatTheLightAllows) {
  const TempFolder folder;
  const Json point = compared(folder / "point", {});
  EXPECT_EQ(names_of_rows(point), (Words{"index-cube", "depth-cube", "shadow-volume"}));
  ASSERT_EQ(point["left_out"].size(), 3U);
  EXPECT_EQ(point["left_out"][2]["technique"], "light-cookie");
  expect_parts(point["left_out"][2]["reason"].get<std::string>(), {"--cookie"});
  const Json spot = compared(folder / "spot", {"--light-type", "spot", "--samples", "4", "--kernel", "3"});
  EXPECT_EQ(names_of_rows(spot), (Words{"shadow-map", "shadow-volume", "reflective"}));
  EXPECT_TRUE(spot["light"].get<std::string>().starts_with("spot light at ")) << spot["light"];
}

// A spot light that reaches all of the picture is a point light for the camera: the row is that of `render` with one.
TEST(Compare, ASpotThatHoldsThePictureIsAPointLight) {
  const TempFolder folder;
  const Words view{"--camera", "0.5,1,0.9", "--look-at", "0.2,0.2,0", "--fov", "30"};
  const Words spot =
      view + Words{"--light-type", "spot", "--light", "0.3,2,0.2", "--light-target", "0.2,0.2,0", "--spot-angle"};
  const Json narrow = compared(folder / "narrow", spot + Words{"20"});
  EXPECT_EQ(names_of_rows(narrow), (Words{"shadow-map", "shadow-volume", "reflective"}));
  EXPECT_EQ(narrow["left_out"][0]["reason"], "no support for a spot light that does not reach all of the picture");
  const Json wide = compared(folder / "wide", spot + Words{"150"});
  EXPECT_EQ(names_of_rows(wide), (Words{"index-cube", "depth-cube", "shadow-map", "shadow-volume", "reflective"}));
  EXPECT_EQ(wide["light"],
            "spot light at 0.3, 2, 0.2; it reaches all of the picture: a point light for index-cube, depth-cube");
  EXPECT_EQ(wide["rows"][0]["light"], "point");
  EXPECT_EQ(wide["rows"][2]["light"], "spot");
  const Words alone{"render", kRoom,    "-o",      folder / "render", "--size",  "64x48",    "--map-size",
                    "32",     "--json", "--quiet", "--ground-truth",  "--light", "0.3,2,0.2"};
  const Json rendered = json_of(ninebit(alone + view));
  EXPECT_EQ(wide["rows"][0]["hash"]["color"], rendered["hash"]["color"]);
  EXPECT_EQ(wide["rows"][0]["errors"]["by_cause"], rendered["errors"]["by_cause"]);
  for (const Json& worst : wide["rows"][0]["errors"]["worst"]) {
    const std::string command = worst["command"];
    expect_parts(command, {"--light=0.3,2,0.2 --light-type=point"});
    EXPECT_EQ(command.find("spot"), std::string::npos) << command;
  }
  const Words mixed{"--vary", "technique=index-cube,shadow-map"};
  const Json both = compared(folder / "both", spot + Words{"150"} + mixed);
  EXPECT_EQ(both["rows"][0]["hash"]["color"], rendered["hash"]["color"]);
  EXPECT_EQ(both["rows"][1]["hash"]["color"], wide["rows"][2]["hash"]["color"]);
  const Json refused = compared(folder / "no", spot + Words{"20"} + mixed);
  EXPECT_EQ(refused["rows"][0]["refused"], "no support for a spot light that does not reach all of the picture");
  EXPECT_TRUE(refused["rows"][1].contains("hash"));
}

// A row has the bits and the wrong pixels of the same rendering by `render`.
TEST(Compare, RowsAreThoseOfRender) {
  const TempFolder folder;
  const Json object = compared(folder / "out", {"--vary", "index-step=1,2", "--vary", "index-format=rgb,la"});
  EXPECT_EQ(names_of_rows(object), (Words{"index-step 1, index-format rgb", "index-step 1, index-format la",
                                          "index-step 2, index-format rgb", "index-step 2, index-format la"}));
  const Words render{"render",         kRoom,          "-o", folder / "render", "--size",
                     "64x48",          "--map-size",   "32", "--json",          "--quiet",
                     "--ground-truth", "--index-step", "1",  "--index-format",  "la"};
  const Json alone = json_of(ninebit(render));
  const Json& row = object["rows"][1];
  EXPECT_EQ(row["hash"]["color"], alone["hash"]["color"]);
  EXPECT_EQ(row["errors"]["false_lit"], alone["errors"]["false_lit"]);
  EXPECT_EQ(row["errors"]["by_cause"], alone["errors"]["by_cause"]);
  EXPECT_GT(row["errors"]["false_shadowed"], 0);
  EXPECT_EQ(row["errors"]["wrong"], row["errors"]["false_lit"].get<int>() + row["errors"]["false_shadowed"].get<int>());
  EXPECT_NE(row["hash"]["index_map"], object["rows"][0]["hash"]["index_map"]);
  EXPECT_EQ(row["map_bytes"], 6 * 32 * 32 * 2);
  EXPECT_EQ(row["passes"], 10);
  EXPECT_EQ(row["drawn"],
            Json({"map +X", "map -X", "map +Y", "map -Y", "map +Z", "map -Z", "depth", "comparison", "lit", "shadow"}));
  EXPECT_EQ(row["texture_units"], 1);
}

// Texture units are counted in passes that mark shadows: there are none without shadows, although the lit pass reads
// the cookie. The total is that of all parts.
TEST(Compare, UnitsOfTheComparisonAndTheTotal) {
  const TempFolder folder;
  const std::string cookie = NINEBIT_SOURCE_DIR "/scenes/cookies/labels.dds";
  const Json object =
      json_of(ninebit({"compare", kRoom, "-o", folder / "out", "--size", "64x48", "--quiet", "--json", "--technique",
                       "light-cookie", "--cookie", cookie, "--vary", "cookie-shadows=index,none"}));
  EXPECT_EQ(object["rows"][0]["texture_units"], 1);
  EXPECT_TRUE(object["rows"][1]["texture_units"].is_null());
  for (const Json& row : object["rows"]) {
    double sum = 0.0;
    for (const auto& [part, time] : row["time_ms"].items()) {
      if (part != "total") sum += time.get<double>();
    }
    EXPECT_GT(row["time_ms"]["transform"], 0.0);
    EXPECT_NEAR(row["time_ms"]["total"].get<double>(), sum, 1e-9 * sum);
  }
}

// Of several passes that mark shadows the one with the most units counts; floats have none. A point that cannot be
// drawn is a row with its reason.
TEST(Compare, UnitsOfSeveralPassesAndRowsWithoutPictures) {
  const TempFolder folder;
  const Json facing =
      compared(folder / "a", {"--light-facing", "--vary", "index-format=rgb,a", "--vary", "index-step=1-2"});
  EXPECT_EQ(names_of_rows(facing), (Words{"index-format rgb, index-step 1", "index-format rgb, index-step 2",
                                          "index-format a, index-step 1", "index-format a, index-step 2"}));
  EXPECT_EQ(facing["rows"][0]["texture_units"], 1) << "averted polygons need none";
  expect_parts(facing["rows"][2]["refused"].get<std::string>(), {"index"});
  const Json floats =
      compared(folder / "b", {"--light-facing", "--technique", "depth-cube", "--vary", "depth-bits=8,float"});
  EXPECT_EQ(floats["rows"][0]["texture_units"], 2);
  EXPECT_TRUE(floats["rows"][1]["texture_units"].is_null());
}

// A flag applies to the techniques that read it; one that none of them reads is an error.
TEST(Compare, FlagsOfOneTechnique) {
  const TempFolder folder;
  const Json plain = compared(folder / "a", {});
  const Json biased = compared(folder / "b", {"--bias", "2"});
  EXPECT_EQ(plain["rows"][0]["hash"], biased["rows"][0]["hash"]) << "index-cube";
  EXPECT_NE(plain["rows"][1]["hash"]["stencil"], biased["rows"][1]["hash"]["stencil"]) << "depth-cube";
  expect_error(ninebit(small_compare(kRoom, folder / "c", {"--bias", "2", "--light-type", "spot"})), 2,
               {"--bias", "none of the compared techniques"});
  EXPECT_TRUE(files_in(folder / "c").empty());
}

TEST(Compare, OffsetsHaveSemicolons) {
  const TempFolder folder;
  const Json object = compared(folder / "out", {"--technique", "shadow-map", "--vary", "polygon-offset=0,0;1,16"});
  EXPECT_EQ(names_of_rows(object), (Words{"polygon-offset 0,0", "polygon-offset 1,16"}));
  EXPECT_NE(object["rows"][0]["errors"]["wrong"], object["rows"][1]["errors"]["wrong"]);
}

// The same chip with exact combiners: no more indices are lost, as only the bytes for the alpha test are rounded;
// `ideal` has nothing to be replaced. No flag of `trace` draws such a picture, so its pixels have no commands.
TEST(Compare, ExactCombiners) {
  const TempFolder folder;
  const Json object = json_of(
      ninebit({"compare", kRoom, "-o", folder / "out", "--size", "160x120", "--map-size", "64", "--quiet", "--json",
               "--index-step", "1", "--vary", "profile=geforce2,ideal", "--vary", "arithmetic=chip,exact"}));
  EXPECT_EQ(names_of_rows(object), (Words{"profile geforce2, arithmetic chip", "profile geforce2, arithmetic exact",
                                          "profile ideal, arithmetic chip", "profile ideal, arithmetic exact"}));
  const Json &chip = object["rows"][0], &exact = object["rows"][1];
  EXPECT_EQ(exact["varied"]["arithmetic"], "exact");
  EXPECT_LE(exact["errors"]["by_cause"]["truncation"], chip["errors"]["by_cause"]["truncation"]);
  EXPECT_EQ(exact["hash"]["index_map"], chip["hash"]["index_map"]);
  EXPECT_NE(exact["hash"]["stencil"], chip["hash"]["stencil"]);
  EXPECT_FALSE(chip["errors"]["worst"].empty());
  EXPECT_TRUE(exact["errors"]["worst"].empty());
  EXPECT_EQ(object["rows"][3]["hash"], object["rows"][2]["hash"]);
}

// One page without other files, and the same figures beside it. Names are data: no markup comes from them.
TEST(Compare, ThePageHoldsAll) {
  const TempFolder folder;
  const std::string hostile = folder / "<img src=x onerror=alert(1)>.gltf";
  write_bytes(hostile, read_bytes(kCornell));
  const Json object =
      json_of(ninebit(small_compare(hostile, folder / "out", {"--json", "--vary", "technique=index-cube,depth-cube"})));
  const Files files = files_in(folder / "out");
  ASSERT_EQ(files.size(), 2U);
  const std::string& page = files.at("index.html");
  EXPECT_EQ(page.find("<img"), std::string::npos);
  expect_parts(page, {"\\u003cimg src=x"});
  EXPECT_EQ(page.find("\nimport "), std::string::npos);
  for (const char* part : {"http:", "https:"}) EXPECT_EQ(page.find(part), std::string::npos) << part;
  expect_parts(page, {"function pictureSwipe", "function sortableTable", "data:image/png;base64,"});
  const Json report = Json::parse(files.at("report.json"));
  EXPECT_EQ(report["rows"], object["rows"]);
}

// The traces on the page are what their commands print, also of a spot light that is drawn as a point light.
TEST(Compare, ThePageHasTheTracesOfListedPixels) {
  const TempFolder folder;
  const std::vector<Words> cases{
      {"--size", "160x120", "--vary", "technique=index-cube,shadow-volume"},
      {"--size", "96x72", "--map-size", "32", "--camera", "0.5,1,0.9", "--look-at", "0.2,0.2,0", "--fov", "30",
       "--light-type", "spot", "--light", "0.3,2,0.2", "--light-target", "0.2,0.2,0", "--spot-angle", "150"}};
  for (const Words& flags : cases) {
    const Json object = json_of(ninebit(Words{"compare", kRoom, "-o", folder / "out", "--quiet", "--json"} + flags));
    const Json data = data_of(read_bytes(folder / "out/index.html"));
    std::size_t texts = 0, listed = 0;
    for (std::size_t i = 0; i < object["rows"].size(); ++i) {
      listed += object["rows"][i]["errors"]["worst"].size();
      expect_traces(data["rows"][i]["traces"], texts);
    }
    EXPECT_GE(texts, 3U);
    EXPECT_EQ(texts, listed);
    EXPECT_EQ(read_bytes(folder / "out/report.json").find("the pixel is wrong"), std::string::npos);
  }
}

// The page stays small: of more than eight pictures it has one trace of each cause.
TEST(Compare, ManyPicturesHaveOneTraceOfEachCause) {
  const TempFolder folder;
  const Words steps{"--vary", "index-step=1-3", "--vary", "index-format=rgb,la,l"};
  ASSERT_EQ(ninebit(small_compare(kCornell, folder / "out", steps)).code, 0);
  const Json data = data_of(read_bytes(folder / "out/index.html"));
  ASSERT_GT(data["rows"].size(), 8U);
  for (const Json& row : data["rows"]) {
    if (row.contains("refused")) continue;
    std::size_t causes = 0, texts = 0;
    for (const auto& [cause, count] : row["errors"]["by_cause"].items()) causes += count == 0 ? 0U : 1U;
    for (const Json& one : row["traces"]) texts += one["text"] == "" ? 0U : 1U;
    EXPECT_EQ(texts, causes) << row["name"];
  }
  EXPECT_GT(data["rows"][0]["traces"].size(), 0U);
}

using ninebit::Image8;
using Place = std::optional<std::pair<int, int>>;

// Where a picture stands in a sheet.
Place place_in(const Image8& sheet, const Image8& picture) {
  const auto row_at = [](const Image8& image, int x, int y) {
    return image.pixels.begin() + std::ptrdiff_t{3} * (std::ptrdiff_t{y} * image.width + x);
  };
  for (int top = 0; top + picture.height <= sheet.height; ++top) {
    for (int left = 0; left + picture.width <= sheet.width; ++left) {
      int y = 0;
      while (y < picture.height && std::equal(row_at(picture, 0, y), row_at(picture, 0, y) + 3 * picture.width,
                                              row_at(sheet, left, top + y))) {
        ++y;
      }
      if (y == picture.height) return std::pair{left, top};
    }
  }
  return std::nullopt;
}

// The pixels of a rectangle of a sheet that are not paper.
std::vector<bool> ink_in(const Image8& sheet, int left, int top, int width, int height) {
  std::vector<bool> ink;
  for (int y = top; y < top + height; ++y) {
    for (int x = left; x < left + width; ++x) {
      ink.push_back(sheet.pixels[static_cast<std::size_t>(3 * (y * sheet.width + x))] < 128);
    }
  }
  return ink;
}

// The sheet has the pictures of `render`, each with its wrong pixels below it, and words that differ around them.
TEST(Compare, TheSheetHasAllPictures) {
  const TempFolder folder;
  const std::string sheet = folder / "sheet.png";
  const Words size{"--size", "360x80", "--map-size", "32", "--quiet"};
  Words words = Words{"compare", kRoom, "--sheet", sheet, "--vary", "index-step=1,2", "--json"} + size;
  const Json object = json_of(ninebit(words));
  EXPECT_EQ(object["files"], Json::array({sheet}));
  const Image8 found = ninebit::test::read_png(sheet);
  ASSERT_EQ(found.channels, 3);
  std::vector<std::vector<bool>> names, counts;
  for (const char* step : {"1", "2"}) {
    ASSERT_EQ(ninebit(Words{"render", kRoom, "-o", folder / step, "--index-step", step, "--ground-truth"} + size).code,
              0);
    const Place colors = place_in(found, ninebit::test::read_png(folder / (std::string(step) + "/color.png")));
    const Place errors = place_in(found, ninebit::test::read_png(folder / (std::string(step) + "/error.png")));
    ASSERT_TRUE(colors && errors) << step;
    EXPECT_EQ(colors->first, errors->first);
    EXPECT_GT(errors->second, colors->second + 80);
    names.push_back(ink_in(found, colors->first, colors->second - 30, 360, 30));
    counts.push_back(ink_in(found, errors->first, errors->second + 80, 360, 40));
  }
  EXPECT_NE(names[0], names[1]);
  EXPECT_NE(counts[0], counts[1]);
  for (const auto& part : {names[0], names[1], counts[0], counts[1]}) {
    EXPECT_GT(std::count(part.begin(), part.end(), true), 100);
  }
  // The same bytes again, beside the page, with any number of threads.
  const std::string before = read_bytes(sheet);
  EXPECT_EQ(json_of(ninebit(words + Words{"-o", folder / "page", "--threads", "2"}))["files"].size(), 3U);
  EXPECT_EQ(read_bytes(sheet), before);
}

TEST(Compare, ASheetHasAPlaceForWhatIsNotDrawn) {
  const TempFolder folder;
  const Json object = json_of(ninebit({"compare", kRoom, "--sheet", folder / "s.png", "--size", "64x48", "--quiet",
                                       "--json", "--vary", "index-format=rgb,a", "--index-step", "2"}));
  EXPECT_TRUE(object["rows"][1].contains("refused"));
  EXPECT_EQ(ninebit::test::read_png(folder / "s.png").width, 3 * 16 + 2 * 6 * 64);  // 360 pixels wide at least
}

TEST(Compare, SheetsThatCannotBe) {
  const TempFolder folder;
  expect_error(ninebit({"compare", kRoom, "--quiet"}), 2, {"--output or --sheet is required"});
  expect_error(ninebit({"compare", kRoom, "--quiet", "--sheet", folder / "s.jpg"}), 2, {"s.jpg", ".png"});
  expect_error(ninebit({"compare", kRoom, "--quiet", "--size", "4096x8192", "--vary", "index-step=1,2", "--sheet",
                        folder / "s.png"}),
               2, {"--sheet", "expected at most 16384 a side", "a smaller --size"});
  expect_error(ninebit(small_compare(kRoom, folder / "out", {"--sheet", "/proc/none/s.png"})), 4, {"/proc/none"});
  EXPECT_TRUE(files_in(folder / "out").empty());
}

TEST(Compare, WrongUsage) {
  const TempFolder folder;
  struct Case {
    Words flags, words;
  };
  const std::vector<Case> cases{
      {{"--technique", "depth-cube"}, {"--technique", "--vary"}},
      {{"--vary", "index-step"}, {"--vary", "FLAG=VALUE"}},
      {{"--vary", "index-stp=1"}, {"index-stp", "did you mean 'index-step'"}},
      {{"--vary", "size=8x8,9x9"}, {"'size' cannot be varied"}},
      {{"--vary", "arithmetic=chip,real"}, {"'real' is not an arithmetic; expected chip or exact"}},
      {{"--vary", "index-step=1,900"}, {"index-step", "900"}},
      {{"--vary", "index-step=1,1"}, {"given twice"}},
      {{"--vary", "index-step=1,"}, {"empty"}},
      {{"--vary", "index-step=1", "--vary", "index-step=2"}, {"varied twice"}},
      {{"--vary", "index-step=1,2", "--index-step", "3"}, {"--index-step is also given"}},
      {{"--vary", "bias=1,2"}, {"--bias", "index-cube does not read it"}},
      {{"--vary", "technique=index-cube,shadow-map", "--light-type", "directional"}, {"directional"}},
      {{"--vary", "index-step=1,2,3,4,5,6,7,8", "--vary", "section-size=8,12,16,20,24,28,32,36,40"}, {"64 pictures"}},
      {{"--vary", "profile=geforce2,voodoo"}, {"voodoo", "geforce2"}},
  };
  for (const Case& c : cases) {
    SCOPED_TRACE(testing::PrintToString(c.flags));
    expect_error(ninebit(small_compare(kRoom, folder / "out", c.flags)), 2, c.words);
  }
  EXPECT_TRUE(files_in(folder / "out").empty());
  expect_error(ninebit(small_compare(folder / "missing.obj", folder / "out")), 3, {"missing.obj"});
  write_bytes(folder / "file", "");
  expect_error(ninebit(small_compare(kRoom, folder / "file/out")), 4, {"file/out"});
}

TEST(Compare, AnInterruptLeavesNothing) {
  const TempFolder folder;
  Child child({"compare", kRoom, "-o", folder / "out", "--size", "1600x1200", "--quiet", "--vary",
               "index-step=1,2,3,4,5,6,7,8"});
  child.until([&] { return std::filesystem::exists(folder / "out"); });
  child.send(SIGINT);
  EXPECT_EQ(child.wait().code, 130);
  EXPECT_TRUE(files_in(folder / "out").empty());
}

}  // namespace
}  // namespace tools_test
