// Renderings to the bit: the hashes in scenes/expected_hashes.json, by scene and flags.
//
// After a change that is meant to change pixels: look at the pictures, then run this test with NINEBIT_UPDATE_HASHES=1.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <sstream>

#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/support.h"

namespace tools_test {
namespace {

const std::string kExpected = NINEBIT_SOURCE_DIR "/scenes/expected_hashes.json";

struct Golden {
  std::string scene;
  Words flags;
};

// Each technique once, for each of three scenes; reflective with fewer samples, as it draws the slowest.
const Words kEveryTechnique{
    "--size 320x240 --map-size 256",
    "--size 320x240 --map-size 256 --technique depth-cube --depth-bits 16",
    "--size 320x240 --map-size 256 --technique shadow-map",
    "--size 320x240 --technique shadow-volume",
    "--size 160x120 --map-size 128 --technique reflective --light-type directional --samples 40",
    "--size 320x240 --map-size 256 --technique light-cookie --cookie scenes/cookies/labels.dds"};

const std::string kAssimpModels = "/usr/share/assimp/models/";
const std::string kSmall = "--size 320x240 --map-size 256";

std::vector<Golden> goldens() {
  return {
      {kRoom, kEveryTechnique},
      {kBunny, kEveryTechnique},
      {kEngine, kEveryTechnique},
      {kRoom, {""}},
      {kRoom, {"--size 320x240 --map-size 256", "--size 320x240 --map-size 256 --light-facing"}},
      {kRoom, {"--size 320x240 --map-size 256 --index-scope object", "--size 320x240 --map-size 256 --index-step 1"}},
      {kRoom, {"--size 320x240 --map-size 256 --cull back", "--size 320x240 --map-size 256 --profile nv2a"}},
      {kRoom, {"--size 199x301 --map-size 32 --camera -3,4,2.5 --look-at 0,1,0 --fov 70 --light 1,3,-1"}},
      {kRoom, {"--technique shadow-map --size 320x240 --map-size 256 --light-target 1,0,1 --spot-angle 100"}},
      {kRoom, {"--technique shadow-map --size 320x240 --map-size 256 --light-type directional --depth-encoding d16"}},
      {kRoom, {"--technique shadow-map --size 320x240 --map-size 256 --depth-encoding rgba8-fract"}},
      {kBunny, {"--technique shadow-map --size 320x240 --map-size 256 --depth-stencil d15s1"}},
      {kRoom,
       {"--size 320x240 --map-size 256 --technique depth-cube",
        "--size 320x240 --map-size 256 --technique depth-cube --depth-bits float",
        "--size 320x240 --map-size 256 --technique depth-cube --depth-bits 16 --bias 0 --profile nv2a"}},
      {kRoom,
       {"--size 320x240 --map-size 256 --technique light-cookie --cookie scenes/cookies/labels_dxt1.dds",
        "--size 320x240 --technique light-cookie --cookie scenes/cookies/labels.dds --cookie-shadows none "
        "--light-rotate 20,30,40"}},
      {kRoom, {"--size 320x240 --map-size 256 --index-format la", "--size 320x240 --map-size 256 --style cartoon"}},
      {kRoom, {"--size 320x240 --map-size 256 --index-format l --index-scope object --index-step 3"}},
      {kRoom, {"--size 320x240 --map-size 256 --index-format a --index-scope object"}},
      {kRoom, {"--technique reflective --size 160x120 --map-size 256 --samples 100 --light-type directional"}},
      {kCornell,
       {"--technique reflective --size 160x120 --map-size 256 --kernel 71.68",
        "--technique reflective --size 160x120 --map-size 256 --kernel 71.68 --pattern polar --gather-scale 4"}},
      {kRoom, {"--size 640x480 --technique shadow-volume"}},
      {kRoom, {"--size 320x240 --technique shadow-volume --volume-method depth-pass --stencil-sides one"}},
      {kBunny, {"", "--size 320x240 --map-size 256 --floor none --light-facing"}},
      {kEngine, {""}},
      // Textures in the scene's folder, in the file, and of sides that are not powers of two.
      {kAssimpModels + "OBJ/spider.obj", {kSmall}},
      {kAssimpModels + "Collada/duck.dae", {kSmall}},
      {kAssimpModels + "glTF/CesiumMilkTruck/CesiumMilkTruck.gltf", {kSmall}},
      {kAssimpModels + "glTF2/ClearCoat-glTF/ClearCoatTest.gltf", {kSmall}},
      {kAssimpModels + "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb", {kSmall}},
      {kAssimpModels + "FBX/embedded_ascii/box_embedded_texture_fragmented.fbx", {kSmall}},
  };
}

// A build with sanitizers draws three pictures of seven.
const bool kSome = ninebit::test::kSanitized && std::getenv("NINEBIT_UPDATE_HASHES") == nullptr;

Json rendered() {
  const TempFolder folder;
  // With the address sanitizer, the program does not look for leaks here: the leak sanitizer's own thread crashes now
  // and then at the end of a program that has read pictures. Other tests look for them.
  ::setenv("ASAN_OPTIONS", "detect_leaks=0", 1);
  Json found = Json::object();
  int number = 0;
  for (const Golden& golden : goldens()) {
    for (const std::string& flags : golden.flags) {
      Words arguments{"render", golden.scene, "-o", folder / "out", "--json", "--quiet"};
      std::istringstream words(flags);
      for (std::string word; words >> word;) {
        arguments.push_back((word.starts_with("scenes/") ? NINEBIT_SOURCE_DIR "/" : "") + word);
      }
      if (kSome && number++ % 7 > 2) continue;
      const Json answer = json_of(ninebit(arguments));
      if (answer.is_null()) return {};
      const std::string name = std::filesystem::path(golden.scene).filename().string();
      found[name][flags.empty() ? "(default)" : flags] = answer.at("hash");
    }
  }
  return found;
}

TEST(GoldenHashes, RenderingsAreTheSameToTheBit) {
  const Json found = rendered();
  ASSERT_TRUE(found.is_object());
  if (const char* update = std::getenv("NINEBIT_UPDATE_HASHES"); update != nullptr && std::string(update) == "1") {
    write_bytes(kExpected, found.dump(2) + "\n");
    FAIL() << kExpected << " has been rewritten and nothing was compared; run again without NINEBIT_UPDATE_HASHES";
  }
  ASSERT_TRUE(std::filesystem::exists(kExpected)) << "NINEBIT_UPDATE_HASHES=1 makes " << kExpected;
  const Json expected = Json::parse(read_bytes(kExpected), nullptr, false);
  ASSERT_TRUE(expected.is_object()) << kExpected << " is not a JSON object";
  if (!kSome) {
    EXPECT_EQ(keys_of(expected), keys_of(found));
  }
  for (const auto& [scene, renderings] : found.items()) {
    ASSERT_TRUE(expected.contains(scene)) << scene;
    if (!kSome) {
      EXPECT_EQ(keys_of(expected[scene]), keys_of(renderings)) << scene;
    }
    for (const auto& [flags, hashes] : renderings.items()) {
      if (!expected[scene].contains(flags)) continue;  // the keys' comparison has told
      EXPECT_EQ(hashes, expected[scene][flags]) << scene << ' ' << flags;
    }
  }
}

}  // namespace
}  // namespace tools_test
