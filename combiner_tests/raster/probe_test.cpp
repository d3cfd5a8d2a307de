// The probe: the very fragments of one pixel, in order, with the registers and the fate that they have in the draw.
#include <gtest/gtest.h>

#include <algorithm>

#include "combiner_tests/raster/fragment_support.h"
#include "combiner_tests/raster/in_threads.h"
#include "combiner_tests/raster/random_scene.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/prepared_draw.h"

namespace ninebit::test {
namespace {

// A draw cut into its primitives where they share no vertices of the list; strips, fans and the like stay whole.
std::vector<oracle::DrawCall> primitives_of(const oracle::DrawCall& call) {
  const std::size_t vertices = call.type == oracle::Primitive::points      ? 1
                               : call.type == oracle::Primitive::lines     ? 2
                               : call.type == oracle::Primitive::triangles ? 3
                               : call.type == oracle::Primitive::quads     ? 4
                                                                           : 0;
  if (vertices == 0) return {call};
  std::vector<oracle::DrawCall> all;
  for (std::size_t first = 0; first + vertices <= call.vertices.size(); first += vertices) {
    oracle::DrawCall& one =
        all.emplace_back(oracle::DrawCall{.type = call.type, .vertices = {}, .primitive_colors = {}});
    const auto begin = call.vertices.begin() + static_cast<std::ptrdiff_t>(first);
    one.vertices.assign(begin, begin + static_cast<std::ptrdiff_t>(vertices));
    if (!call.primitive_colors.empty()) one.primitive_colors = {call.primitive_colors[first / vertices]};
  }
  return all;
}

// The state with a scissor that leaves this pixel, or nothing where its own leaves out the pixel.
PipelineState at_pixel(PipelineState state, int x, int y) {
  const PixelRect own = state.scissor.value_or(PixelRect{0, 0, kMaxSurfaceSize, kMaxSurfaceSize});
  const bool inside = x >= own.x && x < own.x + own.width && y >= own.y && y < own.y + own.height;
  state.scissor = inside ? PixelRect{x, y, 1, 1} : PixelRect{};
  return state;
}

struct ProbesSeen {
  std::array<std::uint64_t, 4> fates{};
  std::uint64_t lost = 0;  // fragments that passed the depth test in vain
};

// One primitive's fragments at the pixel, from `next` on: as many of each fate as the oracle counts.
void compare_primitive(const oracle::Tally& tally, const RandomDraw& draw, const FragmentProbe& probe,
                       std::size_t& next, ProbesSeen& seen) {
  ASSERT_LE(next + tally.fragments, probe.fragments.size());
  std::array<std::uint64_t, 4> fates{};
  for (std::uint64_t i = 0; i < tally.fragments; ++i, ++next) {
    const ProbedFragment& f = probe.fragments[next];
    ++fates[static_cast<std::size_t>(f.fate)];
    const DepthTest& depth = draw.state.depth_test;
    ASSERT_EQ(f.depth_passes, !depth.enabled || compare(depth.function, f.depth, f.stored_depth));
    seen.lost += f.depth_passes && f.fate != FragmentFate::written ? 1U : 0U;
  }
  ASSERT_EQ(fates, (std::array{tally.alpha_fail, tally.stencil_fail, tally.depth_fail, tally.drawn}));
  for (std::size_t i = 0; i < 4; ++i) seen.fates[i] += fates[i];
}

void compare_draw(const RandomDraw& draw, int x, int y, const FragmentProbe& probe, oracle::Picture& picture,
                  ProbesSeen& seen) {
  const auto at = static_cast<std::size_t>(y * picture.width + x);
  const PipelineState state = at_pixel(draw.state, x, y);
  const std::vector<oracle::DrawCall> primitives = primitives_of(for_oracle(draw));
  std::size_t next = 0;
  for (std::size_t i = 0; i < primitives.size(); ++i) {
    const std::uint32_t depth = picture.depth[at];
    const std::uint8_t stencil = stencil_bits(picture.format) > 0 ? picture.stencil[at] : std::uint8_t{0};
    oracle::Tally tally;
    oracle::draw(state, primitives[i], picture, tally);
    if (tally.fragments > 0 && next < probe.fragments.size()) {
      const ProbedFragment& first = probe.fragments[next];
      ASSERT_TRUE(primitives.size() == 1 || first.primitive == i) << i;
      ASSERT_EQ(first.stored_depth, depth);
      ASSERT_EQ(first.stored_stencil, stencil);
    }
    compare_primitive(tally, draw, probe, next, seen);
  }
  ASSERT_EQ(next, probe.fragments.size());
}

TEST(Probe, EveryFragmentMeetsTheFateThatTheOracleTells) {
  constexpr std::uint64_t kProbeSeed = 0x9120BE;
  ProbesSeen seen;
  for (std::uint64_t index = 0; index < (kSlowBuild ? 200U : 3000U); ++index) {
    Random random(kProbeSeed, index);
    const RandomScene scene = random_scene(random);
    const int x = random.below(scene.width), y = random.below(scene.height);
    PicturePlanes watched(scene.start, scene.captures), plain(scene.start, scene.captures);
    oracle::Picture picture = scene.start;
    for (const RandomDraw& draw : scene.draws) {
      const LibraryDraw library = for_library(draw, scene.width, scene.height);
      std::vector<FragmentProbe> probes{{.x = x, .y = y}};
      watched.target.probes = &probes;
      ASSERT_TRUE(rasterize(draw.state, kIdentity, library.arrays, {}, watched.target).ok());
      ASSERT_TRUE(rasterize(draw.state, kIdentity, library.arrays, {}, plain.target).ok());
      compare_draw(draw, x, y, probes[0], picture, seen);
      if (HasFatalFailure()) FAIL() << index << '\n' << describe(scene);
      // The probe changes nothing.
      ASSERT_TRUE(same_samples(watched.picture(), plain.picture()));
    }
  }
  if (kSlowBuild) return;
  for (const std::uint64_t count : seen.fates) EXPECT_GT(count, 50U);
  EXPECT_GT(seen.lost, 50U);
}

// Registers and colours of a textured draw with a program: what the combiners begin with, and what they make of it.
TEST(Probe, TellsTheRegistersBeforeTheProgram) {
  const std::array<std::uint8_t, 3> samples{7, 47, 87};
  std::array<Plane<const std::uint8_t>, 4> planes;
  for (std::size_t k = 0; k < 3; ++k) planes[k] = {&samples[k], 1};
  const std::vector<TextureImage> faces(6, TextureImage{1, 1, planes});
  const Texture map = texture_view(InternalFormat::rgb8, faces);
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
  std::vector<FragmentProbe> probes{{.x = 99, .y = 3}};
  target.probes = &probes;
  const std::array<TextureUnit, 1> units{TextureUnit{&map, kNearestSampler}};
  ASSERT_TRUE(rasterize(state, kIdentity, mesh.arrays(), units, target).ok());
  ASSERT_EQ(probes[0].fragments.size(), 1U);
  const ProbedFragment& f = probes[0].fragments[0];
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
std::vector<FragmentProbe> probed_by(int threads, std::vector<FragmentProbe> probes) {
  with_threads(threads, [&] {
    Random random(61);
    Mesh mesh;
    for (std::uint32_t i = 0; i < 200000; ++i) {
      const glm::vec3 middle(random.real_f(-1, 1), random.real_f(-1, 1), random.real_f(-1, 1));
      const double spread = random.one_in(100) ? 1.5 : 0.01;
      for (int k = 0; k < 3; ++k) {
        mesh.add(middle + glm::vec3(random.real_f(-spread, spread), random.real_f(-spread, spread), 0.0F));
        mesh.vertex_colors.push_back({random.byte(), random.byte(), random.byte(), random.byte()});
      }
      mesh.add_triangle(3 * i, 3 * i + 1, 3 * i + 2);
    }
    Canvas canvas(190, 130);
    canvas.target.probes = &probes;
    PipelineState state;
    state.stencil_test.enabled = true;
    state.stencil_test.front = {.function = CompareFunction::notequal,
                                .mask = 7,
                                .fail = StencilOperation::incr_wrap,
                                .depth_fail = StencilOperation::decr_wrap,
                                .depth_pass = StencilOperation::invert};
    state.alpha_test = {true, CompareFunction::greater, 60};
    state.depth_test = {true, CompareFunction::notequal, true};
    state.program = pass_through(Register::primary, Register::primary);
    // The planes are not cleared before: as they are, they are the first that the probe meets.
    std::fill_n(canvas.target.depth.row(0), 190, 0x800000U);
    EXPECT_TRUE(rasterize(state, kIdentity, mesh.arrays(), {}, canvas.target).ok());
    // The last fragment that was written is what the planes hold.
    for (const FragmentProbe& probe : probes) {
      const auto last = std::find_if(probe.fragments.rbegin(), probe.fragments.rend(),
                                     [](const ProbedFragment& f) { return f.fate == FragmentFate::written; });
      ASSERT_NE(last, probe.fragments.rend());
      EXPECT_EQ(canvas.target.depth.at(probe.x, probe.y), last->depth);
      EXPECT_EQ(canvas.picture().primitive[static_cast<std::size_t>(probe.y * 190 + probe.x)], last->primitive);
      for (std::size_t k = 0; k < 4; ++k) EXPECT_EQ(canvas.target.color[k].at(probe.x, probe.y), last->color[k]);
    }
  });
  return probes;
}

TEST(Probe, AnyNumberOfThreadsTellsTheSame) {
  if (kSanitized && !kThreadSanitizer)
    GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  // Two of them in one tile, and one pixel twice.
  const std::vector<FragmentProbe> watched{
      {.x = 150, .y = 100}, {.x = 0, .y = 0}, {.x = 64, .y = 63}, {.x = 66, .y = 63}, {.x = 0, .y = 0}};
  const std::vector<FragmentProbe> together = probed_by(7, watched);
  EXPECT_EQ(together[1].fragments, together[4].fragments);
  if (kThreadSanitizer) return;  // which has seen the threads
  EXPECT_TRUE(probed_by(2, {watched[0]})[0].fragments == together[0].fragments) << "alone";
  const std::vector<FragmentProbe> by_one = probed_by(1, watched);
  for (std::size_t i = 0; i < watched.size(); ++i) {
    const std::vector<ProbedFragment>& one = by_one[i].fragments;
    EXPECT_TRUE(together[i].fragments == one);
    EXPECT_GT(one.size(), 30U);
    EXPECT_TRUE(std::is_sorted(one.begin(), one.end(), [](const ProbedFragment& x, const ProbedFragment& y) {
      return x.primitive < y.primitive;
    }));
    EXPECT_GT(one.back().primitive, 140000U);
  }
}

// A draw that clears the planes itself shows the probe what a clear before it would.
TEST(Probe, MeetsTheClearedPlanes) {
  Mesh mesh;
  for (const glm::vec2 p : {glm::vec2(-1, -1), glm::vec2(1, -1), glm::vec2(1, 1)}) mesh.add({p, 0.0F});
  mesh.add_triangle(0, 1, 2);
  PipelineState state;
  state.depth_test = {true, CompareFunction::less, true};
  Surface surface = Surface::make(100, 80).value();
  RenderTarget target = surface.target();
  PreparedDraw prepared;
  ASSERT_TRUE(prepare(state, kIdentity, mesh.arrays(), target, prepared).ok());
  const DrawPass pass{.state = &state, .arrays = mesh.arrays()};
  for (int picture = 0; picture < 2; ++picture) {  // the second one finds the planes of the first
    std::vector<FragmentProbe> probes{{.x = 90, .y = 3}};
    target.probes = &probes;
    ASSERT_TRUE(rasterize({&pass, 1}, prepared, {.clear = ClearValues{.stencil = 5}}, target).ok());
    ASSERT_EQ(probes[0].fragments.size(), 1U);
    EXPECT_EQ(probes[0].fragments[0].fate, FragmentFate::written) << picture;
    EXPECT_EQ(probes[0].fragments[0].stored_depth, 0xFFFFFFU) << picture;
    EXPECT_EQ(probes[0].fragments[0].stored_stencil, 5) << picture;
  }
}

TEST(Probe, OutsideOfTheTargetIsAFault) {
  Surface surface = Surface::make(9, 7).value();
  RenderTarget target = surface.target();
  for (const auto& [x, y] : {std::pair(-1, 0), std::pair(0, -1), std::pair(9, 0), std::pair(0, 7)}) {
    std::vector<FragmentProbe> probes{{.x = 1, .y = 1}, {.x = x, .y = y}};
    target.probes = &probes;
    const Status status = rasterize({}, kIdentity, {}, {}, target);
    ASSERT_FALSE(status.ok());
    EXPECT_NE(status.error().message.find("probe's pixel (" + std::to_string(x)), std::string::npos);
  }
}

}  // namespace
}  // namespace ninebit::test
