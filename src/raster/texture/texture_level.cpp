#include "src/raster/texture/texture_level.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>

#include "src/raster/texture/cube_coordinate.h"

namespace ninebit {
namespace {

constexpr int kMantissaBits = 52;  // of a double
constexpr int kExponentBias = 1023;

// The component of v that an axis of the face table picks, with its sign.
double along(const std::array<int, 3>& axis, const std::array<float, 3>& v) {
  for (std::size_t i = 0; i < 3; ++i) {
    if (axis[i] != 0) return static_cast<double>(axis[i]) * static_cast<double>(v[i]);
  }
  return 0.0;
}

}  // namespace

int level_of_detail_q8(double rho_squared) {
  if (!(rho_squared > 0.0)) return kNoTexels;
  if (std::isinf(rho_squared)) return kAllTexels;
  // Floats and their sizes leave a square far above the subnormal doubles.
  const auto bits = std::bit_cast<std::uint64_t>(rho_squared);
  const int exponent = static_cast<int>(bits >> kMantissaBits) - kExponentBias;
  constexpr std::uint64_t kMantissa = (std::uint64_t{1} << kMantissaBits) - 1;
  auto power = std::bit_cast<double>((bits & kMantissa) | (std::uint64_t{kExponentBias} << kMantissaBits));
  // The mantissa to the power of 128: a number below 2^128, whose exponent has the seven bits.
  for (int bit = 0; bit < 7; ++bit) power *= power;
  const int fraction = static_cast<int>(std::bit_cast<std::uint64_t>(power) >> kMantissaBits) - kExponentBias;
  return 128 * exponent + fraction;  // log2(rho²) in 1/128, which is log2(rho) in 1/256
}

double rho_squared(const TexelChanges& c) {
  const double x = c.ux * c.ux + c.vx * c.vx + c.wx * c.wx;
  const double y = c.uy * c.uy + c.vy * c.vy + c.wy * c.wy;
  double larger = 0.0;
  if (x > larger) larger = x;
  if (y > larger) larger = y;
  return larger;
}

TexelChanges cube_changes(const std::array<float, 3>& r, const std::array<float, 3>& dx,
                          const std::array<float, 3>& dy) {
  const CubeFaceAxes& axes = cube_face_axes(cube_coordinate(r[0], r[1], r[2]).face);
  const double ma = along(axes.major, r);
  const double s = along(axes.s, r) / ma, t = along(axes.t, r) / ma;
  const auto change = [&](const std::array<int, 3>& axis, double place, const std::array<float, 3>& d) {
    return 0.5 * (along(axis, d) - place * along(axes.major, d)) / ma;
  };
  return {change(axes.s, s, dx), change(axes.t, t, dx), change(axes.s, s, dy), change(axes.t, t, dy)};
}

int magnification_ends_q8(MinFilter min_filter, MagFilter mag_filter) {
  const bool nearest_mipmaps =
      min_filter == MinFilter::nearest_mipmap_nearest || min_filter == MinFilter::nearest_mipmap_linear;
  return mag_filter == MagFilter::linear && nearest_mipmaps ? 128 : 0;
}

LevelChoice choose_level(MinFilter min_filter, MagFilter mag_filter, int lambda_q8, int last_level) {
  if (lambda_q8 <= magnification_ends_q8(min_filter, mag_filter)) return {.linear = mag_filter == MagFilter::linear};
  LevelChoice choice{.linear = is_linear(min_filter)};
  const int last_q8 = 256 * last_level;
  switch (min_filter) {
    case MinFilter::nearest:
    case MinFilter::linear:
      break;
    case MinFilter::nearest_mipmap_nearest:
    case MinFilter::linear_mipmap_nearest:
      // ceil(lambda + 1/2) - 1: halves go to the finer level.
      choice.level = std::min((std::max(lambda_q8, 128) + 127) / 256, last_level);
      break;
    case MinFilter::nearest_mipmap_linear:
    case MinFilter::linear_mipmap_linear:
      choice.two_levels = true;
      choice.level = lambda_q8 >= last_q8 ? last_level : lambda_q8 / 256;
      choice.between_q8 = lambda_q8 >= last_q8 ? 0 : lambda_q8 % 256;
      break;
  }
  return choice;
}

}  // namespace ninebit
