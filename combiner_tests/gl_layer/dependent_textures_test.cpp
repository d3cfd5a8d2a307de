// NV_texture_shader's operations that depend on other units, drawn by OpenGL and computed by the library.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "combiner_tests/gl_layer/pictures.h"
#include "combiner_tests/support/random.h"
#include "ninebit/texture_shader/evaluate_stages.h"
#include "ninebit/texture_shader/stage_program.h"

namespace ninebit::test {
namespace {

constexpr GLenum kShader = GL_TEXTURE_SHADER_NV;
constexpr int kSide = 8;  // texels of each side; a cube map's faces have one
constexpr std::size_t kPixels = static_cast<std::size_t>(kPictureSize) * kPictureSize;

// The texels of a unit in the layout of stages, and as OpenGL gets them.
struct UnitTexture {
  StageTexture kind{};
  GLint internal = GL_RGBA8;
  GLenum format = GL_RGBA, type = GL_UNSIGNED_BYTE;
  std::vector<Bytes4> texels{};
  std::vector<std::uint8_t> bytes{};
};

// No signed byte is -128, and no word -32768, which the driver's formats do not have.
std::uint8_t random_signed_byte(Random& random) {
  const int value = random.between(-127, 127);
  return static_cast<std::uint8_t>(value & 255);
}

UnitTexture random_texture(Random& random, StageTarget target, StageInput read_as) {
  UnitTexture made{.kind = {.target = target == StageTarget::none ? StageTarget::two_dimensional : target}};
  const bool is_offset = read_as == StageInput::offset;
  if (is_offset) {
    made.internal = GL_DSDT8_NV, made.format = GL_DSDT_NV, made.type = GL_BYTE;
    made.kind.format = TextureFormat::dsdt;
  } else if (read_as == StageInput::luminance) {
    const bool has_intensity = random.one_in(2);
    made.internal = has_intensity ? GL_DSDT8_MAG8_INTENSITY8_NV : GL_DSDT8_MAG8_NV;
    made.format = has_intensity ? GL_DSDT_MAG_VIB_NV : GL_DSDT_MAG_NV, made.type = GL_BYTE;
    made.kind.format = has_intensity ? TextureFormat::dsdt_mag_intensity : TextureFormat::dsdt_mag;
  } else if (read_as == StageInput::normal && random.one_in(2)) {
    made.kind.format = TextureFormat::hilo;
    made.format = GL_HILO_NV;
    const bool is_signed = random.one_in(2);
    made.internal = is_signed ? GL_SIGNED_HILO16_NV : GL_HILO16_NV;
    made.type = is_signed ? GL_SHORT : GL_UNSIGNED_SHORT;
    if (is_signed) made.kind.is_signed = {true, true, true, true};
  } else if (read_as == StageInput::normal && random.one_in(2)) {
    made.internal = GL_SIGNED_RGBA8_NV, made.type = GL_BYTE;
    made.kind.is_signed = {true, true, true, true};
  }
  const int number = target == StageTarget::cube_map ? 6 : target == StageTarget::three_dimensional ? 512 : 64;
  for (int i = 0; i < number; ++i) {
    Bytes4 texel{};
    const auto byte = [&] { return static_cast<std::uint8_t>(random.below(256)); };
    if (made.kind.format == TextureFormat::dsdt) {
      texel = {0, random_signed_byte(random), random_signed_byte(random), 0};
      made.bytes.insert(made.bytes.end(), {texel[kBlue], texel[kGreen]});
    } else if (made.kind.format == TextureFormat::dsdt_mag || made.kind.format == TextureFormat::dsdt_mag_intensity) {
      const int magnitude = random.below(128);  // of 127
      texel = {static_cast<std::uint8_t>((2 * magnitude * 255 + 127) / 254), random_signed_byte(random),
               random_signed_byte(random), 0};
      made.bytes.insert(made.bytes.end(), {texel[kBlue], texel[kGreen], static_cast<std::uint8_t>(magnitude)});
      if (made.kind.format == TextureFormat::dsdt_mag_intensity) {
        const int intensity = random.below(128);
        texel[kAlpha] = static_cast<std::uint8_t>((2 * intensity * 255 + 127) / 254);
        made.bytes.push_back(static_cast<std::uint8_t>(intensity));
      }
    } else if (made.kind.format == TextureFormat::hilo) {
      const int limit = made.kind.is_signed[0] ? 32767 : 65535;
      const int high = random.between(made.kind.is_signed[0] ? -32767 : 0, limit) & 0xFFFF;
      const int low = random.between(made.kind.is_signed[0] ? -32767 : 0, limit) & 0xFFFF;
      texel = {static_cast<std::uint8_t>(high & 255), static_cast<std::uint8_t>(low >> 8),
               static_cast<std::uint8_t>(low & 255), static_cast<std::uint8_t>(high >> 8)};
      made.bytes.insert(made.bytes.end(), {texel[kRed], texel[kAlpha], texel[kBlue], texel[kGreen]});
    } else {
      for (std::uint8_t& b : texel) b = made.kind.is_signed[0] ? random_signed_byte(random) : byte();
      made.bytes.insert(made.bytes.end(), texel.begin(), texel.end());
    }
    made.texels.push_back(texel);
  }
  return made;
}

GLenum target_of(StageTarget target) {
  constexpr GLenum kTargets[]{GL_TEXTURE_2D,        GL_TEXTURE_1D, GL_TEXTURE_2D,
                              GL_TEXTURE_RECTANGLE, GL_TEXTURE_3D, GL_TEXTURE_CUBE_MAP};
  return kTargets[static_cast<std::size_t>(target)];
}

void upload(const UnitTexture& texture) {
  const GLenum target = target_of(texture.kind.target);
  const void* const bytes = texture.bytes.data();
  GLuint name = 0;
  glGenTextures(1, &name);
  glBindTexture(target, name);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  switch (texture.kind.target) {
    case StageTarget::one_dimensional:
      glTexImage1D(target, 0, texture.internal, kSide * kSide, 0, texture.format, texture.type, bytes);
      break;
    case StageTarget::three_dimensional:
      glTexImage3D(target, 0, texture.internal, kSide, kSide, kSide, 0, texture.format, texture.type, bytes);
      break;
    case StageTarget::cube_map:
      for (GLenum face = 0; face < 6; ++face) {
        glTexImage2D(GL_TEXTURE_CUBE_MAP_POSITIVE_X + face, 0, texture.internal, 1, 1, 0, texture.format, texture.type,
                     &texture.bytes[texture.bytes.size() / 6 * face]);
      }
      break;
    default:
      glTexImage2D(target, 0, texture.internal, kSide, kSide, 0, texture.format, texture.type, bytes);
      break;
  }
  use_nearest(target);
}

// The texel at a coordinate that repeats; `is_tie`: so near to a border that float error decides.
int texel_of(float at, int side, bool& is_tie) {
  const float place = at * static_cast<float>(side), floor = std::floor(place);
  is_tie = is_tie || !std::isfinite(place) || std::abs(place) > 1e4F || place - floor < 0.02F || place - floor > 0.98F;
  if (is_tie) return 0;
  return ((static_cast<int>(floor) % side) + side) % side;
}

int face_of(const std::array<float, 3>& at, bool& is_tie) {
  std::array<float, 3> size{std::abs(at[0]), std::abs(at[1]), std::abs(at[2])};
  const auto axis = static_cast<std::size_t>(std::max_element(size.begin(), size.end()) - size.begin());
  const float most = size[axis];
  size[axis] = 0.0F;
  is_tie = is_tie || !(most > 0.001F) || *std::max_element(size.begin(), size.end()) > 0.98F * most;
  return static_cast<int>(2 * axis) + (at[axis] < 0.0F ? 1 : 0);
}

Bytes4 nearest(const UnitTexture& texture, const std::array<float, 3>& at, bool& is_tie) {
  int place = 0;
  switch (texture.kind.target) {
    case StageTarget::one_dimensional:
      place = texel_of(at[0], kSide * kSide, is_tie);
      break;
    case StageTarget::rectangle: {  // clamped, in texels
      const auto clamped = [](float v) { return static_cast<int>(std::clamp(v, 0.0F, static_cast<float>(kSide - 1))); };
      for (std::size_t k = 0; k < 2; ++k) {
        is_tie = is_tie || !std::isfinite(at[k]) || std::abs(at[k] - std::round(at[k])) < 0.02F;
      }
      place = is_tie ? 0 : kSide * clamped(at[1]) + clamped(at[0]);
      break;
    }
    case StageTarget::cube_map:
      place = face_of(at, is_tie);
      break;
    case StageTarget::three_dimensional:
      place = kSide * kSide * texel_of(at[2], kSide, is_tie);
      [[fallthrough]];
    default:
      place += kSide * texel_of(at[1], kSide, is_tie) + texel_of(at[0], kSide, is_tie);
      break;
  }
  return texture.texels[static_cast<std::size_t>(place)];
}

void set_stage(std::size_t unit, const TextureStage& stage) {
  glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
  glTexEnvi(kShader, GL_SHADER_OPERATION_NV, info_of(stage.operation).gl_value);
  if (unit > 0) glTexEnvi(kShader, GL_PREVIOUS_TEXTURE_INPUT_NV, GL_TEXTURE0 + stage.previous);
  glTexEnvfv(kShader, GL_OFFSET_TEXTURE_MATRIX_NV, stage.matrix.data());
  glTexEnvf(kShader, GL_OFFSET_TEXTURE_SCALE_NV, stage.scale);
  glTexEnvf(kShader, GL_OFFSET_TEXTURE_BIAS_NV, stage.bias);
  glTexEnvfv(kShader, GL_CONST_EYE_NV, stage.eye.data());
  glTexEnvi(kShader, GL_RGBA_UNSIGNED_DOT_PRODUCT_MAPPING_NV,
            stage.mapping == DotMapping::zero_to_one ? GL_UNSIGNED_IDENTITY_NV : GL_EXPAND_NORMAL_NV);
}

struct Drawing {
  TextureShaderState state{.enabled = true};
  std::array<UnitTexture, kTextureStages> textures;
  std::vector<StageCoordinates> coordinates;
};

Drawing random_drawing(Random& random, TextureOperation wanted) {
  Drawing drawing;
  const TextureOperationInfo& info = info_of(wanted);
  const int place = random.between(info.first, info.last);
  for (int i = 0; i < kTextureStages; ++i) {
    TextureStage& stage = drawing.state.stage[static_cast<std::size_t>(i)];
    stage.operation = i == 0 ? TextureOperation::texture_2d
                             : random.pick({TextureOperation::pass_through, TextureOperation::texture_2d});
    if (i < place && i >= place - info.dots_before) stage.operation = TextureOperation::dot_product;
    if (i == place) stage.operation = wanted;
    if (i == 3 && wanted == TextureOperation::dot_product_diffuse_cube_map) {
      stage.operation = TextureOperation::dot_product_reflect_cube_map;
    }
    stage.mapping = random.pick({DotMapping::zero_to_one, DotMapping::minus1_to_1_d3d});
    for (float& entry : stage.matrix) entry = random.real_f(-2, 2);
    stage.scale = random.real_f(0, 2);
    stage.bias = random.real_f(-0.5F, 0.5F);
    for (float& e : stage.eye) e = random.real_f(-1, 1);
    const StageInput read_as = i == 0 ? info.input : StageInput::none;
    drawing.textures[static_cast<std::size_t>(i)] = random_texture(random, info_of(stage.operation).target, read_as);
  }
  drawing.coordinates.resize(kPixels);
  for (StageCoordinates& at : drawing.coordinates) {
    for (auto& unit : at) unit = {random.real_f(-2, 2), random.real_f(-2, 2), random.real_f(-2, 2), 1.0F};
    if (wanted == TextureOperation::dot_product_reflect_cube_map) {
      for (auto& unit : at) unit[3] = random.real_f(0.25F, 2);
      at[0][3] = 1.0F;
    }
  }
  return drawing;
}

// One point a pixel.
std::vector<Pixel> draw(const Drawing& drawing, int shown) {
  show_register(GL_TEXTURE0 + static_cast<GLenum>(shown));
  clear_picture();
  glBegin(GL_POINTS);
  for (std::size_t i = 0; i < kPixels; ++i) {
    for (std::size_t unit = 0; unit < kTextureStages; ++unit) {
      glMultiTexCoord4fv(GL_TEXTURE0 + static_cast<GLenum>(unit), drawing.coordinates[i][unit].data());
    }
    const auto place = [](std::size_t n) { return (2.0F * static_cast<float>(n) + 1.0F) / kPictureSize - 1.0F; };
    glVertex2f(place(i % kPictureSize), place(i / kPictureSize));
  }
  glEnd();
  return read_picture();
}

TEST(LayerDependentTextures, EveryOperationGivesTheReferencesTexels) {
  NINEBIT_GL_CONTEXT(context);
  Random random(0x6C617965);
  for (int n = 0; n < 2 * static_cast<int>(TextureOperation::brdf); ++n) {
    const auto wanted = static_cast<TextureOperation>(n % static_cast<int>(TextureOperation::brdf));
    const TextureOperationInfo& info = info_of(wanted);
    if (wanted == TextureOperation::cull_fragment) continue;  // texture_shader_test.cpp
    SCOPED_TRACE(info.name);
    const Drawing drawing = random_drawing(random, wanted);
    StageTextures kinds;
    glEnable(kShader);
    for (std::size_t unit = 0; unit < kTextureStages; ++unit) {
      set_stage(unit, drawing.state.stage[unit]);
      upload(drawing.textures[unit]);
      kinds[unit] = drawing.textures[unit].kind;
    }
    ASSERT_EQ(glGetError(), kNoError);
    const auto program = compile(drawing.state, kinds, profiles::nv2a);
    ASSERT_TRUE(program.ok()) << program.error().message;
    EXPECT_TRUE(program->warnings().empty()) << program->warnings().front();
    const int shown = std::max(1, static_cast<int>(info.last));
    const std::vector<Pixel> picture = draw(drawing, shown);
    int compared = 0;
    for (std::size_t i = 0; i < kPixels; ++i) {
      bool is_tie = false;
      const StageInputs inputs{drawing.coordinates[i], drawing.coordinates[i], drawing.coordinates[i]};
      const auto result = evaluate(*program, profiles::nv2a, inputs, [&](int unit, const TexturePlace& place) {
        return nearest(drawing.textures[static_cast<std::size_t>(unit)], place.at, is_tie);
      });
      if (is_tie) continue;
      ++compared;
      Pixel expected{};
      for (std::size_t k = 0; k < 4; ++k) {
        expected[k] =
            static_cast<std::uint8_t>(std::max<int>(0, result.stage[static_cast<std::size_t>(shown)].codes[k]));
      }
      ASSERT_EQ(picture[i], expected) << "pixel " << i << " of case " << n;
    }
    EXPECT_GT(compared, static_cast<int>(kPixels) / 2);
    for (std::size_t unit = 0; unit < kTextureStages; ++unit) {
      glActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(unit));
      GLint consistent = -1;
      glGetTexEnviv(kShader, GL_SHADER_CONSISTENT_NV, &consistent);
      EXPECT_EQ(consistent, GL_TRUE);
    }
    glActiveTexture(GL_TEXTURE0);
    EXPECT_EQ(glGetError(), kNoError);
  }
}

void draw_with(GLfloat third, const std::array<GLfloat, 3>& first_row, const std::array<GLfloat, 3>& second_row) {
  draw_corners([&](GLfloat x, GLfloat y) {
    glMultiTexCoord2f(GL_TEXTURE0, 0.5F, 0.5F);
    glMultiTexCoord3fv(GL_TEXTURE1, first_row.data());
    glMultiTexCoord3fv(GL_TEXTURE2, second_row.data());
    glVertex3f(x, y, third);
  });
}

// The quotient of two dot products takes the place of the polygon's depth in the depth test.
TEST(LayerDependentTextures, DepthReplace) {
  NINEBIT_GL_CONTEXT(context);
  set_texel({255, 255, 255, 255});
  glEnable(GL_DEPTH_TEST);
  glClearDepth(1.0);
  glClear(GL_DEPTH_BUFFER_BIT);
  show_constant({0, 1, 0, 1});
  clear_picture();
  draw_with(0.0F, {0, 0, 0}, {0, 0, 0});  // at depth 0.5
  set_stage(0, {.operation = TextureOperation::texture_2d});
  set_stage(1, {.operation = TextureOperation::dot_product});
  set_stage(2, {.operation = TextureOperation::dot_product_depth_replace});
  glActiveTexture(GL_TEXTURE0);
  glEnable(kShader);
  show_constant({1, 0, 0, 1});
  draw_with(-0.9F, {0.6F, 0, 0}, {1, 0, 0});  // behind, though its polygon is before
  EXPECT_EQ(center_pixel(), (Pixel{0, 255, 0, 255}));
  draw_with(0.9F, {0.2F, 0.2F, 0}, {0, 0, 1});
  EXPECT_EQ(center_pixel(), (Pixel{255, 0, 0, 255}));
  GLfloat depth = 0.0F;
  glReadPixels(kPictureSize / 2, kPictureSize / 2, 1, 1, GL_DEPTH_COMPONENT, GL_FLOAT, &depth);
  EXPECT_NEAR(depth, 0.4F, 1e-5F);
}

// An inconsistent stage is black, OpenGL reports it, and so it does for all that reads it.
TEST(LayerDependentTextures, InconsistentStages) {
  NINEBIT_GL_CONTEXT(context);
  for (GLenum unit = 0; unit < 3; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    GLuint name = 0;
    glGenTextures(1, &name);
    glBindTexture(GL_TEXTURE_2D, name);
    set_texel({10, 20, 30, 40});
  }
  set_stage(0, {.operation = TextureOperation::texture_2d});
  set_stage(1, {.operation = TextureOperation::offset_2d});  // needs DSDT texels
  set_stage(2, {.operation = TextureOperation::dependent_ar, .previous = 1});
  glEnable(kShader);
  const std::array expected{GL_TRUE, GL_FALSE, GL_FALSE};
  for (GLenum unit = 0; unit < 3; ++unit) {
    glActiveTexture(GL_TEXTURE0 + unit);
    GLint consistent = -1;
    glGetTexEnviv(kShader, GL_SHADER_CONSISTENT_NV, &consistent);
    EXPECT_EQ(consistent, expected[unit]) << unit;
    show_register(GL_TEXTURE0 + unit);
    clear_picture();
    EXPECT_EQ(drawn_pixel(), unit == 0 ? (Pixel{10, 20, 30, 40}) : (Pixel{0, 0, 0, 0})) << unit;
  }
}

// Signed texels without texture shaders: twice their value, at least the lowest code.
TEST(LayerDependentTextures, SignedTexelsReachTheCombiners) {
  NINEBIT_GL_CONTEXT(context);
  const std::int8_t texel[]{100, 30, -5, 127};
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SIGNED_RGBA8_NV, 1, 1, 0, GL_RGBA, GL_BYTE, texel);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glEnable(GL_TEXTURE_2D);
  show_register(GL_TEXTURE0);
  clear_picture();
  EXPECT_EQ(drawn_pixel(), (Pixel{200, 60, 0, 254}));
  // An alpha that a format does not have is 1, not a signed byte.
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SIGNED_RGB8_NV, 1, 1, 0, GL_RGBA, GL_BYTE, texel);
  EXPECT_EQ(drawn_pixel(), (Pixel{200, 60, 0, 255}));
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SIGNED_LUMINANCE8_NV, 1, 1, 0, GL_LUMINANCE, GL_BYTE, texel);
  EXPECT_EQ(drawn_pixel(), (Pixel{200, 200, 200, 255}));
}

// HILO and DSDT texels are for stages; combiners see nothing.
TEST(LayerDependentTextures, TexelsForStagesAreNoColours) {
  NINEBIT_GL_CONTEXT(context);
  const std::uint16_t words[]{40000, 50000};
  const std::int8_t bytes[]{100, 90, 80};
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
  glEnable(GL_TEXTURE_2D);
  show_register(GL_TEXTURE0);
  for (const bool is_hilo : {true, false}) {
    if (is_hilo) glTexImage2D(GL_TEXTURE_2D, 0, GL_HILO_NV, 1, 1, 0, GL_HILO_NV, GL_UNSIGNED_SHORT, words);
    if (!is_hilo) glTexImage2D(GL_TEXTURE_2D, 0, GL_DSDT8_MAG8_NV, 1, 1, 0, GL_DSDT_MAG_NV, GL_BYTE, bytes);
    glClearColor(1, 1, 1, 1);
    glClear(GL_COLOR_BUFFER_BIT);
    EXPECT_EQ(drawn_pixel(), (Pixel{0, 0, 0, 0})) << is_hilo;
  }
}

}  // namespace
}  // namespace ninebit::test
