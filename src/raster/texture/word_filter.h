// Filters texels of a batch whose components lie in one word each, over all levels of a texture, in SIMD lanes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/raster/sampler.h"
#include "src/raster/texture/texture_lanes.h"

namespace ninebit {

// The levels of a texture whose texels are words. Offsets count words from `first`, which is aligned.
struct WordLevels {
  static constexpr std::size_t kRoom = 16;  // levels
  static_assert(kRoom >= kMaxTextureLevels);

  const std::uint8_t* first = nullptr;
  bool cube = false;
  int width = 1;  // of level 0
  int height = 1;
  int count = 1;           // of levels
  std::uint32_t flip = 0;  // the highest bits of signed components, which are filtered with that bit flipped
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  bool border_texels = false;                   // whether the one level holds a border; the sides are without it
  std::uint32_t border = 0;                     // the border's colour
  std::array<std::int32_t, kRoom> stride{};     // by level
  std::array<std::int32_t, 6 * kRoom> begin{};  // by face × kRoom + level
};

// How a sampler chooses levels; see choose_level.
struct LevelRules {
  MinFilter min_filter = MinFilter::nearest;
  MagFilter mag_filter = MagFilter::nearest;
  int last_level = 0;
  FilterRules filter;
};

// The levels that each fragment reads. If they are_same for all, only the first vector's values are set.
struct LevelLanes {
  alignas(64) LaneIntegers level;
  alignas(64) LaneIntegers next;    // weight of level + 1 in 1/2^weight bits
  alignas(64) LaneIntegers linear;  // -1 where the filter is linear within a level, else 0
  bool has_next;                    // true if any weight is not 0
  bool all_linear;
  bool are_same;  // for fragments on one face; set by the caller
};

// The changes of s, or of t, to the fragment on the right and to the one above.
struct ChangeLanes {
  const float* dx;
  const float* dy;
};

// level_of_detail_q8 of two-dimensional textures of this size, for the first `count` fragments, 1 to kBatchSize. As
// below, values of all kBatchSize are read.
void find_detail(int width, int height, const ChangeLanes& s, const ChangeLanes& t, std::size_t count,
                 LaneIntegers& lambda_q8);

// choose_level of each fragment. The levels of detail have their bias.
void choose_levels(const LevelRules& rules, const LaneIntegers& lambda_q8, std::size_t count, LevelLanes& to);

// True if a linear filter may read the border's colour or border texels. (Wrap::clamp reads half of the colour.)
[[nodiscard]] constexpr bool filters_border(const WordLevels& texture) {
  const auto reads = [](Wrap wrap) { return wrap == Wrap::clamp || wrap == Wrap::clamp_to_border; };
  return texture.border_texels || reads(texture.wrap_s) || reads(texture.wrap_t);
}

// The filtered texels as words, components rounded to nearest, halves up, once or after each blend. Without `levels`,
// level 0 is filtered linearly.
void filter_words(const WordLevels& texture, const FilterRules& rules, const std::array<const float*, 3>& at,
                  const LevelLanes* levels, std::size_t count, LaneWords& to);

}  // namespace ninebit
