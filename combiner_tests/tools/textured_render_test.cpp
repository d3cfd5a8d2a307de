// Scenes with textures, drawn by `ninebit render`.
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/support.h"
#include "ninebit/image/image_io.h"

namespace tools_test {
namespace {

namespace fs = std::filesystem;

// A square with the texture of a material library.
class TexturedRender : public testing::Test {
 protected:
  void SetUp() override {
    if (ninebit::test::kSanitized)
      GTEST_SKIP() << "the leak sanitizer's thread crashes now and then after pictures were read";
    fs::create_directories(folder_.path() / "scene");
    write_bytes(folder_ / "scene/s.obj",
                "mtllib s.mtl\nv -1 0 -1\nv 1 0 -1\nv 1 0 1\nv -1 0 1\nvt 0 0\nvt 1 0\nvt 1 1\nvt 0 1\n"
                "usemtl a\nf 4/1 3/2 2/3 1/4\n");
    library("map_Kd t.png\n");
  }
  void library(const std::string& statements) const {
    write_bytes(folder_ / "scene/s.mtl", "newmtl a\nKd 1 1 1\n" + statements);
  }
  void picture(const std::string& name, int side, std::uint8_t red) const {
    ninebit::Image8 image{side, side, 3, {}};
    for (int i = 0; i < side * side; ++i) image.pixels.insert(image.pixels.end(), {red, 255, 255});
    ASSERT_TRUE(ninebit::write_png(folder_ / name, image));
  }
  [[nodiscard]] Outcome run(Words more = {}) const {
    return ninebit(small_render(folder_ / "scene/s.obj", folder_ / "out", more));
  }
  [[nodiscard]] Json answer(Words more = {}) const { return json_of(run(more + Words{"--json", "--quiet"})); }

  TempFolder folder_;
};

TEST_F(TexturedRender, DrawsTheTexture) {
  picture("scene/t.png", 4, 255);
  const Json white = answer();
  EXPECT_EQ(white["ignored"], Json::array());
  picture("scene/t.png", 4, 10);
  const Json dark = answer();
  EXPECT_NE(white["hash"]["color"], dark["hash"]["color"]);
  EXPECT_EQ(white["hash"]["stencil"], dark["hash"]["stencil"]);
  library("");
  const Json plain = answer();
  EXPECT_EQ(white["hash"]["color"], plain["hash"]["color"]) << "a white texture changes nothing";
}

// The pass that decided the shadow is named in all outputs, not one that the stencil test kept from drawing.
TEST_F(TexturedRender, TraceNamesThePassThatDecided) {
  picture("scene/t.png", 4, 10);
  const auto trace = [&](const Words& more) {
    return ninebit(
        Words{"trace", "--scene", folder_ / "scene/s.obj", "--size", "32x24", "--pixel", "16,14", "--quiet"} + more);
  };
  const Json answer = json_of(trace({"--json"}));
  EXPECT_EQ(answer["scene"]["state"], "lit");
  EXPECT_EQ(answer["scene"]["pass"], "comparison");
  EXPECT_EQ(answer["scene"]["passes"][1]["fragments"].at(answer["scene"]["fragment"].get<std::size_t>())["fate"],
            "alpha test failed");
  const Outcome text = trace({});
  expect_parts(text.out, {"traced: pass comparison, "});
  EXPECT_EQ(trace({"-o", folder_ / "page.html"}).code, 0);
  expect_parts(read_bytes(folder_ / "page.html"), {"<dt>Pass</dt><dd>comparison</dd>"});

  // No face of a volume is at this pixel: the pass that coloured it.
  const Json volume = json_of(trace({"--json", "--technique", "shadow-volume"}));
  EXPECT_EQ(volume["scene"]["pass"], "lit");
  int written = 0;
  for (const Json& pass : volume["scene"]["passes"]) {
    for (const Json& fragment : pass["fragments"]) {
      if (pass["name"] == "depth" || fragment["fate"] != "written") continue;
      EXPECT_EQ(pass["name"], "lit");
      EXPECT_EQ(fragment["color"], volume["out"]["bytes"]);
      ++written;
    }
  }
  EXPECT_EQ(written, 1);
}

// The pass that decided may have no program.
TEST(TraceOfVolumes, NamesThePassThatHasNothingToTrace) {
  const auto trace = [](Words more) {
    return ninebit(Words{"trace", "--scene", kRoom, "--size", "64x48", "--pixel", "32,40", "--technique",
                         "shadow-volume", "--quiet"} +
                   more);
  };
  const Json answer = json_of(trace({"--json"}));
  EXPECT_EQ(answer["scene"]["pass"], "volumes");
  EXPECT_TRUE(answer["scene"]["fragment"].is_null());
  EXPECT_FALSE(answer.contains("stages"));
  const Outcome text = trace({});
  expect_parts(text.out, {"pass volumes decided, without a program: nothing to trace"});
}

TEST_F(TexturedRender, CartoonIgnoresIt) {
  picture("scene/t.png", 4, 10);
  EXPECT_EQ(answer({"--style", "cartoon"})["ignored"], Json{"textures, by --style cartoon"});
}

TEST_F(TexturedRender, WarnsOnceOfAllThatIsIgnored) {
  picture("scene/t.png", 3, 10);
  library("map_Kd t.png\nbump n.png\nd 0.5\n");
  const std::string outcome = err_of(run());
  const std::string words =
      "ignored: normal maps; alpha blending; exact sizes of textures, resampled to powers of two: 't.png' (3 x 3)";
  expect_parts(outcome, {words});
  EXPECT_EQ(outcome.find("warning"), outcome.rfind("warning"));
}

TEST_F(TexturedRender, FaultsNameBothFilesAndWriteNothing) {
  expect_error(run(), 3, {"s.obj", "t.png"});
  write_bytes(folder_ / "scene/t.png", "not a picture");
  expect_error(run(), 3, {"s.obj", "t.png"});
  picture("scene/t.png", 16, 10);
  const std::string good = read_bytes(folder_ / "scene/t.png");
  write_bytes(folder_ / "scene/t.png", good.substr(0, good.size() / 2));
  expect_error(run(), 3, {"s.obj", "t.png"});
  picture("t.png", 4, 10);
  library("map_Kd ../t.png\n");
  expect_error(run(), 3, {"s.obj", "../t.png", "--allow-outside"});
  EXPECT_FALSE(fs::exists(folder_.path() / "out"));
  EXPECT_EQ(answer({"--allow-outside"})["ignored"], Json::array());
}

}  // namespace
}  // namespace tools_test
