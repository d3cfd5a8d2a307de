// `ninebit draw`: pictures, answers, the gallery's hashes, and errors.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

#include "combiner_tests/support/random.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/support/stored_pictures.h"
#include "combiner_tests/tools/support.h"
#include "ninebit/image/image_io.h"

namespace tools_test {
namespace {

using ninebit::Image8;

const std::string kEffects = NINEBIT_SOURCE_DIR "/scenes/effects/";
const std::string kSepia = kEffects + "programs/sepia.rc1";
const std::string kPhotograph = kEffects + "textures/photograph.png";

Words draw(const std::string& what, const std::string& picture, const Words& more = {}) {
  return Words{"draw", what, "-o", picture, "--quiet"} + more;
}

// The hash of what is drawn.
Json color_of(const TempFolder& folder, const std::string& what, const Words& more) {
  return json_of(ninebit(draw(what, folder / "p.png", Words{"--json"} + more)))["hash"]["color"];
}

// The stencil plane of the effect is that of the technique, bit for bit.
TEST(Draw, IndexCubeIsTheTechnique) {
  const TempFolder folder;
  const Json effect = json_of(ninebit(draw(kEffects + "index_cube.json", folder / "p.png", {"--json"})));
  const Json technique =
      json_of(ninebit({"render", kRoom, "-o", folder / "r", "--size", "640x480", "--json", "--quiet"}));
  EXPECT_EQ(effect["hash"]["stencil"], technique["hash"]["stencil"]);
}

TEST(Draw, TheGalleryIsToTheBit) {
  if (ninebit::test::kSanitized)
    GTEST_SKIP() << "the leak sanitizer's thread crashes now and then after pictures were read";
  const TempFolder folder;
  const Json expected = Json::parse(read_bytes(kEffects + "expected_hashes.json"));
  std::size_t count = 0;
  for (const auto& entry : std::filesystem::directory_iterator(kEffects)) {
    const std::string name = entry.path().stem().string();
    if (entry.path().extension() != ".json" || name == "expected_hashes") continue;
    ASSERT_TRUE(expected.contains(name)) << name;
    const std::string threads = count % 2 == 0 ? "1" : "3";
    const Json drawn =
        json_of(ninebit(draw(entry.path().string(), folder / "p.png", {"--json", "--threads", threads})));
    EXPECT_EQ(drawn["hash"]["color"], expected[name]) << name;
    EXPECT_TRUE(drawn["warnings"].empty()) << name << ": " << drawn["warnings"];
    ++count;
  }
  EXPECT_EQ(count, expected.size());
}

TEST(Draw, AnswersWhatItDrew) {
  if (ninebit::test::kSanitized)
    GTEST_SKIP() << "the leak sanitizer's thread crashes now and then after pictures were read";
  const TempFolder folder;
  const Json drawn = json_of(ninebit(draw(kSepia, folder / "p.png",
                                          {"--tex0", kPhotograph, "--filter0", "nearest", "--size", "256x256", "--json",
                                           "--difference", "ideal", "--layers"})));
  EXPECT_EQ(drawn["program"], kSepia);
  EXPECT_EQ(drawn["size"], Json::parse("[256, 256]"));
  EXPECT_EQ(drawn["files"].size(), 3U);
  EXPECT_GT(drawn["difference"]["pixels"], 0);
  EXPECT_GT(drawn["difference"]["max"], 0);
  EXPECT_LT(drawn["difference"]["max"], 16);
  const Files files = files_in(folder.path());
  EXPECT_EQ(files.size(), 3U);
  EXPECT_EQ(files.count("p.png") + files.count("p.difference.png") + files.count("p.layers.exr"), 3U);
  const Json same = json_of(ninebit(draw(
      kSepia, folder / "q.png",
      {"--tex0", kPhotograph, "--filter0", "nearest", "--size", "256x256", "--json", "--difference", "geforce2"})));
  EXPECT_EQ(same["difference"]["pixels"], 0);
  EXPECT_EQ(same["hash"], drawn["hash"]);
}

TEST(Draw, FilesAreNamedAsTheyWereGiven) {
  const TempFolder folder;
  for (const std::string before : {"", "./", "sub//"}) {
    Words words = draw(kSepia, before + "d.png", {"--tex0", kPhotograph, "--difference", "ideal"});
    std::erase(words, "--quiet");
    const Outcome drawn = ninebit(words, {.folder = folder.path().string()});
    EXPECT_EQ(drawn.err, "wrote " + before + "d.png\nwrote " + before + "d.difference.png\n");
    EXPECT_TRUE(std::filesystem::exists(folder.path() / before / "d.difference.png"));
  }
}

// A program without arithmetic: what differs comes from the rasterizer.
TEST(Draw, ArithmeticIsTheSameChipWithExactCombiners) {
  const TempFolder folder;
  write_bytes(folder / "color.rc1", "!!RC1.0\nout.rgb = col0;\n");
  const auto differ = [&](const std::string& file, const std::string& other) {
    return json_of(ninebit(draw(file, folder / "p.png",
                                {"--mesh", "sphere:8", "--primary", "normal", "--size", "64x64", "--json",
                                 "--difference", other})))["difference"];
  };
  EXPECT_EQ(differ(folder / "color.rc1", "arithmetic"), Json::parse(R"({"pixels": 0, "max": 0})"));
  EXPECT_GT(differ(folder / "color.rc1", "ideal")["pixels"], 0);
  write_bytes(folder / "square.rc1", "!!RC1.0\n{ rgb { spare0 = col0 * col0; } }\nout.rgb = spare0;\n");
  write_bytes(folder / "exact.json", R"({"base": "geforce2", "name": "mine", "arithmetic": "exact"})");
  const Json squares = differ(folder / "square.rc1", "arithmetic");
  EXPECT_GT(squares["pixels"], 0);
  EXPECT_EQ(squares["max"], 1);
  EXPECT_EQ(differ(folder / "square.rc1", folder / "exact.json"), squares);
}

TEST(Draw, TheWordArithmeticIsNoFile) {
  const TempFolder folder;
  write_bytes(folder / "arithmetic.json", R"({"base": "geforce2", "name": "arithmetic", "texture_units": 4})");
  const auto said = [&](const std::string& other) {
    return ninebit(
        {"draw", kSepia, "--tex0", kPhotograph, "-o", folder / "p.png", "--size", "64x64", "--difference", other});
  };
  expect_parts(said("arithmetic").out, {" pixels differ with exact combiners, by 1 at most\n"});
  expect_parts(said(folder / "arithmetic.json").out, {"\n0 pixels differ under profile arithmetic, by 0 at most\n"});
  expect_error(said("./arithmetic"), 2, {"--difference", "unknown profile", "arithmetic, geforce2", ".json file"});
  expect_error(said(folder / "missing.json"), 3, {"missing.json"});
}

// A flag changes the picture that has the same effect file otherwise.
TEST(Draw, FlagsReplaceTheSceneOfAnEffect) {
  const TempFolder folder;
  const auto hash = [&](const Words& flags) {
    return color_of(folder, kEffects + "toon.json", Words{"--size", "64x64"} + flags);
  };
  const Json plain = hash({});
  for (const Words& flags : std::vector<Words>{{"--light", "2,0,2"},
                                               {"--camera", "0,0,4"},
                                               {"--mesh", "cube"},
                                               {"--fov", "30"},
                                               {"--look-at", "0.2,0,0"},
                                               {"--color-format", "r5g6b5"},
                                               {"--floor", "-1"}}) {
    EXPECT_NE(hash(flags), plain) << flags[0];
  }
}

TEST(Draw, FlagsOfAPassChangeThePicture) {
  const TempFolder folder;
  const auto hash = [&](const Words& flags) {
    const Words sphere{"--size", "64x64", "--mesh", "sphere:16", "--tex0", "checker:64", "--primary", "lambert"};
    return color_of(folder, kEffects + "programs/fog.rc1", sphere + flags);
  };
  const Json plain = hash({});
  for (const Words& flags : std::vector<Words>{{"--fog", "exp:0.5"},
                                               {"--fog", "registers-exp2:1.6,-0.1"},
                                               {"--blend", "dst_color,zero"},
                                               {"--alpha-test", "less,128"},
                                               {"--depth", "never"},
                                               {"--color-format", "b8"},
                                               {"--cull", "front"},
                                               {"--polygon-mode", "line"},
                                               {"--polygon-mode", "line", "--line-width", "3", "--line-smooth"},
                                               {"--polygon-mode", "point", "--point-size", "4"},
                                               {"--polygon-smooth"},
                                               {"--polygon-stipple", "10,01"},
                                               {"--color-mask", "r"}}) {
    EXPECT_NE(hash(flags), plain) << flags[0];
  }
}

// The checkerboard's darker squares are 0x40, of texels that a filter does not mix.
TEST(Draw, FlagsOfASamplerChangeThePicture) {
  const TempFolder folder;
  const auto hash = [&](const Words& flags, const std::string& mesh = "sphere:16") {
    const Words textured{"--size", "64x64", "--mesh", mesh, "--tex0", "checker:64", "--filter0", "nearest"};
    return color_of(folder, kEffects + "programs/texture0.rc1", textured + flags);
  };
  std::set<std::string> seen{hash({})};
  for (const Words& flags :
       std::vector<Words>{{"--wrap0", "clamp-to-border", "--border-texels0"},
                          {"--wrap0", "clamp-to-border", "--coord0", "position"},
                          {"--wrap0", "clamp-to-border", "--coord0", "position", "--border-color0", "1,0.5,0,1"},
                          {"--color-key0", "kill:FFFFFFFF"},
                          {"--color-key0", "rgba:FFFFFFFF"}}) {
    EXPECT_TRUE(seen.insert(hash(flags)).second) << flags[0] << ' ' << flags[1];
  }
  // One square's difference of 1 becomes 0.
  EXPECT_NE(hash({"--cylinder-wrap0", "s"}, "plane:1"), hash({}, "plane:1"));
  const auto fails = [&](Words flags) {
    return ninebit(draw(kEffects + "programs/texture0.rc1", folder / "p.png", flags + Words{"--tex0", "checker:64"}));
  };
  expect_error(fails({"--color-key0", "kill:FFFFFFFF"}), 3, {"a colour key needs the nearest texel"});
  expect_error(fails({"--border-texels0"}), 3, {"border texels need a 2D image of 16 texels a side"});
  expect_error(fails({"--color-key0", "kill"}), 2, {"--color-key0", "eight hexadecimal digits"});
  expect_error(fails({"--cylinder-wrap0", "q"}), 2, {"--cylinder-wrap0", "expected s, t or st"});
  expect_error(fails({"--cylinder-wrap0", "s", "--wrap0", "clamp"}), 2,
               {"a cylinder wrap has no effect with this wrap mode; expected repeat"});
  expect_error(fails({"--border-color0", "1,1,1"}), 2, {"--border-color0", "R,G,B,A"});
  expect_error(fails({"--border-color1", "1,1,1,1"}), 2, {"--border-color1 requires --tex1"});
  expect_error(fails({"--polygon-stipple", "2"}), 2, {"--polygon-stipple", "not a stipple pattern"});
  expect_error(fails({"--line-width", "2"}), 2, {"a line width has no effect here"});
  expect_error(fails({"--polygon-mode", "point", "--coord0", "point-sprite", "--filter0", "nearest"}), 3,
               {"geforce2", "point sprites"});
}

// A torus hides itself: every format decides which side is in front, a W buffer by w.
TEST(Draw, EveryDepthFormatDrawsATorus) {
  const TempFolder folder;
  const auto drawn = [&](const std::string& format) {
    return color_of(folder, kEffects + "programs/fog.rc1",
                    {"--size", "64x64", "--mesh", "torus:16", "--tex0", "checker:64", "--primary", "lambert",
                     "--depth-stencil", format});
  };
  const Json fixed = drawn("d24s8");
  ASSERT_FALSE(fixed.is_null());
  for (const std::string format : {"f24s8", "w24s8", "wf24s8", "w16"}) EXPECT_EQ(drawn(format), fixed) << format;
  EXPECT_EQ(ninebit({"draw", "x.rc1", "--depth-stencil", "d32"}).code, 2);
  // A rectangle has one w, which only a depth test reads.
  const Words rectangle{
      "draw",      kEffects + "programs/fog.rc1", "-o", folder / "p.png", "--depth-stencil", "w24s8", "--tex0",
      "checker:64"};
  EXPECT_EQ(ninebit(rectangle).code, 0);
  expect_error(ninebit(rectangle + Words{"--depth", "less"}), 3, {"the W buffer w24s8 needs a perspective view"});
}

// The program is const0 of the first combiner times const1, plus const0 of the second.
TEST(Draw, AConstantOfOneCombinerReplacesTheGlobalOneThere) {
  const TempFolder folder;
  write_bytes(folder / "constants.rc1",
              "!!RC1.0\n{ rgb { spare0 = const0; } }\n{ rgb { spare1 = const0; } }\n"
              "out.rgb = spare0 * const1 + spare1;\n");
  const auto hash = [&](const Words& flags) {
    return color_of(folder, folder / "constants.rc1", Words{"--size", "8x8", "--profile", "nv2a"} + flags);
  };
  const Json red_then_blue = hash({"--const0", "0:1,0,0,1", "--const0", "1:0,0,1,1", "--const1", "1,1,1,1"});
  EXPECT_EQ(hash({"--const0", "1,0,0,1", "--const0", "1:0,0,1,1", "--const1", "1,1,1,1"}), red_then_blue);
  EXPECT_EQ(hash({"--const0", "1,0,1,1", "--const1", "0,0,0,0"}), red_then_blue);
  EXPECT_NE(hash({"--const0", "1,0,0,1", "--const1", "1,1,1,1"}), red_then_blue);
  const std::string picture = folder / "q.png";
  const auto fails = [&](const std::string& constant, const std::string& profile) {
    return ninebit(draw(folder / "constants.rc1", picture, {"--const0", constant, "--profile", profile}));
  };
  expect_error(fails("8:0,0,0,0", "nv2a"), 2, {"--const0", "0 to 7"});
  expect_error(fails("0:0,0,0", "nv2a"), 2, {"--const0", "4 numbers"});
  expect_error(fails("2:0,0,0,0", "nv2a"), 3, {"general combiner 2", "has 2"});
  expect_error(fails("0:0,0,0,0", "geforce2"), 3, {"per-stage constants"});
}

TEST(Draw, OnlyWritesTheNamedFiles) {
  const TempFolder folder;
  const Json drawn = json_of(
      ninebit(draw(kEffects + "toon.json", folder / "p.png",
                   {"--size", "32x32", "--json", "--difference", "ideal", "--layers", "--only", "difference,layers"})));
  EXPECT_EQ(drawn["files"].size(), 2U);
  EXPECT_FALSE(std::filesystem::exists(folder / "p.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "p.difference.png"));
  EXPECT_TRUE(std::filesystem::exists(folder / "p.layers.exr"));
  const std::string picture = folder / "p.png";
  expect_error(ninebit(draw(kSepia, picture, {"--only", "color"})), 2,
               {"--only", "expected a list of picture, difference, layers"});
  expect_error(ninebit(draw(kSepia, picture, {"--only", "layers"})), 2, {"requires --layers"});
  expect_error(ninebit(draw(kSepia, picture, {"--only", "difference"})), 2, {"requires --difference"});
}

TEST(Draw, BadInputIsOneError) {
  const TempFolder folder;
  const std::string picture = folder / "p.png";
  expect_error(ninebit(draw(kSepia, folder / "p.jpg")), 2, {"--output", ".png"});
  expect_error(ninebit(draw(kSepia, picture, {"--tex0", "checker:3"})), 2, {"--tex0", "power of two"});
  expect_error(ninebit(draw(kSepia, picture, {"--filter0", "linear"})), 2, {"--filter0 requires --tex0"});
  expect_error(ninebit(draw(kSepia, picture, {"--coord0", "color", "--tex0", "gradient"})), 2, {"--coord0"});
  expect_error(ninebit(draw(kSepia, picture, {"--tex0", "target:x"})), 2, {"only effect files"});
  expect_error(ninebit(draw(kEffects + "toon.json", picture, {"--cull", "back"})), 2, {"--cull", "effect file"});
  expect_error(ninebit(draw(kSepia, picture, {"--color-format", "rgb565"})), 2, {"--color-format", "r5g6b5"});
  expect_error(ninebit(draw(kSepia, picture, {"--color-format", "b8", "--blend", "one,one"})), 2,
               {"blends into target 'picture' of format b8, which the chip does not"});
  expect_error(ninebit(draw(kSepia, picture, {"--tex0", folder / "none.png"})), 3, {"none.png"});
  expect_error(ninebit(draw(folder / "none.gl", picture)), 3, {"none.gl"});
  expect_error(ninebit(draw(kSepia, picture, {"--mesh", folder / "none.obj"})), 3, {"none.obj"});
  write_bytes(folder / "bad.json", "{\"ninebit\": \"effect\", \"version\": 1,\n\"passes\": [{\"cull\": \"up\"}]}");
  expect_error(ninebit(draw(folder / "bad.json", picture)), 3, {"bad.json:2:", "expected none, back or front"});
  EXPECT_FALSE(std::filesystem::exists(picture));
}

// A picture whose sides are not powers of two keeps its texels and gives the drawing its size.
TEST(Draw, APictureOfAnySizeIsDrawnTexelByTexel) {
  const TempFolder folder;
  ninebit::test::Random random(46);
  Image8 odd{37, 11, 4, {}}, even{32, 8, 4, {}};
  for (int i = 0; i < 37 * 11 * 4; ++i) odd.pixels.push_back(random.byte());
  for (int i = 0; i < 32 * 8 * 4; ++i) even.pixels.push_back(random.byte());
  ASSERT_TRUE(ninebit::write_png(folder / "odd.png", odd));
  ASSERT_TRUE(ninebit::write_png(folder / "even.png", even));
  write_bytes(folder / "p.rc1", "!!RC1.0\nout.rgb = unsigned_invert(tex0);\nout.a = tex0.a;\n");
  const std::string program = folder / "p.rc1", out = folder / "out.png", eval = folder / "eval.png";
  const auto drawn = [&](const Words& flags) { return json_of(ninebit(draw(program, out, Words{"--json"} + flags))); };
  for (const char* name : {"odd.png", "even.png"}) {
    const std::string file = folder / name;
    ASSERT_EQ(ninebit({"eval", program, "--tex0", file, "-o", eval, "--quiet"}).code, 0);
    const Json answer = drawn({"--tex0", file});
    const Image8 expected = ninebit::test::read_png(eval), seen = ninebit::test::read_png(out);
    EXPECT_EQ(answer["size"], Json::array({expected.width, expected.height}));
    EXPECT_EQ(seen.pixels, expected.pixels) << name;
    EXPECT_TRUE(answer["warnings"].empty()) << answer["warnings"];
  }
  const std::string file = folder / "odd.png";
  // Twice as large: each texel is four pixels.
  EXPECT_EQ(drawn({"--tex0", file, "--size", "74x22", "--filter0", "nearest"})["size"], Json::array({74, 22}));
  const Image8 twice = ninebit::test::read_png(out);
  for (int y = 0; y < 22; ++y) {
    for (int x = 0; x < 74; ++x) {
      const auto at = static_cast<std::size_t>(4 * (y * 74 + x)),
                 from = static_cast<std::size_t>(4 * (y / 2 * 37 + x / 2));
      ASSERT_EQ(twice.pixels[at], 255 - odd.pixels[from]) << x << ' ' << y;
    }
  }
  // What rectangle textures do not have asks for powers of two.
  const std::string to_keep_wrap = "as its wrap repeats; with --wrap0 clamp-to-edge it keeps its size";
  const std::vector<std::pair<Words, std::string>> resampled{
      {{"--filter0", "trilinear"}, "as its filter reads mip-maps; with --filter0 linear it keeps its size"},
      {{"--wrap0", "repeat"}, to_keep_wrap},
      {{"--mesh", "cube", "--filter0", "linear"}, to_keep_wrap},
      {{"--mesh", "cube"},
       "as its filter reads mip-maps and its wrap repeats; with --filter0 linear and --wrap0 clamp-to-edge it keeps"}};
  const auto with_file = [&](Words flags) { return Words{"--tex0", file} + flags; };
  for (const auto& [flags, why] : resampled) {
    const Json warnings = drawn(with_file(flags))["warnings"];
    ASSERT_EQ(warnings.size(), 1U) << why << warnings;
    expect_parts(warnings[0].get<std::string>(), {"odd.png: 37 x 11 is resampled to powers of two, " + why});
  }
  // Where nothing repeats, a mesh reads all texels, too: the picture looks as with each texel as 3 x 3.
  Image8 large{.width = 48, .height = 24, .channels = 4, .pixels = {}};
  for (std::size_t i = 0; i < 48 * 24; ++i) {
    const std::size_t from = 4 * (i / 48 / 3 * 32 + i % 48 / 3);
    for (std::size_t c = 0; c < 4; ++c) large.pixels.push_back(even.pixels[from + c]);
  }
  Image8 small{.width = 16, .height = 8, .channels = 4, .pixels = {}};
  for (std::size_t i = 0; i < 16 * 8; ++i) {
    for (std::size_t c = 0; c < 4; ++c) small.pixels.push_back(even.pixels[4 * (i / 16 * 32 + i % 16) + c]);
  }
  ASSERT_TRUE(ninebit::write_png(folder / "large.png", large));
  ASSERT_TRUE(ninebit::write_png(folder / "small.png", small));
  const auto on_cube = [&](const char* name) {
    const Json answer = drawn({"--tex0", folder / name, "--mesh", "cube", "--filter0", "nearest", "--wrap0",
                               "clamp-to-edge", "--size", "96x96"});
    EXPECT_TRUE(answer["warnings"].empty()) << answer["warnings"];
    return ninebit::test::read_png(out).pixels;
  };
  const auto seen = on_cube("large.png"), expected = on_cube("small.png");
  ASSERT_EQ(seen.size(), expected.size());
  std::size_t different = 0;
  for (std::size_t i = 0; i < seen.size(); i += 4)
    different += std::equal(&seen[i], &seen[i] + 4, &expected[i]) ? 0U : 1U;
  EXPECT_LT(different, 96U * 96U / 100U);  // at texels' edges
  // A stage names a 2D texture.
  write_bytes(folder / "p.rc1", "!!TS1.0\ntexture_2d();\n!!RC1.0\nout.rgb = unsigned_invert(tex0);\nout.a = tex0.a;\n");
  const Json staged = drawn({"--tex0", file, "--profile", "nv2a"});
  ASSERT_EQ(staged["warnings"].size(), 1U) << staged["warnings"];
  expect_parts(staged["warnings"][0].get<std::string>(), {"is resampled"});
}

TEST(Draw, WarnsOfWhatOneMayNotExpect) {
  const TempFolder folder;
  const Json drawn = json_of(ninebit(draw(kSepia, folder / "p.png", {"--size", "8x8", "--json"})));
  ASSERT_EQ(drawn["warnings"].size(), 1U);
  expect_parts(drawn["warnings"][0].get<std::string>(), {"texture unit 0"});
  const Json still = json_of(
      ninebit(draw(NINEBIT_SOURCE_DIR "/scenes/effects/sepia.json", folder / "p.png", {"--frame", "2", "--json"})));
  ASSERT_EQ(still["warnings"].size(), 1U) << still["warnings"];
  expect_parts(still["warnings"][0].get<std::string>(), {"--frame has no effect: no number of"});
  // A target has no mip-maps, so that a filter that reads them switches the unit off, as OpenGL does.
  write_bytes(folder / "invert.rc1", "!!RC1.0\nout.rgb = unsigned_invert(tex0);\n");
  for (const char* filter : {"linear", "trilinear"}) {
    write_bytes(folder / "off.json",
                std::string(R"({"ninebit": "effect", "version": 1, "size": [8, 8], "targets": {"first": {"size": 4}},
"textures": {"t": {"source": "target:first", "filter": ")") +
                    filter + R"("}},
"passes": [{"name": "a", "target": "first", "draw": "rectangle"},
{"name": "b", "draw": "rectangle", "program": "invert.rc1", "units": [{"texture": "t", "coordinates": "uv"}]}]})");
    const Json warnings = json_of(ninebit(draw(folder / "off.json", folder / "p.png", {"--json"})))["warnings"];
    if (std::string(filter) == "linear") {
      EXPECT_TRUE(warnings.empty()) << warnings;
      continue;
    }
    const std::string expected =
        "pass 'b': texture unit 0 is off, because its texture is incomplete: its filter reads mip-maps, and level 1 "
        "(2 × 2 texels) is missing";
    EXPECT_EQ(warnings, Json::array({expected}));
    const auto said = ninebit({"draw", folder / "off.json", "-o", folder / "p.png"});
    expect_parts(said.err, {"ninebit: warning: " + expected + "\n"});
  }
}

}  // namespace
}  // namespace tools_test
