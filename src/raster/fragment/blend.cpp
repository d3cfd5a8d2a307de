#include "src/raster/fragment/blend.h"

#include <algorithm>

namespace ninebit {
namespace {

// A factor's four components; 255 is 1.0.
using Factors = std::array<int, 4>;

Factors all(int value) {
  return {value, value, value, value};
}

Factors of_color(const ColorBytes& color) {
  return {color[0], color[1], color[2], color[3]};
}

Factors one_minus(const Factors& factors) {
  return {255 - factors[0], 255 - factors[1], 255 - factors[2], 255 - factors[3]};
}

Factors factors_of(BlendFactor factor, const ColorBytes& source, const ColorBytes& destination,
                   const ColorBytes& constant) {
  switch (factor) {
    case BlendFactor::zero:
      return all(0);
    case BlendFactor::one:
      return all(255);
    case BlendFactor::src_color:
      return of_color(source);
    case BlendFactor::one_minus_src_color:
      return one_minus(of_color(source));
    case BlendFactor::dst_color:
      return of_color(destination);
    case BlendFactor::one_minus_dst_color:
      return one_minus(of_color(destination));
    case BlendFactor::src_alpha:
      return all(source[3]);
    case BlendFactor::one_minus_src_alpha:
      return all(255 - source[3]);
    case BlendFactor::dst_alpha:
      return all(destination[3]);
    case BlendFactor::one_minus_dst_alpha:
      return all(255 - destination[3]);
    case BlendFactor::constant_color:
      return of_color(constant);
    case BlendFactor::one_minus_constant_color:
      return one_minus(of_color(constant));
    case BlendFactor::constant_alpha:
      return all(constant[3]);
    case BlendFactor::one_minus_constant_alpha:
      return all(255 - constant[3]);
    case BlendFactor::src_alpha_saturate: {
      const int least = std::min<int>(source[3], 255 - destination[3]);
      return {least, least, least, 255};
    }
  }
  return all(0);
}

// A sum of products in units of 1/255² as a byte: rounded to nearest (255 is odd: there are no halves), clamped.
std::uint8_t byte_of_sum(int sum) {
  return static_cast<std::uint8_t>(std::min(255, (std::max(0, sum) + 127) / 255));
}

}  // namespace

// Rule 19: one sum of products, one rounding.
ColorBytes blend(const Blend& state, const ColorBytes& source, const ColorBytes& destination) {
  ColorBytes result{};
  if (state.equation == BlendEquation::min || state.equation == BlendEquation::max) {
    const bool smaller = state.equation == BlendEquation::min;
    for (std::size_t i = 0; i < 4; ++i) {
      result[i] = smaller ? std::min(source[i], destination[i]) : std::max(source[i], destination[i]);
    }
    return result;
  }
  if (state.equation == BlendEquation::add_signed || state.equation == BlendEquation::reverse_subtract_signed) {
    const int sign = state.equation == BlendEquation::add_signed ? 1 : -1;
    for (std::size_t i = 0; i < 4; ++i) {
      const int sum = destination[i] + sign * static_cast<std::int8_t>(source[i]);
      result[i] = static_cast<std::uint8_t>(std::clamp(sum, 0, 255));
    }
    return result;
  }
  const Factors source_factors = factors_of(state.source, source, destination, state.color);
  const Factors destination_factors = factors_of(state.destination, source, destination, state.color);
  const int source_sign = state.equation == BlendEquation::reverse_subtract ? -1 : 1;
  const int destination_sign = state.equation == BlendEquation::subtract ? -1 : 1;
  for (std::size_t i = 0; i < 4; ++i) {
    result[i] = byte_of_sum(source_sign * source[i] * source_factors[i] +
                            destination_sign * destination[i] * destination_factors[i]);
  }
  return result;
}

}  // namespace ninebit
