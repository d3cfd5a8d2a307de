// Six textured models, drawn on every SIMD target and with several threads, against the golden hashes.
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "combiner_tests/combiner/simd_targets.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/technique.h"
#include "src/image/texture/picture_loader.h"
#include "src/system/parallel/parallel_loop.h"
#include "src/tools/common/picture_hashes.h"

namespace ninebit::test {
namespace {

namespace fs = std::filesystem;

const fs::path kModels = "/usr/share/assimp/models";

// The scene with the pictures of its materials, as `ninebit render` draws it. Linked to this test program, OpenImageIO
// would take longer to start than most of its tests take.
Scene textured_scene(const fs::path& file, const HardwareProfile& profile) {
  auto scene = read_scene(file);
  EXPECT_TRUE(scene) << scene.error().text();
  const TextureReadOptions options{.mipmaps = true, .any_size = true};
  for (SceneTexture& texture : scene->textures) {
    EXPECT_EQ(texture.fault, "");
    using image_detail::kPictureModule;
    auto read = texture.file.empty()
                    ? image_detail::read_texture(
                          {reinterpret_cast<const std::uint8_t*>(texture.bytes.data()), texture.bytes.size()},
                          texture.name, options, kPictureModule)
                    : image_detail::read_texture(profile, texture.file, options, kPictureModule);
    EXPECT_TRUE(read) << read.error().text();
    texture.texture = std::make_shared<const Texture>(std::move(*read));
  }
  auto whole = complete_scene(std::move(*scene), {}, 4.0F / 3.0F);
  EXPECT_TRUE(whole) << whole.error().text();
  return std::move(*whole);
}

class TexturedModels : public testing::TestWithParam<const char*> {};

TEST_P(TexturedModels, AreTheSameOnEveryTarget) {
  const fs::path file = kModels / GetParam();
  ASSERT_TRUE(fs::exists(file)) << "install assimp-testmodels";
  std::ifstream golden(NINEBIT_SOURCE_DIR "/scenes/expected_hashes.json");
  const auto expected = nlohmann::json::parse(golden);
  const auto& hashes = expected.at(file.filename().string()).at("--size 320x240 --map-size 256");
  RenderSettings settings;
  settings.width = 320;
  settings.height = 240;
  settings.map_size = 256;
  const Scene scene = textured_scene(file, settings.profile);
  ASSERT_FALSE(scene.textures.empty());
  std::size_t threads = 1;  // on the first target, and three on the others
  for (const std::int64_t target : simd_targets()) {
    SCOPED_TRACE(simd_target_name(target) + ", " + std::to_string(threads) + " threads");
    const ScopedThreadLimit limit(threads);
    const OnTarget on_target(target);
    const auto rendering = find_technique("index-cube")->render(scene, settings, {});
    ASSERT_TRUE(rendering) << rendering.error().text();
    for (const auto& [planes, hash] : tools::picture_hashes(*rendering)) EXPECT_EQ(hash, hashes.at(planes)) << planes;
    threads = 3;
  }
}

INSTANTIATE_TEST_SUITE_P(Assimp, TexturedModels,
                         testing::Values("OBJ/spider.obj", "Collada/duck.dae",
                                         "glTF/CesiumMilkTruck/CesiumMilkTruck.gltf",
                                         "glTF2/ClearCoat-glTF/ClearCoatTest.gltf",
                                         "glTF2/BoxTextured-glTF-Binary/BoxTextured.glb",
                                         "FBX/embedded_ascii/box_embedded_texture_fragmented.fbx"));

}  // namespace
}  // namespace ninebit::test
