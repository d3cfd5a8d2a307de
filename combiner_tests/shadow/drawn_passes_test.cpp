// The techniques' own account of their drawing: passes, texture units, memory of maps.
#include "src/frame/drawn_passes.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <string>
#include <vector>

#include "combiner_tests/shadow/ground_truth_support.h"

namespace shadow_test {
namespace {

using namespace ninebit;

Rendering room_by(std::string_view name, RenderSettings settings) {
  const Technique& technique = *find_technique(name);
  settings.width = 80;
  settings.height = 60;
  settings.map_size = 32;
  settings.reflective.samples = 1;
  settings.light_cookie.cookie = test::noisy_cookie();
  return render_by(name, index_room(technique.lights), settings);
}

std::vector<std::string> drawn_names(const Rendering& rendering) {
  std::vector<std::string> out;
  for (const DrawnPass& pass : rendering.drawn) out.push_back(pass.name);
  return out;
}

std::vector<std::string> marking(const Rendering& rendering) {
  std::vector<std::string> out;
  for (const DrawnPass& pass : rendering.drawn) {
    if (pass.marks_shadows) {
      out.push_back(pass.name + ": " + (pass.texture_units ? std::to_string(*pass.texture_units) : "floats"));
    }
  }
  return out;
}

using Names = std::vector<std::string>;
const Names kSixFaces{"map +X", "map -X", "map +Y", "map -Y", "map +Z", "map -Z"};

Names after_maps(const Names& more) {
  Names all = kSixFaces;
  all.insert(all.end(), more.begin(), more.end());
  return all;
}

TEST(DrawnPasses, OfTheIndexCube) {
  RenderSettings settings;
  const Rendering together = room_by("index-cube", settings);
  EXPECT_EQ(drawn_names(together), after_maps({"depth", "comparison", "lit", "shadow"}));
  EXPECT_EQ(marking(together), (Names{"comparison: 1"}));
  EXPECT_EQ(together.map_bytes, 6U * 32 * 32 * 4);
  settings.layers = true;  // then the passes are drawn one by one
  EXPECT_EQ(drawn_names(room_by("index-cube", settings)), drawn_names(together));
  settings.light_facing = true;
  settings.index.format = IndexFormat::alpha;
  settings.index.scope = IndexScope::object;
  const Rendering alpha = room_by("index-cube", settings);
  EXPECT_EQ(drawn_names(alpha), after_maps({"depth", "comparison", "averted", "lit", "shadow"}));
  EXPECT_EQ(alpha.map_bytes, 6U * 32 * 32);
}

TEST(DrawnPasses, OfTheDepthCube) {
  RenderSettings settings;
  const Rendering eight = room_by("depth-cube", settings);
  EXPECT_EQ(eight.map_bytes, 6U * 32 * 32);
  EXPECT_EQ(eight.drawn.size(), 6 + 1 + marking(eight).size() + 2) << "depth, lit, shadow";
  EXPECT_EQ(marking(eight).size() % 6, 0U) << "each comparison once a face";
  settings.depth_cube.bits = DepthCubeBits::sixteen;
  const Rendering sixteen = room_by("depth-cube", settings);
  EXPECT_EQ(sixteen.map_bytes, 6U * 32 * 32 * 2);
  EXPECT_GT(marking(sixteen).size(), marking(eight).size());
  settings.depth_cube.bits = DepthCubeBits::real;
  const Rendering floats = room_by("depth-cube", settings);
  EXPECT_EQ(drawn_names(floats), after_maps({"depth", "comparison", "lit", "shadow"}));
  EXPECT_EQ(marking(floats), (Names{"comparison: floats"}));
  EXPECT_EQ(floats.map_bytes, 6U * 32 * 32 * 4);
}

TEST(DrawnPasses, OfMapsOfOneView) {
  RenderSettings settings;
  const Rendering map = room_by("shadow-map", settings);
  EXPECT_EQ(drawn_names(map), (Names{"map", "depth", "comparison", "lit", "shadow"}));
  EXPECT_EQ(marking(map), (Names{"comparison: 2"}));
  EXPECT_EQ(map.map_bytes, 32U * 32 * 4);
  const Rendering reflective = room_by("reflective", settings);
  EXPECT_EQ(drawn_names(reflective),
            (Names{"map", "depth", "comparison", "lit", "shadow", "reflective map", "surface", "gathering"}));
  EXPECT_EQ(reflective.map_bytes, map.map_bytes + 32U * 32 * (4 + 9 * 2));
  settings.shadow_map.encoding = DepthEncoding::d16;
  EXPECT_EQ(room_by("shadow-map", settings).map_bytes, 32U * 32 * 2);
  settings.shadow_map.encoding = DepthEncoding::rgba8_fract;
  const Rendering packed = room_by("shadow-map", settings);
  EXPECT_EQ(marking(packed), (Names{"coordinates: floats"}));
  EXPECT_EQ(packed.map_bytes, 32U * 32 * 4);
}

TEST(DrawnPasses, OfVolumesAndCookies) {
  RenderSettings settings;
  settings.shadow_volume.two_sided = true;
  const Rendering one = room_by("shadow-volume", settings);
  EXPECT_EQ(drawn_names(one), (Names{"depth", "volumes", "background", "lit", "shadow"}));
  EXPECT_EQ(one.map_bytes, 0U);
  settings.shadow_volume.two_sided = false;
  EXPECT_EQ(room_by("shadow-volume", settings).drawn.size(), one.drawn.size() + 1);
  settings.light_cookie.shadows = false;
  const Rendering plain = room_by("light-cookie", settings);
  EXPECT_EQ(drawn_names(plain), (Names{"depth", "lit", "shadow"}));
  EXPECT_TRUE(marking(plain).empty());
  settings.light_cookie.shadows = true;
  EXPECT_EQ(drawn_names(room_by("light-cookie", settings)), after_maps({"depth", "comparison", "lit", "shadow"}));
}

// Every pass of the camera that a pixel's probe finds was noted.
TEST(DrawnPasses, HaveAllThatAreProbed) {
  for (const Technique& technique : techniques()) {
    SCOPED_TRACE(technique.name);
    RenderSettings settings;
    settings.light_cookie.shadows = true;
    settings.light_facing = true;
    settings.pixels = {glm::ivec2(40, 30)};
    const Rendering rendering = room_by(technique.name, settings);
    const Names names = drawn_names(rendering);
    EXPECT_GE(rendering.probed[0].size(), 3U);
    for (const ProbedPass& pass : rendering.probed[0]) {
      EXPECT_EQ(std::count(names.begin(), names.end(), pass.name), 1) << pass.name;
    }
  }
}

// A file that calls the rasterizer notes its passes. The evidence of ground truth is not part of the picture.
TEST(DrawnPasses, AreNotedWhereTheRasterizerIsCalled) {
  int files = 0;
  for (const char* folder : {"/src/frame", "/src/shadow"}) {
    for (const auto& entry : std::filesystem::recursive_directory_iterator(std::string(NINEBIT_SOURCE_DIR) + folder)) {
      if (entry.path().extension() != ".cpp" || entry.path().filename() == "map_evidence.cpp") continue;
      std::ifstream in(entry.path());
      const std::string text(std::istreambuf_iterator<char>(in), {});
      if (text.find(" rasterize(") == std::string::npos) continue;
      ++files;
      EXPECT_NE(text.find("note_pass("), std::string::npos) << entry.path();
    }
  }
  EXPECT_GE(files, 6);
}

TEST(DrawnPasses, TheMemoryOfATexture) {
  std::vector<std::vector<TextureSamples>> faces(
      6, {TextureSamples{.width = 4, .height = 4, .samples = std::vector<std::uint8_t>(32, 1)}});
  const auto texture = make_texture(TextureTarget::cube_map, InternalFormat::luminance8_alpha8, faces);
  ASSERT_TRUE(texture);
  EXPECT_EQ(texture_bytes(*texture), 6U * 16 * 2);
  const auto levels = with_mipmaps(*texture);
  ASSERT_TRUE(levels);
  EXPECT_EQ(texture_bytes(*levels), 6U * (16 + 4 + 1) * 2);
}

}  // namespace
}  // namespace shadow_test
