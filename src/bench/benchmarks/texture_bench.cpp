// Texture reads of a 1024x768 frame from byte textures, in batches of 16x16 pixels. Items are fragments.
#include <benchmark/benchmark.h>

#include <array>
#include <cstdint>
#include <random>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/raster/sampler.h"

namespace {

using namespace ninebit;

constexpr int kWidth = 1024, kHeight = 768, kSquare = 16, kTextureSize = 512;

Texture random_texture(TextureTarget target, InternalFormat format) {
  std::mt19937 random(1);
  const std::size_t planes = format == InternalFormat::rgba8 ? 4 : format == InternalFormat::rgb8 ? 3 : 1;
  std::vector<std::vector<TextureSamples>> faces(target == TextureTarget::cube_map ? 6 : 1);
  for (auto& levels : faces) {
    std::vector<std::uint8_t> bytes(planes * kTextureSize * kTextureSize);
    for (std::uint8_t& byte : bytes) byte = static_cast<std::uint8_t>(random());
    levels.push_back({kTextureSize, kTextureSize, std::move(bytes)});
  }
  return make_texture(target, format, std::move(faces)).value();
}

// Coordinates of a wall that fills the frame and is close enough to the light to be visible from five faces of the
// cube; for 2D, the texture covers the frame once.
std::array<std::vector<float>, 3> coordinates(TextureTarget target) {
  std::array<std::vector<float>, 3> at;
  for (int square = 0; square < kWidth * kHeight / (kSquare * kSquare); ++square) {
    const int left = square % (kWidth / kSquare) * kSquare, bottom = square / (kWidth / kSquare) * kSquare;
    for (int i = 0; i < kSquare * kSquare; ++i) {
      const int column = left + i % kSquare, row = bottom + i / kSquare;
      const float x = (static_cast<float>(column) + 0.5F) / kWidth;
      const float y = (static_cast<float>(row) + 0.5F) / kHeight;
      const bool cube = target == TextureTarget::cube_map;
      at[0].push_back(cube ? 4.0F * x - 2.0F : x);
      at[1].push_back(cube ? 3.0F * y - 1.5F : y);
      at[2].push_back(1.0F);
    }
  }
  return at;
}

void sample(benchmark::State& state, TextureTarget target, InternalFormat format, Wrap wrap, MagFilter filter) {
  const Texture texture = random_texture(target, format);
  const bool linear = filter == MagFilter::linear;
  const Sampler parameters{.min_filter = linear ? MinFilter::linear : MinFilter::nearest,
                           .mag_filter = filter,
                           .wrap_s = wrap,
                           .wrap_t = wrap};
  const TextureSampler sampler = TextureSampler::make(profiles::geforce2, texture, parameters).value();
  const auto at = coordinates(target);
  std::array<std::array<s9, kBatchSize>, 4> codes;
  for ([[maybe_unused]] auto _ : state) {
    for (std::size_t first = 0; first < at[0].size(); first += kBatchSize) {
      const TextureCoordinates batch{.value = {at[0].data() + first, at[1].data() + first, at[2].data() + first}};
      sampler.sample(batch, kBatchSize, {codes[0].data(), codes[1].data(), codes[2].data(), codes[3].data()});
      benchmark::DoNotOptimize(codes);
      benchmark::ClobberMemory();
    }
  }
  state.SetItemsProcessed(static_cast<std::int64_t>(state.iterations()) * kWidth * kHeight);
}

constexpr TextureTarget kCube = TextureTarget::cube_map, kFlat = TextureTarget::texture_2d;
constexpr InternalFormat kRgb = InternalFormat::rgb8, kRgba = InternalFormat::rgba8;
constexpr InternalFormat kLuminance = InternalFormat::luminance8;
constexpr MagFilter kNearest = MagFilter::nearest, kLinear = MagFilter::linear;
BENCHMARK_CAPTURE(sample, nearest_cube_rgb, kCube, kRgb, Wrap::clamp_to_edge, kNearest);
BENCHMARK_CAPTURE(sample, nearest_cube_rgba, kCube, kRgba, Wrap::clamp_to_edge, kNearest);
BENCHMARK_CAPTURE(sample, nearest_2d_rgb, kFlat, kRgb, Wrap::repeat, kNearest);
BENCHMARK_CAPTURE(sample, nearest_2d_luminance, kFlat, kLuminance, Wrap::clamp, kNearest);
BENCHMARK_CAPTURE(sample, nearest_2d_mirrored, kFlat, kRgb, Wrap::mirrored_repeat, kNearest);
BENCHMARK_CAPTURE(sample, linear_cube_rgb, kCube, kRgb, Wrap::clamp_to_edge, kLinear);
BENCHMARK_CAPTURE(sample, linear_2d_rgb, kFlat, kRgb, Wrap::repeat, kLinear);
BENCHMARK_CAPTURE(sample, linear_2d_luminance, kFlat, kLuminance, Wrap::clamp_to_edge, kLinear);

}  // namespace
