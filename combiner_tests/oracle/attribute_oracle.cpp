#include "combiner_tests/oracle/attribute_oracle.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace ninebit::oracle {
namespace {

// Shares in the window, which add up to 1.
std::vector<long double> window_shares(const std::vector<AttributeVertex>& primitive, int px, int py) {
  if (primitive.size() == 1) return {1};
  if (primitive.size() == 2) {
    const Along at = along_line({primitive[0].position, primitive[1].position}, px, py);
    const long double along = static_cast<long double>(at.along) / static_cast<long double>(at.squared_length);
    return {1 - along, along};
  }
  const auto share = shares_at({primitive[0].position, primitive[1].position, primitive[2].position}, px, py);
  return {share.begin(), share.end()};
}

// The turn of a cylinder at which b lies next to a. One half of a turn is not too far.
long double around(long double a, long double b) {
  while (b - a > 0.5L) b -= 1;
  while (b - a < -0.5L) b += 1;
  return b;
}

// How far the pixel's centre lies across the square of a point, from its left side and from its upper side.
std::array<long double, 4> across(const WindowVertex& centre, float size, int px, int py) {
  const long double eighths = std::floor(8 * static_cast<long double>(size) + 0.5L);
  if (eighths == 0) return {0.5L, 0.5L, 0, 1};
  const long double right = px + 0.5L - static_cast<long double>(centre.x_q4) / 16;
  const long double down = static_cast<long double>(centre.y_q4) / 16 - py - 0.5L;
  return {0.5L + 8 * right / eighths, 0.5L + 8 * down / eighths, 0, 1};
}

long double factor_of(const Fog& fog, long double x) {
  const long double b = fog.bias, l = fog.slope, t = b - 1.5L + l * x;
  switch (fog.function) {
    case FogFunction::factor:
      return x;
    case FogFunction::linear:
      return b - 1 + l * x;
    case FogFunction::linear_abs:
      return b - 1 + l * std::fabs(x);
    case FogFunction::exp:
      return t > 0 ? 1 : std::exp2(16 * t);
    case FogFunction::exp_abs:
      return std::exp2(-16 * std::fabs(t));
    case FogFunction::exp2:
    case FogFunction::exp2_abs:
      return std::exp2(-32 * t * t);
  }
  std::abort();
}

// Factors are cut to 12 bits, those of the exponential functions to the nearest byte.
int byte_of(const HardwareProfile& profile, const Fog& fog, long double factor) {
  const long double f = factor > 1 ? 1 : factor > 0 ? factor : 0;
  const bool is_exponential = fog.function >= FogFunction::exp;
  if (is_exponential || profile.fog_byte.value == StageByte::nearest) return static_cast<int>(255 * f + 0.5L);
  const int n = f == 1 ? 4095 : static_cast<int>(4096 * f);
  return 255 * (n + 1) / 4096;
}

}  // namespace

Attributes attributes_at(const PipelineState& state, const Sampler& sampler, std::size_t unit,
                         const std::vector<AttributeVertex>& primitive, int px, int py) {
  const std::vector<long double> window = window_shares(primitive, px, py);
  long double whole = 0;
  for (std::size_t i = 0; i < primitive.size(); ++i) whole += window[i] / primitive[i].w;
  Attributes at;
  for (std::size_t i = 0; i < primitive.size(); ++i) {
    const AttributeVertex& v = primitive[i];
    const long double share = window[i] / v.w / whole;
    for (std::size_t k = 0; k < 4; ++k) {
      const bool repeats = (k == 0 ? sampler.wrap_s : sampler.wrap_t) == Wrap::repeat;
      const bool turns = k < 2 && repeats && sampler.cylinder_wrap[k];
      at.coordinate[k] += share * (turns ? around(primitive[0].coordinate[k], v.coordinate[k]) : v.coordinate[k]);
    }
    const bool is_factor = state.fog.function == FogFunction::factor;
    at.fog += share * (is_factor ? std::clamp(v.fog, 0.0F, 1.0F) : v.fog);
  }
  const bool is_sprite = primitive.size() == 1 && state.point_sprite.enabled && state.point_sprite.coord_replace[unit];
  if (is_sprite) at.coordinate = across(primitive[0].position, state.point_size, px, py);
  return at;
}

std::array<int, 2> fog_bytes(const HardwareProfile& profile, const Fog& fog, long double x, long double error) {
  int low = 255, high = 0;
  for (const long double at : {x - error, x, x + error}) {
    const bool is_table = fog.function >= FogFunction::exp;
    const long double terms = std::fabs(static_cast<long double>(fog.bias)) + std::fabs(fog.slope * at) + 1;
    const long double rounding = is_table ? 1e-12L : 2e-7L * terms;
    for (const long double side : {-1.0L, 1.0L}) {
      const int byte = byte_of(profile, fog, factor_of(fog, at) + side * rounding);
      low = std::min(low, byte);
      high = std::max(high, byte);
    }
  }
  return {low, high};
}

}  // namespace ninebit::oracle
