// Textures of bytes without mip-maps: the texels are found and weighed in SIMD lanes, and fetched byte by byte.
#include <algorithm>
#include <cstring>
#include <type_traits>
#include <variant>

#include "src/raster/lanes/texture_lanes.h"
#include "src/raster/surface/color_words.h"

namespace ninebit {
namespace {

using BytePlane = Plane<const std::uint8_t>;

// How offsets count where planes have rows of several lengths: y in the upper half.
constexpr std::int32_t kUpperHalf = 0x10000;

}  // namespace

// Level 0's planes of all faces, by component.
struct TextureSampler::BytePlanes {
  std::array<std::array<BytePlane, 6>, 4> plane{};
  bool alike = true;   // all have rows and steps of one length, a row is whole steps, and offsets fit 32 bits
  bool words = false;  // and each texel is a word of memory, red in its first byte, alpha in its last, all near enough
  std::int32_t stride = 0;
  std::ptrdiff_t step = 1;
  FaceWords face_word{};  // of words: where each face begins, in words from the first one's beginning

  explicit BytePlanes(const Texture& texture);

  // One component of every fragment's texel. Loads of single bytes: gathers are no faster, nor may they read beyond a
  // plane.
  template <class Lanes>
  void fetch(std::size_t component, const Lanes& lanes, const LaneIntegers& offset, std::size_t count, s9* to) const;
  // The texels of words.
  void fetch_words(const LaneLevel& level, const TextureCoordinates& at, std::size_t first, std::size_t count,
                   LaneWords& to) const;

 private:
  [[nodiscard]] bool find_face_words(std::size_t faces);
};

TextureSampler::BytePlanes::BytePlanes(const Texture& texture) {
  constexpr std::ptrdiff_t kLongestRow = 0x1FFFF;  // kMaxSurfaceSize times this is less than 2^31
  const std::array<bool, 4> stored = stored_components(texture.format);
  words = stored[0] && stored[1] && stored[2];
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    const auto& of_face = *std::get_if<std::array<BytePlane, 4>>(&texture.faces[f][0].planes);
    for (std::size_t k = 0; k < 4; ++k) plane[k][f] = of_face[k];
    words = words && are_words(of_face);
  }
  const BytePlane& first = plane[stored[0] ? 0 : 3][0];
  step = first.step;
  const std::ptrdiff_t steps = first.stride / first.step;
  alike = steps >= -kLongestRow && steps <= kLongestRow && first.stride % first.step == 0;
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    for (std::size_t k = 0; k < 4; ++k) {
      const BytePlane& other = plane[k][f];
      alike = alike && (!stored[k] || (other.stride == first.stride && other.step == first.step));
    }
  }
  stride = alike ? static_cast<std::int32_t>(steps) : kUpperHalf;
  words = words && alike && find_face_words(texture.face_count());
}

// Vectors reach words within 2^31 of one place, from an aligned one on.
bool TextureSampler::BytePlanes::find_face_words(std::size_t faces) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 30;
  const auto address = [this](std::size_t f) { return reinterpret_cast<std::intptr_t>(plane[0][f].data); };
  if (std::abs(stride) > kFarthest / kMaxSurfaceSize) return false;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::intptr_t bytes = address(f) - address(0), word = bytes / 4;
    if (address(f) % 4 != 0 || word <= -kFarthest || word >= kFarthest) return false;
    face_word[f] = static_cast<std::int32_t>(word);
  }
  return true;
}

void TextureSampler::find_byte_planes() {
  byte_planes_ = std::make_shared<const BytePlanes>(*texture_);
}

template <class Lanes>
void TextureSampler::BytePlanes::fetch(std::size_t component, const Lanes& lanes, const LaneIntegers& offset,
                                       std::size_t count, s9* to) const {
  const std::array<BytePlane, 6>& faces = plane[component];
  const auto plane_of = [&](std::size_t i) -> const BytePlane& {
    return faces[static_cast<std::size_t>(lanes.face[i])];
  };
  const auto by_step = [&](auto samples) {
    if (lanes.one_face) {
      const std::uint8_t* const only = plane_of(0).data;
      for (std::size_t i = 0; i < count; ++i) to[i] = only[samples * offset[i]];
    } else {
      for (std::size_t i = 0; i < count; ++i) to[i] = plane_of(i).data[samples * offset[i]];
    }
  };
  if (!alike) {
    for (std::size_t i = 0; i < count; ++i) to[i] = plane_of(i).at(offset[i] % kUpperHalf, offset[i] / kUpperHalf);
  } else if (step == 1) {
    by_step(std::integral_constant<std::ptrdiff_t, 1>());
  } else if (step == 4) {
    by_step(std::integral_constant<std::ptrdiff_t, 4>());
  } else {
    by_step(step);
  }
}

// Groups of coordinates are read where they stand; what follows the last ones is not ours to read.
inline void TextureSampler::BytePlanes::fetch_words(const LaneLevel& level, const TextureCoordinates& at,
                                                    std::size_t first, std::size_t count, LaneWords& to) const {
  const std::size_t components = level.cube ? 3 : 2;
  const std::size_t whole = count / kMostLanes * kMostLanes, left = count - whole;
  std::array<const float*, 3> from{};
  for (std::size_t k = 0; k < components; ++k) from[k] = at.value[k] + first;
  if (whole > 0) fetch_nearest_words(level, from, plane[0][0].data, face_word, whole, to.data());
  if (left == 0) return;
  std::array<std::array<float, kMostLanes>, 3> rest{};
  for (std::size_t k = 0; k < components; ++k) {
    std::copy_n(from[k] + whole, left, rest[k].begin());
    from[k] = rest[k].data();
  }
  fetch_nearest_words(level, from, plane[0][0].data, face_word, left, to.data() + whole);
}

namespace {

// Whole batches are read where they stand, too.
using CoordinateRoom = std::array<std::array<float, kBatchSize>, 3>;
std::array<const float*, 3> whole_batch(const TextureCoordinates& at, std::size_t first, std::size_t count,
                                        std::size_t components, CoordinateRoom& room) {
  std::array<const float*, 3> batch{};
  for (std::size_t k = 0; k < components; ++k) {
    batch[k] = at.value[k] + first;
    if (count == kBatchSize) continue;
    std::fill(std::copy_n(batch[k], count, room[k].begin()), room[k].end(), 0.0F);
    batch[k] = room[k].data();
  }
  return batch;
}

}  // namespace

bool TextureSampler::samples_bytes() const {
  if (needs_derivatives_ || texture_->faces[0][0].planes.index() != 0) return false;
  if (sampler_.min_filter == MinFilter::nearest) return true;
  // The border is no texel.
  return sampler_.wrap_s != Wrap::clamp && sampler_.wrap_t != Wrap::clamp;
}

void TextureSampler::sample_bytes(const TextureCoordinates& at, std::size_t first, std::size_t count,
                                  const std::array<s9*, 4>& codes) const {
  const BytePlanes& planes = *byte_planes_;
  const TextureImage& base = texture_->faces[0][0];
  const LaneLevel level{.cube = cube_,
                        .width = base.width,
                        .height = base.height,
                        .wrap_s = sampler_.wrap_s,
                        .wrap_t = sampler_.wrap_t,
                        .stride = planes.stride};
  CoordinateRoom room;
  const bool linear = sampler_.min_filter == MinFilter::linear;
  NearestLanes nearest;
  LinearLanes quads;
  alignas(64) LaneWords words;
  const auto batch = [&] { return whole_batch(at, first, count, cube_ ? 3 : 2, room); };
  if (linear) {
    find_linear(level, weight_bits_, batch(), count, quads);
  } else if (planes.words) {
    planes.fetch_words(level, at, first, count, words);
  } else {
    find_nearest(level, batch(), count, nearest);
  }
  for (std::size_t out = 0; out < 4; ++out) {
    s9* const to = codes[out] + first;
    const auto twin =
        static_cast<std::size_t>(std::find(source_.begin(), source_.end(), source_[out]) - source_.begin());
    if (source_[out] < 0) {
      std::fill_n(to, count, constant_[out]);
      continue;
    }
    if (twin < out) {
      std::copy_n(codes[twin] + first, count, to);
      continue;
    }
    const auto component = static_cast<std::size_t>(source_[out]);
    if (linear) {
      CornerBytes corner;
      std::array<s9, kBatchSize> sum;
      for (std::size_t k = 0; k < 4; ++k) {
        planes.fetch(component, quads, quads.offset[k], count, corner[k].data());
        std::fill(corner[k].begin() + static_cast<std::ptrdiff_t>(count), corner[k].end(), s9{0});
      }
      weigh_linear(quads, corner, weight_bits_, count, sum);
      std::copy_n(sum.begin(), count, to);
    } else if (planes.words) {
      split_words(words, source_[out], count, to);
    } else {
      planes.fetch(component, nearest, nearest.offset, count, to);
    }
    if (byte_shift_ == 0) continue;
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<s9>(to[i] >> byte_shift_);
  }
}

}  // namespace ninebit
