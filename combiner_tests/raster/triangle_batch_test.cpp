// Triangles and vertices set up several at a time, on every SIMD target: against the oracle, and against the code that
// sets them up one by one.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <random>

#include "combiner_tests/combiner/simd_targets.h"
#include "combiner_tests/raster/support.h"
#include "combiner_tests/support/special_floats.h"
#include "src/raster/draw/primitive_setup.h"
#include "src/raster/setup/clip.h"

namespace ninebit::test {
namespace {

// A draw's setup, with or without packed vertices.
class DrawSetup {
 public:
  DrawSetup(const PipelineState& state, const PixelBox& drawn, const glm::mat4& matrix, const VertexArrays& arrays,
            int width, int height, bool packed, bool corners = true)
      : grid_(width, height),
        context_(state, PixelRect{0, 0, width, height}, drawn, DepthStencilFormat::d24s8, corners),
        assembly_(arrays),
        clip_(matrix, arrays) {
    if (packed) {
      vertices_.resize(arrays.positions.size());
      transform_vertices(clip_, context_.window, vertices_.data());
    }
    setup_.emplace(context_, assembly_, clip_, vertices_);
  }
  DrawSetup(const DrawSetup&) = delete;
  DrawSetup& operator=(const DrawSetup&) = delete;

  [[nodiscard]] std::size_t items() const { return setup_->items(); }
  // Appends the range to what is there.
  void run(std::size_t begin, std::size_t end) { ASSERT_TRUE(setup_->set_up(begin, end, grid_, block)); }

  BinnedBlock block;

 private:
  TileGrid grid_;
  SetupContext context_;
  PrimitiveAssembly assembly_;
  ClipPositions clip_;
  RawVector<PackedVertex> vertices_;
  std::optional<PrimitiveSetup> setup_;
};

oracle::WindowTriangle window_of(const SetupPrimitive& p) {
  oracle::WindowTriangle t;
  for (std::size_t k = 0; k < 3; ++k) t[k] = {p.x_q4()[k], p.y_q4()[k], static_cast<std::int64_t>(p.z24[k])};
  return t;
}

// A triangle's pixels, found centre by centre within its corners.
struct Coverage {
  int pixels = 0;
  PixelBox box{1 << 20, 1 << 20, 0, 0};  // around them
};
Coverage coverage_of(const oracle::WindowTriangle& t, const PixelBox& drawn) {
  const auto [low_x, high_x] = std::minmax({t[0].x_q4, t[1].x_q4, t[2].x_q4});
  const auto [low_y, high_y] = std::minmax({t[0].y_q4, t[1].y_q4, t[2].y_q4});
  const auto pixel = [](std::int64_t q4, int low, int high) {
    return static_cast<int>(std::clamp<std::int64_t>(q4 >> 4, low, high));
  };
  Coverage c;
  for (int y = pixel(low_y, drawn.bottom, drawn.top); y < pixel(high_y + 16, drawn.bottom, drawn.top); ++y) {
    for (int x = pixel(low_x, drawn.left, drawn.right); x < pixel(high_x + 16, drawn.left, drawn.right); ++x) {
      if (!oracle::covers(t, x, y)) continue;
      ++c.pixels;
      c.box = {std::min(c.box.left, x), std::min(c.box.bottom, y), std::max(c.box.right, x + 1),
               std::max(c.box.top, y + 1)};
    }
  }
  return c;
}

bool holds(const PixelBox& outer, const PixelBox& inner) {
  return outer.left <= inner.left && outer.bottom <= inner.bottom && outer.right >= inner.right &&
         outer.top >= inner.top;
}

// Of a primitive, whose box has its last pixels in it.
PixelBox box_of(const SetupPrimitive& p) {
  return {p.box.left, p.box.bottom, p.box.right + 1, p.box.top + 1};
}

// Corners on places that matter around the centre (24, 24): on it, on its neighbours' and beside them.
constexpr std::array kPlaces{8, 13, 23, 24, 25, 38, 40};
constexpr int kBatchWindow = 3;

struct SmallTriangles {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> indices;
  std::vector<oracle::WindowVertex> vertices;
};

// All triangles of three such corners, of both windings and degenerate ones.
SmallTriangles all_small_triangles(std::uint64_t seed) {
  SmallTriangles t;
  Random random(seed);
  for (const int y : kPlaces) {
    for (const int x : kPlaces) {
      const int z = random.one_in(3) ? random.pick({0, 1, 0xFFFFFE, 0xFFFFFF}) : random.below(1 << 24);
      t.vertices.push_back({x, y, z});
      t.positions.push_back(clip_position(t.vertices.back(), kBatchWindow, kBatchWindow));
    }
  }
  const auto count = static_cast<std::uint32_t>(t.vertices.size());
  for (std::uint32_t a = 0; a < count; ++a) {
    for (std::uint32_t b = 0; b < count; ++b) {
      for (std::uint32_t c = 0; c < count; ++c) t.indices.insert(t.indices.end(), {a, b, c});
    }
  }
  return t;
}

// How often there was what a test is about.
struct Found {
  int pixels = 0, uncovered = 0, several = 0;
};

void compare_small(const SmallTriangles& t, const std::vector<Coverage>& covered, const PixelBox& drawn, CullFace cull,
                   const BinnedBlock& block, Found& found) {
  std::size_t next = 0;
  for (std::size_t i = 0; i < covered.size(); ++i) {
    oracle::WindowTriangle triangle;
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = t.vertices[t.indices[3 * i + k]];
    const std::int64_t area = (triangle[1].x_q4 - triangle[0].x_q4) * (triangle[2].y_q4 - triangle[0].y_q4) -
                              (triangle[1].y_q4 - triangle[0].y_q4) * (triangle[2].x_q4 - triangle[0].x_q4);
    const bool culled = cull == CullFace::back ? area < 0 : cull == CullFace::front && area > 0;
    const Coverage c = culled ? Coverage{} : covered[i];
    const bool is_there = next < block.setup.primitives.size() && block.setup.primitives[next].primitive == i;
    if (c.pixels == 0) ++found.uncovered;
    if (!is_there) {
      ASSERT_EQ(c.pixels, 0) << "triangle " << i << " is missing";
      continue;
    }
    const SetupPrimitive& p = block.setup.primitives[next++];
    ASSERT_EQ(p.front_facing, area > 0) << i;
    const PixelBox box = box_of(p);
    if (c.pixels == 1 && p.kind == SetupKind::pixel) {
      ++found.pixels;
      ASSERT_TRUE(holds(box, c.box) && holds(c.box, box)) << i;
      for (const std::uint32_t z : p.z24) ASSERT_EQ(z, oracle::depth_at(triangle, c.box.left, c.box.bottom)) << i;
      continue;
    }
    ASSERT_EQ(p.kind, SetupKind::triangle) << i;
    // Boxes of up to 2 × 2 centres leave nothing to look for.
    if (box.right - box.left <= 2 && box.top - box.bottom <= 2) {
      ASSERT_GE(c.pixels, 2) << i;
    }
    found.several += c.pixels > 1 ? 1 : 0;
    ASSERT_TRUE(holds(drawn, box) && (c.pixels == 0 || holds(box, c.box))) << i;
  }
  ASSERT_EQ(next, block.setup.primitives.size());
}

TEST(TriangleBatch, SmallTrianglesAreDecidedAsTheOracleDecides) {
  const SmallTriangles t = all_small_triangles(5);
  const VertexArrays arrays{.positions = t.positions, .indices = t.indices};
  Found found;
  for (const PixelBox& drawn : {PixelBox{0, 0, 3, 3}, PixelBox{1, 1, 2, 2}, PixelBox{1, 0, 3, 2}}) {
    std::vector<Coverage> covered;
    for (std::size_t i = 0; i < t.indices.size(); i += 3) {
      covered.push_back(
          coverage_of({t.vertices[t.indices[i]], t.vertices[t.indices[i + 1]], t.vertices[t.indices[i + 2]]}, drawn));
    }
    for (const CullFace cull : {CullFace::none, CullFace::back, CullFace::front}) {
      PipelineState state;
      state.cull_face = cull;
      for (const std::int64_t target : simd_targets()) {
        const OnTarget on(target);
        DrawSetup setup(state, drawn, kIdentity, arrays, kBatchWindow, kBatchWindow, true);
        setup.run(0, setup.items());
        compare_small(t, covered, drawn, cull, setup.block, found);
        ASSERT_FALSE(HasFatalFailure()) << simd_target_name(target);
        EXPECT_TRUE(on.ran());
      }
    }
  }
  const int targets = static_cast<int>(simd_targets().size());
  EXPECT_GT(found.pixels, 10000 * targets);
  EXPECT_GT(found.several, 5000 * targets);
  EXPECT_GT(found.uncovered, 10000 * targets);
}

// A position of any kind: in view, at a plane or side of the view volume, far beyond, not finite, behind the eye.
float any_number(Random& random) {
  switch (random.below(8)) {
    case 0:
      return random.pick({0.0F, -0.0F, 1.0F, -1.0F, 1e-30F, 1e-45F, 0x1p-80F, 0x1p-81F});
    case 1:
      return random.pick({1e30F, -1e30F, 3e38F, -3e38F, kInfinity, -kInfinity, std::nanf("")});
    case 2:
      return random.real_f(-50, 50);
    default:
      return random.real_f(-1.1, 1.1);
  }
}

struct AnyVertices {
  glm::mat4 matrix{1.0F};
  std::vector<glm::vec3> positions;
};
AnyVertices any_vertices(Random& random, std::size_t count) {
  AnyVertices v;
  if (random.one_in(2)) v.matrix = perspective(0.8, 1.3, 0.1, 10);
  if (random.one_in(4)) {
    for (int i = 0; i < 16; ++i) v.matrix[i / 4][i % 4] = any_number(random);
  }
  const bool tame = random.one_in(2), fine = random.one_in(2);
  for (std::size_t i = 0; i < count; ++i) {
    glm::vec3 p(random.real_f(-2, 2), random.real_f(-2, 2), random.real_f(-6, 1));
    if (tame) p = {random.real_f(-0.8, 0.8), random.real_f(-0.8, 0.8), random.real_f(-1, -0.5)};
    if (!tame && random.one_in(3)) p = {any_number(random), any_number(random), any_number(random)};
    if (!v.positions.empty() && (fine ? !random.one_in(30) : random.one_in(2))) {
      p = v.positions.back() + glm::vec3(0.02F * p.x, 0.02F * p.y, 0.01F * (p.z + 0.75F));
    }
    v.positions.push_back(p);
  }
  return v;
}

PipelineState any_state(Random& random) {
  PipelineState state;
  state.profile.subpixel_bits.value = random.one_in(3) ? random.below(5) : 4;
  state.cull_face = random.pick({CullFace::none, CullFace::front, CullFace::back, CullFace::front_and_back});
  state.front_face = random.one_in(2) ? FrontFace::clockwise : FrontFace::counter_clockwise;
  if (random.one_in(2)) state.cull_face = CullFace::none;
  if (random.one_in(3)) {
    state.polygon_offset = {.fill = true, .factor = random.real_f(-40, 40), .units = random.real_f(-900, 900)};
    if (random.one_in(4)) state.polygon_offset.factor = random.pick({1e30F, -1e30F, 0.0F});
    if (random.one_in(2)) state.profile.polygon_offset_slope.value = OffsetSlope::root;
    if (random.one_in(2)) state.profile.polygon_offset_fraction.value = OffsetFraction::rounded;
  }
  if (random.one_in(3)) {
    state.depth_near = random.real_f(-0.2, 1.2);
    state.depth_far = random.real_f(-0.2, 1.2);
  }
  return state;
}

TEST(TriangleBatch, VerticesAreTransformedAsOneByOne) {
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on(target);
    int plain = 0, beyond = 0, care = 0;
    for (std::uint64_t index = 0; index < (kSlowBuild ? 40U : 400U); ++index) {
      Random random(0x7A45F, index);
      const AnyVertices v = any_vertices(random, static_cast<std::size_t>(random.between(1, 300)));
      const DepthStencilFormat format =
          random.pick({DepthStencilFormat::d24s8, DepthStencilFormat::d16, DepthStencilFormat::d15s1});
      const PixelRect viewport{random.below(900), random.below(900), random.between(1, 16384 - 900),
                               random.between(1, 16384 - 900)};
      const WindowTransform window(any_state(random), viewport, format);
      const GuardBand guard{window.guard_x(), window.guard_y()};
      std::vector<glm::vec4> homogeneous;
      for (const glm::vec3& p : v.positions) homogeneous.emplace_back(p, random.pick({0.0F, 0.0F, 1.0F, 0.3F, -2.0F}));
      VertexArrays arrays;
      if (index % 2 == 0) {
        arrays.positions = v.positions;
      } else {
        arrays.homogeneous_positions = homogeneous;
      }
      const ClipPositions clip(v.matrix, arrays);
      std::vector<PackedVertex> packed(v.positions.size() + 1, PackedVertex{77, 77, 77, 77});
      transform_vertices(clip, window, packed.data());
      for (std::size_t i = 0; i < v.positions.size(); ++i) {
        const glm::vec4 p = clip[i];
        const std::optional<unsigned> crossed = crossed_planes(std::array<glm::vec4, 3>{p, p, p}, guard);
        const int code = packed[i].x_q4_and_code & ((1 << kCodeBits) - 1);
        if ((code & kBeyondAny) != 0) {
          ++beyond;
          ASSERT_FALSE(crossed.has_value()) << index << ' ' << i;
        }
        if ((code & kNeedsCare) != 0) {
          ++care;
          ASSERT_FALSE(crossed.has_value() && p.w >= kSmallestW && std::fabs(p.x) < 0.99F * p.w && p.w < 1e20F &&
                       std::fabs(p.y) < 0.99F * p.w && std::fabs(p.z) <= p.w)
              << index << ' ' << i << ": " << p.x << ' ' << p.y << ' ' << p.z << ' ' << p.w;
          continue;
        }
        // Beyond a side crossed_planes says nothing of the guard band.
        ASSERT_TRUE(std::fabs(static_cast<double>(p.x)) <= static_cast<double>(guard.x) * static_cast<double>(p.w) &&
                    std::fabs(static_cast<double>(p.y)) <= static_cast<double>(guard.y) * static_cast<double>(p.w) &&
                    std::fabs(p.z) <= p.w && p.w >= kSmallestW);
        ++plain;
        const WindowVertex expected = window(p);
        ASSERT_EQ(packed[i].x_q4_and_code >> kCodeBits, expected.x_q4) << index << ' ' << i;
        ASSERT_EQ(packed[i].y_q4, expected.y_q4) << index << ' ' << i;
        ASSERT_EQ(static_cast<std::uint32_t>(packed[i].z24), expected.z24) << index << ' ' << i;
        ASSERT_EQ(packed[i].inv_w_bits, std::bit_cast<std::int32_t>(expected.inv_w)) << index << ' ' << i;
      }
      ASSERT_EQ(packed.back().z24, 77) << "wrote beyond the end";
    }
    EXPECT_TRUE(on.ran()) << simd_target_name(target);
    EXPECT_GT(plain, 5000 / (kSlowBuild ? 10 : 1));
    EXPECT_GT(beyond, 5000 / (kSlowBuild ? 10 : 1));
    EXPECT_GT(care, 5000 / (kSlowBuild ? 10 : 1));
  }
}

void compare_corners(const SetupBlock& block, const SetupCorners& c, const SetupBlock& other,
                     const SetupCorners& expected) {
  for (std::size_t k = 0; k < 3; ++k) {
    ASSERT_EQ(std::bit_cast<std::uint32_t>(c.inv_w[k]), std::bit_cast<std::uint32_t>(expected.inv_w[k]));
  }
  ASSERT_EQ(c.corner, expected.corner);
  ASSERT_EQ(c.vertex, expected.vertex);
  const glm::mat3 *weights = block.weights_of(c), *other_weights = other.weights_of(expected);
  ASSERT_EQ(weights == nullptr, other_weights == nullptr);
  if (weights != nullptr) {
    ASSERT_EQ(*weights, *other_weights);
  }
}

// The primitives of both, but for what covers nothing, and for boxes.
void compare_blocks(const SetupBlock& batch, const SetupBlock& single, const PixelBox& drawn) {
  std::size_t next = 0;
  for (const SetupPrimitive& expected : single.primitives) {
    const bool is_there = next < batch.primitives.size() && batch.primitives[next].primitive == expected.primitive &&
                          batch.primitives[next].position.word == expected.position.word;
    const PixelBox box = box_of(expected);
    const bool is_small = box.right - box.left <= 2 && box.top - box.bottom <= 2;
    const Coverage c = is_small || !is_there ? coverage_of(window_of(expected), drawn) : Coverage{};
    if (!is_there) {
      ASSERT_EQ(c.pixels, 0) << "primitive " << expected.primitive << " is missing";
      continue;
    }
    const SetupPrimitive& p = batch.primitives[next++];
    ASSERT_EQ(p.front_facing, expected.front_facing);
    ASSERT_EQ(p.offset_z24, expected.offset_z24);
    ASSERT_EQ(p.fraction, expected.fraction);
    if (!single.corners.empty()) compare_corners(batch, batch.corners_of(p), single, single.corners_of(expected));
    if (p.kind == SetupKind::pixel) {
      ASSERT_EQ(c.pixels, 1);
      // With the offset's fraction, in 1/65536.
      oracle::WindowTriangle finer = window_of(expected);
      for (auto& v : finer) v.z24 = 65536 * v.z24 + expected.fraction;
      for (const std::uint32_t z : p.z24) ASSERT_EQ(z, oracle::depth_at(finer, c.box.left, c.box.bottom) / 65536);
    } else {
      ASSERT_EQ(p.kind, expected.kind);
      ASSERT_EQ(p.z24, expected.z24);
      if (!is_small) {
        ASSERT_EQ(std::memcmp(&p.box, &expected.box, sizeof p.box), 0);
      }
    }
  }
  ASSERT_EQ(next, batch.primitives.size());
}

TEST(TriangleBatch, PositionsArePackedExactly) {
  constexpr int kLeast = -(1 << 19), kMost = (1 << 19) - 1;
  std::mt19937 random(3);
  std::uniform_int_distribution<int> any(kLeast, kMost), few(0, 5);
  const auto value = [&] {
    constexpr std::array kEdges{kLeast, -4097, -1, 0, 4095, kMost};
    return few(random) == 0 ? kEdges[static_cast<std::size_t>(few(random))] : any(random);
  };
  for (int run = 0; run < 20000; ++run) {
    std::array<std::array<int, 2>, 3> corner{};
    SetupPrimitive p{};
    for (std::size_t i = 0; i < 3; ++i) {
      corner[i] = {value(), value()};
      p.position.set(i, corner[i][0], corner[i][1]);
    }
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_EQ(p.x_q4()[i], corner[i][0]);
      ASSERT_EQ(p.y_q4()[i], corner[i][1]);
    }
  }
}

// Long runs beyond a side of the view, of which now and then one vertex reaches into it.
TEST(TriangleBatch, RunsBeyondASideHideNoTriangle) {
  constexpr int kWidth = 150, kHeight = 100;
  constexpr PixelBox kDrawn{0, 0, kWidth, kHeight};
  for (const std::int64_t target : simd_targets()) {
    const OnTarget on(target);
    std::size_t drawn = 0;
    for (std::uint64_t index = 0; index < (kSlowBuild ? 12U : 120U); ++index) {
      Random random(0xBE9, index);
      const bool is_indexed = random.one_in(2), repeats = random.one_in(2);
      const int count = random.between(800, 2400);
      std::vector<glm::vec3> positions;
      std::vector<std::uint32_t> indices;
      const glm::vec3 beyond = random.pick({glm::vec3(-3, 0, 0), glm::vec3(3, 0, 0), glm::vec3(0, -3, 0),
                                            glm::vec3(0, 3, 0), glm::vec3(0, 0, -3), glm::vec3(0, 0, 3)});
      for (int i = 0; i < count; ++i) {
        const glm::vec3 near(random.real_f(-0.9, 0.9), random.real_f(-0.9, 0.9), random.real_f(-0.9, 0.9));
        positions.push_back(random.one_in(600) ? near : near + beyond);
        if (is_indexed)
          indices.push_back(static_cast<std::uint32_t>(repeats && random.one_in(2) ? random.below(i + 1) : i));
      }
      const VertexArrays arrays{
          .type = random.pick({PrimitiveType::triangles, PrimitiveType::triangle_strip, PrimitiveType::triangle_fan}),
          .positions = positions,
          .indices = indices};
      DrawSetup batch({}, kDrawn, kIdentity, arrays, kWidth, kHeight, true);
      DrawSetup single({}, kDrawn, kIdentity, arrays, kWidth, kHeight, false);
      batch.run(0, batch.items());
      single.run(0, single.items());
      compare_blocks(batch.block.setup, single.block.setup, kDrawn);
      ASSERT_FALSE(HasFatalFailure()) << simd_target_name(target) << ", case " << index;
      drawn += batch.block.setup.primitives.size();
    }
    EXPECT_TRUE(on.ran()) << simd_target_name(target);
    EXPECT_GT(drawn, kSlowBuild ? 10U : 100U);
  }
}

// Degenerate, huge and not finite positions among others, in ranges of any length.
TEST(TriangleBatch, AnyTrianglesAreSetUpAsOneByOne) {
  constexpr int kWidth = 150, kHeight = 100;
  const TileGrid grid(kWidth, kHeight);
  std::size_t pixels = 0, triangles = 0, clipped = 0;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 60U : 600U); ++index) {
    Random random(0x5E70B, index);
    const AnyVertices v = any_vertices(random, static_cast<std::size_t>(random.between(3, 200)));
    const int vertices = static_cast<int>(v.positions.size());
    std::vector<std::uint32_t> indices;
    if (random.one_in(2)) {
      const int count = random.between(3, 300);
      const int reach = random.one_in(4) ? vertices : 3;
      for (int i = 0; i < count; ++i) {
        const int first = indices.empty() ? 0 : static_cast<int>(indices.back());
        indices.push_back(static_cast<std::uint32_t>((first + random.below(reach)) % vertices));
      }
    }
    const PipelineState state = any_state(random);
    const VertexArrays arrays{
        .type = random.pick({PrimitiveType::triangles, PrimitiveType::triangle_strip, PrimitiveType::triangle_fan}),
        .positions = v.positions,
        .indices = indices};
    const PixelBox drawn = random.one_in(2) ? PixelBox{0, 0, kWidth, kHeight} : PixelBox{31, 20, 97, 71};
    const bool corners = !random.one_in(4);
    DrawSetup single(state, drawn, v.matrix, arrays, kWidth, kHeight, false, corners);
    single.run(0, single.items());
    for (const std::int64_t target : simd_targets()) {
      const OnTarget on(target);
      DrawSetup batch(state, drawn, v.matrix, arrays, kWidth, kHeight, true, corners);
      const std::size_t cut = static_cast<std::size_t>(random.below(static_cast<int>(batch.items()) + 1));
      batch.run(0, cut);
      batch.run(cut, batch.items());
      EXPECT_TRUE(on.ran()) << simd_target_name(target);
      const SetupBlock& block = batch.block.setup;
      compare_blocks(block, single.block.setup, drawn);
      ASSERT_FALSE(HasFatalFailure()) << simd_target_name(target) << ", case " << index;
      ASSERT_EQ(batch.block.tile.size(), block.primitives.size());
      ASSERT_EQ(block.corners.size(), corners ? block.primitives.size() : 0);
      for (std::size_t i = 0; i < block.primitives.size(); ++i) {
        const PixelBounds& box = block.primitives[i].box;
        const std::uint32_t low = grid.tile_of(box.left, box.bottom), high = grid.tile_of(box.right, box.top);
        ASSERT_EQ(batch.block.tile[i], low == high ? low : kSeveralTiles);
        const bool is_pixel = block.primitives[i].kind == SetupKind::pixel;
        pixels += is_pixel ? 1U : 0U;
        if (!corners) continue;
        const bool is_clipped = block.corners[i].weights != kNoWeights;
        clipped += is_clipped ? 1U : 0U;
        triangles += !is_pixel && !is_clipped ? 1U : 0U;
      }
    }
  }
  const std::size_t least = (kSlowBuild ? 50 : 1000) * simd_targets().size();
  EXPECT_GT(pixels, least / 2);
  EXPECT_GT(triangles, least);
  EXPECT_GT(clipped, least);
}

}  // namespace
}  // namespace ninebit::test
