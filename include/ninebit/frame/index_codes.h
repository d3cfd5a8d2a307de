// Polygon indices as colours: what the index cube map holds.
#pragma once

#include <cstdint>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/rasterizer.h"

namespace NINEBIT_PUBLIC ninebit {

// The units that each get an index of their own.
enum class IndexScope : std::uint8_t {
  polygon,  // every triangle
  object,   // every mesh instance: no joint errors, and no shadow of an object upon itself
  section   // every cluster of neighbouring triangles of an object
};

// How units get their indices.
enum class IndexOrder : std::uint8_t {
  file,      // counted in the order of the scene's triangles: the article's
  neighbour  // codes that the comparison cannot tell apart go to neighbours: patches of polygons that meet
};

// The products that the comparison scales by four: the differences, and the sum of their squares.
enum class IndexScales : std::uint8_t {
  both,    // the article's
  first,   // the differences only
  second,  // the sum of squares only
  none
};

// The channels that hold an index, in the map and in the polygon's colour.
enum class IndexFormat : std::uint8_t {
  rgb,              // three channels
  luminance_alpha,  // two
  luminance,        // one
  alpha             // one
};

// "rgb", "la", "l", "a"; "polygon", "object", "section"; "file", "neighbour"; "both-x4", "first-x4", "second-x4",
// "no-scale".
[[nodiscard]] std::string_view name_of(IndexFormat format);
[[nodiscard]] std::string_view name_of(IndexScope scope);
[[nodiscard]] std::string_view name_of(IndexOrder order);
[[nodiscard]] std::string_view name_of(IndexScales scales);

// The largest distance between the codes of neighbouring indices in a channel.
inline constexpr int kMaxIndexStep = 16;
// The limits of meshoptimizer's meshlets, which sections are: triangles, in multiples of four, and vertices.
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

  // The step and the format that the codes were made with.
  [[nodiscard]] constexpr int step() const { return static_cast<int>(step_); }
  [[nodiscard]] constexpr IndexFormat format() const { return format_; }

  // The number of codes, including the cleared map's: with step 2, 2^21 in three channels, 2^14 in two, 2^7 in one.
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

  // The colour of a code number below capacity(), as the combiners read it from a texel of the format's texture:
  // luminance in red, green and blue; alpha 255, or colours 0, if the format has none.
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

  // The code number of a colour that color() returned. Reads only the channels that the format's texture stores;
  // luminance is read from red.
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

// The number of indices that each scope needs in a scene.
struct IndexCounts {
  std::uint64_t polygons = 0;  // the scene's triangles
  std::uint64_t sections = 0;  // an upper bound if another scope is requested; 0: not counted
  std::uint64_t objects = 0;   // the scene's objects
  [[nodiscard]] constexpr std::uint64_t of(IndexScope scope) const {  // the count of one scope
    return scope == IndexScope::polygon ? polygons : scope == IndexScope::section ? sections : objects;
  }
};

// Reports a step outside 1 to kMaxIndexStep, and too few codes for the scope's indices and the cleared map. The message
// gives both counts, and the step, the format or the scope that would be enough if only that were changed; sections
// that were not counted are not suggested.
[[nodiscard]] Status check_index_codes(IndexFormat format, int step, IndexScope scope, const IndexCounts& counts);

}  // namespace ninebit
