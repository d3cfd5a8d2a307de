// Textures of bytes, sampled a batch at a time: texels are found and weighed in SIMD lanes. Mip-maps only of texels
// that lie in words.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/sampler.h"
#include "src/raster/surface/color_store.h"
#include "src/raster/texture/texture_lanes.h"
#include "src/raster/texture/word_filter.h"

namespace ninebit {

// Gives the codes that TextureSampler computes fragment by fragment for other textures.
class TextureSampler::ByteSampler {
 public:
  // Copies what it needs of `of`, whose texture must outlive it. Empty if `of` reads other samples than bytes, or a
  // colour key with a filter or several levels, or if its texels do not lie in words and it filters a border or has a
  // colour key or several levels.
  [[nodiscard]] static std::shared_ptr<const ByteSampler> make(const TextureSampler& of);

  // The codes of fragments [first, first + count), count from 1 to kBatchSize, to codes[component][fragment], and
  // which of them the colour key kills to `killed`; see TextureSampler::sample.
  void sample(const TextureCoordinates& at, std::size_t first, std::size_t count, const std::array<s9*, 4>& codes,
              std::uint8_t* killed) const;

 private:
  using BytePlane = Plane<const std::uint8_t>;

  // The way in which a batch's texels are found and read.
  enum class Method {
    linear,         // four texels and their weights, each component by itself
    nearest,        // one texel, each component by itself
    nearest_words,  // one texel, all its components in one word of memory
    filtered_words  // texels of any level in words
  };

  // The texels of a batch, as far as `method_` needs them: large, and not initialized.
  struct Texels {
    NearestLanes nearest;
    LinearLanes linear;
    alignas(64) LaneWords words;
    alignas(64) LaneIntegers lambda_q8;
    LevelLanes levels;
  };

  explicit ByteSampler(const TextureSampler& of);

  void find_planes(const Texture& texture);
  [[nodiscard]] bool find_face_words(std::size_t faces);
  [[nodiscard]] bool find_level_words(const Texture& texture);
  void find_texels(const TextureCoordinates& at, std::size_t first, std::size_t count, Texels& to) const;
  void filter(const TextureCoordinates& at, std::size_t first, std::size_t count, Texels& to) const;
  void fetch_words(const TextureCoordinates& at, std::size_t first, std::size_t count, LaneWords& to) const;
  void flip(std::size_t component, std::size_t count, s9* codes) const;
  void read_component(const Texels& texels, std::size_t component, std::size_t count, s9* to) const;
  template <class Lanes>
  void fetch(std::size_t component, const Lanes& lanes, const LaneIntegers& offset, std::size_t count, s9* to) const;

  LaneLevel level_;
  Method method_ = Method::nearest;
  LevelRules rules_;
  bool needs_detail_;
  int lod_bias_q8_;
  int byte_shift_;
  std::array<int, 4> source_;  // as in TextureSampler
  std::array<s9, 4> constant_;
  std::array<std::uint8_t, 4> flip_{};  // 0x80 for signed components
  StoredBytes border_{};                // the border's colour
  WordKey key_{};                       // nearest_words

  // Level 0's planes of all faces, by component.
  std::array<std::array<BytePlane, 6>, 4> plane_{};
  // True if all planes have rows and steps of one length, a row is a whole number of steps, and offsets fit 32 bits.
  bool alike_ = true;
  std::ptrdiff_t step_ = 1;
  WordLevels words_{};     // filtered_words
  FaceWords face_word_{};  // nearest_words: where each face begins, in words from the first one's beginning
};

}  // namespace ninebit
