// What fragments read besides their colour against the oracles, at every pixel of random points, lines and triangles:
// fog factors, point sprites, cylinder wrap, border texels and colour keys.
//
// One case again, alone: NINEBIT_ATTRIBUTE_INDEX=123.
#include <gtest/gtest.h>

#include <cmath>

#include "combiner_tests/oracle/attribute_oracle.h"
#include "combiner_tests/raster/texture_support.h"
#include "combiner_tests/support/environment.h"

namespace ninebit::test {
namespace {

constexpr std::uint64_t kAttributeSeed = 0xA77216;
constexpr int kAttributeCases = kSlowBuild ? 300 : 3000;
constexpr int kAttributeWindow = 40;
constexpr std::uint8_t kNotDrawn = 9;

struct AttributeCase {
  PipelineState state;
  Texture texture;
  Sampler sampler;
  std::vector<oracle::AttributeVertex> vertices;  // of one primitive
  bool has_q = false;
  bool reads_fog = false;  // as alpha
};

// Often of two values a component, so that many texels are the colour key's.
Texture some_texture(Random& random, InternalFormat format, int width, int height) {
  if (random.one_in(2)) return random_texture(random, TextureTarget::texture_2d, format, width, height, false);
  std::vector<std::uint8_t> bytes(static_cast<std::size_t>(width * height) * (format == InternalFormat::rgb8 ? 3 : 4));
  for (std::uint8_t& byte : bytes) byte = random.one_in(3) ? 0x20 : 0x10;
  return make_texture(TextureTarget::texture_2d, format, {{{width, height, std::move(bytes)}}}).value();
}

Sampler some_sampler(Random& random, const Texture& texture) {
  const bool linear = random.one_in(4);
  Sampler s{.min_filter = linear ? MinFilter::linear : MinFilter::nearest,
            .mag_filter = linear ? MagFilter::linear : MagFilter::nearest};
  const auto wrap = [&] { return random.one_in(2) ? Wrap::repeat : kWraps[static_cast<std::size_t>(random.below(5))]; };
  s.wrap_s = wrap();
  s.wrap_t = wrap();
  s.border_color = {0.2F, 0.4F, 0.6F, 0.8F};
  const TextureImage& image = texture.faces[0][0];
  s.border_texels = image.width >= 16 && image.height >= 16 && random.one_in(2);
  s.cylinder_wrap = {random.one_in(2), random.one_in(2)};
  if (linear) return s;
  s.color_key.operation = static_cast<ColorKeyOperation>(random.below(4));
  for (int k = 0; k < 4; ++k) s.color_key.key = 256 * s.color_key.key + (random.one_in(3) ? 0x20 : 0x10);
  return s;
}

PipelineState some_state(Random& random, bool reads_fog) {
  PipelineState state;
  state.profile = profiles::nv2a;
  if (random.one_in(4)) state.profile.fog_byte.value = StageByte::nearest;
  state.fog = {.enabled = true,
               .color = {},
               .function = static_cast<FogFunction>(random.below(7)),
               .bias = random.real_f(0.5, 2.5),
               .slope = random.real_f(-1, 1)};
  state.program = pass_through(Register::texture0, reads_fog ? Register::fog : Register::texture0, state.profile);
  state.point_size = static_cast<float>(random.between(0, 8 * 40)) / 8.0F;
  state.line_width = static_cast<float>(random.between(8, 8 * 9)) / 8.0F;
  state.point_sprite = {.enabled = !random.one_in(4), .coord_replace = {!random.one_in(4)}};
  if (random.one_in(3)) {
    state.texture_shader.enabled = true;
    state.texture_shader.stage[0].operation = TextureOperation::texture_2d;
  }
  return state;
}

AttributeCase make_attribute_case(std::uint64_t index) {
  Random random(kAttributeSeed, index);
  AttributeCase c;
  const auto side = [&] { return 1 << random.between(random.one_in(4) ? 0 : 4, 6); };
  const int width = side(), height = side();
  const InternalFormat format = random.one_in(3) ? InternalFormat::rgb8 : InternalFormat::rgba8;
  c.texture = some_texture(random, format, width, height);
  c.sampler = some_sampler(random, c.texture);
  c.reads_fog = random.one_in(2);
  c.state = some_state(random, c.reads_fog);
  c.has_q = random.one_in(3);
  const bool is_deep = random.one_in(2), is_small = random.one_in(3);
  const int reach = is_small ? 120 : 16 * kAttributeWindow, shift = is_small ? random.below(500) : 0;
  const int vertices = random.between(1, 3);
  for (int i = 0; i < vertices; ++i) {
    oracle::AttributeVertex v{.position = {shift + random.below(reach), shift / 2 + random.below(reach)}};
    if (is_deep) v.w = random.real_f(0.5, 4);
    for (std::size_t k = 0; k < 2; ++k) {
      v.coordinate[k] =
          random.one_in(3) ? random.pick({0.0F, 0.25F, 0.75F, 0.1F, 0.9F, 1.1F, 1.0F}) : random.real_f(-1.5, 2.5);
    }
    if (c.has_q) v.coordinate[3] = random.real_f(0.5, 2);
    v.fog = random.real_f(-2, 2);
    c.vertices.push_back(v);
  }
  return c;
}

// The planes, drawn one fragment at a time for the sake of an output plane, or in any other way.
Surface draw_attributes(const AttributeCase& c, bool with_outputs) {
  Surface surface = Surface::make(kAttributeWindow, kAttributeWindow, {.with_primitive = with_outputs}).value();
  surface.fill({.color = {kNotDrawn, kNotDrawn, kNotDrawn, kNotDrawn}});
  std::vector<glm::vec4> clip;
  std::vector<glm::vec3> coordinates;
  std::vector<float> q, fog;
  for (const oracle::AttributeVertex& v : c.vertices) {
    clip.push_back(glm::vec4(clip_position(v.position, kAttributeWindow, kAttributeWindow), 1.0F) * v.w);
    coordinates.emplace_back(v.coordinate[0], v.coordinate[1], v.coordinate[2]);
    q.push_back(v.coordinate[3]);
    fog.push_back(v.fog);
  }
  constexpr std::array kTypes{PrimitiveType::points, PrimitiveType::lines, PrimitiveType::triangles};
  VertexArrays arrays{.type = kTypes[clip.size() - 1], .homogeneous_positions = clip, .fog_factors = fog};
  arrays.texture_coordinates[0] = coordinates;
  if (c.has_q) arrays.texture_q[0] = q;
  const TextureUnit unit{&c.texture, c.sampler};
  RenderTarget target = surface.target();
  const Status status = rasterize(c.state, kIdentity, arrays, {&unit, 1}, target);
  EXPECT_TRUE(status.ok()) << status.error().message;
  return surface;
}

bool is_covered(const AttributeCase& c, int x, int y) {
  const auto& v = c.vertices;
  const auto eighths = [](float size) { return static_cast<int>(std::lround(8 * size)); };
  if (v.size() == 1) return oracle::square_covers(v[0].position, eighths(c.state.point_size), x, y);
  if (v.size() == 2) {
    return oracle::rectangle_covers({v[0].position, v[1].position}, eighths(c.state.line_width), x, y);
  }
  return oracle::covers({v[0].position, v[1].position, v[2].position}, x, y);
}

struct AttributesSeen {
  std::uint64_t drawn = 0, fog = 0, killed = 0, sprites = 0, turned = 0, border = 0;
};

// Whether the fragment may have this colour, its coordinates being floats. Coordinates of a vertex are below 3, and may
// be up to that much further around a cylinder.
bool may_be(const AttributeCase& c, oracle::TextureQuestion& question, const std::array<int, 4>& color,
            const oracle::Attributes& at, AttributesSeen& seen) {
  constexpr long double kError = 4e-6L;
  const std::array<int, 2> fog = oracle::fog_bytes(c.state.profile, c.state.fog, at.fog, 1e-6L);
  for (const int down : {0, -1, 1}) {
    for (const int right : {0, -1, 1}) {
      question.coordinate[0] = static_cast<float>((at.coordinate[0] + right * kError) / at.coordinate[3]);
      question.coordinate[1] = static_cast<float>((at.coordinate[1] + down * kError) / at.coordinate[3]);
      const oracle::TextureAnswer answer = oracle::sample(question).front();
      if (answer.killed) {
        if (color != std::array<int, 4>{kNotDrawn, kNotDrawn, kNotDrawn, kNotDrawn}) continue;
        ++seen.killed;
        return true;
      }
      bool same = c.reads_fog ? fog[0] <= color[3] && color[3] <= fog[1] : color[3] == answer.value[3];
      for (std::size_t k = 0; k < 3; ++k) same = same && color[k] == answer.value[k];
      if (same) return true;
    }
  }
  return false;
}

void run_attributes(std::uint64_t index, AttributesSeen& seen) {
  const AttributeCase c = make_attribute_case(index);
  Surface surface = draw_attributes(c, index % 2 == 0);
  const RenderTarget target = surface.target();
  Sampler straight = c.sampler;
  straight.cylinder_wrap = {};
  oracle::TextureQuestion question = texture_question(c.state.profile, c.texture, c.sampler);
  for (int y = 0; y < kAttributeWindow; ++y) {
    for (int x = 0; x < kAttributeWindow; ++x) {
      std::array<int, 4> color{};
      for (std::size_t k = 0; k < 4; ++k) color[k] = target.color[k].at(x, y);
      if (!is_covered(c, x, y)) {
        ASSERT_EQ(color[0], kNotDrawn) << index << ": " << x << ' ' << y;
        continue;
      }
      const oracle::Attributes at = oracle::attributes_at(c.state, c.sampler, 0, c.vertices, x, y);
      ASSERT_TRUE(may_be(c, question, color, at, seen))
          << "NINEBIT_ATTRIBUTE_INDEX=" << index << ": " << c.vertices.size() << " vertices, pixel " << x << ' ' << y
          << " has " << color[0] << ' ' << color[1] << ' ' << color[2] << ' ' << color[3] << " at "
          << static_cast<double>(at.coordinate[0]) << ' ' << static_cast<double>(at.coordinate[1]) << " fog "
          << static_cast<double>(at.fog) << ", key " << static_cast<int>(c.sampler.color_key.operation) << ", wraps "
          << static_cast<int>(c.sampler.wrap_s) << ' ' << static_cast<int>(c.sampler.wrap_t) << ", border "
          << c.sampler.border_texels << ", stages " << c.state.texture_shader.enabled;
      ++seen.drawn;
      seen.fog += c.reads_fog ? 1U : 0U;
      const PointSprite& sprite = c.state.point_sprite;
      seen.sprites += c.vertices.size() == 1 && sprite.enabled && sprite.coord_replace[0] ? 1U : 0U;
      seen.border += c.sampler.border_texels ? 1U : 0U;
      const auto beside = oracle::attributes_at(c.state, straight, 0, c.vertices, x, y).coordinate;
      seen.turned += beside != at.coordinate ? 1U : 0U;
    }
  }
}

TEST(FragmentAttributes, AreThoseOfTheOracle) {
  AttributesSeen seen;
  const CaseRange range("NINEBIT_ATTRIBUTE_INDEX", kAttributeCases);
  for (std::uint64_t index = range.first; index < range.end; ++index) {
    run_attributes(index, seen);
    if (HasFailure()) return;
  }
  if (!range.is_whole) return;
  EXPECT_GE(seen.drawn, std::uint64_t{150} * kAttributeCases);
  for (const std::uint64_t count : {seen.fog, seen.sprites, seen.turned, seen.border}) {
    EXPECT_GE(count, seen.drawn / 50);
  }
  EXPECT_GE(seen.killed, seen.drawn / (kSlowBuild ? 1000 : 200));
  RecordProperty("fragments", std::to_string(seen.drawn));
}

}  // namespace
}  // namespace ninebit::test
