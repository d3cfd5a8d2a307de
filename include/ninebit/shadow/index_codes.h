// Polygon indices as colours: what the index cube map holds.
#pragma once

#include <cstdint>

#include "ninebit/numerics/result.h"
#include "ninebit/raster/rasterizer.h"

namespace ninebit {

// What gets an index of its own.
enum class IndexScope : std::uint8_t {
  polygon,  // every triangle
  object,   // every mesh instance: no joint errors, and no shadow of an object upon itself
  section   // every cluster of neighbouring triangles of an object
};

// What holds an index in the map and in the polygon's colour.
enum class IndexFormat : std::uint8_t {
  rgb,              // three channels
  luminance_alpha,  // two
  luminance,        // one
  alpha             // one
};

inline constexpr int kMaxIndexStep = 16;
inline constexpr int kMaxSectionSize = 65'535;

// RGB index codes with a step: a channel holds 0, step, 2 step … up to 255, red fastest. Code number 0 is the cleared
// map, so numbers from 1 on are given to polygons.
class IndexCodes {
 public:
  // step is 1 to kMaxIndexStep.
  constexpr explicit IndexCodes(int step) : step_(step), levels_(255 / step + 1) {}

  [[nodiscard]] constexpr int step() const { return step_; }

  // How many codes there are, the cleared map included: 2^21 with step 2.
  [[nodiscard]] constexpr std::uint32_t capacity() const {
    const auto levels = static_cast<std::uint32_t>(levels_);
    return levels * levels * levels;
  }

  // The colour of a code number below capacity(); its alpha is 255.
  [[nodiscard]] constexpr ColorBytes color(std::uint32_t number) const {
    const auto levels = static_cast<std::uint32_t>(levels_);
    const auto channel = [&](std::uint32_t digit) {
      return static_cast<std::uint8_t>(digit * static_cast<std::uint32_t>(step_));
    };
    return {channel(number % levels), channel(number / levels % levels), channel(number / levels / levels), 255};
  }

  // The number of a colour that color() made.
  [[nodiscard]] constexpr std::uint32_t number(std::uint8_t red, std::uint8_t green, std::uint8_t blue) const {
    const auto levels = static_cast<std::uint32_t>(levels_);
    const auto step = static_cast<std::uint32_t>(step_);
    return red / step + levels * (green / step + levels * (blue / step));
  }

 private:
  int step_;
  int levels_;
};

// Reports a step outside 1 to kMaxIndexStep, and too few codes for `used` polygons (or objects) and the cleared map:
// then it says how many there are of each, and which step or scope would do. `objects` is the count of scope object.
[[nodiscard]] Status check_index_codes(int step, IndexScope scope, std::uint64_t used, std::uint64_t objects);

}  // namespace ninebit
