// The probe: the very fragments of one pixel, in order, with the registers and the fate that they have in the draw.
#include <gtest/gtest.h>
#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/task_arena.h>

#include <algorithm>

#include "combiner_tests/raster/random_scene.h"
#include "ninebit/combiner/evaluate.h"

namespace ninebit::test {
namespace {

// What the oracle says of one pixel: every fragment there, each drawn alone into a picture of that pixel.
struct Expected {
  std::uint32_t primitive = 0;
  std::int64_t z24 = 0;
  std::uint32_t stored_z24 = 0;
  std::uint8_t stored_stencil = 0;
  FragmentFate fate = FragmentFate::written;
};

std::vector<Expected> expected_at(const RandomDraw& draw, int x, int y, oracle::Picture& pixel) {
  std::vector<Expected> all;
  for (oracle::DrawnTriangle triangle : for_oracle(draw)) {
    for (oracle::WindowVertex& v : triangle.corners) {
      v.x_q4 -= 16 * x;
      v.y_q4 -= 16 * y;
    }
    Expected one{.primitive = triangle.number, .stored_z24 = pixel.depth_z24[0], .stored_stencil = pixel.stencil[0]};
    oracle::Tally tally;
    oracle::draw(draw.state, {triangle}, pixel, tally);
    if (tally.fragments == 0) continue;
    one.z24 = oracle::depth_at(triangle.corners, 0, 0);
    one.fate = tally.alpha_fail > 0     ? FragmentFate::alpha_failed
               : tally.stencil_fail > 0 ? FragmentFate::stencil_failed
               : tally.depth_fail > 0   ? FragmentFate::depth_failed
                                        : FragmentFate::written;
    all.push_back(one);
  }
  return all;
}

oracle::Picture pixel_of(const oracle::Picture& picture, int x, int y) {
  const auto at = static_cast<std::size_t>(y * picture.width + x);
  return {1,
          1,
          {picture.color[at]},
          {picture.depth_z24[at]},
          {picture.stencil[at]},
          {picture.primitive[at]},
          {picture.captured[at]}};
}

TEST(Probe, EveryFragmentMeetsTheFateThatTheOracleTells) {
  constexpr std::uint64_t kSeed = 0x9120BE;
  std::array<std::uint64_t, 4> fates{};
  std::uint64_t lost = 0;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 100U : 1500U); ++index) {
    Random random(kSeed, index);
    const RandomScene scene = random_scene(random);
    const int x = random.below(scene.width), y = random.below(scene.height);
    Canvas watched(scene.width, scene.height, scene.captures), plain(scene.width, scene.height, scene.captures);
    watched.load(scene.start);
    plain.load(scene.start);
    oracle::Picture pixel = pixel_of(scene.start, x, y);
    for (const RandomDraw& draw : scene.draws) {
      const Mesh mesh = for_library(draw, scene.width, scene.height);
      FragmentProbe probe{.x = x, .y = y};
      watched.target.probe = &probe;
      ASSERT_TRUE(rasterize(draw.state, kIdentity, mesh.arrays(), {}, watched.target).ok());
      ASSERT_TRUE(rasterize(draw.state, kIdentity, mesh.arrays(), {}, plain.target).ok());
      const std::vector<Expected> expected = expected_at(draw, x, y, pixel);
      ASSERT_EQ(probe.fragments.size(), expected.size()) << index;
      for (std::size_t i = 0; i < expected.size(); ++i) {
        const ProbedFragment& f = probe.fragments[i];
        ASSERT_EQ(f.primitive, expected[i].primitive);
        ASSERT_EQ(f.z24, expected[i].z24);
        ASSERT_EQ(f.fate, expected[i].fate) << index << '\n' << describe(scene);
        ASSERT_EQ(f.stored_z24, expected[i].stored_z24);
        ASSERT_EQ(f.stored_stencil, expected[i].stored_stencil);
        const DepthTest& depth = draw.state.depth_test;
        ASSERT_EQ(f.depth_passes, !depth.enabled || compare(depth.function, f.z24, f.stored_z24));
        ++fates[static_cast<std::size_t>(f.fate)];
        lost += f.depth_passes && f.fate != FragmentFate::written ? 1U : 0U;
      }
      // The probe changes nothing.
      const oracle::Picture a = watched.picture(), b = plain.picture();
      ASSERT_TRUE(a.color == b.color && a.depth_z24 == b.depth_z24 && a.stencil == b.stencil &&
                  a.primitive == b.primitive && a.captured == b.captured);
      ASSERT_TRUE(watched.padding_is_whole());
    }
  }
  for (const std::uint64_t count : fates) EXPECT_GT(count, 50U);
  EXPECT_GT(lost, 50U);
}

// Registers and colours of a textured draw with a program: what the combiners begin with, and what they make of it.
TEST(Probe, TellsTheRegistersBeforeTheProgram) {
  std::array<std::vector<std::uint8_t>, 3> samples;
  for (std::size_t k = 0; k < 3; ++k) samples[k].assign(6, static_cast<std::uint8_t>(40 * k + 7));
  CubeMap map;
  map.size = 1;
  for (std::size_t f = 0; f < 6; ++f) {
    for (std::size_t k = 0; k < 3; ++k) map.faces[f][k] = {samples[k].data() + f, 1};
  }
  Mesh mesh;
  for (const glm::vec2 p : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1), glm::vec2(-1, 1)}) {
    mesh.add({p, 0.0F});
    mesh.vertex_colors.push_back({11, 22, 33, 44});
    mesh.texture_coordinates.emplace_back(p.x, p.y, 1.0F);
  }
  mesh.add_triangle(0, 1, 2);
  mesh.add_triangle(2, 3, 0);
  PipelineState state;
  state.program = pass_through(Register::texture0, Register::primary);
  state.color_mask = {};  // then the draw itself computes no colour
  Surface surface = Surface::make(100, 80).value();
  RenderTarget target = surface.target();
  FragmentProbe probe{.x = 99, .y = 3};
  target.probe = &probe;
  const std::array<const CubeMap*, 1> textures{&map};
  ASSERT_TRUE(rasterize(state, kIdentity, mesh.arrays(), textures, target).ok());
  ASSERT_EQ(probe.fragments.size(), 1U);
  const ProbedFragment& f = probe.fragments[0];
  EXPECT_EQ(f.primitive, 0U);
  EXPECT_EQ(f.fate, FragmentFate::written);
  EXPECT_EQ(f.registers[Register::primary], (Rgba9{11, 22, 33, 44}));
  EXPECT_EQ(f.registers[Register::texture0], (Rgba9{7, 47, 87, 255}));
  EXPECT_EQ(f.registers[Register::texture1], (Rgba9{0, 0, 0, 255}));
  EXPECT_EQ(f.registers[Register::spare0], (Rgba9{0, 0, 0, 255}));
  EXPECT_EQ(f.color, (std::array<std::uint8_t, 4>{7, 47, 87, 44}));
  const Rgba9 again = evaluate(*state.program, f.registers);
  for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(f.color[k], again[k]);
}

// More triangles than one chunk of the rasterizer takes, many on each pixel.
std::vector<ProbedFragment> probed_by(int threads, int x, int y) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  tbb::task_arena arena(threads);
  FragmentProbe probe{.x = x, .y = y};
  arena.execute([&] {
    Random random(61);
    Mesh mesh;
    for (std::uint32_t i = 0; i < 150000; ++i) {
      const glm::vec3 middle(random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1));
      const double spread = random.one_in(100) ? 1.5 : 0.01;
      for (int k = 0; k < 3; ++k) {
        mesh.add(middle + glm::vec3(random.real_f(-spread, spread), random.real_f(-spread, spread), 0.0F));
        mesh.vertex_colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
      }
      mesh.add_triangle(3 * i, 3 * i + 1, 3 * i + 2);
    }
    Canvas canvas(190, 130);
    canvas.target.probe = &probe;
    PipelineState state;
    state.stencil_test = {.enabled = true,
                          .function = CompareFunction::notequal,
                          .mask = 7,
                          .fail = StencilOperation::incr_wrap,
                          .depth_fail = StencilOperation::decr_wrap,
                          .depth_pass = StencilOperation::invert};
    state.alpha_test = {true, CompareFunction::greater, 60};
    state.depth_test = {true, CompareFunction::notequal, true};
    state.program = pass_through(Register::primary, Register::primary);
    // The planes are not cleared before: as they are, they are the first that the probe meets.
    std::fill_n(canvas.target.depth_z24.row(0), 190, 0x800000U);
    EXPECT_TRUE(rasterize(state, kIdentity, mesh.arrays(), {}, canvas.target).ok());
    // The last fragment that was written is what the planes hold.
    const auto last = std::find_if(probe.fragments.rbegin(), probe.fragments.rend(),
                                   [](const ProbedFragment& f) { return f.fate == FragmentFate::written; });
    ASSERT_NE(last, probe.fragments.rend());
    EXPECT_EQ(canvas.target.depth_z24.at(x, y), last->z24);
    EXPECT_EQ(canvas.target.primitive.at(x, y), last->primitive);
    for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(canvas.target.color[k].at(x, y), last->color[k]);
  });
  return std::move(probe.fragments);
}

TEST(Probe, AnyNumberOfThreadsTellsTheSame) {
  for (const auto& [x, y] : {std::pair(0, 0), std::pair(64, 63), std::pair(150, 100)}) {
    const std::vector<ProbedFragment> one = probed_by(1, x, y);
    EXPECT_GT(one.size(), 30U);
    EXPECT_TRUE(std::is_sorted(one.begin(), one.end(), [](const ProbedFragment& a, const ProbedFragment& b) {
      return a.primitive < b.primitive;
    }));
    EXPECT_GT(one.back().primitive, 140000U);
    for (const int threads : {2, 7}) EXPECT_TRUE(probed_by(threads, x, y) == one) << threads;
  }
}

TEST(Probe, OutsideOfTheTargetIsAFault) {
  Surface surface = Surface::make(9, 7).value();
  RenderTarget target = surface.target();
  for (const auto& [x, y] : {std::pair(-1, 0), std::pair(0, -1), std::pair(9, 0), std::pair(0, 7)}) {
    FragmentProbe probe{.x = x, .y = y};
    target.probe = &probe;
    const Status status = rasterize({}, kIdentity, {}, {}, target);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("probe's pixel (" + std::to_string(x)), std::string::npos);
  }
}

}  // namespace
}  // namespace ninebit::test
