// Colour keys and cylinder wrap of the NV2A's textures.
#include <gtest/gtest.h>

#include "combiner_tests/raster/support.h"
#include "ninebit/raster/sampler.h"

namespace ninebit::test {
namespace {

Texture bytes_texture(InternalFormat format, int width, int height, std::vector<std::uint8_t> planes) {
  return make_texture(TextureTarget::texture_2d, format, {{{width, height, std::move(planes)}}}).value();
}

// The texel under each pixel of a row of `width`, with the colour that was there before.
struct KeyRow {
  std::array<PlaneSamples<std::uint8_t>, 4> color;
  PlaneSamples<std::uint32_t> depth;
};
KeyRow draw_row(const Texture& texture, const Sampler& sampler, int width, const PipelineState& base,
                float s_left = 0.0F, float s_right = 1.0F) {
  Surface surface = Surface::make(width, 1).value();
  surface.fill({.color = {9, 9, 9, 9}});
  RenderTarget target = surface.target();
  const std::array<glm::vec3, 4> coordinates{glm::vec3(s_left, 0.5, 0), glm::vec3(s_right, 0.5, 0),
                                             glm::vec3(s_right, 0.5, 0), glm::vec3(s_left, 0.5, 0)};
  PipelineState state = base;
  state.depth_test = {true, CompareFunction::always, true};
  VertexArrays arrays{.type = PrimitiveType::quads, .positions = kWholeQuad};
  arrays.texture_coordinates[0] = coordinates;
  const std::array<TextureUnit, 1> units{TextureUnit{&texture, sampler}};
  const Status status = rasterize(state, kIdentity, arrays, units, target);
  EXPECT_TRUE(status.ok()) << status.error().message;
  return {{surface.color(0), surface.color(1), surface.color(2), surface.color(3)}, surface.depth()};
}

PipelineState textured() {
  PipelineState state;
  state.program = pass_through(Register::texture0, Register::texture0);
  return state;
}

// Texels 0x40102030, 0x41102030, 0x40102031, 0x40102030.
Texture key_texture(InternalFormat format) {
  std::vector<std::uint8_t> planes{0x10, 0x10, 0x10, 0x10, 0x20, 0x20, 0x20, 0x20, 0x30, 0x30, 0x31, 0x30};
  if (format == InternalFormat::rgba8) planes.insert(planes.end(), {0x40, 0x41, 0x40, 0x40});
  return bytes_texture(format, 4, 1, planes);
}

TEST(ColorKeys, CompareAllBitsAndDoAsTheyAreTold) {
  Sampler sampler = kNearestSampler;
  const Texture texture = key_texture(InternalFormat::rgba8);
  sampler.color_key = {ColorKeyOperation::alpha, 0x40102030};
  KeyRow row = draw_row(texture, sampler, 4, textured());
  EXPECT_EQ(row.color[3], (PlaneSamples<std::uint8_t>{0, 0x41, 0x40, 0}));
  EXPECT_EQ(row.color[0], (PlaneSamples<std::uint8_t>{0x10, 0x10, 0x10, 0x10}));
  sampler.color_key.operation = ColorKeyOperation::rgba;
  row = draw_row(texture, sampler, 4, textured());
  EXPECT_EQ(row.color[3], (PlaneSamples<std::uint8_t>{0, 0x41, 0x40, 0}));
  EXPECT_EQ(row.color[0], (PlaneSamples<std::uint8_t>{0, 0x10, 0x10, 0}));
  sampler.color_key.operation = ColorKeyOperation::kill;
  row = draw_row(texture, sampler, 4, textured());
  EXPECT_EQ(row.color[0], (PlaneSamples<std::uint8_t>{9, 0x10, 0x10, 9}));
  EXPECT_EQ(row.depth[0], 0xFFFFFFU);
  EXPECT_NE(row.depth[1], 0xFFFFFFU);
  // The alpha of a texel without one is not compared.
  sampler.color_key = {ColorKeyOperation::kill, 0x99102030};
  row = draw_row(key_texture(InternalFormat::rgb8), sampler, 4, textured());
  EXPECT_EQ(row.color[0], (PlaneSamples<std::uint8_t>{9, 9, 0x10, 9}));
}

// color() and texel() are the same texel, with alpha and without it.
TEST(ColorKeys, ColorsAreThoseOfTexels) {
  for (const InternalFormat format : {InternalFormat::rgba8, InternalFormat::rgb8}) {
    const Texture texture = key_texture(format);
    for (const ColorKeyOperation operation : {ColorKeyOperation::alpha, ColorKeyOperation::rgba}) {
      Sampler sampler = kNearestSampler;
      sampler.color_key = {operation, 0x40102030};
      const auto made = TextureSampler::make(profiles::nv2a, texture, sampler);
      ASSERT_TRUE(made.has_value());
      for (int x = 0; x < 4; ++x) {
        const float s = (static_cast<float>(x) + 0.5F) / 4, t = 0.5F, r = 0;
        const float none = 0;
        const TextureCoordinates at{
            .value = {&s, &t, &r}, .dx = {&none, &none, &none}, .dy = {&none, &none, &none}, .one_change = true};
        const Bytes4 value = made->texel(at, 0).value;
        const std::array<float, 4> color = made->color(at, 0);
        for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(color[k], value[k] / 255.0F) << x << ' ' << k;
        const int alpha = format == InternalFormat::rgba8 ? (x == 1 ? 0x41 : 0x40) : 255;
        const bool is_keyed = x == 0 || x == 3 || (x == 1 && format == InternalFormat::rgb8);
        EXPECT_EQ(value[3], is_keyed ? 0 : alpha) << x;
      }
    }
  }
}

// A program that does not read the texel, and no program at all.
TEST(ColorKeys, KillWhetherOrNotTheTexelIsRead) {
  Sampler sampler = kNearestSampler;
  sampler.color_key = {ColorKeyOperation::kill, 0x40102030};
  PipelineState state;
  for (const bool has_program : {false, true}) {
    if (has_program) state.program = pass_through(Register::primary, Register::primary);
    const KeyRow row = draw_row(key_texture(InternalFormat::rgba8), sampler, 4, state);
    EXPECT_EQ(row.color[0], (PlaneSamples<std::uint8_t>{9, 255, 255, 9})) << has_program;
  }
}

TEST(ColorKeys, OfOtherFormatsAndFiltersAreRefused) {
  Sampler sampler = kNearestSampler;
  sampler.color_key.operation = ColorKeyOperation::alpha;
  const Texture grey = bytes_texture(InternalFormat::luminance8, 1, 1, {7});
  EXPECT_EQ(check_sampler(grey, sampler).error().message, "a colour key needs texels of rgba8 or rgb8");
  sampler.mag_filter = MagFilter::linear;
  const Texture texture = key_texture(InternalFormat::rgba8);
  EXPECT_NE(check_sampler(texture, sampler).error().message.find("needs the nearest texel"), std::string::npos);
  Sampler bordered = kNearestSampler;
  bordered.border_texels = true;
  EXPECT_NE(check_sampler(texture, bordered).error().message.find("16 texels a side"), std::string::npos);
  PipelineState state;
  state.profile = profiles::nv2a;
  state.texture_shader.enabled = true;
  Surface surface = Surface::make(1, 1).value();
  RenderTarget target = surface.target();
  Sampler around = kNearestSampler;
  around.cylinder_wrap = {true, false};
  const auto message = [&](const Sampler& one, TextureOperation operation) {
    state.texture_shader.stage = {};
    state.texture_shader.stage[0].operation = TextureOperation::texture_2d;
    state.texture_shader.stage[1].operation = operation;
    const std::array<TextureUnit, 2> units{TextureUnit{&texture, kNearestSampler}, TextureUnit{&texture, one}};
    const Status drawn = rasterize(state, kIdentity, {}, units, target);
    return drawn ? std::string() : drawn.error().message;
  };
  Sampler killing = kNearestSampler;
  killing.color_key.operation = ColorKeyOperation::kill;
  EXPECT_EQ(message(around, TextureOperation::texture_2d), "");
  EXPECT_EQ(message(killing, TextureOperation::texture_2d), "");
  EXPECT_EQ(
      message(around, TextureOperation::dependent_ar),
      "texture unit 1: a cylinder wrap needs a texture-shader stage that reads the texture at its own coordinates: "
      "what it does to others is not known");
  EXPECT_NE(message(killing, TextureOperation::dependent_ar).find("texture unit 1: a killing colour key needs"),
            std::string::npos);
}

// Stages that read textures at their own coordinates draw what units do without stages, in vectors and in the probe,
// too.
TEST(ColorKeys, AndCylindersAreThoseOfStages) {
  PipelineState plain = textured(), staged = textured();
  plain.profile = staged.profile = profiles::nv2a;
  plain.program = staged.program = pass_through(Register::texture0, Register::texture0, profiles::nv2a);
  staged.texture_shader.enabled = true;
  staged.texture_shader.stage[0].operation = TextureOperation::texture_2d;
  Sampler sampler = kNearestSampler;
  sampler.wrap_s = Wrap::repeat;
  const Texture texture = key_texture(InternalFormat::rgba8);
  for (const bool is_around : {false, true}) {
    for (const ColorKeyOperation operation :
         {ColorKeyOperation::disable, ColorKeyOperation::alpha, ColorKeyOperation::rgba, ColorKeyOperation::kill}) {
      sampler.cylinder_wrap = {is_around, false};
      sampler.color_key = {operation, 0x40102030};
      for (const float s_right : {1.0F, 1.3F, 0.1F}) {
        const KeyRow expected = draw_row(texture, sampler, 40, plain, 0.3F, s_right);
        const KeyRow found = draw_row(texture, sampler, 40, staged, 0.3F, s_right);
        EXPECT_EQ(found.color, expected.color) << is_around << ' ' << static_cast<int>(operation) << ' ' << s_right;
        EXPECT_EQ(found.depth, expected.depth);
      }
    }
  }
  // The depth alone.
  sampler.cylinder_wrap = {};
  plain.color_mask = staged.color_mask = {};
  EXPECT_EQ(draw_row(texture, sampler, 40, staged).depth, draw_row(texture, sampler, 40, plain).depth);
}

// What a row of eight texels shows where a triangle's coordinates run from s to s + d.
TEST(CylinderWrap, TakesTheShorterWayWhereTheModeRepeats) {
  const Texture texture = bytes_texture(InternalFormat::luminance8, 8, 1, {0, 1, 2, 3, 4, 5, 6, 7});
  const auto row = [&](Wrap wrap, bool is_cylinder, float from, float to) {
    Sampler sampler = kNearestSampler;
    sampler.wrap_s = wrap;
    sampler.cylinder_wrap = {is_cylinder, false};
    return draw_row(texture, sampler, 16, textured(), from, to).color[0];
  };
  // A difference of exactly 1 becomes 0 ...
  EXPECT_EQ(row(Wrap::repeat, true, 0.3F, 1.3F), PlaneSamples<std::uint8_t>(16, 2));
  // ... but not in a mirrored direction.
  EXPECT_EQ(row(Wrap::mirrored_repeat, true, 0.3F, 1.3F), row(Wrap::mirrored_repeat, false, 0.3F, 1.3F));
  // A small one across 1 changes nothing.
  EXPECT_EQ(row(Wrap::repeat, true, 0.9F, 1.1F), row(Wrap::repeat, false, 0.9F, 1.1F));
  // From 0.9 to 0.1 goes on over 1; one half stays.
  EXPECT_EQ(row(Wrap::repeat, true, 0.9F, 0.1F), row(Wrap::repeat, false, 0.9F, 1.1F));
  EXPECT_EQ(row(Wrap::repeat, true, 0.25F, 0.75F), row(Wrap::repeat, false, 0.25F, 0.75F));
}

}  // namespace
}  // namespace ninebit::test
