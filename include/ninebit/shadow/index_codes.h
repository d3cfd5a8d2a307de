// Polygon indices as colours: what the index cube map holds.
#pragma once

#include <cstdint>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/rasterizer.h"

namespace NINEBIT_PUBLIC ninebit {

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

// "rgb", "la", "l", "a"; "polygon", "object", "section".
[[nodiscard]] std::string_view name_of(IndexFormat format);
[[nodiscard]] std::string_view name_of(IndexScope scope);

// The largest distance between the codes of neighbouring indices in a channel.
inline constexpr int kMaxIndexStep = 16;
// meshoptimizer's meshlets, which sections are, have at most so many triangles and vertices; it counts triangles in
// fours.
inline constexpr int kMinSectionSize = 4;
inline constexpr int kMaxSectionSize = 512;
inline constexpr int kMaxSectionVertices = 255;

// Index codes with a step: a channel holds 0, step, 2 step … up to 255. Code number 0 is the cleared map, so numbers
// from 1 on are given to polygons. The first channel counts fastest: red, then green and blue; luminance, then alpha.
class IndexCodes {
 public:
  // step is 1 to kMaxIndexStep.
  constexpr explicit IndexCodes(int step, IndexFormat format = IndexFormat::rgb)
      : format_(format), step_(static_cast<std::uint32_t>(step)), levels_(255 / step_ + 1) {}

  // As the codes were made.
  [[nodiscard]] constexpr int step() const { return static_cast<int>(step_); }
  [[nodiscard]] constexpr IndexFormat format() const { return format_; }

  // How many codes there are, the cleared map included: with step 2, 2^21 in three channels, 2^14 in two, 2^7 in one.
  [[nodiscard]] constexpr std::uint32_t capacity() const {
    switch (format_) {
      case IndexFormat::rgb:
        return levels_ * levels_ * levels_;
      case IndexFormat::luminance_alpha:
        return levels_ * levels_;
      case IndexFormat::luminance:
      case IndexFormat::alpha:
        break;
    }
    return levels_;
  }

  // The colour of a code number below capacity(), as a texel of the format's texture enters the combiners: a luminance
  // stands in red, green and blue; alpha is 255 and colours are 0 where the format has none.
  [[nodiscard]] constexpr ColorBytes color(std::uint32_t number) const {
    const std::uint8_t first = channel(number), second = channel(number / levels_);
    switch (format_) {
      case IndexFormat::rgb:
        return {first, second, channel(number / levels_ / levels_), 255};
      case IndexFormat::luminance_alpha:
        return {first, first, first, second};
      case IndexFormat::luminance:
        return {first, first, first, 255};
      case IndexFormat::alpha:
        break;
    }
    return {0, 0, 0, first};
  }

  // The number of a colour that color() made. Reads only what the format's texture stores: of a luminance, red.
  [[nodiscard]] constexpr std::uint32_t number(const ColorBytes& color) const {
    const auto digit = [&](std::size_t component) { return color[component] / step_; };
    switch (format_) {
      case IndexFormat::rgb:
        return digit(0) + levels_ * (digit(1) + levels_ * digit(2));
      case IndexFormat::luminance_alpha:
        return digit(0) + levels_ * digit(3);
      case IndexFormat::luminance:
        return digit(0);
      case IndexFormat::alpha:
        break;
    }
    return digit(3);
  }

 private:
  [[nodiscard]] constexpr std::uint8_t channel(std::uint32_t digits) const {
    return static_cast<std::uint8_t>(digits % levels_ * step_);
  }

  IndexFormat format_;
  std::uint32_t step_;
  std::uint32_t levels_;
};

// The texture that holds a format's indices: rgb8, luminance8_alpha8, luminance8 or alpha8.
[[nodiscard]] InternalFormat map_format(IndexFormat format);

// How many indices each scope needs in a scene.
struct IndexCounts {
  std::uint64_t polygons = 0;  // the scene's triangles
  std::uint64_t sections = 0;  // an upper bound where another scope is asked for; 0: not counted
  std::uint64_t objects = 0;   // the scene's objects
  [[nodiscard]] constexpr std::uint64_t of(IndexScope scope) const {  // those that the scope numbers
    return scope == IndexScope::polygon ? polygons : scope == IndexScope::section ? sections : objects;
  }
};

// Reports a step outside 1 to kMaxIndexStep, and too few codes for what the scope counts and the cleared map: then it
// says how many there are of each, and which step, format or scope would do, if only that were changed. Of sections
// that were not counted it says nothing.
[[nodiscard]] Status check_index_codes(IndexFormat format, int step, IndexScope scope, const IndexCounts& counts);

}  // namespace ninebit
