#include "ninebit/raster/sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "src/raster/texture/byte_sampler.h"
#include "src/raster/texture/cube_face.h"
#include "src/raster/texture/texture_level.h"
#include "src/raster/texture/texture_wrap.h"

namespace ninebit {
namespace {

constexpr float kMaxLodBias = 15.0F;

// A number from 0 to 1 as a code of 0 to `largest`, to nearest, halves up; NaN gives 0. A float times 24 bits is exact
// in a double.
std::uint32_t code_of(float value, std::uint32_t largest) {
  if (!(value > 0.0F)) return 0;
  if (value >= 1.0F) return largest;
  return static_cast<std::uint32_t>(static_cast<double>(value) * largest + 0.5);
}

int lod_bias_q8(float bias) {
  if (std::isnan(bias)) return 0;
  return static_cast<int>(std::floor(static_cast<double>(std::clamp(bias, -kMaxLodBias, kMaxLodBias)) * 256.0 + 0.5));
}

std::uint8_t byte_of_depth(std::uint32_t code, std::uint32_t largest) {
  return static_cast<std::uint8_t>((std::uint64_t{code} * 510 + largest) / (std::uint64_t{largest} * 2));
}

double real_of(Half value) {
  return static_cast<double>(float_of(value));
}
double real_of(float value) {
  return static_cast<double>(value);
}

std::array<float, 3> triple(const std::array<const float*, 3>& arrays, std::size_t i) {
  return {arrays[0][i], arrays[1][i], arrays[2] == nullptr ? 0.0F : arrays[2][i]};
}

}  // namespace

struct TextureSampler::Taps {
  struct Tap {
    const TextureImage* image = nullptr;
    int x = 0;  // x and y: kBorderTexel for either is the border
    int y = 0;
    std::uint32_t weight = 0;
    [[nodiscard]] bool is_border() const { return x == kBorderTexel || y == kBorderTexel; }
  };
  std::array<Tap, 8> tap;
  std::size_t count = 0;
  int shift = 0;  // the weights' sum is 2^shift

  void add(const TextureImage& image, int x, int y, std::uint32_t weight) {
    if (weight != 0) tap[count++] = {&image, x, y, weight};
  }
};

struct TextureSampler::Filtered {
  std::array<std::uint32_t, 4> code{};  // bytes, or a depth code in the first
  std::array<double, 4> real{};         // of float formats
};

std::optional<TextureSampler> TextureSampler::make(const HardwareProfile& profile, const Texture& texture,
                                                   const Sampler& sampler) {
  const bool mipmaps = uses_mipmaps(sampler.min_filter);
  if (!is_complete(texture, mipmaps)) return std::nullopt;
  TextureSampler made;
  made.texture_ = &texture;
  made.sampler_ = sampler;
  made.format_ = base_format(texture.format);
  if (made.format_ == TextureFormat::depth && sampler.comparison != DepthComparison::none) {
    made.comparison_ = sampler.comparison;
    made.format_ = TextureFormat::depth_comparison;
  }
  made.cube_ = texture.target == TextureTarget::cube_map;
  made.needs_derivatives_ = mipmaps || is_linear(sampler.min_filter) != (sampler.mag_filter == MagFilter::linear);
  const TextureImage& base = texture.faces[0][0];
  if (mipmaps) {
    made.last_level_ = static_cast<int>(std::bit_width(static_cast<unsigned>(std::max(base.width, base.height)))) - 1;
  }
  made.lod_bias_q8_ = lod_bias_q8(sampler.lod_bias);
  made.weight_bits_ = profile.texture_weight_bits;
  made.byte_shift_ = profile.byte_shift;
  made.max_depth_ = texture.format == InternalFormat::depth16 ? 0xFFFF : 0xFFFFFF;
  const std::uint32_t largest = base_format(texture.format) == TextureFormat::depth ? made.max_depth_ : 255;
  for (std::size_t i = 0; i < 4; ++i) {
    float& border = made.sampler_.border_color[i];
    border = border > 0.0F ? std::min(border, 1.0F) : 0.0F;
    made.border_code_[i] = code_of(border, largest);
  }
  // texel_codes decides which byte of a texel each code comes from; it passes one byte at a time.
  made.constant_ = texel_codes(profile, {.format = made.format_});
  for (std::size_t out = 0; out < 4; ++out) {
    made.source_[out] = -1;
    for (std::size_t in = 0; in < 4; ++in) {
      Texel probe{.format = made.format_};
      probe.value[in] = 255;
      if (texel_codes(profile, probe)[out] != made.constant_[out]) made.source_[out] = static_cast<int>(in);
    }
  }
  if (ByteSampler::can_sample(made)) made.byte_sampler_ = std::make_shared<const ByteSampler>(made);
  return made;
}

void TextureSampler::add_level(Taps& taps, std::size_t face, int level, float s, float t, bool linear,
                               std::uint32_t weight) const {
  const TextureImage& image = texture_->faces[face][static_cast<std::size_t>(level)];
  if (!linear) {
    taps.add(image, nearest_texel(s, image.width, sampler_.wrap_s), nearest_texel(t, image.height, sampler_.wrap_t),
             weight);
    return;
  }
  const LinearTexels u = linear_texels(s, image.width, sampler_.wrap_s, weight_bits_);
  const LinearTexels v = linear_texels(t, image.height, sampler_.wrap_t, weight_bits_);
  const std::uint32_t one = std::uint32_t{1} << weight_bits_;
  taps.add(image, u.first, v.first, weight * (one - u.weight) * (one - v.weight));
  taps.add(image, u.second, v.first, weight * u.weight * (one - v.weight));
  taps.add(image, u.first, v.second, weight * (one - u.weight) * v.weight);
  taps.add(image, u.second, v.second, weight * u.weight * v.weight);
}

TextureSampler::Filtered TextureSampler::filter(const TextureCoordinates& at, std::size_t i) const {
  const std::array<float, 3> value = triple(at.value, i);
  CubeCoordinate place{CubeFace::positive_x, value[0], value[1]};
  if (cube_) place = cube_coordinate_inline(value[0], value[1], value[2]);
  const auto face = static_cast<std::size_t>(place.face);
  int lambda_q8 = kNoTexels;
  if (needs_derivatives_) {
    const std::array<float, 3> dx = triple(at.dx, i), dy = triple(at.dy, i);
    TexelChanges changes = cube_ ? cube_changes(value, dx, dy) : TexelChanges{dx[0], dx[1], dy[0], dy[1]};
    const TextureImage& base = texture_->faces[face][0];
    changes.ux *= base.width;
    changes.uy *= base.width;
    changes.vx *= base.height;
    changes.vy *= base.height;
    lambda_q8 = level_of_detail_q8(rho_squared(changes)) + lod_bias_q8_;
  }
  const LevelChoice choice = choose_level(sampler_.min_filter, sampler_.mag_filter, lambda_q8, last_level_);
  Taps taps;
  taps.shift = choice.linear ? 2 * weight_bits_ : 0;
  if (choice.two_levels) {
    const std::uint32_t one = std::uint32_t{1} << weight_bits_;
    const std::uint32_t second = static_cast<std::uint32_t>(choice.between_q8) >> (8 - weight_bits_);
    taps.shift += weight_bits_;
    add_level(taps, face, choice.level, place.s, place.t, choice.linear, one - second);
    if (second != 0) add_level(taps, face, choice.level + 1, place.s, place.t, choice.linear, second);
  } else {
    add_level(taps, face, choice.level, place.s, place.t, choice.linear, 1);
  }
  return weigh(taps, value[2]);
}

TextureSampler::Filtered TextureSampler::weigh(const Taps& taps, float r) const {
  Filtered result;
  const std::array<bool, 4> stored = stored_components(texture_->format);
  const std::uint32_t reference = comparison_ == DepthComparison::none ? 0 : code_of(r, max_depth_);
  const auto compared = [&](std::uint32_t depth) -> std::uint32_t {
    if (comparison_ == DepthComparison::none) return depth;
    return (comparison_ == DepthComparison::lequal ? reference <= depth : reference >= depth) ? 255 : 0;
  };
  // Texel by texel, its components in turn: of the border, or where its planes hold them.
  const auto visit_taps = [&](auto planes_type, const auto& border, const auto& add) {
    using Planes = decltype(planes_type);
    for (std::size_t i = 0; i < taps.count; ++i) {
      const Taps::Tap& tap = taps.tap[i];
      const Planes& planes = *std::get_if<Planes>(&tap.image->planes);
      for (std::size_t k = 0; k < 4; ++k) {
        if (!stored[k]) continue;
        if (tap.is_border()) {
          add(k, tap.weight, border[k]);
        } else {
          add(k, tap.weight, planes[k].at(tap.x, tap.y));
        }
      }
    }
  };
  const auto sum_codes = [&](auto planes_type) {
    std::array<std::uint64_t, 4> sum{};
    visit_taps(planes_type, border_code_, [&](std::size_t k, std::uint32_t weight, std::uint32_t code) {
      sum[k] += std::uint64_t{weight} * compared(code);
    });
    const std::uint64_t half = (std::uint64_t{1} << taps.shift) >> 1;
    for (std::size_t k = 0; k < 4; ++k) result.code[k] = static_cast<std::uint32_t>((sum[k] + half) >> taps.shift);
  };
  const auto sum_reals = [&](auto planes_type) {
    std::array<double, 4> sum{};
    visit_taps(planes_type, sampler_.border_color, [&](std::size_t k, std::uint32_t weight, auto texel) {
      sum[k] += static_cast<double>(weight) * real_of(texel);
    });
    for (std::size_t k = 0; k < 4; ++k) result.real[k] = std::ldexp(sum[k], -taps.shift);
  };
  switch (texture_->format) {
    case InternalFormat::depth16:
    case InternalFormat::depth24:
      sum_codes(std::array<Plane<const std::uint32_t>, 4>{});
      break;
    case InternalFormat::rgba16f:
      sum_reals(std::array<Plane<const Half>, 4>{});
      break;
    case InternalFormat::rgba32f:
      sum_reals(std::array<Plane<const float>, 4>{});
      break;
    default:
      sum_codes(std::array<Plane<const std::uint8_t>, 4>{});
      break;
  }
  return result;
}

void TextureSampler::sample(const TextureCoordinates& at, std::size_t count, const std::array<s9*, 4>& codes) const {
  if (byte_sampler_) {
    for (std::size_t first = 0; first < count; first += kBatchSize) {
      byte_sampler_->sample(at, first, std::min(kBatchSize, count - first), codes);
    }
    return;
  }
  for (std::size_t i = 0; i < count; ++i) {
    const Texel filtered = texel(at, i);
    for (std::size_t out = 0; out < 4; ++out) {
      const int source = source_[out];
      codes[out][i] = source < 0 ? constant_[out]
                                 : static_cast<s9>(filtered.value[static_cast<std::size_t>(source)] >> byte_shift_);
    }
  }
}

Texel TextureSampler::texel(const TextureCoordinates& at, std::size_t i) const {
  const Filtered filtered = filter(at, i);
  Texel result{.format = format_};
  for (std::size_t k = 0; k < 4; ++k) {
    if (texture_->faces[0][0].planes.index() >= 2) {
      result.value[k] = byte_of_color(static_cast<float>(filtered.real[k]));
    } else if (format_ == TextureFormat::depth) {
      result.value[k] = byte_of_depth(filtered.code[k], max_depth_);
    } else {
      result.value[k] = static_cast<std::uint8_t>(filtered.code[k]);
    }
  }
  return result;
}

std::array<float, 4> TextureSampler::color(const TextureCoordinates& at, std::size_t i) const {
  const Filtered filtered = filter(at, i);
  const bool real = texture_->faces[0][0].planes.index() >= 2;
  const double largest = format_ == TextureFormat::depth ? max_depth_ : 255.0;
  std::array<float, 4> result{};
  for (std::size_t out = 0; out < 4; ++out) {
    if (source_[out] < 0) {
      result[out] = constant_[out] == 0 ? 0.0F : 1.0F;
      continue;
    }
    const auto source = static_cast<std::size_t>(source_[out]);
    result[out] = static_cast<float>(real ? filtered.real[source] : filtered.code[source] / largest);
  }
  return result;
}

}  // namespace ninebit
