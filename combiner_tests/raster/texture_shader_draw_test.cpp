// Draws with random texture-shader stages: every plane as the oracles of stages and fragments draw it, on every SIMD
// target and with any number of threads; the probe; what is refused; warnings.
//
// NINEBIT_STAGE_DRAWS_COUNT=500 draws so many cases of each operation, NINEBIT_STAGE_DRAWS_SEED others.
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/oracle/stage_oracle.h"
#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/raster/stage_support.h"
#include "combiner_tests/support/environment.h"
#include "ninebit/raster/prepared_draw.h"

namespace ninebit::test {
namespace {

constexpr int kDrawWidth = 40, kDrawHeight = 32, kDrawPrimitives = 5;

struct StageDraw {
  std::unique_ptr<StageCase> stages;
  PipelineState state;
  PrimitiveType type = PrimitiveType::triangles;
  std::vector<glm::vec4> positions;
  std::array<std::vector<glm::vec3>, kTextureStages> str;
  std::array<std::vector<float>, kTextureStages> q;  // or none
  std::array<Register, 2> shown{};                   // the program's colour and alpha
  std::size_t corners = 3;                           // of a primitive
  oracle::Picture start;

  [[nodiscard]] VertexArrays arrays() const {
    VertexArrays a{.type = type, .homogeneous_positions = positions};
    for (std::size_t u = 0; u < kTextureStages; ++u) {
      a.texture_coordinates[u] = str[u];
      a.texture_q[u] = q[u];
    }
    return a;
  }
  [[nodiscard]] std::vector<TextureUnit> units() const {
    std::vector<TextureUnit> all(kTextureStages);
    for (std::size_t u = 0; u < kTextureStages; ++u) all[u] = {stages->units.texture[u], stages->units.sampler[u]};
    return all;
  }
};

// Numbers that most often keep a fragment, and depths that may lie in the buffer.
float vertex_number(Random& random, const StageDraw& d, std::size_t unit, std::size_t k) {
  const TextureStage& stage = d.stages->state.stage[unit];
  float number = random.real_f(-2, 2);
  if (stage.operation == TextureOperation::cull_fragment && !random.one_in(6)) {
    number = stage.cull[k] == CullMode::kills_negative ? std::fabs(number) : -std::fabs(number) - 0.01F;
  }
  const bool is_depth = unit + 1 < kTextureStages && d.stages->state.depth_unit == DepthUnit::codes &&
                        d.stages->state.stage[unit + 1].operation == TextureOperation::dot_product_depth_replace;
  return is_depth ? number * 30000.0F : number;
}

StageDraw random_stage_draw(std::uint64_t seed, TextureOperation operation, std::uint64_t index, bool has_mipmaps) {
  Random random(seed, 100000 * static_cast<std::uint64_t>(operation) + 2 * index + (has_mipmaps ? 1 : 0));
  StageDraw d;
  d.stages = random_stages(random, operation, has_mipmaps);
  d.stages->state.depth_unit = random.one_in(2) ? DepthUnit::codes : DepthUnit::window;
  if (random.one_in(3)) d.stages->profile.replaced_depth_narrowing.value = Narrowing::nearest_halves_up;
  randomize_fragment_operations(random, d.state);
  d.state.stencil_test.back.reset();
  d.state.scissor.reset();
  d.state.profile = d.stages->profile;
  d.state.texture_shader = d.stages->state;
  d.shown = {texture_register(random.below(4)), texture_register(random.below(4))};
  d.state.program = pass_through(d.shown[0], d.shown[1], d.state.profile);
  if (random.one_in(8)) d.state.program.reset();
  if (random.one_in(4)) d.state.polygon_offset = {.fill = true, .factor = random.real_f(-2, 2), .units = 100.0F};
  const int kind = random.below(8);
  d.type = kind == 0 ? PrimitiveType::points : kind == 1 ? PrimitiveType::lines : PrimitiveType::triangles;
  d.corners = kind == 0 ? 1 : kind == 1 ? 2 : 3;
  d.state.point_size = 9.0F;
  d.state.line_width = 5.0F;
  for (std::size_t v = 0; v < d.corners * kDrawPrimitives; ++v) {
    const float w = random.one_in(3) ? 1.0F : random.real_f(0.3F, 3);
    d.positions.emplace_back(random.real_f(-1.3F, 1.3F) * w, random.real_f(-1.3F, 1.3F) * w, random.real_f(-1, 1) * w,
                             w);
  }
  for (std::size_t u = 0; u < kTextureStages; ++u) {
    const bool has_q = random.one_in(2);
    for (std::size_t v = 0; v < d.positions.size(); ++v) {
      d.str[u].emplace_back(vertex_number(random, d, u, 0), vertex_number(random, d, u, 1),
                            vertex_number(random, d, u, 2));
      if (has_q) d.q[u].push_back(vertex_number(random, d, u, 3));
    }
  }
  d.start = random_picture(random, kDrawWidth, kDrawHeight,
                           random.pick({DepthStencilFormat::d24s8, DepthStencilFormat::d16}));
  return d;
}

// A primitive's coordinates at its pixels: attributes are interpolated as they are.
struct PixelCoordinates {
  std::vector<float> samples = std::vector<float>(16 * kDrawWidth * kDrawHeight);
  std::vector<std::uint32_t> primitive = std::vector<std::uint32_t>(kDrawWidth * kDrawHeight, 0xFFFFFFFF);
  std::vector<std::uint32_t> depth = std::vector<std::uint32_t>(kDrawWidth * kDrawHeight);

  PixelCoordinates(const StageDraw& d, std::size_t number) {
    PipelineState state = d.state;
    state.texture_shader = {};
    state.program.reset();
    state.alpha_test = {};
    state.stencil_test = {};
    state.blend = {};
    state.depth_test = {.enabled = true, .function = CompareFunction::always};
    std::array<std::vector<glm::vec4>, kTextureStages> values;
    VertexArrays arrays{.type = d.type, .homogeneous_positions = d.positions};
    std::vector<std::uint32_t> indices;
    for (std::size_t i = 0; i < d.corners; ++i) indices.push_back(static_cast<std::uint32_t>(number * d.corners + i));
    arrays.indices = indices;
    RenderTarget target{.width = kDrawWidth, .height = kDrawHeight, .format = d.start.format};
    target.depth = {depth.data(), kDrawWidth};
    target.outputs.push_back(
        {.source = OutputSource::primitive, .plane = Plane<std::uint32_t>{primitive.data(), kDrawWidth}});
    for (std::size_t u = 0; u < kTextureStages; ++u) {
      for (std::size_t v = 0; v < d.positions.size(); ++v) {
        values[u].emplace_back(d.str[u][v], d.q[u].empty() ? 1.0F : d.q[u][v]);
      }
      arrays.attributes[u] = values[u];
      for (std::size_t k = 0; k < 4; ++k) {
        float* const first = samples.data() + (4 * u + k) * kDrawWidth * kDrawHeight;
        target.outputs.push_back({.source = OutputSource::attribute,
                                  .attribute = static_cast<int>(u),
                                  .component = static_cast<int>(k),
                                  .plane = Plane<float>{first, kDrawWidth}});
      }
    }
    const Status drawn = rasterize(state, kIdentity, arrays, {}, target);
    EXPECT_TRUE(drawn.ok()) << drawn.error().message;
    // A q that nobody gives is 1, not interpolated.
    for (std::size_t u = 0; u < kTextureStages; ++u) {
      if (!d.q[u].empty()) continue;
      std::fill_n(samples.begin() + static_cast<std::ptrdiff_t>((4 * u + 3) * kDrawWidth * kDrawHeight),
                  kDrawWidth * kDrawHeight, 1.0F);
    }
  }
  [[nodiscard]] std::array<std::array<float, 4>, 4> at(std::size_t pixel) const {
    std::array<std::array<float, 4>, 4> c{};
    for (std::size_t n = 0; n < 16; ++n) c[n / 4][n % 4] = samples[n * kDrawWidth * kDrawHeight + pixel];
    return c;
  }
};

// Rule 39, with doubles.
std::uint32_t depth_code_of(const StageDraw& d, float depth, std::uint32_t largest) {
  double code = static_cast<double>(depth);
  if (d.stages->state.depth_unit == DepthUnit::window) code *= static_cast<double>(largest);
  if (std::isnan(code) || code <= 0.0) return 0;
  if (code >= static_cast<double>(largest)) return largest;
  const bool nearest = d.stages->profile.replaced_depth_narrowing.value == Narrowing::nearest_halves_up;
  return static_cast<std::uint32_t>(std::floor(nearest ? code + 0.5 : code));
}

struct ExpectedDraw {
  oracle::Picture picture;
  std::vector<oracle::StageAnswer> probed;  // the fragments at the probe's pixel
  std::vector<std::uint32_t> probed_depth;
};

struct StageDrawsSeen {
  std::uint64_t fragments = 0, culled = 0, replaced = 0, in_range = 0, drawn = 0, shaded = 0;
};

ExpectedDraw expected_draw(const StageDraw& d, std::size_t probe, StageDrawsSeen& seen) {
  ExpectedDraw e{.picture = d.start, .probed = {}, .probed_depth = {}};
  oracle::StageQuestion question = stage_question(*d.stages);
  const std::uint32_t largest = max_depth(d.start.format);
  for (std::size_t p = 0; p < kDrawPrimitives; ++p) {
    const PixelCoordinates coordinates(d, p);
    for (std::size_t pixel = 0; pixel < kDrawWidth * kDrawHeight; ++pixel) {
      if (coordinates.primitive[pixel] != 0) continue;
      question.coordinate = coordinates.at(pixel);
      const oracle::StageAnswer answer = oracle::run_stages(question);
      ++seen.fragments;
      std::uint32_t depth = coordinates.depth[pixel];
      if (answer.depth) {
        depth = depth_code_of(d, *answer.depth, largest);
        ++seen.replaced;
        seen.in_range += depth > 0 && depth < largest ? 1U : 0U;
      }
      if (pixel == probe) {
        e.probed.push_back(answer);
        e.probed_depth.push_back(depth);
      }
      seen.culled += answer.culled ? 1U : 0U;
      if (answer.culled) continue;
      oracle::Bytes color{255, 255, 255, 255};
      for (std::size_t k = 0; k < 4 && d.state.program; ++k) {
        const auto from =
            static_cast<std::size_t>(d.shown[k < 3 ? 0 : 1]) - static_cast<std::size_t>(Register::texture0);
        color[k] = static_cast<std::uint8_t>(std::clamp(answer.code[from][k], 0, 255));
        seen.shaded += color[k] > 0 ? 1U : 0U;
      }
      oracle::Tally tally;
      const oracle::Incoming fragment{.x = static_cast<int>(pixel % kDrawWidth),
                                      .y = static_cast<int>(pixel / kDrawWidth),
                                      .depth = depth,
                                      .number = static_cast<std::uint32_t>(p),
                                      .front_facing = true,
                                      .color = color};
      oracle::process(d.state, fragment, e.picture, tally);
      seen.drawn += tally.drawn;
    }
  }
  return e;
}

std::string name_of_case(TextureOperation operation, std::uint64_t index) {
  return std::string(info_of(operation).name) + ", case " + std::to_string(index);
}

oracle::Picture drawn_by_library(const StageDraw& d, bool with_outputs, std::vector<FragmentProbe>* probes = nullptr) {
  PicturePlanes planes(d.start, with_outputs);
  if (!with_outputs) planes.target.outputs.clear();
  planes.target.probes = probes;
  const Status drawn = rasterize(d.state, kIdentity, d.arrays(), d.units(), planes.target);
  EXPECT_TRUE(drawn.ok()) << drawn.error().message;
  return planes.picture();
}

void expect_probe(const FragmentProbe& probe, const ExpectedDraw& e, const std::string& name) {
  ASSERT_EQ(probe.fragments.size(), e.probed.size()) << name;
  for (std::size_t i = 0; i < e.probed.size(); ++i) {
    const ProbedFragment& f = probe.fragments[i];
    ASSERT_TRUE(f.stages.has_value()) << name;
    ASSERT_EQ(f.fate == FragmentFate::culled, e.probed[i].culled) << name;
    ASSERT_EQ(f.depth, e.probed_depth[i]) << name;
    for (std::size_t u = 0; u < kTextureStages; ++u) {
      const Rgba9& seen = f.registers[texture_register(static_cast<int>(u))];
      ASSERT_EQ(seen, f.stages->stage[u].codes) << name;
      for (std::size_t k = 0; k < 4; ++k) ASSERT_EQ(int{seen[k]}, e.probed[i].code[u][k]) << name;
    }
  }
}

void run_draw(std::uint64_t seed, TextureOperation operation, std::uint64_t index, StageDrawsSeen& seen) {
  const StageDraw d = random_stage_draw(seed, operation, index, false);
  const std::string name = name_of_case(operation, index);
  const std::size_t pixel = (kDrawHeight / 2) * kDrawWidth + kDrawWidth / 2 + index % 5;
  const ExpectedDraw e = expected_draw(d, pixel, seen);
  const auto same = [&](const oracle::Picture& actual, bool with_outputs) {
    return actual.color == e.picture.color && actual.depth == e.picture.depth && actual.stencil == e.picture.stencil &&
           (!with_outputs || (actual.primitive == e.picture.primitive && actual.captured == e.picture.captured));
  };
  ASSERT_TRUE(same(drawn_by_library(d, true), true)) << name;
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on(target);
    ASSERT_TRUE(same(drawn_by_library(d, false), false)) << name << " on " << simd_target_name(target);
  }
  with_threads(3, [&] { ASSERT_TRUE(same(drawn_by_library(d, false), false)) << name << " in three threads"; });
  std::vector<FragmentProbe> probes{
      {.x = static_cast<int>(pixel % kDrawWidth), .y = static_cast<int>(pixel / kDrawWidth)}};
  ASSERT_TRUE(same(drawn_by_library(d, true, &probes), true)) << name << " with a probe";
  expect_probe(probes[0], e, name);
}

TEST(TextureShaderDraws, EveryPlaneIsAsTheOraclesDrawIt) {
  const std::uint64_t seed = number_from_environment("NINEBIT_STAGE_DRAWS_SEED", 4210);
  const std::uint64_t count = number_from_environment("NINEBIT_STAGE_DRAWS_COUNT", kSlowBuild ? 2 : 10);
  StageDrawsSeen all;
  for (int n = 0; n < static_cast<int>(TextureOperation::brdf); ++n) {
    const auto operation = static_cast<TextureOperation>(n);
    StageDrawsSeen seen;
    for (std::uint64_t index = 0; index < count; ++index) {
      run_draw(seed, operation, index, seen);
      if (HasFailure()) return;
    }
    all.fragments += seen.fragments;
    all.drawn += seen.drawn;
    if (kSlowBuild) continue;
    EXPECT_GT(seen.shaded, 0U) << info_of(operation).name;
    if (operation == TextureOperation::cull_fragment) {
      EXPECT_GT(seen.culled, 20 * count);
      EXPECT_GT(seen.fragments - seen.culled, 20 * count);
    }
    if (operation == TextureOperation::dot_product_depth_replace) {
      EXPECT_GT(seen.in_range, 10 * count);
    }
  }
  RecordProperty("fragments", std::to_string(all.fragments));
  EXPECT_GE(all.fragments, kSlowBuild ? 10000U : 100000U);
  EXPECT_GE(all.drawn, all.fragments / 10);
}

// The same draw of points, with coordinates across them in some units.
void make_sprites(StageDraw& d, std::uint64_t number) {
  d.type = PrimitiveType::points;
  d.state.point_size = std::array{9.0F, 0.0F, 2.5F, 24.0F}[number % 4];
  d.state.point_sprite.enabled = true;
  for (std::size_t u = 0; u < kTextureStages; ++u) d.state.point_sprite.coord_replace[u] = ((number >> u) & 1U) == 0;
}

// With mip-maps there is no oracle: single fragments, which the probe evaluates, and vectors agree.
TEST(TextureShaderDraws, LevelsOfDetailAreThoseOfSingleFragments) {
  std::size_t probed = 0, of_sprites = 0;
  for (int n = 0; n < static_cast<int>(TextureOperation::brdf); ++n) {
    for (std::uint64_t index = 0; index < (kSlowBuild ? 2 : 8); ++index) {
      StageDraw d = random_stage_draw(4211, static_cast<TextureOperation>(n), index / 2, true);
      const bool are_sprites = index % 2 == 1;
      if (are_sprites) make_sprites(d, static_cast<std::uint64_t>(n) + index / 2);
      const std::string name = name_of_case(static_cast<TextureOperation>(n), index);
      const oracle::Picture first = drawn_by_library(d, true);
      for (const std::int64_t target : simd_targets()) {
        const OnTarget on(target);
        const oracle::Picture other = drawn_by_library(d, false);
        ASSERT_TRUE(other.color == first.color && other.depth == first.depth && other.stencil == first.stencil)
            << name << " on " << simd_target_name(target);
      }
      for (int i = 0; i < 12; ++i) {
        std::vector<FragmentProbe> probes{{.x = 3 * i % kDrawWidth, .y = 5 * i % kDrawHeight}};
        drawn_by_library(d, true, &probes);
        for (const ProbedFragment& f : probes[0].fragments) {
          for (std::size_t u = 0; u < kTextureStages; ++u) {
            ASSERT_EQ(f.registers[texture_register(static_cast<int>(u))], f.stages->stage[u].codes) << name;
          }
          ++(are_sprites ? of_sprites : probed);
        }
      }
    }
  }
  EXPECT_GT(probed, 100U);
  EXPECT_GT(of_sprites, 100U);
}

// A quad over the whole target.
struct StageQuad {
  std::vector<glm::vec3> positions{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
  std::vector<glm::vec3> str = std::vector<glm::vec3>(4, glm::vec3(0.5F, 0.25F, 0.125F));
  PicturePlanes planes;
  PipelineState state;

  StageQuad() : planes(empty_picture(8, 8)) {
    state.profile = profiles::nv2a;
    state.texture_shader.enabled = true;
    state.texture_shader.stage[0].operation = TextureOperation::pass_through;
    state.program = pass_through(Register::texture0, Register::texture0, profiles::nv2a);
  }
  [[nodiscard]] VertexArrays arrays() const {
    VertexArrays a{.type = PrimitiveType::quads, .positions = positions};
    a.texture_coordinates[0] = str;
    return a;
  }
  Status draw() { return rasterize(state, kIdentity, arrays(), {}, planes.target); }
};

TEST(TextureShaderDraws, StagesWithoutTexturesReadCoordinates) {
  StageQuad quad;
  ASSERT_TRUE(quad.draw().ok());
  EXPECT_EQ(quad.planes.picture().color[0], (oracle::Bytes{127, 63, 31, 255}));  // rule 33; q is 1
  quad.str.clear();
  const Status refused = quad.draw();
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message, "texture unit 0 has 0 texture coordinates for 4 vertices");
}

TEST(TextureShaderDraws, FaultsAreReportedBeforeAnythingIsDrawn) {
  StageQuad quad;
  quad.state.texture_shader.stage[0].operation = TextureOperation::offset_2d;
  const Status refused = quad.draw();
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message.rfind("texture stage 0: ", 0), 0U) << refused.error().message;
  EXPECT_EQ(quad.planes.picture().color[0], oracle::Bytes{});
  EXPECT_FALSE(texture_shader_warnings(quad.state, {}).ok());
  quad.state.texture_shader.stage[0].operation = TextureOperation::pass_through;
  quad.state.profile = profiles::geforce2;
  quad.state.program.reset();
  EXPECT_FALSE(quad.draw().ok());
}

TEST(TextureShaderDraws, InconsistentStagesGiveZerosAndAWarning) {
  StageQuad quad;
  quad.state.texture_shader.stage[0].operation = TextureOperation::texture_2d;
  ASSERT_TRUE(quad.draw().ok());
  EXPECT_EQ(quad.planes.picture().color[0], oracle::Bytes{});
  const auto warnings = texture_shader_warnings(quad.state, {});
  ASSERT_TRUE(warnings.ok());
  ASSERT_EQ(warnings->size(), 1U);
  EXPECT_EQ(warnings->front().rfind("texture stage 0: ", 0), 0U) << warnings->front();
  quad.state.texture_shader.enabled = false;
  EXPECT_TRUE(texture_shader_warnings(quad.state, {})->empty());
}

// The depth that is tested is the replaced one, in vectors and one by one: the quad's own would fail.
TEST(TextureShaderDraws, AReplacedDepthIsTestedAndWritten) {
  TextureSamples white{.width = 1, .height = 1};
  white.samples = std::vector<std::uint8_t>{255, 255, 255};
  const Texture texture = make_texture(TextureTarget::texture_2d, InternalFormat::rgb8, {{white}}).value();
  for (const bool with_outputs : {false, true}) {
    StageQuad quad;
    if (!with_outputs) quad.planes.target.outputs.clear();
    const std::uint32_t largest = max_depth(quad.planes.target.format);
    for (int y = 0; y < 8; ++y) std::fill_n(quad.planes.target.depth.row(y), 8, largest / 8 * 3);
    quad.state.texture_shader.stage[0].operation = TextureOperation::texture_2d;
    quad.state.texture_shader.stage[1].operation = TextureOperation::dot_product;
    quad.state.texture_shader.stage[2].operation = TextureOperation::dot_product_depth_replace;
    quad.state.depth_test = {.enabled = true, .function = CompareFunction::less};
    VertexArrays arrays = quad.arrays();
    const std::vector<glm::vec3> quarter(4, glm::vec3(0.25F, 0, 0)), one(4, glm::vec3(0, 1, 0));
    arrays.texture_coordinates[1] = quarter;
    arrays.texture_coordinates[2] = one;
    const TextureUnit unit{&texture, kNearestSampler};
    ASSERT_TRUE(rasterize(quad.state, kIdentity, arrays, {&unit, 1}, quad.planes.target).ok());
    const oracle::Picture picture = quad.planes.picture();
    EXPECT_EQ(picture.color[0], (oracle::Bytes{255, 255, 255, 255})) << with_outputs;
    EXPECT_EQ(picture.depth[0], largest / 4) << with_outputs;
    quad.planes.target.format = DepthStencilFormat::f24s8;
    const Status refused = rasterize(quad.state, kIdentity, arrays, {&unit, 1}, quad.planes.target);
    ASSERT_FALSE(refused.ok());
    EXPECT_EQ(refused.error().message,
              "texture-shader stages cannot replace depths of the floating-point and W buffers");
  }
}

// Passes over one preparation that ask for equal depth share their fragments; each culls its own.
TEST(TextureShaderDraws, PassesThatShareFragmentsCullTheirOwn) {
  StageQuad quad;
  quad.planes.target.outputs.clear();
  quad.str = {{-1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {-1, 1, 1}};
  PipelineState nearest;
  nearest.profile = profiles::nv2a;
  nearest.depth_test = {.enabled = true, .function = CompareFunction::less};
  nearest.color_mask = {false, false, false, false};
  PipelineState culls = quad.state;
  culls.texture_shader.stage[0].operation = TextureOperation::cull_fragment;
  culls.program.reset();
  culls.depth_test = {.enabled = true, .function = CompareFunction::equal, .write = false};
  PipelineState all = culls;
  all.texture_shader = {};
  culls.color_mask = {false, true, false, true};
  const VertexArrays arrays = quad.arrays();
  PreparedDraw prepared;
  ASSERT_TRUE(prepare(nearest, kIdentity, arrays, quad.planes.target, prepared).ok());
  for (const bool culls_first : {false, true}) {
    PipelineState first = culls_first ? culls : all, second = culls_first ? all : culls;
    first.color_mask = second.color_mask = {true, true, true, true};
    std::vector<ColorBytes> red(4, ColorBytes{200, 0, 0, 255}), green(4, ColorBytes{0, 200, 0, 255});
    VertexArrays in_red = arrays, in_green = arrays;
    in_red.vertex_colors = red;
    in_green.vertex_colors = green;
    const std::array passes{DrawPass{.state = &nearest, .arrays = arrays}, DrawPass{.state = &first, .arrays = in_red},
                            DrawPass{.state = &second, .arrays = in_green}};
    const ClearValues values{};
    ASSERT_TRUE(rasterize(passes, prepared, {.clear = values}, quad.planes.target).ok());
    const oracle::Picture picture = quad.planes.picture();
    // The left half is culled in one of the passes.
    EXPECT_EQ(picture.color[0], (culls_first ? oracle::Bytes{0, 200, 0, 255} : oracle::Bytes{200, 0, 0, 255}));
    EXPECT_EQ(picture.color[7], (oracle::Bytes{0, 200, 0, 255}));
  }
}

}  // namespace
}  // namespace ninebit::test
