// THE rules of texture-shader stages (docs/numerics.md, rules 33 to 40), written once. No include guard:
// stage_fragment.h includes it for one fragment, stage_lanes.cpp once for each SIMD target, where the compiler makes
// vectors of its loops. So every function is straight: choices between values, no early return in a branch of one
// fragment.
//
// The includer provides the macro NINEBIT_STAGE_RULE (the functions' attributes) and <cmath>, <cstdint>.

// Rule 33: a number becomes a byte. NaN gives 0.
template <StageByte kHow>
NINEBIT_STAGE_RULE std::int32_t stage_byte(float c) {
  if constexpr (kHow == StageByte::twelve_bits) {
    const float scaled = c * 4096.0F;
    const float low = scaled > 0.0F ? scaled : 0.0F;
    const auto n = static_cast<std::int32_t>(low < 4095.0F ? low : 4095.0F);
    return 255 * (n + 1) >> 12;
  } else {
    const float low = c > 0.0F ? c : 0.0F;
    return static_cast<std::int32_t>((low < 1.0F ? low : 1.0F) * 255.0F + 0.5F);
  }
}

// The number that becomes the byte.
NINEBIT_STAGE_RULE float byte_number(NegativeNumber negative, float c) {
  return negative == NegativeNumber::size ? std::fabs(c) : c;
}

// Rule 42: whether a coordinate kills the fragment. NaN does not.
NINEBIT_STAGE_RULE bool is_killing(CullMode mode, CullZero zero, float c) {
  const bool is_minus_zero = c == 0.0F && std::signbit(c);
  const bool is_negative = c < 0.0F || (zero == CullZero::by_sign && is_minus_zero);
  return mode == CullMode::kills_negative ? is_negative : c >= 0.0F && !is_negative;
}

// A byte, or a word of 16 bits, as two's complement.
NINEBIT_STAGE_RULE std::int32_t s8(std::int32_t byte) {
  return (byte ^ 0x80) - 0x80;
}
NINEBIT_STAGE_RULE std::int32_t s16(std::int32_t word) {
  return (word ^ 0x8000) - 0x8000;
}

// Rule 34: a coordinate, moved by two signed bytes.
NINEBIT_STAGE_RULE float offset_coordinate(float at, float by_ds, std::int32_t ds, float by_dt, std::int32_t dt) {
  constexpr float kUnit = 1.0F / 128.0F;
  const float moved = at + by_ds * (static_cast<float>(s8(ds)) * kUnit);
  return moved + by_dt * (static_cast<float>(s8(dt)) * kUnit);
}

// Rule 35: a component of the texel, times the luminance.
template <StageByte kHow>
NINEBIT_STAGE_RULE std::int32_t scaled_byte(NegativeNumber negative, std::int32_t texel, std::int32_t luminance,
                                            float scale, float bias) {
  const float factor = scale * (static_cast<float>(luminance) / 255.0F) + bias;
  return stage_byte<kHow>(byte_number(negative, static_cast<float>(texel) / 255.0F * factor));
}

// Three numbers: a direction, or the whole numbers that a texel stands for.
struct StageVector {
  float x, y, z;
};
NINEBIT_STAGE_RULE float stage_dot(const StageVector& a, const StageVector& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

// Rule 36: the other factor of a dot product is `number` / `over`. The sum is divided, not its parts: that agrees with
// more of the measured depths. The third number of HILO texels is exactly 1: programs of the time compare a depth that
// passes through it with one that does not.
struct StageFactor {
  StageVector number;
  float over;
};
template <DotMapping kMapping>
NINEBIT_STAGE_RULE StageFactor stage_factor(DotDivisors divisors, std::int32_t red, std::int32_t green,
                                            std::int32_t blue, std::int32_t alpha) {
  const bool is_odd = divisors == DotDivisors::odd;
  const auto vector = [](std::int32_t x, std::int32_t y, std::int32_t z) {
    return StageVector{static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)};
  };
  if constexpr (kMapping == DotMapping::minus1_to_1_d3d) {
    return {vector(red - 128, green - 128, blue - 128), is_odd ? 127.0F : 128.0F};
  } else if constexpr (kMapping == DotMapping::minus1_to_1_gl) {
    return {vector(2 * s8(red) + 1, 2 * s8(green) + 1, 2 * s8(blue) + 1), is_odd ? 255.0F : 256.0F};
  } else if constexpr (kMapping == DotMapping::minus1_to_1) {
    return {vector(s8(red), s8(green), s8(blue)), is_odd ? 127.0F : 128.0F};
  } else if constexpr (kMapping == DotMapping::hilo_1) {
    const StageVector words = vector(256 * alpha + red, 256 * green + blue, 1);
    return {{words.x / 65535.0F, words.y / 65535.0F, words.z}, 1.0F};
  } else if constexpr (kMapping == DotMapping::hilo_hemisphere) {
    const std::int32_t high = s16(256 * alpha + red), low = s16(256 * green + blue);
    const double left = 0x1p30 - static_cast<double>(high) * high - static_cast<double>(low) * low;
    const auto root = static_cast<std::int32_t>(std::sqrt(left > 0.0 ? left : 0.0));
    const StageVector words = vector(high, low, root);
    return {{words.x / 32767.0F, words.y / 32767.0F, words.z / 32768.0F}, 1.0F};
  } else {
    return {vector(red, green, blue), 255.0F};
  }
}

// Rule 38: the eye, reflected: 2 D (D . E) - E (D . D). Zero for a zero D.
NINEBIT_STAGE_RULE StageVector reflected_eye(const StageVector& d, const StageVector& e) {
  const float along = 2.0F * stage_dot(d, e), length = stage_dot(d, d);
  return {d.x * along - e.x * length, d.y * along - e.y * length, d.z * along - e.z * length};
}

// CONTROL0's conversion of a stage's result (rule 40): red, green, blue of Y, U, V in their places.
struct StageColor {
  std::int32_t red, green, blue;
};
NINEBIT_STAGE_RULE StageColor rgb_of_yuv(std::int32_t y, std::int32_t u, std::int32_t v) {
  const auto clamped = [](std::int32_t x) { return x < 0 ? 0 : x > 255 ? 255 : x; };
  const std::int32_t f = 298 * y >> 8;
  return {clamped(f + 2 * ((409 * (v - 128) + 128) >> 9) - 19),
          clamped(f - 2 * (100 * (u - 128) >> 9) - 2 * (208 * (v - 128) >> 9) - 18),
          clamped(f + (516 * (u - 128) >> 8) - 19)};
}
