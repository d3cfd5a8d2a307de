#include "ninebit/frame/depth_packing.h"

#include <cstddef>

namespace ninebit {
namespace {

// GLSL's functions, for numbers below 2^63.
constexpr float floor_of(float x) {
  const auto whole = static_cast<float>(static_cast<std::int64_t>(x));
  return whole > x ? whole - 1.0F : whole;
}
constexpr float fract(float x) {
  return x - floor_of(x);
}
constexpr float mod(float x, float y) {
  return x - y * floor_of(x / y);
}
constexpr float dot(const DepthComponents& a, const DepthComponents& b) {
  return ((a[0] * b[0] + a[1] * b[1]) + a[2] * b[2]) + a[3] * b[3];
}

constexpr float kTo2 = 256.0F, kTo3 = 256.0F * 256.0F, kTo4 = 256.0F * 256.0F * 256.0F;
constexpr float kShift = 1.0F / 256.0F;
constexpr float kUpscale = 256.0F / 255.0F, kDownscale = 255.0F / 256.0F;
constexpr float kByte = 1.0F / 255.0F;

// Subtracts from each component the part that the component before it holds.
constexpr DepthComponents without_carries(const DepthComponents& c) {
  return {c[0], c[1] - c[0] * kShift, c[2] - c[1] * kShift, c[3] - c[2] * kShift};
}

// Up to r66. Each component is a fraction of at most 255/256, which a byte cannot hold; and depth 1 has the fraction 0.
constexpr DepthComponents pack_fract(float depth) {
  return without_carries({fract(depth * kTo4), fract(depth * kTo3), fract(depth * kTo2), fract(depth)});
}

// r67 to r75: fractions in 255ths.
constexpr DepthComponents pack_mod(float depth) {
  constexpr std::array<float, 4> kFactors{kTo4, kTo3, kTo2, 1.0F};
  DepthComponents c{};
  for (std::size_t i = 0; i < 4; ++i) c[i] = mod(depth * kFactors[i] * 255.0F, 256.0F) / 255.0F;
  return without_carries(c);
}

constexpr float unpack_fractions(const DepthComponents& c) {
  return dot(c, {1.0F / kTo4, 1.0F / kTo3, 1.0F / kTo2, 1.0F});
}

// r77 to r166: the fractions of fract, scaled so that 255/256 becomes 1. The highest component is not a fraction: it is
// 256/255 at depth 1.
constexpr DepthComponents pack_upscaled(float depth) {
  DepthComponents c = without_carries({fract(depth * kTo4), fract(depth * kTo3), fract(depth * kTo2), depth});
  for (float& component : c) component *= kUpscale;
  return c;
}
constexpr float unpack_downscaled(const DepthComponents& c) {
  return dot(c, {kDownscale / kTo4, kDownscale / kTo3, kDownscale / kTo2, kDownscale});
}
// The two lowest digits; the unpacking exchanges them.
constexpr DepthComponents pack_upscaled_pair(float depth) {
  const DepthComponents c = pack_upscaled(depth);
  return {c[1], c[0], 0.0F, 0.0F};
}
constexpr float unpack_downscaled_pair(const DepthComponents& c) {
  return unpack_downscaled({c[0], c[1], 0.0F, 0.0F});
}

// Splits a number of 0 or more into its fraction, which is returned, and the whole number that stays.
constexpr float take_fraction(float& number) {
  const float whole = floor_of(number), fraction = number - whole;
  number = whole;
  return fraction;
}

// From r167 on: whole digits from the highest down; the lowest keeps its fraction, and 1 is all ones.
constexpr DepthComponents pack_digits(float depth) {
  if (depth <= 0.0F) return {};
  if (depth >= 1.0F) return {1.0F, 1.0F, 1.0F, 1.0F};
  float whole = depth * kTo4;
  const float alpha = take_fraction(whole);
  whole *= kShift;
  const float blue = take_fraction(whole);
  whole *= kShift;
  const float green = take_fraction(whole);
  return {whole * kByte, green * kUpscale, blue * kUpscale, alpha};
}
constexpr float unpack_digits(const DepthComponents& c) {
  return dot(c, {kDownscale, kDownscale / kTo2, kDownscale / kTo3, 1.0F / kTo4});
}
constexpr DepthComponents pack_three_digits(float depth) {
  if (depth <= 0.0F) return {};
  if (depth >= 1.0F) return {1.0F, 1.0F, 1.0F, 0.0F};
  float whole = depth * kTo3;
  const float blue = take_fraction(whole);
  whole *= kShift;
  const float green = take_fraction(whole);
  return {whole * kByte, green * kUpscale, blue, 0.0F};
}
constexpr float unpack_three_digits(const DepthComponents& c) {
  return (c[0] * kDownscale + c[1] * (kDownscale / kTo2)) + c[2] * (1.0F / kTo3);
}
constexpr DepthComponents pack_two_digits(float depth) {
  if (depth <= 0.0F) return {};
  if (depth >= 1.0F) return {1.0F, 1.0F, 0.0F, 0.0F};
  float whole = depth * kTo2;
  const float green = take_fraction(whole);
  return {whole * kByte, green, 0.0F, 0.0F};
}
constexpr float unpack_two_digits(const DepthComponents& c) {
  return c[0] * kDownscale + c[1] * (1.0F / kTo2);
}

constexpr std::array kComponentOfByte = [] {
  std::array<float, 256> values{};
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = read_component(static_cast<std::uint8_t>(i));
  return values;
}();

// Both directions in one loop, in which the functions are inlined.
template <auto kPack, auto kUnpack, ChannelStorage kStorage>
void round_trips(std::span<const float> depths, std::span<float> back) {
  for (std::size_t i = 0; i < depths.size(); ++i) {
    DepthComponents components = kPack(depths[i]);
    for (float& c : components) c = kComponentOfByte[stored_component(c, kStorage)];
    back[i] = kUnpack(components);
  }
}

template <auto kPack, auto kUnpack>
constexpr DepthPacking packing_of(std::string_view name, std::string_view releases, int channels, bool red_is_highest) {
  return {.name = name,
          .releases = releases,
          .channels = channels,
          .red_is_highest = red_is_highest,
          .pack = kPack,
          .unpack = kUnpack,
          .round_trips = [](std::span<const float> depths, ChannelStorage storage, std::span<float> back) {
            if (storage == ChannelStorage::round)
              round_trips<kPack, kUnpack, ChannelStorage::round>(depths, back);
            else
              round_trips<kPack, kUnpack, ChannelStorage::truncate>(depths, back);
          }};
}

constexpr std::array kPackings{
    packing_of<&pack_fract, &unpack_fractions>("rgba8-fract", "up to r66", 4, false),
    packing_of<&pack_mod, &unpack_fractions>("rgba8-mod", "r67 to r75", 4, false),
    packing_of<&pack_upscaled, &unpack_downscaled>("rgba8-256over255", "r77 to r166", 4, false),
    packing_of<&pack_upscaled_pair, &unpack_downscaled_pair>("rg8-256over255", "before r167", 2, true),
    packing_of<&pack_digits, &unpack_digits>("rgba8-modf", "r167 on", 4, true),
    packing_of<&pack_three_digits, &unpack_three_digits>("rgb8-modf", "r167 on", 3, true),
    packing_of<&pack_two_digits, &unpack_two_digits>("rg8-modf", "r167 on", 2, true),
};

}  // namespace

std::span<const DepthPacking> depth_packings() {
  return kPackings;
}

const DepthPacking* find_depth_packing(std::string_view name) {
  for (const DepthPacking& packing : kPackings) {
    if (packing.name == name) return &packing;
  }
  return nullptr;
}

const DepthPacking* depth_packing(DepthEncoding encoding) {
  switch (encoding) {
    case DepthEncoding::d24:
    case DepthEncoding::d16:
      return nullptr;
    case DepthEncoding::rgba8_fract:
      return find_depth_packing("rgba8-fract");
    case DepthEncoding::rgba8_mod:
      return find_depth_packing("rgba8-mod");
    case DepthEncoding::rgba8_256over255:
      return find_depth_packing("rgba8-256over255");
    case DepthEncoding::rgba8_modf:
      return find_depth_packing("rgba8-modf");
  }
  return nullptr;
}

DepthBytes store_depth(const DepthPacking& packing, float depth, ChannelStorage storage) {
  const DepthComponents components = packing.pack(depth);
  DepthBytes bytes{};
  for (std::size_t i = 0; i < bytes.size(); ++i) bytes[i] = stored_component(components[i], storage);
  return bytes;
}

float read_depth(const DepthPacking& packing, const DepthBytes& bytes) {
  DepthComponents components{};
  for (std::size_t i = 0; i < bytes.size(); ++i) components[i] = read_component(bytes[i]);
  return packing.unpack(components);
}

}  // namespace ninebit
