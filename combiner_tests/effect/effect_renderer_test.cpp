// Drawing effects: the rectangle against evaluation, vectors against their definitions, warnings and faults.
#include "ninebit/effect/effect_renderer.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>
#include <set>
#include <string>

#include "combiner_tests/effect/program_reader.h"
#include "combiner_tests/oracle/combiner_oracle.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/program.h"
#include "ninebit/effect/generated_meshes.h"
#include "ninebit/effect/generated_textures.h"
#include "ninebit/language/rc10.h"
#include "ninebit/numerics/fixed9.h"
#include "src/effect/tangents.h"

namespace ninebit::test {
namespace {

constexpr int kSize = 32;

// Readers that know programs by their text and textures by a number.
EffectReaders readers_of(const std::string& program, const Texture& texture) {
  EffectReaders readers = reader_of(program);
  readers.texture = [texture](std::span<const std::filesystem::path>, const HardwareProfile&) -> Result<Texture> {
    return texture;
  };
  readers.scene = [](const std::filesystem::path&, std::optional<UpAxis>) -> Result<Scene> {
    return Diagnostic{.message = "no scene"};
  };
  return readers;
}

Texture random_texture(std::vector<std::uint8_t>& bytes) {
  std::mt19937 random(20001224);
  bytes.resize(4 * kSize * kSize);
  for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random() & 255U);
  TextureSamples samples{.width = kSize, .height = kSize};
  samples.samples = bytes;
  return make_texture(TextureTarget::texture_2d, InternalFormat::rgba8, {{samples}}).value();
}

const std::string kProgram =
    "!!RC1.0\n{ rgb { discard = expand(tex0) * const0; discard = -tex0.a * col0; spare0 = sum(); scale_by_two(); }\n"
    "  alpha { spare1 = tex0.b * half_bias(tex0.a); } }\n{ rgb { spare0 = spare0 . tex0; } }\n"
    "out.rgb = lerp(tex0.a, spare0, const1); out.a = unsigned_invert(spare1);\n";

Effect rectangle_effect() {
  Effect effect;
  effect.width = effect.height = kSize;
  EffectTexture texture;
  texture.name = "t";
  texture.files = {"t.png"};
  texture.sampler = kNearestSampler;
  effect.textures.push_back(texture);
  EffectPass pass{.name = "draw", .geometry = EffectGeometry::rectangle};
  pass.program = "p";
  pass.units[0].texture = "t";
  pass.constants.global[0] = ColorF{0.25F, 0.5F, 0.75F, 1.0F};
  pass.constants.global[1] = ColorF{1.0F, 0.5F, 0.0F, 1.0F};
  pass.primary.constant = {0.2F, 0.4F, 0.6F, 1.0F};
  effect.passes.push_back(pass);
  return effect;
}

TEST(EffectRenderer, WhatTheMeshDoesNotHaveIsAFault) {
  Effect colored = rectangle_effect();
  colored.passes[0].secondary.source = VertexSource::secondary_color;
  Effect fogged = rectangle_effect();
  fogged.passes[0].fog.mode = FogMode::mesh;
  std::vector<std::uint8_t> bytes;
  const EffectReaders readers = readers_of(kProgram, random_texture(bytes));
  for (const auto& [effect, missing] : {std::pair{&colored, "secondary colours"}, std::pair{&fogged, "fog factors"}}) {
    const auto made = EffectRenderer::make(*effect, profiles::nv2a, readers);
    ASSERT_FALSE(made) << missing;
    EXPECT_NE(made.error().text().find(missing), std::string::npos) << made.error().text();
  }
}

// With the nearest texel of a texture of the picture's size, each pixel is what evaluation gives for its texel.
TEST(EffectRenderer, TheRectangleIsEvaluation) {
  std::vector<std::uint8_t> bytes;
  const Texture texture = random_texture(bytes);
  const Effect effect = rectangle_effect();
  for (const HardwareProfile& profile : hardware_profiles()) {
    const EffectReaders readers = readers_of(kProgram, texture);
    auto renderer = EffectRenderer::make(effect, profile, readers);
    ASSERT_TRUE(renderer) << renderer.error().text();
    ASSERT_TRUE(renderer->draw());
    EXPECT_TRUE(renderer->warnings().empty());
    CombinerState state = readers.program({}, profile).value().state;
    state.constant0 = *effect.passes[0].constants.global[0];
    state.constant1 = *effect.passes[0].constants.global[1];
    const Program program = compile(state, profile).value();
    for (std::size_t y = 0; y < kSize; ++y) {
      for (std::size_t x = 0; x < kSize; ++x) {
        FragmentInputs inputs;
        for (std::size_t c = 0; c < 4; ++c) {
          inputs.primary[c] = byte_of_vertex_color(profile, effect.passes[0].primary.constant[static_cast<int>(c)]);
        }
        inputs.secondary = {0, 0, 0, 255};
        Texel texel;
        for (std::size_t c = 0; c < 4; ++c) texel.value[c] = bytes[(c * kSize + y) * kSize + x];
        inputs.texture[0] = texel;
        const Rgba9 out = evaluate(program, initial_registers(profile, inputs));
        for (int c = 0; c < 4; ++c) {
          // Row 0 of the file is the top of the picture.
          const std::size_t at = (kSize - 1 - y) * kSize + x;
          ASSERT_EQ(int{renderer->picture().color(c)[at]}, int{to_byte(profile, out[static_cast<std::size_t>(c)])})
              << profile.name << " at " << x << ", " << y << " component " << c;
        }
      }
    }
  }
}

// A target of 16 bits reads as its bits repeated, and the picture may have a format of its own.
TEST(EffectRenderer, TargetsHaveColorFormats) {
  Effect effect;
  effect.width = effect.height = 8;
  effect.color_format = ColorFormat::b8;
  effect.targets.push_back({.name = "m", .width = 8, .height = 8, .color_format = ColorFormat::r5g6b5});
  EffectTexture texture;
  texture.name = "t";
  texture.origin = TextureOrigin::target_color;
  texture.target = "m";
  texture.sampler = kNearestSampler;
  effect.textures.push_back(texture);
  EffectPass first{.name = "first", .geometry = EffectGeometry::rectangle, .target = "m"};
  first.primary.constant = {200 / 255.0F, 100 / 255.0F, 50 / 255.0F, 7 / 255.0F};
  EffectPass second{.name = "second", .geometry = EffectGeometry::rectangle, .program = "p"};
  second.units[0].texture = "t";
  effect.passes = {first, second};
  for (const bool to_bytes : {false, true}) {
    if (to_bytes) effect.color_format = ColorFormat::a8r8g8b8;
    auto renderer =
        EffectRenderer::make(effect, profiles::geforce2,
                             readers_of("!!RC1.0\n{ rgb { spare0 = tex0; } }\nout.rgb = tex0; out.a = tex0.a;\n", {}));
    ASSERT_TRUE(renderer) << renderer.error().text();
    ASSERT_TRUE(renderer->draw());
    const std::array<std::uint8_t, 4> read{206, 101, 49, 255};
    for (std::size_t k = 0; k < 4; ++k) {
      EXPECT_EQ(renderer->target("m")[0].color(static_cast<int>(k))[9], read[k]) << k;
      const bool is_kept = to_bytes || k >= 2;
      EXPECT_EQ(renderer->picture().color(static_cast<int>(k))[9], is_kept ? read[k] : 0) << k;
    }
  }
}

TEST(EffectRenderer, WarnsOfUnitsWithoutTexture) {
  Effect effect = rectangle_effect();
  effect.passes[0].units[0].texture.clear();
  const auto renderer = EffectRenderer::make(effect, profiles::geforce2, readers_of(kProgram, Texture{}));
  ASSERT_TRUE(renderer) << renderer.error().text();
  ASSERT_EQ(renderer->warnings().size(), 1U);
  EXPECT_NE(renderer->warnings()[0].find("texture unit 0"), std::string::npos);
}

TEST(EffectRenderer, ReportsWhatCannotBeDrawn) {
  const auto fault_of = [](const Effect& effect) {
    const auto renderer = EffectRenderer::make(effect, profiles::geforce2, readers_of(kProgram, Texture{}));
    return renderer ? std::string("no fault") : renderer.error().text();
  };
  Effect effect = rectangle_effect();
  effect.textures.clear();
  EXPECT_NE(fault_of(effect).find("unknown texture 't'"), std::string::npos);
  effect = {};
  effect.scene.mesh = "sphere:8";
  effect.scene.setup.floor = FloorChoice::none;
  effect.passes.push_back({.name = "light", .view = EffectView::light});
  EXPECT_NE(fault_of(effect).find("expected a spot or directional light"), std::string::npos);
  effect.scene.mesh = "file.obj";
  EXPECT_NE(fault_of(effect).find("no scene"), std::string::npos);
  effect.scene.mesh = "sphere:0";
  EXPECT_NE(fault_of(effect).find("not a generated mesh"), std::string::npos);
}

// A bump-mapped rectangle under a directional light, whose direction makes whole bytes of the light vector: each pixel
// is what the oracle of the combiners computes from its texel.
TEST(EffectRenderer, ABumpMapIsWhatTheOracleComputes) {
  const std::string program =
      "!!RC1.0\nconst0 = (0.1, 0.06, 0.05, 1.0);\nconst1 = (1.0, 0.8, 0.6, 1.0);\n"
      "{ rgb { spare0 = expand(tex0) . expand(col0); } }\nout.rgb = spare0 * const1 + const0;\n";
  const Texture normals = normal_map(checkerboard(kSize).value(), 3.0).value();
  Effect effect = rectangle_effect();
  effect.passes[0].constants = {};
  effect.scene.setup.light_kinds = {.point = false, .directional = true};
  effect.scene.setup.light = glm::vec3(-2.0F, 3.0F, 6.0F);  // the rectangle's tangent space is the world's
  effect.passes[0].primary = {.source = VertexSource::tangent_light_vector};
  auto renderer = EffectRenderer::make(effect, profiles::geforce2, readers_of(program, normals));
  ASSERT_TRUE(renderer) << renderer.error().text();
  ASSERT_TRUE(renderer->draw());
  const CombinerState state = *parse_rc10({program, "test"}, profiles::geforce2);
  const auto& planes = std::get<0>(normals.faces[0][0].planes);
  oracle::Registers registers{};
  // 255 (x / 7 + 1) / 2, to nearest.
  registers[static_cast<std::size_t>(Register::primary)] = {91, 182, 237, 255};
  std::set<std::uint8_t> reds;
  for (int y = 0; y < kSize; ++y) {
    for (int x = 0; x < kSize; ++x) {
      oracle::Codes& texel = registers[static_cast<std::size_t>(Register::texture0)];
      for (std::size_t c = 0; c < 3; ++c) texel[c] = planes[c].at(x, y);
      const oracle::Codes expected = oracle::run(state, profiles::geforce2, registers).color;
      const auto at = static_cast<std::size_t>((kSize - 1 - y) * kSize + x);
      for (int c = 0; c < 3; ++c) {
        ASSERT_EQ(int{renderer->picture().color(c)[at]}, expected[static_cast<std::size_t>(c)]) << x << ", " << y;
      }
      reds.insert(renderer->picture().color(0)[at]);
    }
  }
  EXPECT_GT(reds.size(), 3U);
}

TEST(GeneratedMeshes, AreValidAndFaceOutward) {
  for (const char* name : {"sphere:24", "torus:24", "cube", "plane:3"}) {
    const auto mesh = generated_mesh(name);
    ASSERT_TRUE(mesh) << name;
    EXPECT_TRUE(validate(*mesh)) << name;
    EXPECT_EQ(mesh->texture_coordinates.size(), mesh->positions.size());
    for (const glm::uvec3& t : mesh->triangles) {
      const glm::vec3 across =
          glm::cross(mesh->positions[t.y] - mesh->positions[t.x], mesh->positions[t.z] - mesh->positions[t.x]);
      if (glm::length(across) < 1e-6F) continue;  // at a pole
      EXPECT_GT(glm::dot(across, mesh->normals[t.x] + mesh->normals[t.y] + mesh->normals[t.z]), 0.0F) << name;
    }
    for (const glm::vec3& normal : mesh->normals) EXPECT_NEAR(glm::length(normal), 1.0F, 1e-5F);
  }
  for (const char* name : {"sphere", "sphere:", "sphere:0", "sphere:x", "torus:5000", "cone:8", ""}) {
    EXPECT_FALSE(generated_mesh(name).ok()) << name;
  }
}

TEST(Tangents, PointWhereSGrows) {
  for (const char* name : {"sphere:24", "torus:24", "cube", "plane:3"}) {
    const Scene mesh = generated_mesh(name).value();
    const std::vector<glm::vec4> tangents = tangents_of(mesh);
    ASSERT_EQ(tangents.size(), mesh.positions.size());
    for (std::size_t v = 0; v < tangents.size(); ++v) {
      EXPECT_NEAR(glm::length(glm::vec3(tangents[v])), 1.0F, 1e-4F);
      EXPECT_NEAR(glm::dot(glm::vec3(tangents[v]), mesh.normals[v]), 0.0F, 1e-4F);
      if (std::fabs(mesh.normals[v].y) > 0.999F && mesh.name == "sphere:24") continue;  // s has no direction at a pole
      EXPECT_EQ(tangents[v].w, 1.0F) << name << ": s to the right and t downwards, seen from the front";
    }
  }
  const std::vector<glm::vec4> plane = tangents_of(generated_mesh("plane:1").value());
  EXPECT_EQ(plane[0], glm::vec4(1.0F, 0.0F, 0.0F, 1.0F));
}

// A file's stages are those of the pass, unless the pass has its own; inconsistent ones are warned about.
TEST(EffectRenderer, StagesOfTheProgramAndOfThePass) {
  std::vector<std::uint8_t> bytes;
  const Texture texture = random_texture(bytes);
  EffectReaders readers = readers_of("!!RC1.0\nout.rgb = tex1;\nout.a = unsigned_invert(zero);\n", texture);
  readers.program = [inner = readers.program](const std::filesystem::path& file, const HardwareProfile& profile) {
    auto program = inner(file, profile);
    program->texture_shader.enabled = true;
    program->texture_shader.stage[1].operation = TextureOperation::pass_through;
    return program;
  };
  Effect effect = rectangle_effect();
  effect.passes[0].constants = {};
  effect.passes[0].units[1].coordinates = {.source = VertexSource::constant, .constant = {0.25F, 0.5F, 1.0F, 1.0F}};
  auto renderer = EffectRenderer::make(effect, profiles::nv2a, readers);
  ASSERT_TRUE(renderer) << renderer.error().text();
  EXPECT_TRUE(renderer->warnings().empty());
  ASSERT_TRUE(renderer->draw());
  EXPECT_NEAR(renderer->picture().color(0)[100], 63, 1);
  EXPECT_NEAR(renderer->picture().color(1)[100], 127, 1);

  TextureShaderState& own = effect.passes[0].state.texture_shader;
  own.enabled = true;
  own.stage[1].operation = TextureOperation::texture_2d;
  auto other = EffectRenderer::make(effect, profiles::nv2a, readers);
  ASSERT_TRUE(other) << other.error().text();
  ASSERT_EQ(other->warnings().size(), 1U);
  EXPECT_EQ(other->warnings()[0].rfind("pass 'draw': texture stage 1: ", 0), 0U) << other->warnings()[0];
  ASSERT_TRUE(other->draw());
  EXPECT_EQ(other->picture().color(1)[100], 0);
  EXPECT_FALSE(EffectRenderer::make(effect, profiles::geforce2, readers));
}

}  // namespace
}  // namespace ninebit::test
