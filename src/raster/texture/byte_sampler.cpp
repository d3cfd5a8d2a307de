#include "src/raster/texture/byte_sampler.h"

#include <algorithm>
#include <type_traits>
#include <variant>

#include "src/raster/surface/color_words.h"
#include "src/raster/texture/texture_level.h"

namespace ninebit {
namespace {

// The factor of y in offsets where planes have rows of several lengths: y is in the upper half.
constexpr std::int32_t kUpperHalf = 0x10000;

// The coordinates of a batch as the lanes read them, kBatchSize of each: in place where the batch is whole, else from
// `room`.
using CoordinateRoom = std::array<std::array<float, kBatchSize>, 3>;
std::array<const float*, 3> whole_batch(const std::array<const float*, 3>& at, std::size_t first, std::size_t count,
                                        std::size_t components, CoordinateRoom& room) {
  std::array<const float*, 3> batch{};
  for (std::size_t k = 0; k < components; ++k) {
    batch[k] = at[k] + first;
    if (count == kBatchSize) continue;
    std::fill(std::copy_n(batch[k], count, room[k].begin()), room[k].end(), 0.0F);
    batch[k] = room[k].data();
  }
  return batch;
}

int cube_detail_q8(int size, const TextureCoordinates& at, std::size_t i) {
  const auto triple = [](const std::array<const float*, 3>& of, std::size_t k) {
    return std::array<float, 3>{of[0][k], of[1][k], of[2][k]};
  };
  const std::size_t d = at.one_change ? 0 : i;
  TexelChanges changes = cube_changes(triple(at.value, i), triple(at.dx, d), triple(at.dy, d));
  for (double* const change : {&changes.ux, &changes.vx, &changes.uy, &changes.vy}) *change *= size;
  return level_of_detail_q8(rho_squared(changes));
}

// The level of detail that all fragments share, if their coordinates have one_change.
int one_detail_q8(int width, int height, const TextureCoordinates& at) {
  TexelChanges changes{at.dx[0][0], at.dx[1][0], at.dy[0][0], at.dy[1][0]};
  for (double* const change : {&changes.ux, &changes.uy}) *change *= width;
  for (double* const change : {&changes.vx, &changes.vy}) *change *= height;
  return level_of_detail_q8(rho_squared(changes));
}

}  // namespace

std::shared_ptr<const TextureSampler::ByteSampler> TextureSampler::ByteSampler::make(const TextureSampler& of) {
  if (of.texture_->faces[0][0].planes.index() != 0 || of.volume_ || of.rectangle_) return {};
  const Sampler& sampler = of.sampler_;
  const auto wraps = [&sampler](Wrap mode) { return sampler.wrap_s == mode || sampler.wrap_t == mode; };
  const bool filters = is_linear(sampler.min_filter) || sampler.mag_filter == MagFilter::linear;
  const bool has_key = sampler.color_key.operation != ColorKeyOperation::disable;
  // Lanes compare a key only where the nearest texel of level 0 is read.
  const bool has_border = sampler.border_texels || wraps(Wrap::clamp_to_border) || (filters && wraps(Wrap::clamp));
  if ((has_key || has_words(of.texture_->format)) && (filters || of.needs_derivatives_)) return {};
  const std::shared_ptr<const ByteSampler> made(new ByteSampler(of));
  const bool needs_words = of.needs_derivatives_ || (has_border && filters);
  if (needs_words && made->method_ != Method::filtered_words) return {};
  if (has_key && made->method_ != Method::nearest_words) return {};
  return made;
}

TextureSampler::ByteSampler::ByteSampler(const TextureSampler& of)
    : rules_{of.sampler_.min_filter, of.sampler_.mag_filter, of.last_level_, of.filter_rules_},
      needs_detail_(of.needs_derivatives_),
      lod_bias_q8_(of.lod_bias_q8_),
      byte_shift_(of.decodes_ ? 0 : of.byte_shift_),
      source_(of.source_),
      constant_(of.constant_) {
  for (std::size_t k = 0; k < 4; ++k) {
    flip_[k] = of.is_signed_[k] ? 0x80 : 0;
    border_[k] = static_cast<std::uint8_t>(of.border_code_[k]);
  }
  const std::uint32_t key = of.sampler_.color_key.key;
  key_ = {.operation = of.sampler_.color_key.operation,
          .word = (key & 0xFF00FF00) | (key >> 16 & 0xFF) | (key & 0xFF) << 16,
          .compared = of.key_bits()};
  const TextureImage& base = of.texture_->faces[0][0];
  const int images = of.sampler_.border_texels ? 2 : 1;
  level_ = {.cube = of.cube_,
            .border_texels = of.sampler_.border_texels,
            .width = base.width / images,
            .height = base.height / images,
            .wrap_s = of.sampler_.wrap_s,
            .wrap_t = of.sampler_.wrap_t};
  find_planes(*of.texture_);
  const bool one_nearest = of.sampler_.min_filter == MinFilter::nearest && !needs_detail_;
  if (one_nearest) return;
  method_ = find_level_words(*of.texture_) ? Method::filtered_words : Method::linear;
}

void TextureSampler::ByteSampler::find_planes(const Texture& texture) {
  constexpr std::ptrdiff_t kLongestRow = 0x1FFFF;  // kMaxSurfaceSize times this is less than 2^31
  const std::array<bool, 4> stored = stored_components(texture.format);
  bool words = stored[1] && stored[2];
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    const auto& of_face = *std::get_if<std::array<BytePlane, 4>>(&texture.faces[f][0].planes);
    for (std::size_t k = 0; k < 4; ++k) plane_[k][f] = of_face[k];
    words = words && are_words(of_face);
  }
  const BytePlane& first = plane_[stored[0] ? 0 : 3][0];
  step_ = first.step;
  const std::ptrdiff_t steps = first.stride / first.step;
  alike_ = steps >= -kLongestRow && steps <= kLongestRow && first.stride % first.step == 0;
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    for (std::size_t k = 0; k < 4; ++k) {
      const BytePlane& other = plane_[k][f];
      alike_ = alike_ && (!stored[k] || (other.stride == first.stride && other.step == first.step));
    }
  }
  level_.stride = alike_ ? static_cast<std::int32_t>(steps) : kUpperHalf;
  if (words && alike_ && find_face_words(texture.face_count())) method_ = Method::nearest_words;
}

// False unless vectors can reach all faces: words within 2^31 of one place, from an aligned one on.
bool TextureSampler::ByteSampler::find_face_words(std::size_t faces) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 30;
  const auto address = [this](std::size_t f) { return reinterpret_cast<std::intptr_t>(plane_[0][f].data); };
  if (std::abs(level_.stride) > kFarthest / kMaxSurfaceSize) return false;
  for (std::size_t f = 0; f < faces; ++f) {
    const std::intptr_t bytes = address(f) - address(0), word = bytes / 4;
    if (address(f) % 4 != 0 || word <= -kFarthest || word >= kFarthest) return false;
    face_word_[f] = static_cast<std::int32_t>(word);
  }
  return true;
}

// The same of all levels that are read. False unless each one's rows are whole words.
bool TextureSampler::ByteSampler::find_level_words(const Texture& texture) {
  constexpr std::int64_t kFarthest = std::int64_t{1} << 30;
  words_ = {.width = level_.width,
            .height = level_.height,
            .count = rules_.last_level + 1,
            .wrap_s = level_.wrap_s,
            .wrap_t = level_.wrap_t};
  words_.cube = level_.cube;
  words_.border_texels = level_.border_texels;
  words_.border = word_of(border_);
  for (std::size_t k = 0; k < 4; ++k) words_.flip |= std::uint32_t{flip_[k]} << (8 * k);
  std::intptr_t first = 0;
  for (std::size_t f = 0; f < texture.face_count(); ++f) {
    for (std::size_t level = 0; level < static_cast<std::size_t>(words_.count); ++level) {
      const auto& planes = *std::get_if<std::array<BytePlane, 4>>(&texture.faces[f][level].planes);
      const auto address = reinterpret_cast<std::intptr_t>(planes[0].data);
      if (f == 0 && level == 0) first = address;
      const std::intptr_t word = (address - first) / 4, stride = planes[0].stride / 4;
      if (!are_words(planes) || address % 4 != 0 || planes[0].stride % 4 != 0) return false;
      if (std::abs(word) >= kFarthest || std::abs(stride) > kFarthest / kMaxSurfaceSize) return false;
      if (f > 0 && stride != words_.stride[level]) return false;
      words_.stride[level] = static_cast<std::int32_t>(stride);
      words_.begin[f * WordLevels::kRoom + level] = static_cast<std::int32_t>(word);
    }
  }
  words_.first = reinterpret_cast<const std::uint8_t*>(first);
  const std::array<bool, 4> stored = stored_components(texture.format);
  return stored[1] && stored[2];
}

void TextureSampler::ByteSampler::find_texels(const TextureCoordinates& at, std::size_t first, std::size_t count,
                                              Texels& to) const {
  CoordinateRoom room;
  const auto batch = [&] { return whole_batch(at.value, first, count, level_.cube ? 3 : 2, room); };
  switch (method_) {
    case Method::linear:
      find_linear(level_, rules_.filter, batch(), count, to.linear);
      break;
    case Method::nearest:
      find_nearest(level_, batch(), count, to.nearest);
      break;
    case Method::nearest_words:
      fetch_words(at, first, count, to.words);
      break;
    case Method::filtered_words:
      filter(at, first, count, to);
      break;
  }
}

// The words of a batch's filtered texels.
void TextureSampler::ByteSampler::filter(const TextureCoordinates& at, std::size_t first, std::size_t count,
                                         Texels& to) const {
  CoordinateRoom room, dx_room, dy_room;
  const std::size_t components = level_.cube ? 3 : 2;
  const auto value = whole_batch(at.value, first, count, components, room);
  if (!needs_detail_) return filter_words(words_, rules_.filter, value, nullptr, count, to.words);
  const int images = level_.border_texels ? 2 : 1;  // the level of detail is that of the whole image
  const int width = images * level_.width, height = images * level_.height;
  to.levels.are_same = at.one_change && !level_.cube;
  const std::size_t chosen = to.levels.are_same ? kMostLanes : count;
  if (to.levels.are_same) {
    std::fill_n(to.lambda_q8.begin(), chosen, one_detail_q8(width, height, at));
  } else if (level_.cube) {
    for (std::size_t i = 0; i < count; ++i) to.lambda_q8[i] = cube_detail_q8(width, at, first + i);
    std::fill(to.lambda_q8.begin() + static_cast<std::ptrdiff_t>(count), to.lambda_q8.end(), 0);
  } else {
    const auto dx = whole_batch(at.dx, first, count, 2, dx_room), dy = whole_batch(at.dy, first, count, 2, dy_room);
    find_detail(width, height, {dx[0], dy[0]}, {dx[1], dy[1]}, count, to.lambda_q8);
  }
  for (std::size_t i = 0; i < chosen; ++i) to.lambda_q8[i] += lod_bias_q8_;
  choose_levels(rules_, to.lambda_q8, chosen, to.levels);
  filter_words(words_, rules_.filter, value, &to.levels, count, to.words);
}

// The words of a batch's texels. Whole groups of coordinates are read in place; the rest is copied, as what follows it
// may not be read.
inline void TextureSampler::ByteSampler::fetch_words(const TextureCoordinates& at, std::size_t first, std::size_t count,
                                                     LaneWords& to) const {
  const std::size_t components = level_.cube ? 3 : 2;
  const std::size_t whole = count / kMostLanes * kMostLanes, left = count - whole;
  std::array<const float*, 3> from{};
  for (std::size_t k = 0; k < components; ++k) from[k] = at.value[k] + first;
  const TexelWords texels{plane_[0][0].data, face_word_, word_of(border_)};
  if (whole > 0) fetch_nearest_words(level_, from, texels, whole, to.data());
  if (left == 0) return;
  std::array<std::array<float, kMostLanes>, 3> rest{};
  for (std::size_t k = 0; k < components; ++k) {
    std::copy_n(from[k] + whole, left, rest[k].begin());
    from[k] = rest[k].data();
  }
  fetch_nearest_words(level_, from, texels, left, to.data() + whole);
}

// One component of one texel a fragment. Loads of single bytes: gathers are no faster, and may not read beyond a plane.
template <class Lanes>
void TextureSampler::ByteSampler::fetch(std::size_t component, const Lanes& lanes, const LaneIntegers& offset,
                                        std::size_t count, s9* to) const {
  const std::array<BytePlane, 6>& faces = plane_[component];
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
  if (!alike_) {
    for (std::size_t i = 0; i < count; ++i) to[i] = plane_of(i).at(offset[i] % kUpperHalf, offset[i] / kUpperHalf);
  } else if (step_ == 1) {
    by_step(std::integral_constant<std::ptrdiff_t, 1>());
  } else if (step_ == 4) {
    by_step(std::integral_constant<std::ptrdiff_t, 4>());
  } else {
    by_step(step_);
  }
}

// One component of a batch's texels, filtered.
void TextureSampler::ByteSampler::read_component(const Texels& texels, std::size_t component, std::size_t count,
                                                 s9* to) const {
  if (method_ == Method::nearest) {
    fetch(component, texels.nearest, texels.nearest.offset, count, to);
    for (std::size_t i = 0; i < count && level_.has_border_color(); ++i) {
      if (texels.nearest.outside[i] != 0) to[i] = border_[component];
    }
    return;
  }
  CornerBytes corner;
  for (std::size_t k = 0; k < 4; ++k) {
    fetch(component, texels.linear, texels.linear.offset[k], count, corner[k].data());
    flip(component, count, corner[k].data());
    std::fill(corner[k].begin() + static_cast<std::ptrdiff_t>(count), corner[k].end(), s9{0});
  }
  std::array<s9, kBatchSize> sum;
  weigh_linear(texels.linear, corner, rules_.filter, count, sum);
  std::copy_n(sum.begin(), count, to);
  flip(component, count, to);
}

// Two's complement with its highest bit flipped is filtered like any byte.
void TextureSampler::ByteSampler::flip(std::size_t component, std::size_t count, s9* codes) const {
  if (flip_[component] == 0) return;
  for (std::size_t i = 0; i < count; ++i) codes[i] = static_cast<s9>(codes[i] ^ flip_[component]);
}

void TextureSampler::ByteSampler::sample(const TextureCoordinates& at, std::size_t first, std::size_t count,
                                         const std::array<s9*, 4>& codes, std::uint8_t* killed) const {
  Texels texels;
  find_texels(at, first, count, texels);
  if (key_.operation != ColorKeyOperation::disable) apply_key(key_, count, texels.words, killed);
  // The first component that reads each texel component; the others copy its codes.
  std::array<s9*, 4> to{};
  for (std::size_t out = 4; out-- > 0;) {
    if (source_[out] >= 0) to[static_cast<std::size_t>(source_[out])] = codes[out] + first;
  }
  if (method_ == Method::nearest_words || method_ == Method::filtered_words) {
    split_words(texels.words, byte_shift_, count, to);
  } else {
    for (std::size_t k = 0; k < 4; ++k) {
      if (to[k] == nullptr) continue;
      read_component(texels, k, count, to[k]);
      for (std::size_t i = 0; i < count && byte_shift_ != 0; ++i) to[k][i] = static_cast<s9>(to[k][i] >> byte_shift_);
    }
  }
  for (std::size_t out = 0; out < 4; ++out) {
    s9* const codes_out = codes[out] + first;
    if (source_[out] < 0) {
      std::fill_n(codes_out, count, constant_[out]);
    } else if (const s9* const from = to[static_cast<std::size_t>(source_[out])]; from != codes_out) {
      std::copy_n(from, count, codes_out);
    }
  }
}

}  // namespace ninebit
