// Textures of bytes without mip-maps: the texels are found and weighed in SIMD lanes, and fetched byte by byte.
#include <algorithm>
#include <variant>

#include "src/raster/texture_lanes.h"

namespace ninebit {
namespace {

using BytePlane = Plane<const std::uint8_t>;

// How offsets count where planes have rows of several lengths: y in the upper half.
constexpr std::int32_t kUpperHalf = 0x10000;

// Level 0's planes of all faces, by component.
struct LevelPlanes {
  std::array<std::array<BytePlane, 6>, 4> plane{};
  bool alike = true;  // all have rows of one length, and offsets fit 32 bits
  std::int32_t stride = 0;
};

LevelPlanes level_planes(const Texture& texture) {
  constexpr std::ptrdiff_t kLongestRow = 0x1FFFF;  // kMaxSurfaceSize times this is less than 2^31
  const std::array<bool, 4> stored = stored_components(texture.format);
  LevelPlanes level;
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    const auto& of_face = *std::get_if<std::array<BytePlane, 4>>(&texture.faces[f][0].planes);
    for (std::size_t k = 0; k < 4; ++k) level.plane[k][f] = of_face[k];
  }
  const std::ptrdiff_t stride = level.plane[stored[0] ? 0 : 3][0].stride;
  level.alike = stride >= -kLongestRow && stride <= kLongestRow;
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    for (std::size_t k = 0; k < 4; ++k) level.alike = level.alike && (!stored[k] || level.plane[k][f].stride == stride);
  }
  level.stride = level.alike ? static_cast<std::int32_t>(stride) : kUpperHalf;
  return level;
}

// One component of every fragment's texel. Loads of single bytes: gathers are no faster, nor may they read beyond a
// plane; an interleaved copy of the texture takes as long as it saves in a frame.
void fetch(const std::array<BytePlane, 6>& faces, bool alike, const LaneIntegers& offset, const LaneIntegers& face,
           bool one_face, std::size_t count, s9* to) {
  const auto plane_of = [&](std::size_t i) -> const BytePlane& { return faces[static_cast<std::size_t>(face[i])]; };
  if (!alike) {
    for (std::size_t i = 0; i < count; ++i) to[i] = plane_of(i).at(offset[i] % kUpperHalf, offset[i] / kUpperHalf);
  } else if (one_face) {
    const std::uint8_t* const plane = plane_of(0).data;
    for (std::size_t i = 0; i < count; ++i) to[i] = plane[offset[i]];
  } else {
    for (std::size_t i = 0; i < count; ++i) to[i] = plane_of(i).data[offset[i]];
  }
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
  if (linear) {
    find_linear(level, weight_bits_, batch, count, quads);
  } else {
    find_nearest(level, batch, count, nearest);
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
    const std::array<BytePlane, 6>& faces = planes.plane[static_cast<std::size_t>(source_[out])];
    if (linear) {
      CornerBytes corner;
      std::array<s9, kBatchSize> sum;
      for (std::size_t k = 0; k < 4; ++k) {
        fetch(faces, planes.alike, quads.offset[k], quads.face, quads.one_face, count, corner[k].data());
        std::fill(corner[k].begin() + static_cast<std::ptrdiff_t>(count), corner[k].end(), s9{0});
      }
      weigh_linear(quads, corner, weight_bits_, count, sum);
      std::copy_n(sum.begin(), count, to);
    } else {
      fetch(faces, planes.alike, nearest.offset, nearest.face, nearest.one_face, count, to);
    }
    if (byte_shift_ == 0) continue;
    for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<s9>(to[i] >> byte_shift_);
  }
}

}  // namespace ninebit
