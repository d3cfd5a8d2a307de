// Why pixels are wrong: the article's faults counted, and the rules one by one.
#include <numeric>

#include "combiner_tests/shadow/ground_truth_support.h"
#include "src/shadow/ground_truth/judge.h"

namespace shadow_test {
namespace {

using namespace ninebit;

struct JudgedRoom {
  Rendering rendering;
  GroundTruth truth;
};
JudgedRoom judged_room(const Scene& scene, const RenderSettings& settings) {
  Rendering rendering = render(scene, settings);
  GroundTruth truth = judged(scene, settings, rendering);
  return {std::move(rendering), std::move(truth)};
}

RenderSettings room_settings(int step, IndexScope scope) {
  RenderSettings settings = judged_settings(320, 240);
  settings.index.step = step;
  settings.index.scope = scope;
  return settings;
}

// Every pixel that is wrong has one cause, and no other pixel has any.
void expect_sums(const JudgedRoom& room) {
  const GroundTruth& t = room.truth;
  std::uint64_t false_lit = 0, false_shadowed = 0;
  std::array<std::uint64_t, kErrorCauses> by_cause{};
  for (std::size_t i = 0; i < t.truth.size(); ++i) {
    const bool background = room.rendering.frame.primitive()[i] == 0xFFFFFFFF;
    ASSERT_EQ(t.truth[i] == PixelTruth::background, background);
    const bool lit = room.rendering.frame.stencil()[i] == 0;
    const bool right = background || lit == (t.truth[i] == PixelTruth::lit);
    ASSERT_EQ(t.cause[i] == ErrorCause::none, right) << i;
    if (right) continue;
    ++(lit ? false_lit : false_shadowed);
    ++by_cause[static_cast<std::size_t>(t.cause[i])];
  }
  EXPECT_EQ(t.false_lit, false_lit);
  EXPECT_EQ(t.false_shadowed, false_shadowed);
  EXPECT_EQ(t.by_cause, by_cause);
  std::uint64_t named = 0;
  for (const ErrorCause cause : causes_of(*room.rendering.evidence)) named += count(t, cause);
  EXPECT_EQ(named, false_lit + false_shadowed);
}

TEST(ErrorCauses, ByPolygonWithStepTwoNothingIsTruncated) {
  const Scene scene = index_room();
  const JudgedRoom room = judged_room(scene, room_settings(2, IndexScope::polygon));
  expect_sums(room);
  EXPECT_GT(count(room.truth, ErrorCause::joint), 1000U);
  EXPECT_EQ(count(room.truth, ErrorCause::truncation), 0U);
  EXPECT_EQ(count(room.truth, ErrorCause::shared), 0U);
}

TEST(ErrorCauses, ByPolygonWithStepOneNeighboursAreTruncated) {
  const Scene scene = index_room();
  const JudgedRoom room = judged_room(scene, room_settings(1, IndexScope::polygon));
  expect_sums(room);
  EXPECT_GT(count(room.truth, ErrorCause::truncation), 0U);
  // Each of them is lit though its texel holds another polygon.
  for (std::size_t i = 0; i < room.truth.cause.size(); ++i) {
    if (room.truth.cause[i] != ErrorCause::truncation) continue;
    EXPECT_EQ(room.rendering.frame.stencil()[i], 0);
    EXPECT_NE(room.rendering.evidence->fetched[i], room.rendering.frame.primitive()[i] + 1);
  }
}

TEST(ErrorCauses, ByObjectTheTorusDoesNotShadeItself) {
  const Scene scene = index_room();
  const JudgedRoom room = judged_room(scene, room_settings(2, IndexScope::object));
  expect_sums(room);
  EXPECT_EQ(count(room.truth, ErrorCause::joint), 0U);
  EXPECT_EQ(count(room.truth, ErrorCause::truncation), 0U);
  std::uint64_t on_torus = 0;
  for (std::size_t i = 0; i < room.truth.cause.size(); ++i) {
    if (room.truth.cause[i] != ErrorCause::shared) continue;
    const std::uint32_t object = scene.triangle_object[room.rendering.frame.primitive()[i]];
    on_torus += scene.objects[object].name == "torus" ? 1U : 0U;
    EXPECT_EQ(room.truth.truth[i], PixelTruth::shadowed);
  }
  EXPECT_GT(on_torus, 100U);
}

TEST(ErrorCauses, InATinyMapPolygonsVanish) {
  const Scene scene = index_room();
  RenderSettings settings = room_settings(2, IndexScope::polygon);
  settings.map_size = 16;
  const JudgedRoom room = judged_room(scene, settings);
  expect_sums(room);
  EXPECT_GT(count(room.truth, ErrorCause::vanished), 1000U);
  for (std::size_t i = 0; i < room.truth.cause.size(); ++i) {
    if (room.truth.cause[i] != ErrorCause::vanished) continue;
    EXPECT_FALSE(room.rendering.evidence->in_map[room.rendering.frame.primitive()[i]]);
  }
}

// Floor (triangles 0, 1) and square (2, 3) as one object of an index each, or by depth.
class Rules : public ::testing::Test {
 protected:
  [[nodiscard]] ErrorCause index_cause(bool lit, std::uint32_t own, std::uint32_t fetched,
                                       std::span<const RayCrossing> between = {}) const {
    return cause_of(scene_, index_, {.lit = lit, .own = own, .fetched = fetched, .between = between});
  }
  [[nodiscard]] ErrorCause depth_cause(bool lit, std::uint32_t own, std::uint32_t fetched,
                                       std::span<const RayCrossing> between = {}) const {
    return cause_of(scene_, depth_, {.lit = lit, .own = own, .fetched = fetched, .between = between});
  }
  Scene scene_ = square_over_floor();
  ShadowEvidence index_{.fetched = {0}, .in_map = {true, true, true, false}, .index_of_triangle = {1, 2, 3, 2}};
  ShadowEvidence depth_{.fetched = {0}, .in_map = {true, true, true, true}, .index_of_triangle = {}};
  const std::array<RayCrossing, 2> below_square_{RayCrossing{2, 0.6}, RayCrossing{3, 0.3}};
};

TEST_F(Rules, OfIndicesThatAreLit) {
  EXPECT_EQ(index_cause(true, 0, 3, below_square_), ErrorCause::truncation);
  EXPECT_EQ(index_cause(true, 0, 0, below_square_), ErrorCause::truncation) << "the cleared map has an index, too";
  EXPECT_EQ(index_cause(true, 1, 2, below_square_), ErrorCause::sampling) << "the light sees triangle 2, of index 3";
  const std::array<RayCrossing, 2> from_other_side{RayCrossing{2, 0.3}, RayCrossing{3, 0.6}};
  EXPECT_EQ(index_cause(true, 1, 2, from_other_side), ErrorCause::shared);
  EXPECT_EQ(index_cause(true, 1, 4, from_other_side), ErrorCause::shared);
  EXPECT_EQ(index_cause(true, 1, 2), ErrorCause::sampling);
}

TEST_F(Rules, OfIndicesThatAreShadowed) {
  EXPECT_EQ(index_cause(false, 0, 2), ErrorCause::joint);
  EXPECT_EQ(index_cause(false, 0, 3), ErrorCause::sampling) << "of another object";
  EXPECT_EQ(index_cause(false, 0, 0), ErrorCause::sampling);
  EXPECT_EQ(index_cause(false, 3, 3), ErrorCause::vanished) << "before joint";
}

TEST_F(Rules, OfDepths) {
  EXPECT_EQ(depth_cause(false, 0, 1), ErrorCause::acne);
  EXPECT_EQ(depth_cause(false, 0, 2), ErrorCause::acne);
  EXPECT_EQ(depth_cause(false, 0, 3), ErrorCause::sampling);
  EXPECT_EQ(depth_cause(true, 0, 3, {&below_square_[0], 1}), ErrorCause::detached);
  EXPECT_EQ(depth_cause(true, 0, 4, {&below_square_[0], 1}), ErrorCause::detached) << "beside it";
  EXPECT_EQ(depth_cause(true, 0, 2, below_square_), ErrorCause::sampling);
  EXPECT_EQ(depth_cause(true, 0, 0, below_square_), ErrorCause::sampling);
}

TEST_F(Rules, WithoutAMapThereIsSamplingAlone) {
  EXPECT_EQ(cause_of(scene_, {}, {.lit = true, .own = 0, .fetched = 0, .between = below_square_}),
            ErrorCause::sampling);
  ASSERT_EQ(causes_of({}).size(), 1U);
  EXPECT_EQ(name_of(causes_of({})[0]), "sampling");
}

TEST(ErrorPicture, HasAColourForEachKind) {
  const Scene scene = index_room();
  RenderSettings settings = room_settings(1, IndexScope::polygon);
  settings.layers = true;
  JudgedRoom room = judged_room(scene, settings);
  add_ground_truth(room.rendering, settings, room.truth);
  ASSERT_EQ(room.rendering.pictures.size(), 1U);
  EXPECT_EQ(room.rendering.pictures[0].file, "error.png");
  const Image8& image = room.rendering.pictures[0].image;
  const int width = settings.width, height = settings.height;
  ASSERT_EQ(image.width, width);
  ASSERT_EQ(image.channels, 3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::uint8_t* const p = &image.pixels[static_cast<std::size_t>(((height - 1 - y) * width + x) * 3)];
      const auto i = static_cast<std::size_t>(y * width + x);
      const bool wrong = room.truth.cause[i] != ErrorCause::none;
      const int warmth = p[0] - p[2];
      const int expected = !wrong ? 0 : room.truth.truth[i] == PixelTruth::shadowed ? 1 : -1;
      ASSERT_EQ((warmth > 0) - (warmth < 0), expected) << x << "," << y;
    }
  }
  const auto samples = [&](const std::string& part) {
    for (const Layer& layer : room.rendering.layers) {
      if (layer.part == part) return std::get<std::vector<std::uint8_t>>(layer.samples);
    }
    return std::vector<std::uint8_t>();
  };
  const auto truth = samples("truth"), cause = samples("cause");
  ASSERT_EQ(truth.size(), room.truth.truth.size());
  ASSERT_EQ(cause.size(), room.truth.cause.size());
  for (std::size_t i = 0; i < truth.size(); ++i) {
    ASSERT_EQ(truth[i], static_cast<std::uint8_t>(room.truth.truth[i]));
    ASSERT_EQ(cause[i], static_cast<std::uint8_t>(room.truth.cause[i]));
  }
}

}  // namespace
}  // namespace shadow_test
