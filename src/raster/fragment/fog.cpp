#include "src/raster/fragment/fog.h"

#include <cmath>

#include "ninebit/numerics/fixed9.h"

namespace ninebit {
namespace {

// 2^t for t <= 0, with sums and products alone, which give every machine the same bits. Its relative error is below
// 2^-40; where t is below -64, or NaN, it is 0.
double power_of_two(double t) {
  if (!(t > -64.0)) return 0.0;
  constexpr double kLog2 = 0x1.62e42fefa39efp-1;
  constexpr int kTerms = 14;
  const double whole = std::floor(t), x = (t - whole) * kLog2;
  double sum = 1.0;  // 1 + x (1 + x / 2 (1 + x / 3 …))
  for (int k = kTerms; k >= 1; --k) sum = 1.0 + x / k * sum;
  return std::ldexp(sum, static_cast<int>(whole));
}

std::uint8_t byte_to_nearest(double factor) {
  return static_cast<std::uint8_t>(factor * 255.0 + 0.5);
}

}  // namespace

// Rules 25 and 49. A factor becomes a byte by byte_of_fog_factor (fixed9.h).
std::uint8_t fog_byte(const HardwareProfile& profile, const Fog& fog, float x) {
  const auto linear = [&](float at) { return fog.bias - 1.0F + fog.slope * at; };
  const double t = static_cast<double>(fog.bias) - 1.5 + static_cast<double>(fog.slope) * static_cast<double>(x);
  switch (fog.function) {
    case FogFunction::factor:
      return byte_of_fog_factor(profile, x);
    case FogFunction::linear:
      return byte_of_fog_factor(profile, linear(x));
    case FogFunction::linear_abs:
      return byte_of_fog_factor(profile, linear(std::fabs(x)));
    case FogFunction::exp:
      return t > 0.0 ? 255 : byte_to_nearest(power_of_two(16.0 * t));
    case FogFunction::exp_abs:
      return byte_to_nearest(power_of_two(-16.0 * std::fabs(t)));
    case FogFunction::exp2:
    case FogFunction::exp2_abs:
      return byte_to_nearest(power_of_two(-32.0 * t * t));
  }
  return 0;
}

}  // namespace ninebit
