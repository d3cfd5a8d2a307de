// `ninebit trace --effect`: a pixel of an effect, step by step.
#include <gtest/gtest.h>

#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

const std::string kFolder = NINEBIT_SOURCE_DIR "/scenes/effects/";
const std::string kTones = kFolder + "toon.json";

// The traced colour is that of the pixel of the picture.
TEST(TraceEffect, APixel) {
  const Json toon = json_of(ninebit({"trace", "--effect", kTones, "--pixel", "60,128", "--json", "--quiet"}));
  EXPECT_EQ(toon["profile"], "nv2a") << "the effect's own profile";
  EXPECT_EQ(toon["effect"]["state"], "drawn");
  EXPECT_EQ(toon["effect"]["pass"], "tones");
  EXPECT_EQ(toon["effect"]["technique"], Json());
  EXPECT_EQ(toon["stages"].size(), 3U);
  const Json& passes = toon["effect"]["passes"];
  ASSERT_EQ(passes.size(), 1U);
  const Json& fragment = passes[0]["fragments"][toon["effect"]["fragment"].get<std::size_t>()];
  EXPECT_EQ(fragment["fate"], "written");
  EXPECT_EQ(fragment["object_name"], "torus");
  EXPECT_EQ(fragment["color"], toon["out"]["bytes"]);
  const Json ideal =
      json_of(ninebit({"trace", "--effect", kTones, "--pixel", "60,128", "--json", "--quiet", "--profile", "ideal"}));
  EXPECT_EQ(ideal["profile"], "ideal");
  const Json blur =
      json_of(ninebit({"trace", "--effect", kFolder + "blur.json", "--pixel", "9,9", "--json", "--quiet"}));
  EXPECT_EQ(blur["effect"]["passes"].size(), 1U) << "only the last pass draws the picture";
  EXPECT_EQ(blur["effect"]["passes"][0]["fragments"][0]["object_name"], "rectangle");
  const std::string light = kFolder + "point_light.json";
  for (const std::string pass : {"diffuse", "specular"}) {
    const Json chosen =
        json_of(ninebit({"trace", "--effect", light, "--pixel", "128,128", "--json", "--quiet", "--pass", pass}));
    EXPECT_EQ(chosen["effect"]["pass"], pass);
  }
  expect_error(ninebit({"trace", "--effect", light, "--pixel", "128,128", "--pass", "ambient"}), 2,
               {"--pass ambient: there is no such pass; expected one of diffuse, specular"});
  expect_parts(out_of(ninebit({"trace", "--effect", kTones, "--pixel", "0,0", "--quiet"})),
               {"not drawn: no fragment to trace"});
  expect_error(ninebit({"trace", "--effect", kTones, "--pixel", "256,0"}), 3, {"256,0 is outside", "0 to 255"});
  expect_error(ninebit({"trace", "--effect", kRoom, "--pixel", "1,1"}), 3,
               {"index_room.gltf: this is a glTF scene; `ninebit render` draws it"});
}

// The moment of an effect that moves, and of one that does not.
TEST(TraceEffect, AMoment) {
  const auto trace = [](const std::string& effect, const std::string& flag) {
    return err_of(ninebit({"trace", "--effect", kFolder + effect, "--pixel", "60,128", "--json", flag, "1.5"}));
  };
  EXPECT_EQ(trace("dot3_specular.json", "--time").find("has no effect"), std::string::npos);
  const std::string warned = trace("toon.json", "--time");
  expect_parts(warned, {"--time has no effect: no number of", "toon.json depends on time or frame"});
}

// The stages before the combiners, and what they did to the fragment.
TEST(TraceEffect, TextureShaders) {
  const auto pixel_of = [](const std::string& effect, const std::string& at) {
    return json_of(ninebit({"trace", "--effect", kFolder + effect, "--pixel", at, "--json", "--quiet"}))["effect"];
  };
  const Json balls = pixel_of("depth_balls.json", "130,130");
  const Json& replaced = balls["passes"][balls["pass"] == "green" ? 2 : 0]["fragments"][0];
  EXPECT_EQ(replaced["depth_replaced"], true);
  ASSERT_EQ(replaced["stages"].size(), 4U);
  EXPECT_TRUE(replaced["stages"][1].contains("dot"));
  EXPECT_EQ(replaced["stages"][1]["operation"], "dot_product");
  EXPECT_EQ(replaced["stages"][1]["previous"], 0);
  EXPECT_EQ(replaced["stages"][2]["dot_products"], (Json{1, 2}));
  EXPECT_FALSE(replaced["stages"][0].contains("previous")) << "a plain texture reads no other stage";
  EXPECT_TRUE(replaced["stages"][3].contains("at"));
  EXPECT_EQ(replaced["stages"][2]["texel"], (Json{0, 0, 0, 0}));
  const Json shell = pixel_of("clip_planes.json", "60,90");
  EXPECT_EQ(shell["passes"][0]["fragments"][0]["fate"], "culled by the texture shader");
  const Outcome text = ninebit({"trace", "--effect", kFolder + "depth_balls.json", "--pixel", "130,130", "--quiet"});
  expect_parts(text.out, {"(replaced)", "  texture stage 1: dot_product by stage 0, s, t, r, q = (", "dot product"});
  EXPECT_EQ(replaced["stages"][3]["coordinates"].size(), 4U);
  expect_parts(replaced["stages"][3]["text"].get<std::string>(), {"texture read at ("});
  // The dot product of the next stage is read, too.
  const Json diffuse = pixel_of("diffuse_specular.json", "60,128");
  EXPECT_EQ(diffuse["passes"][0]["fragments"][0]["stages"][2]["dot_products"], (Json{1, 2, 3}));
  // In a picture, each stage is a box with its values one below the other.
  const TempFolder folder;
  const std::string picture = folder / "stages.svg";
  const Outcome drawn =
      ninebit({"trace", "--effect", kFolder + "depth_balls.json", "--pixel", "130,130", "--quiet", "-o", picture});
  ASSERT_EQ(drawn.code, 0) << drawn.err;
  const std::string svg = read_bytes(picture);
  expect_parts(svg, {">texture stage 2: dot_product_depth_replace by stage 0</text>", ">  dot product 1 with ("});
  EXPECT_NE(svg.find(">  texel (197, 197, 197, 255)</text>"), std::string::npos) << "without the legend that follows";
}

}  // namespace
}  // namespace tools_test
