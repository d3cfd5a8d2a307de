// Finds and weighs the texels of a run of fragments in SIMD lanes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/sampler.h"
#include "src/raster/texture/texture_wrap.h"

namespace ninebit {

// A level of a texture. Offsets count its texels: `stride` from one row to the next.
struct LaneLevel {
  bool cube = false;
  bool border_texels = false;  // the image has them (rule 52); the sides are then the texture's
  int width = 1;
  int height = 1;
  Wrap wrap_s = Wrap::repeat;
  Wrap wrap_t = Wrap::repeat;
  std::int32_t stride = 0;

  // True if fragments outside read the border's colour.
  [[nodiscard]] bool has_border_color() const {
    return !border_texels && (wrap_s == Wrap::clamp_to_border || wrap_t == Wrap::clamp_to_border);
  }
  // True if a border may be read.
  [[nodiscard]] bool has_borders() const { return border_texels || has_border_color(); }
};

using LaneIntegers = std::array<std::int32_t, kBatchSize>;

using LaneWords = std::array<std::uint32_t, kBatchSize>;

// y × stride + x of each fragment, and the face: 0 where there is only one.
struct NearestLanes {
  alignas(64) LaneIntegers offset;
  alignas(64) LaneIntegers face;
  alignas(64) LaneIntegers outside;  // if LaneLevel::has_border_color(): -1 where the border is read, else 0
  bool one_face;                     // true if all fragments read face[0]
};

// The four texels of LINEAR: two neighbours in s, then the two above them. `u` weighs the second in s, `v` in t.
struct LinearLanes {
  alignas(64) std::array<LaneIntegers, 4> offset;
  alignas(64) LaneIntegers face, u, v;
  bool one_face;
};

// Finds the texels that cube_coordinate and nearest_texel, or bordered_texels, select for the first `count`
// coordinates, 1 to kBatchSize. All kBatchSize of each coordinate are read, whatever their values.
void find_nearest(const LaneLevel& level, const std::array<const float*, 3>& at, std::size_t count, NearestLanes& to);

// The same with linear_texels, for any mode but Wrap::clamp, whose border is not a texel.
void find_linear(const LaneLevel& level, const FilterRules& rules, const std::array<const float*, 3>& at,
                 std::size_t count, LinearLanes& to);

// Texels whose components lie in one word each: face f begins face_word[f] words after `first`, which is aligned.
using FaceWords = std::array<std::int32_t, 16>;
struct TexelWords {
  const std::uint8_t* first;
  const FaceWords& face_word;
  std::uint32_t border;  // the border's colour
};

// Reads the words of the texels that find_nearest selects. Reads and writes whole groups of up to kMostLanes fragments.
inline constexpr std::size_t kMostLanes = 64;
void fetch_nearest_words(const LaneLevel& level, const std::array<const float*, 3>& at, const TexelWords& texels,
                         std::size_t count, std::uint32_t* to);

// A colour key for words of texels (rule 54).
struct WordKey {
  ColorKeyOperation operation = ColorKeyOperation::disable;
  std::uint32_t word = 0;      // the key, with red in the lowest byte
  std::uint32_t compared = 0;  // its bits that are compared
};

// Does to `count` texels what the key says. `killed`: where 1 is stored for fragments that are killed; null if none is.
void apply_key(const WordKey& key, std::size_t count, LaneWords& words, std::uint8_t* killed);

// Splits `count` words into their bytes as codes, without their lowest `byte_shift` bits: the lowest byte goes to
// to[0], and so on; a null pointer skips its byte.
void split_words(const LaneWords& words, int byte_shift, std::size_t count, const std::array<s9*, 4>& to);

// The weighted sum of the texels' bytes, rounded to nearest, halves up, once or after each blend. Writes some lanes
// beyond `count`.
using CornerBytes = std::array<std::array<s9, kBatchSize>, 4>;
void weigh_linear(const LinearLanes& lanes, const CornerBytes& corner, const FilterRules& rules, std::size_t count,
                  std::array<s9, kBatchSize>& to);

}  // namespace ninebit
