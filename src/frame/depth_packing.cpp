#include "ninebit/frame/depth_packing.h"

#include <cstddef>

namespace ninebit {
namespace {

// GLSL's functions, for numbers of 0 or more. Without a conversion to integers, compilers make vectors of them: 2^23
// added and subtracted rounds to a whole number, and larger numbers are whole already.
constexpr float floor_of(float x) {
  constexpr float kWhole = 8388608.0F;
  const float rounded = (x + kWhole) - kWhole;
  const float whole = rounded - (rounded > x ? 1.0F : 0.0F);
  return x < kWhole ? whole : x;
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
constexpr DepthComponents all_ones_at_one(float depth, const DepthComponents& c, const DepthComponents& ones) {
  const bool one = depth >= 1.0F;
  return {one ? ones[0] : c[0], one ? ones[1] : c[1], one ? ones[2] : c[2], one ? ones[3] : c[3]};
}
constexpr DepthComponents pack_digits(float depth) {
  float whole = depth * kTo4;
  const float alpha = take_fraction(whole);
  whole *= kShift;
  const float blue = take_fraction(whole);
  whole *= kShift;
  const float green = take_fraction(whole);
  return all_ones_at_one(depth, {whole * kByte, green * kUpscale, blue * kUpscale, alpha}, {1.0F, 1.0F, 1.0F, 1.0F});
}
constexpr float unpack_digits(const DepthComponents& c) {
  return dot(c, {kDownscale, kDownscale / kTo2, kDownscale / kTo3, 1.0F / kTo4});
}
constexpr DepthComponents pack_three_digits(float depth) {
  float whole = depth * kTo3;
  const float blue = take_fraction(whole);
  whole *= kShift;
  const float green = take_fraction(whole);
  return all_ones_at_one(depth, {whole * kByte, green * kUpscale, blue, 0.0F}, {1.0F, 1.0F, 1.0F, 0.0F});
}
constexpr float unpack_three_digits(const DepthComponents& c) {
  return (c[0] * kDownscale + c[1] * (kDownscale / kTo2)) + c[2] * (1.0F / kTo3);
}
constexpr DepthComponents pack_two_digits(float depth) {
  float whole = depth * kTo2;
  const float green = take_fraction(whole);
  return all_ones_at_one(depth, {whole * kByte, green, 0.0F, 0.0F}, {1.0F, 1.0F, 0.0F, 0.0F});
}
constexpr float unpack_two_digits(const DepthComponents& c) {
  return c[0] * kDownscale + c[1] * (1.0F / kTo2);
}

// Base 255: the digits are fractions of 255 parts, so that a byte holds each, up to rounding. `last` is the factor of
// alpha, 255 to the third power.
constexpr float k255To2 = 65025.0F, k255To3 = 16581375.0F, kTypedWrong = 160581375.0F;

constexpr DepthComponents fractions_255(float depth, float last) {
  return {fract(depth), fract(depth * 255.0F), fract(depth * k255To2), fract(depth * last)};
}
// As without_carries(), but red is the highest component.
constexpr DepthComponents without_lower_parts(const DepthComponents& c, float shift) {
  return {c[0] - c[1] * shift, c[1] - c[2] * shift, c[2] - c[3] * shift, c[3]};
}
constexpr float join_255(const DepthComponents& c, float last) {
  return dot(c, {1.0F, kByte, 1.0F / k255To2, 1.0F / last});
}

constexpr DepthComponents pack_255(float depth) {
  return without_lower_parts(fractions_255(depth, k255To3), kByte);
}
constexpr float unpack_255(const DepthComponents& c) {
  return join_255(c, k255To3);
}
constexpr DepthComponents pack_255_typo(float depth) {
  return without_lower_parts(fractions_255(depth, kTypedWrong), kByte);
}
constexpr float unpack_255_typo(const DepthComponents& c) {
  return join_255(c, kTypedWrong);
}
constexpr DepthComponents pack_255_clamped(float depth) {
  return pack_255(depth < 0.999F ? depth : 0.999F);
}
// The highest component holds the whole depth: nothing is subtracted.
constexpr DepthComponents pack_255_half_added(float depth) {
  DepthComponents c = fractions_255(depth, k255To3);
  for (float& component : c) component += 0.5F / 255.0F;
  return c;
}
constexpr DepthComponents pack_three_255(float depth) {
  constexpr float kBelowOne = 16777215.0F / 16777216.0F;
  const float d = depth < kBelowOne ? depth : kBelowOne;
  return without_lower_parts({fract(d), fract(d * 255.0F), fract(d * k255To2), 0.0F}, kByte);
}
constexpr DepthComponents pack_two_255(float depth) {
  const float d = depth * 0.99F;
  return without_lower_parts({fract(d), fract(d * 255.0F), 0.0F, 0.0F}, kByte);
}
constexpr float unpack_two_255(const DepthComponents& c) {
  return (c[0] + c[1] * kByte) / 0.99F;
}
// Depth 1 stays 1. A 256th is subtracted, a little less than is due: a component is then never just below its byte.
constexpr DepthComponents pack_255_by_256(float depth) {
  DepthComponents c = fractions_255(depth, k255To3);
  c[0] = depth;
  return without_lower_parts(c, kShift);
}

// 24 bits that unpack as n / 16777215. Multiples of the higher digits are subtracted before the fractions are taken.
constexpr DepthComponents pack_24_bits(float depth) {
  constexpr float kHigh = 65536.0F / 16777215.0F, kMiddle = 256.0F / 16777215.0F;
  const float green = depth - floor_of(depth / kHigh) * kHigh, blue = depth - floor_of(depth / kMiddle) * kMiddle;
  // A remainder may be negative by rounding.
  const auto part = [](float x) { return (x < 0.0F ? 1.0F - fract(-x) : fract(x)) * kUpscale; };
  return without_lower_parts({part(depth), part(green * kTo2), part(blue * kTo3), 0.0F}, kShift);
}
constexpr float unpack_24_bits(const DepthComponents& c) {
  return dot(c, {65536.0F / 65793.0F, 256.0F / 65793.0F, 1.0F / 65793.0F, 0.0F});
}

// Whole digits of depth times 2^24 by division, each over 255; the lowest keeps its fraction, and depth 1 is 256/255.
constexpr DepthComponents pack_floors(float depth) {
  const float all = depth * kTo4, high = floor_of(all / kTo3), rest = all - high * kTo3;
  const float middle = floor_of(rest / kTo2), low = rest - middle * kTo2;
  return {high / 255.0F, middle / 255.0F, low / 255.0F, 0.0F};
}
constexpr float unpack_floors(const DepthComponents& c) {
  return (c[0] * 255.0F * kTo3 + c[1] * 255.0F * kTo2 + c[2] * 255.0F) / kTo4;
}

// A texel's way through a texture: to_bytes() stores what a shader writes, to_components() is what a shader reads.
constexpr DepthBytes to_bytes(const DepthComponents& c, ChannelStorage storage) {
  return {stored_component(c[0], storage), stored_component(c[1], storage), stored_component(c[2], storage),
          stored_component(c[3], storage)};
}
constexpr DepthComponents to_components(const DepthBytes& b, ChannelStorage storage) {
  return {read_component(b[0], storage), read_component(b[1], storage), read_component(b[2], storage),
          read_component(b[3], storage)};
}

// The whole way in one loop, in which everything is inlined.
template <auto kPack, auto kUnpack, ChannelStorage kStorage>
void round_trips(std::span<const float> depths, std::span<float> back) {
  for (std::size_t i = 0; i < depths.size(); ++i) {
    back[i] = kUnpack(to_components(to_bytes(kPack(depths[i]), kStorage), kStorage));
  }
}
template <auto kPack, auto kUnpack>
void round_trips_of(std::span<const float> depths, ChannelStorage storage, std::span<float> back) {
  switch (storage) {
    case ChannelStorage::round:
      return round_trips<kPack, kUnpack, ChannelStorage::round>(depths, back);
    case ChannelStorage::truncate:
      return round_trips<kPack, kUnpack, ChannelStorage::truncate>(depths, back);
    case ChannelStorage::floor_256:
      return round_trips<kPack, kUnpack, ChannelStorage::floor_256>(depths, back);
    case ChannelStorage::half:
      return round_trips<kPack, kUnpack, ChannelStorage::half>(depths, back);
  }
}

struct PackingText {
  std::string_view name, formula, source;
};
template <auto kPack, auto kUnpack>
constexpr DepthPacking packing_of(const PackingText& text, int channels, bool red_is_highest) {
  return {.name = text.name,
          .formula = text.formula,
          .source = text.source,
          .channels = channels,
          .red_is_highest = red_is_highest,
          .pack = kPack,
          .unpack = kUnpack,
          .round_trips = &round_trips_of<kPack, kUnpack>};
}

constexpr std::array kPackings{
    packing_of<&pack_fract, &unpack_fractions>(
        {"rgba8-fract", "fract(d (256^3, 256^2, 256, 1)), less the carries / 256; c . 1/(256^3, 256^2, 256, 1)",
         "three.js up to r66"},
        4, false),
    packing_of<&pack_mod, &unpack_fractions>(
        {"rgba8-mod", "mod(255 d (256^3, 256^2, 256, 1), 256) / 255, less the carries / 256; as rgba8-fract",
         "three.js r67 to r75"},
        4, false),
    packing_of<&pack_upscaled, &unpack_downscaled>(
        {"rgba8-256over255", "rgba8-fract with alpha d instead of fract(d), times 256/255; times 255/256",
         "three.js r77 to r166"},
        4, false),
    packing_of<&pack_upscaled_pair, &unpack_downscaled_pair>(
        {"rg8-256over255", "the two lowest components of rgba8-256over255, exchanged", "three.js before r167"}, 2,
        true),
    packing_of<&pack_digits, &unpack_digits>(
        {"rgba8-modf", "whole digits of d 256^3 / 255, alpha a fraction; depth 1 is all ones", "three.js r167 on"}, 4,
        true),
    packing_of<&pack_three_digits, &unpack_three_digits>(
        {"rgb8-modf", "whole digits of d 256^2 / 255, blue a fraction; depth 1 is all ones", "three.js r167 on"}, 3,
        true),
    packing_of<&pack_two_digits, &unpack_two_digits>(
        {"rg8-modf", "a whole digit of d 256 / 255, green a fraction; depth 1 is all ones", "three.js r167 on"}, 2,
        true),
    packing_of<&pack_255, &unpack_255>(
        {"rgba8-base255", "e = fract(d (1, 255, 255^2, 255^3)), e - (e.yzw / 255, 0); c . 1/(1, 255, 255^2, 255^3)",
         "Unity, Cesium, bgfx, sokol, osgjs, Mapbox"},
        4, true),
    packing_of<&pack_255_typo, &unpack_255_typo>(
        {"rgba8-base255-typo", "rgba8-base255 with 160581375 for 255^3 = 16581375",
         "a typing error on aras-p.info, copied since 2007; older sokol samples and osgjs"},
        4, true),
    packing_of<&pack_255_clamped, &unpack_255>(
        {"rgba8-base255-clamped", "rgba8-base255 of min(d, 0.999)", "Unity's cube shadow maps"}, 4, true),
    packing_of<&pack_255_half_added, &unpack_255>(
        {"rgba8-base255-2007", "fract(d (1, 255, 255^2, 255^3)) + 0.5/255; as rgba8-base255",
         "aras-p.info, 29 June 2007, with 255^3 as corrected since"},
        4, true),
    packing_of<&pack_255_by_256, &unpack_255>(
        {"rgba8-base255-by-256", "rgba8-base255 with d for fract(d) and e.yzw / 256; as rgba8-base255",
         "skytiger.wordpress.com, 1 December 2010"},
        4, true),
    packing_of<&pack_three_255, &unpack_255>(
        {"rgb8-base255", "three components of rgba8-base255, of min(d, 1 - 2^-24)", "itwin.js"}, 3, true),
    packing_of<&pack_two_255, &unpack_two_255>(
        {"rg8-base255", "two components of rgba8-base255, of 0.99 d; / 0.99", "older engines"}, 2, true),
    packing_of<&pack_24_bits, &unpack_24_bits>(
        {"rgb8-65793",
         "256/255 fract((d, 256 g, 65536 b)), g and b = d mod 65536/m and 256/m, m = 16777215, less the lower / 256; c "
         ". (65536, 256, 1) / 65793",
         "skytiger.wordpress.com, 1 December 2010"},
        3, true),
    packing_of<&pack_floors, &unpack_floors>(
        {"rgb8-floor", "whole digits of d 256^3 / 255, blue with its fraction; 255 c . (65536, 256, 1) / 256^3",
         "forum.beyond3d.com, thread 39552"},
        3, true),
};

constexpr std::array kStorageRules{
    StorageRule{.storage = ChannelStorage::round,
                .name = "round",
                .help = "components rounded to bytes",
                .formula = "floor(255 v + 1/2); n / 255",
                .source = "OpenGL and Direct3D 10"},
    StorageRule{.storage = ChannelStorage::truncate,
                .name = "truncate",
                .help = "components truncated to bytes",
                .formula = "floor(255 v); n / 255",
                .source = "reported of older chips"},
    StorageRule{.storage = ChannelStorage::floor_256,
                .name = "floor-256",
                .help = "components split into 256 equal parts",
                .formula = "floor(255.999 v); n / 255",
                .source = "considered in three.js issue 28692"},
    StorageRule{.storage = ChannelStorage::half,
                .name = "half",
                .help = "components rounded to bytes and read as half floats",
                .formula = "floor(255 v + 1/2); n / 255 as a half float",
                .source = "reported of mobile chips in three.js issue 9092"},
};

}  // namespace

std::span<const DepthPacking> depth_packings() {
  return kPackings;
}

std::span<const StorageRule> storage_rules() {
  return kStorageRules;
}

std::string_view name_of(ChannelStorage storage) {
  for (const StorageRule& rule : kStorageRules) {
    if (rule.storage == storage) return rule.name;
  }
  return {};
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
  return to_bytes(packing.pack(depth), storage);
}

float read_depth(const DepthPacking& packing, const DepthBytes& bytes, ChannelStorage storage) {
  return packing.unpack(to_components(bytes, storage));
}

}  // namespace ninebit
