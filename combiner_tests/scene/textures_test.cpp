// Base colour textures, alpha modes and notes of what the readers leave out.
#include <algorithm>

#include "combiner_tests/scene/gltf_text.h"
#include "combiner_tests/scene/scene_test_support.h"

namespace ninebit::scene_tests {
namespace {

// A triangle with one material, and more members of the root.
std::string textured_gltf(const std::string& material, const std::string& more) {
  return vertex_data_gltf(
      R"({"attributes": {"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 3}, "indices": 2, "material": 0})", "", "picture!",
      R"(, "materials": [)" + material + "]" + more);
}

const std::string kTextured = R"({"name": "m", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}})";

class Textures : public SceneFiles {
 protected:
  // The scene of that material and root; fails the test where there is none.
  [[nodiscard]] Scene scene_of(const std::string& material, const std::string& more = "") const {
    const Result<Scene> scene = read("t.gltf", textured_gltf(material, more));
    EXPECT_TRUE(scene) << (scene ? "" : scene.error().text());
    if (!scene) return {};
    expect_contract(*scene);
    return *scene;
  }
};

TEST_F(Textures, GltfNamesFilesDataAndBufferViews) {
  const Scene file = scene_of(kTextured, R"(, "textures": [{"source": 0}], "images": [{"uri": "a%20b.png"}])");
  ASSERT_EQ(file.textures.size(), 1U);
  EXPECT_EQ(file.materials[0].base_texture, 0U);
  EXPECT_EQ(file.textures[0].file, folder_ / "a b.png");
  EXPECT_EQ(file.textures[0].name, "a b.png");
  EXPECT_EQ(file.textures[0].fault, "");
  EXPECT_FALSE(file.textures[0].texture);
  EXPECT_FALSE(file.materials.back().base_texture) << "the default material";

  const Scene data =
      scene_of(kTextured, R"(, "textures": [{"source": 0}], "images": [{"uri": "data:image/png;base64,aGVsbG8="}])");
  EXPECT_EQ(data.textures.at(0).bytes, "hello");
  EXPECT_TRUE(data.textures.at(0).file.empty());
  const Scene view = scene_of(kTextured, R"(, "textures": [{"source": 0}], "images": [{"bufferView": 4}])");
  EXPECT_EQ(view.textures.at(0).bytes, "picture!");
  EXPECT_EQ(view.textures.at(0).name, "images[0]");
}

TEST_F(Textures, TexturesOfOnePictureShareIt) {
  const std::string second = R"(, {"pbrMetallicRoughness": {"baseColorTexture": {"index": 1}}})";
  const Scene scene = scene_of(kTextured + second, R"(, "textures": [{"source": 0}, {"source": 0, "sampler": 0}],
    "samplers": [{"magFilter": 9728, "minFilter": 9985, "wrapS": 33071, "wrapT": 33648}], "images": [{"uri": "a.png"}])");
  ASSERT_EQ(scene.textures.size(), 1U);
  const Sampler &plain = scene.materials[0].sampler, &own = scene.materials[1].sampler;
  EXPECT_EQ(plain.min_filter, MinFilter::linear_mipmap_linear);
  EXPECT_EQ(plain.mag_filter, MagFilter::linear);
  EXPECT_EQ(plain.wrap_s, Wrap::repeat);
  EXPECT_EQ(own.min_filter, MinFilter::linear_mipmap_nearest);
  EXPECT_EQ(own.mag_filter, MagFilter::nearest);
  EXPECT_EQ(own.wrap_s, Wrap::clamp_to_edge);
  EXPECT_EQ(own.wrap_t, Wrap::mirrored_repeat);
}

TEST_F(Textures, AlphaModes) {
  const Scene mask = scene_of(
      R"({"alphaMode": "MASK", "alphaCutoff": 0.25, "pbrMetallicRoughness": {"baseColorFactor": [1, 1, 1, 0.5]}})");
  EXPECT_EQ(mask.materials[0].alpha_mode, AlphaMode::mask);
  EXPECT_EQ(mask.materials[0].alpha_cutoff, 0.25F);
  EXPECT_EQ(mask.materials[0].alpha, 0.5F);
  EXPECT_TRUE(mask.notes.empty());
  const Scene blend = scene_of(R"({"alphaMode": "BLEND"})");
  EXPECT_EQ(blend.materials[0].alpha_mode, AlphaMode::blend);
  EXPECT_EQ(blend.notes, std::vector<std::string>{"alpha blending"});
  EXPECT_EQ(scene_of("{}").materials[0].alpha_mode, AlphaMode::opaque);
}

// The scene is still read: only who draws the texture needs it.
TEST_F(Textures, FaultsAreKeptForWhoeverDraws) {
  const auto fault = [&](const std::string& more) { return scene_of(kTextured, more).textures.at(0).fault; };
  EXPECT_NE(fault(R"(, "textures": [{"source": 0}], "images": [{"uri": "../a.png"}])").find("--allow-outside"),
            std::string::npos);
  EXPECT_EQ(fault(R"(, "textures": [{"source": 0}], "images": [{"uri": "data:image/png,abc"}])"),
            "is not in base64, or is empty");
  EXPECT_EQ(fault(R"(, "textures": [{"source": 0}], "images": [{"bufferView": 77}])"),
            "has neither a URI nor a buffer view");
  EXPECT_EQ(fault(R"(, "textures": [{"source": 3}], "images": [])"), "names a picture that does not exist");
  EXPECT_EQ(fault(""), "names a picture that does not exist");
  const Result<Scene> outside = read_scene(write("o.gltf", textured_gltf(kTextured, R"(, "textures": [{"source": 0}],
                                                            "images": [{"uri": "../a.png"}])")),
                                           {.allow_outside = true});
  ASSERT_TRUE(outside);
  EXPECT_EQ(outside->textures.at(0).fault, "");
}

TEST_F(Textures, GltfNotesWhatItLeavesOut) {
  const Scene scene = scene_of(
      R"({"normalTexture": {"index": 0}, "occlusionTexture": {"index": 0}, "emissiveFactor": [0, 0.5, 0],
          "pbrMetallicRoughness": {"metallicFactor": 1, "baseColorTexture": {"index": 0, "texCoord": 1,
            "extensions": {"KHR_texture_transform": {}}}}})",
      R"(, "animations": [{}], "extensionsUsed": ["KHR_lights_punctual", "KHR_texture_transform", "X_a", "X_b"])");
  EXPECT_EQ(scene.notes,
            (std::vector<std::string>{"normal maps", "metalness and roughness", "occlusion maps", "emitted light",
                                      "base colour textures with other coordinates than TEXCOORD_0",
                                      "KHR_texture_transform", "animations", "extensions X_a, X_b"}));
  EXPECT_FALSE(scene.materials[0].base_texture);
  EXPECT_TRUE(scene_of(R"({"pbrMetallicRoughness": {"metallicFactor": 0, "roughnessFactor": 0.9}})").notes.empty());
}

TEST_F(Textures, ObjSkipsTheOptionsOfMapKd) {
  write("s.mtl",
        "newmtl a\nmap_Kd sub\\a b.png\n"
        "newmtl b\nmap_Kd -blendu on -mm 0 1 -o 0.5 1 -s 1 1 1 -clamp on -bm 2 b.png\n"
        "newmtl c\nmap_Kd b.png\nd 0.5\nmap_Bump n.png\nmap_Ks s.png\n"
        "newmtl d\nmap_Kd -clamp\n");
  const Result<Scene> scene = read("s.obj",
                                   "mtllib s.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\n"
                                   "usemtl a\nf 1/1 2/2 3/3\nusemtl b\nf 1/1 2/2 3/3\nusemtl c\nf 1/1 2/2 3/3\n"
                                   "usemtl d\nf 1/1 2/2 3/3\n");
  ASSERT_TRUE(scene) << scene.error().text();
  expect_contract(*scene);
  const auto material = [&](const char* name) {
    const auto found =
        std::find_if(scene->materials.begin(), scene->materials.end(), [&](const auto& m) { return m.name == name; });
    return found == scene->materials.end() ? Material{} : *found;
  };
  ASSERT_EQ(scene->textures.size(), 2U);
  EXPECT_EQ(scene->textures[0].file, folder_ / "sub/a b.png");
  EXPECT_EQ(scene->textures[1].name, "b.png");
  EXPECT_EQ(material("a").sampler.wrap_s, Wrap::repeat);
  EXPECT_EQ(material("a").sampler.min_filter, MinFilter::linear_mipmap_linear);
  EXPECT_EQ(material("b").base_texture, 1U);
  EXPECT_EQ(material("b").sampler.wrap_t, Wrap::clamp_to_edge);
  EXPECT_EQ(material("c").base_texture, 1U) << "one picture, read once";
  EXPECT_EQ(material("c").sampler.wrap_t, Wrap::repeat);
  EXPECT_EQ(material("c").alpha, 0.5F);
  EXPECT_EQ(material("c").alpha_mode, AlphaMode::blend);
  EXPECT_FALSE(material("d").base_texture);
  EXPECT_EQ(scene->notes, (std::vector<std::string>{"normal maps", "textures other than map_Kd",
                                                    "offset, scale and turbulence of textures", "alpha blending"}));
}

TEST_F(Textures, ValidateChecksThem) {
  Scene scene = box({0, 0, 0}, {1, 1, 1});
  scene.materials[0].base_texture = 0;
  EXPECT_FALSE(validate(scene));
  scene.textures.emplace_back();
  EXPECT_TRUE(validate(scene));
  scene.materials[0].alpha = std::nanf("");
  EXPECT_FALSE(validate(scene));
}

}  // namespace
}  // namespace ninebit::scene_tests
