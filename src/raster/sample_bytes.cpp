// Textures of bytes without mip-maps: the texels are found and weighed in SIMD lanes, and fetched byte by byte.
#include <algorithm>
#include <cstring>
#include <type_traits>
#include <variant>

#include "src/raster/color_words.h"
#include "src/raster/texture_lanes.h"

namespace ninebit {
namespace {

using BytePlane = Plane<const std::uint8_t>;

// How offsets count where planes have rows of several lengths: y in the upper half.
constexpr std::int32_t kUpperHalf = 0x10000;

// Level 0's planes of all faces, by component.
struct LevelPlanes {
  std::array<std::array<BytePlane, 6>, 4> plane{};
  bool alike = true;   // all have rows and steps of one length, a row is whole steps, and offsets fit 32 bits
  bool words = false;  // and each texel is a word of memory, red in its first byte, alpha in its last
  std::int32_t stride = 0;
  std::ptrdiff_t step = 1;
};

LevelPlanes level_planes(const Texture& texture) {
  constexpr std::ptrdiff_t kLongestRow = 0x1FFFF;  // kMaxSurfaceSize times this is less than 2^31
  const std::array<bool, 4> stored = stored_components(texture.format);
  LevelPlanes level;
  level.words = stored[0] && stored[1] && stored[2];
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    const auto& of_face = *std::get_if<std::array<BytePlane, 4>>(&texture.faces[f][0].planes);
    for (std::size_t k = 0; k < 4; ++k) level.plane[k][f] = of_face[k];
    level.words = level.words && are_words(of_face);
  }
  const BytePlane& first = level.plane[stored[0] ? 0 : 3][0];
  level.step = first.step;
  const std::ptrdiff_t stride = first.stride / first.step;
  level.alike = stride >= -kLongestRow && stride <= kLongestRow && first.stride % first.step == 0;
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    for (std::size_t k = 0; k < 4; ++k) {
      const BytePlane& plane = level.plane[k][f];
      level.alike = level.alike && (!stored[k] || (plane.stride == first.stride && plane.step == first.step));
    }
  }
  level.words = level.words && level.alike;
  level.stride = level.alike ? static_cast<std::int32_t>(stride) : kUpperHalf;
  return level;
}

// Calls take(i, texel) with the address of every fragment's texel in the planes of one component.
template <class Lanes, class Take>
void visit_texels(const LevelPlanes& level, std::size_t component, const Lanes& lanes, const LaneIntegers& offset,
                  std::size_t count, Take take) {
  const std::array<BytePlane, 6>& faces = level.plane[component];
  const auto plane_of = [&](std::size_t i) -> const BytePlane& {
    return faces[static_cast<std::size_t>(lanes.face[i])];
  };
  const auto visit = [&](auto step) {
    if (lanes.one_face) {
      const std::uint8_t* const plane = plane_of(0).data;
      for (std::size_t i = 0; i < count; ++i) take(i, plane + step * offset[i]);
    } else {
      for (std::size_t i = 0; i < count; ++i) take(i, plane_of(i).data + step * offset[i]);
    }
  };
  if (!level.alike) {
    for (std::size_t i = 0; i < count; ++i) take(i, &plane_of(i).at(offset[i] % kUpperHalf, offset[i] / kUpperHalf));
  } else if (level.step == 1) {
    visit(std::integral_constant<std::ptrdiff_t, 1>());
  } else if (level.step == 4) {
    visit(std::integral_constant<std::ptrdiff_t, 4>());
  } else {
    visit(level.step);
  }
}

// One component of every fragment's texel. Loads of single bytes: gathers are no faster, nor may they read beyond a
// plane.
template <class Lanes>
void fetch(const LevelPlanes& level, std::size_t component, const Lanes& lanes, const LaneIntegers& offset,
           std::size_t count, s9* to) {
  visit_texels(level, component, lanes, offset, count,
               [to](std::size_t i, const std::uint8_t* texel) { to[i] = *texel; });
}

void fetch_words(const LevelPlanes& level, const NearestLanes& lanes, std::size_t count, LaneWords& to) {
  const std::uint8_t* const first = level.plane[0][static_cast<std::size_t>(lanes.face[0])].data;
  if (lanes.one_face && reinterpret_cast<std::uintptr_t>(first) % alignof(std::uint32_t) == 0) {
    return gather_words(first, lanes.offset, count, to);
  }
  visit_texels(level, 0, lanes, lanes.offset, count,
               [&to](std::size_t i, const std::uint8_t* texel) { std::memcpy(&to[i], texel, sizeof(to[i])); });
}

// Whole batches are read where they stand; what follows fewer coordinates is not ours to read.
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
  const LevelPlanes planes = level_planes(*texture_);
  const TextureImage& base = texture_->faces[0][0];
  const LaneLevel level{.cube = cube_,
                        .width = base.width,
                        .height = base.height,
                        .wrap_s = sampler_.wrap_s,
                        .wrap_t = sampler_.wrap_t,
                        .stride = planes.stride};
  CoordinateRoom room;
  const std::array<const float*, 3> batch = whole_batch(at, first, count, cube_ ? 3 : 2, room);
  const bool linear = sampler_.min_filter == MinFilter::linear;
  NearestLanes nearest;
  LinearLanes quads;
  alignas(64) LaneWords words;
  if (linear) {
    find_linear(level, weight_bits_, batch, count, quads);
  } else {
    find_nearest(level, batch, count, nearest);
    if (planes.words) fetch_words(planes, nearest, count, words);
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
        fetch(planes, component, quads, quads.offset[k], count, corner[k].data());
        std::fill(corner[k].begin() + static_cast<std::ptrdiff_t>(count), corner[k].end(), s9{0});
      }
      weigh_linear(quads, corner, weight_bits_, count, sum);
      std::copy_n(sum.begin(), count, to);
    } else if (planes.words) {
      split_words(words, source_[out], count, to);
    } else {
      fetch(planes, component, nearest, nearest.offset, count, to);
    }
    if (byte_shift_ == 0) continue;
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<s9>(to[i] >> byte_shift_);
  }
}

}  // namespace ninebit
