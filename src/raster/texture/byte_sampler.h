// Textures of bytes without mip-maps, sampled a batch at a time: texels are found and weighed in SIMD lanes.
#pragma once

#include <array>
#include <cstddef>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/sampler.h"
#include "src/raster/texture/texture_lanes.h"

namespace ninebit {

// Gives the codes that TextureSampler computes fragment by fragment for other textures.
class TextureSampler::ByteSampler {
 public:
  // True if `of` reads bytes, from one level, and no border.
  [[nodiscard]] static bool can_sample(const TextureSampler& of);

  // Copies what it needs of `of`, for which can_sample; its texture must outlive this.
  explicit ByteSampler(const TextureSampler& of);

  // The codes of fragments [first, first + count), count from 1 to kBatchSize, to codes[component][fragment].
  void sample(const TextureCoordinates& at, std::size_t first, std::size_t count,
              const std::array<s9*, 4>& codes) const;

 private:
  using BytePlane = Plane<const std::uint8_t>;

  // The way in which a batch's texels are found and read.
  enum class Method {
    linear,        // four texels and their weights, each component by itself
    nearest,       // one texel, each component by itself
    nearest_words  // one texel, all its components in one word of memory
  };

  // The texels of a batch, as far as `method_` needs them: large, and not initialized.
  struct Texels {
    NearestLanes nearest;
    LinearLanes linear;
    alignas(64) LaneWords words;
  };

  void find_planes(const Texture& texture);
  [[nodiscard]] bool find_face_words(std::size_t faces);
  void find_texels(const TextureCoordinates& at, std::size_t first, std::size_t count, Texels& to) const;
  void fetch_words(const TextureCoordinates& at, std::size_t first, std::size_t count, LaneWords& to) const;
  void read_component(const Texels& texels, std::size_t component, std::size_t count, s9* to) const;
  template <class Lanes>
  void fetch(std::size_t component, const Lanes& lanes, const LaneIntegers& offset, std::size_t count, s9* to) const;

  LaneLevel level_;
  Method method_ = Method::nearest;
  int weight_bits_;
  int byte_shift_;
  std::array<int, 4> source_;  // as in TextureSampler
  std::array<s9, 4> constant_;

  // Level 0's planes of all faces, by component.
  std::array<std::array<BytePlane, 6>, 4> plane_{};
  // True if all planes have rows and steps of one length, a row is a whole number of steps, and offsets fit 32 bits.
  bool alike_ = true;
  std::ptrdiff_t step_ = 1;
  FaceWords face_word_{};  // nearest_words: where each face begins, in words from the first one's beginning
};

}  // namespace ninebit
