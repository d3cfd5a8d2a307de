#include "ninebit/raster/sampler.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "ninebit/raster/pipeline_state.h"
#include "src/raster/texture/byte_sampler.h"
#include "src/raster/texture/cube_coordinate.h"
#include "src/raster/texture/texture_level.h"
#include "src/raster/texture/texture_wrap.h"

namespace ninebit {
namespace {

using Bytes = std::array<Plane<const std::uint8_t>, 4>;

constexpr float kMaxLodBias = 15.0F;

// Whether a texel that has the key gets an alpha of 0.
bool clears(ColorKeyOperation operation) {
  return operation == ColorKeyOperation::alpha || operation == ColorKeyOperation::rgba;
}

// A number from 0 to 1 as a code of 0 to `largest`, to nearest, halves up; NaN gives 0. A float times 24 bits is exact
// in a double.
std::uint32_t code_of(float value, std::uint32_t largest) {
  if (!(value > 0.0F)) return 0;
  if (value >= 1.0F) return largest;
  return static_cast<std::uint32_t>(static_cast<double>(value) * largest + 0.5);
}

// Rule 26: the bias in 1/256 level.
int lod_bias_q8(float bias, Narrowing narrowing) {
  if (std::isnan(bias)) return 0;
  const double exact = static_cast<double>(std::clamp(bias, -kMaxLodBias, kMaxLodBias)) * 256.0;
  return static_cast<int>(narrowing == Narrowing::toward_zero ? std::trunc(exact) : std::floor(exact + 0.5));
}

// Rule 29. The functions follow `none` in GL's order.
static_assert(static_cast<int>(DepthComparison::always) - static_cast<int>(DepthComparison::never) ==
              static_cast<int>(CompareFunction::always));
bool holds(DepthComparison comparison, std::uint32_t reference, std::uint32_t depth) {
  const int function = static_cast<int>(comparison) - static_cast<int>(DepthComparison::never);
  return compare(static_cast<CompareFunction>(function), reference, depth);
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

// The texels of a fragment: of one level, or of two.
struct TextureSampler::Taps {
  struct Level {
    const TextureImage* image = nullptr;
    LinearTexels s, t, r;  // NEAREST: the first alone, of weight 1; r of 3D textures
  };
  std::array<Level, 2> level;
  bool linear = false;        // within a level
  bool layers = false;        // linear along r, too
  bool two_levels = false;    // the second may have a weight of 0
  std::uint32_t between = 0;  // weight of the second level in 1/2^weight bits
};

struct TextureSampler::Filtered {
  std::array<std::uint32_t, 4> code{};  // bytes, or a depth code in the first
  std::array<double, 4> real{};         // of float formats
};

std::array<bool, 4> signed_components(const Texture& texture, const Sampler& sampler) {
  std::array<bool, 4> is_signed = sampler.is_signed;
  const TextureFormat format = base_format(texture.format);
  const bool is_dsdt =
      format == TextureFormat::dsdt || format == TextureFormat::dsdt_mag || format == TextureFormat::dsdt_mag_intensity;
  if (is_dsdt) is_signed[kGreen] = is_signed[kBlue] = true;
  const bool has_bytes = texture.format < InternalFormat::depth16 || texture.format > InternalFormat::rgba32f;
  return has_bytes ? is_signed : std::array<bool, 4>{};
}

std::optional<TextureSampler> TextureSampler::make(const HardwareProfile& profile, const Texture& texture,
                                                   const Sampler& sampler, TexelUse use) {
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
  // Rule 54: a key makes an alpha 0 that such texels do not store.
  const bool adds_alpha = clears(sampler.color_key.operation) && made.format_ == TextureFormat::rgb;
  if (adds_alpha) made.format_ = TextureFormat::rgba;
  made.cube_ = texture.target == TextureTarget::cube_map;
  made.volume_ = texture.target == TextureTarget::texture_3d;
  made.rectangle_ = texture.target == TextureTarget::rectangle;
  if (made.rectangle_) {
    for (Wrap* const wrap : {&made.sampler_.wrap_s, &made.sampler_.wrap_t}) {
      if (*wrap == Wrap::repeat || *wrap == Wrap::mirrored_repeat) *wrap = Wrap::clamp_to_edge;
    }
  }
  if (texture.target == TextureTarget::texture_1d) made.sampler_.wrap_t = Wrap::clamp_to_edge;
  made.needs_derivatives_ = mipmaps || is_linear(sampler.min_filter) != (sampler.mag_filter == MagFilter::linear);
  const TextureImage& base = texture.faces[0][0];
  if (mipmaps) {
    const int longest = std::max({base.width, base.height, base.depth});
    made.last_level_ = static_cast<int>(std::bit_width(static_cast<unsigned>(longest))) - 1;
  }
  made.lod_bias_q8_ = lod_bias_q8(sampler.lod_bias, profile.texture_bias_narrowing);
  made.filter_rules_ = {.weight_bits = profile.texture_weight_bits,
                        .cuts_weights = profile.texture_weight_narrowing.value == Narrowing::toward_zero,
                        .rounds_each_blend = profile.texture_filter_rounding.value == FilterRounding::each_blend};
  made.max_depth_ = texture.format == InternalFormat::depth16 ? 0xFFFF : 0xFFFFFF;
  const std::uint32_t largest = base_format(texture.format) == TextureFormat::depth ? made.max_depth_ : 255;
  for (std::size_t i = 0; i < 4; ++i) {
    float& border = made.sampler_.border_color[i];
    border = border > 0.0F ? std::min(border, 1.0F) : 0.0F;
    made.border_code_[i] = code_of(border, largest);
  }
  made.find_sources(profile, use);
  if (!adds_alpha) made.byte_sampler_ = ByteSampler::make(made);
  return made;
}

void TextureSampler::find_sources(const HardwareProfile& profile, TexelUse use) {
  const InternalFormat format = texture_->format;
  is_signed_ = signed_components(*texture_, sampler_);
  if (format == InternalFormat::rgb8) is_signed_[kAlpha] = false;
  // The combiners do not see these formats' numbers.
  if (use == TexelUse::stages && format_ >= TextureFormat::hilo) {
    const std::array<bool, 4> stored = stored_components(format);
    for (std::size_t k = 0; k < 4; ++k) source_[k] = stored[k] ? static_cast<int>(k) : -1;
    return;
  }
  // texel_codes decides which byte of a texel each code comes from; it passes one byte at a time.
  constant_ = texel_codes(profile, {.format = format_});
  for (std::size_t out = 0; out < 4; ++out) {
    source_[out] = -1;
    for (std::size_t in = 0; in < 4; ++in) {
      Texel probe{.format = format_};
      probe.value[in] = 255;
      if (texel_codes(profile, probe)[out] != constant_[out]) source_[out] = static_cast<int>(in);
    }
  }
  if (use == TexelUse::stages) {
    for (s9& constant : constant_) constant = constant == 0 ? s9{0} : s9{255};
    return;
  }
  byte_shift_ = profile.byte_shift;
  lowest_ = profile.lowest;
  decodes_ = std::find(is_signed_.begin(), is_signed_.end(), true) != is_signed_.end();
}

TextureSampler::Filtered TextureSampler::filter(const TextureCoordinates& at, std::size_t i) const {
  const std::array<float, 3> value = triple(at.value, i);
  CubeCoordinate place{CubeFace::positive_x, value[0], value[1]};
  if (cube_) place = cube_coordinate_inline(value[0], value[1], value[2]);
  const auto face = static_cast<std::size_t>(place.face);
  int lambda_q8 = kNoTexels;
  if (needs_derivatives_) {
    const std::size_t change = at.one_change ? 0 : i;
    const std::array<float, 3> dx = triple(at.dx, change), dy = triple(at.dy, change);
    TexelChanges changes = cube_ ? cube_changes(value, dx, dy) : TexelChanges{dx[0], dx[1], dy[0], dy[1]};
    if (volume_) changes.wx = dx[2], changes.wy = dy[2];
    const TextureImage& base = texture_->faces[face][0];
    const int width = rectangle_ ? 1 : base.width, height = rectangle_ ? 1 : base.height;
    changes.ux *= width;
    changes.uy *= width;
    changes.vx *= height;
    changes.vy *= height;
    changes.wx *= base.depth;
    changes.wy *= base.depth;
    lambda_q8 = level_of_detail_q8(rho_squared(changes)) + lod_bias_q8_;
  }
  const LevelChoice choice = choose_level(sampler_.min_filter, sampler_.mag_filter, lambda_q8, last_level_);
  Taps taps;
  taps.linear = choice.linear;
  taps.layers = choice.linear && volume_;
  taps.two_levels = choice.two_levels;
  taps.between = static_cast<std::uint32_t>(choice.between_q8) >> (8 - filter_rules_.weight_bits);
  for (std::size_t n = 0; n < (taps.between != 0 ? 2U : 1U); ++n) {
    const TextureImage& image = texture_->faces[face][static_cast<std::size_t>(choice.level) + n];
    const auto along = [&](float coordinate, int size, Wrap wrap) {
      if (sampler_.border_texels) {
        return bordered_texels(coordinate, {size / 2, size / 2, wrap}, choice.linear, filter_rules_);
      }
      const TextureAxis axis{size, rectangle_ ? 1 : size, wrap};
      if (choice.linear) return linear_texels(coordinate, axis, filter_rules_);
      return LinearTexels{.first = nearest_texel(coordinate, axis)};
    };
    taps.level[n] = {&image, along(place.s, image.width, sampler_.wrap_s),
                     along(place.t, image.height, sampler_.wrap_t), LinearTexels{}};
    if (volume_) taps.level[n].r = along(value[2], image.depth, sampler_.wrap_r);
  }
  return weigh(taps, value[2]);
}

// One component of all taps, each of which `read` gives: the weighted sum in whole numbers, rounded once, or each blend
// of two rounded (rule 26).
template <class Read>
std::uint32_t TextureSampler::weigh_codes(const Taps& taps, const Read& read) const {
  const int bits = filter_rules_.weight_bits;
  const std::uint64_t one = std::uint64_t{1} << bits;
  // Before the last rounding, numbers are 2^shift times as large.
  int shift = 0;
  const auto blend = [&](std::uint64_t a, std::uint64_t b, std::uint64_t weight) {
    const std::uint64_t sum = a * (one - weight) + b * weight;
    return filter_rules_.rounds_each_blend ? (sum + one / 2) >> bits : sum;
  };
  const auto level_code = [&](const Taps::Level& level) -> std::uint64_t {
    const auto code = [&](int x, int y, int z) -> std::uint64_t { return read(*level.image, x, y, z); };
    if (!taps.linear) return code(level.s.first, level.t.first, level.r.first);
    // A texel of weight 0 is not read: there may be none.
    const auto row = [&](int y, int z) {
      const std::uint64_t first = code(level.s.first, y, z);
      return blend(first, level.s.weight != 0 ? code(level.s.second, y, z) : first, level.s.weight);
    };
    const auto layer = [&](int z) {
      const std::uint64_t low = row(level.t.first, z);
      return blend(low, level.t.weight != 0 ? row(level.t.second, z) : low, level.t.weight);
    };
    const std::uint64_t near = layer(level.r.first);
    if (!taps.layers) return near;
    return blend(near, level.r.weight != 0 ? layer(level.r.second) : near, level.r.weight);
  };
  std::uint64_t result = level_code(taps.level[0]);
  if (taps.linear) shift += 2 * bits;
  if (taps.layers) shift += bits;
  if (taps.two_levels) {
    result = blend(result, taps.between != 0 ? level_code(taps.level[1]) : result, taps.between);
    shift += bits;
  }
  if (filter_rules_.rounds_each_blend) return static_cast<std::uint32_t>(result);
  return static_cast<std::uint32_t>((result + ((std::uint64_t{1} << shift) >> 1)) >> shift);
}

// The weighted sum of one component in doubles, texel by texel; those of weight 0 are left out.
template <class Read>
double TextureSampler::weigh_reals(const Taps& taps, const Read& read) const {
  const int bits = filter_rules_.weight_bits;
  const std::uint64_t one = std::uint64_t{1} << bits;
  double sum = 0.0;
  const auto add = [&](const TextureImage& image, int x, int y, int z, std::uint64_t weight) {
    if (weight != 0) sum += static_cast<double>(weight) * read(image, x, y, z);
  };
  const auto add_layer = [&](const Taps::Level& level, int z, std::uint64_t weight) {
    const LinearTexels &s = level.s, &t = level.t;
    add(*level.image, s.first, t.first, z, weight * (one - s.weight) * (one - t.weight));
    add(*level.image, s.second, t.first, z, weight * s.weight * (one - t.weight));
    add(*level.image, s.first, t.second, z, weight * (one - s.weight) * t.weight);
    add(*level.image, s.second, t.second, z, weight * s.weight * t.weight);
  };
  const auto add_level = [&](const Taps::Level& level, std::uint64_t weight) {
    if (!taps.linear) return add(*level.image, level.s.first, level.t.first, level.r.first, weight);
    if (!taps.layers) return add_layer(level, level.r.first, weight);
    add_layer(level, level.r.first, weight * (one - level.r.weight));
    add_layer(level, level.r.second, weight * level.r.weight);
  };
  add_level(taps.level[0], taps.two_levels ? one - taps.between : 1);
  if (taps.between != 0) add_level(taps.level[1], taps.between);
  return std::ldexp(sum, -((taps.linear ? 2 * bits : 0) + (taps.layers ? bits : 0) + (taps.two_levels ? bits : 0)));
}

// The texel's bytes lie in two words where a format has words of 16 bits.
void TextureSampler::weigh_words(const Taps& taps, Filtered& to) const {
  const auto word = [&](std::size_t high, std::size_t low) {
    const std::uint32_t flip = is_signed_[high] ? 0x8000 : 0;
    const std::uint32_t filtered = weigh_codes(taps, [&](const TextureImage& image, int x, int y, int z) {
      if (x == kBorderTexel || y == kBorderTexel || z == kBorderTexel) {
        return (256 * border_code_[high] + border_code_[low]) ^ flip;
      }
      const Bytes& planes = *std::get_if<Bytes>(&image.planes);
      const int row = y + image.height * z;
      return static_cast<std::uint32_t>(256 * planes[high].at(x, row) + planes[low].at(x, row)) ^ flip;
    });
    to.code[high] = (filtered ^ flip) >> 8;
    to.code[low] = (filtered ^ flip) & 0xFF;
  };
  word(kAlpha, kRed);
  word(kGreen, kBlue);
}

TextureSampler::Filtered TextureSampler::weigh(const Taps& taps, float r) const {
  Filtered result;
  const std::array<bool, 4> stored = stored_components(texture_->format);
  const std::uint32_t reference = comparison_ == DepthComparison::none ? 0 : code_of(r, max_depth_);
  const auto compared = [&](std::uint32_t depth) -> std::uint32_t {
    if (comparison_ == DepthComparison::none) return depth;
    return holds(comparison_, reference, depth) ? 255 : 0;
  };
  const auto is_border = [](int x, int y, int z) {
    return x == kBorderTexel || y == kBorderTexel || z == kBorderTexel;
  };
  const auto all_codes = [&](auto planes_type) {
    using Planes = decltype(planes_type);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!stored[k]) continue;
      // Two's complement with its highest bit flipped is filtered like any code.
      const std::uint32_t flip = is_signed_[k] ? 0x80 : 0;
      const std::uint32_t filtered = weigh_codes(taps, [&](const TextureImage& image, int x, int y, int z) {
        if (is_border(x, y, z)) return compared(border_code_[k]) ^ flip;
        return compared((*std::get_if<Planes>(&image.planes))[k].at(x, y + image.height * z)) ^ flip;
      });
      result.code[k] = filtered ^ flip;
    }
  };
  const auto all_reals = [&](auto planes_type) {
    using Planes = decltype(planes_type);
    for (std::size_t k = 0; k < 4; ++k) {
      if (!stored[k]) continue;
      result.real[k] = weigh_reals(taps, [&](const TextureImage& image, int x, int y, int z) {
        if (is_border(x, y, z)) return real_of(sampler_.border_color[k]);
        return real_of((*std::get_if<Planes>(&image.planes))[k].at(x, y + image.height * z));
      });
    }
  };
  switch (texture_->format) {
    case InternalFormat::depth16:
    case InternalFormat::depth24:
      all_codes(std::array<Plane<const std::uint32_t>, 4>{});
      break;
    case InternalFormat::rgba16f:
      all_reals(std::array<Plane<const Half>, 4>{});
      break;
    case InternalFormat::rgba32f:
      all_reals(std::array<Plane<const float>, 4>{});
      break;
    case InternalFormat::hilo16:
      weigh_words(taps, result);
      break;
    default:
      all_codes(Bytes{});
      break;
  }
  return result;
}

void TextureSampler::sample(const TextureCoordinates& at, std::size_t count, const std::array<s9*, 4>& codes,
                            std::uint8_t* killed) const {
  if (byte_sampler_) {
    for (std::size_t first = 0; first < count; first += kBatchSize) {
      std::uint8_t* const killed_there = killed == nullptr ? nullptr : killed + first;
      byte_sampler_->sample(at, first, std::min(kBatchSize, count - first), codes, killed_there);
    }
  } else {
    const int shift = decodes_ ? 0 : byte_shift_;
    for (std::size_t i = 0; i < count; ++i) {
      const Texel filtered = texel(at, i);
      if (killed != nullptr && kills() && is_keyed(filtered)) killed[i] = 1;
      for (std::size_t out = 0; out < 4; ++out) {
        const int source = source_[out];
        codes[out][i] =
            source < 0 ? constant_[out] : static_cast<s9>(filtered.value[static_cast<std::size_t>(source)] >> shift);
      }
    }
  }
  if (decodes_) decode(count, codes);
}

// From bytes to the codes of texel_byte_code.
void TextureSampler::decode(std::size_t count, const std::array<s9*, 4>& codes) const {
  for (std::size_t out = 0; out < 4; ++out) {
    if (source_[out] < 0) continue;
    s9* const to = codes[out];
    if (is_signed_[static_cast<std::size_t>(source_[out])]) {
      for (std::size_t i = 0; i < count; ++i) {
        const int twice = 2 * ((to[i] ^ 0x80) - 0x80);
        to[i] = static_cast<s9>(std::max(twice >> byte_shift_, lowest_));
      }
    } else if (byte_shift_ != 0) {
      for (std::size_t i = 0; i < count; ++i) to[i] = static_cast<s9>(to[i] >> byte_shift_);
    }
  }
}

Bytes4 TextureSampler::bytes(const TextureCoordinates& at, std::size_t i) const {
  const Texel filtered = texel(at, i);
  Bytes4 result{};
  for (std::size_t out = 0; out < 4; ++out) {
    result[out] = source_[out] < 0 ? static_cast<std::uint8_t>(constant_[out])
                                   : filtered.value[static_cast<std::size_t>(source_[out])];
  }
  return result;
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
  if (format_ == TextureFormat::rgba && texture_->format == InternalFormat::rgb8) result.value[kAlpha] = 255;
  const ColorKeyOperation operation = sampler_.color_key.operation;
  if (clears(operation) && is_keyed(result)) {
    if (operation == ColorKeyOperation::rgba) result.value = {};
    result.value[kAlpha] = 0;
  }
  return result;
}

// Rule 54.
bool TextureSampler::is_keyed(const Texel& texel) const {
  const auto byte = [&](int k) { return std::uint32_t{texel.value[static_cast<std::size_t>(k)]}; };
  const std::uint32_t word = byte(kAlpha) << 24 | byte(kRed) << 16 | byte(kGreen) << 8 | byte(kBlue);
  return ((word ^ sampler_.color_key.key) & key_bits()) == 0;
}

std::uint32_t TextureSampler::key_bits() const {
  return texture_->format == InternalFormat::rgb8 ? 0xFFFFFF : 0xFFFFFFFF;
}

bool TextureSampler::kills(const TextureCoordinates& at, std::size_t i) const {
  return kills() && is_keyed(texel(at, i));
}

Status check_sampler(const Texture& texture, const Sampler& sampler) {
  const auto fault = [](const char* message) { return Diagnostic{.message = message}; };
  const bool is_plain = texture.target == TextureTarget::texture_1d || texture.target == TextureTarget::texture_2d;
  const bool is_nearest = sampler.min_filter == MinFilter::nearest && sampler.mag_filter == MagFilter::nearest;
  if (sampler.border_texels) {
    const TextureImage& image = texture.faces[0][0];
    const bool is_large = image.width >= 16 && image.height >= 16;
    if (!is_plain || !is_large || uses_mipmaps(sampler.min_filter)) {
      return fault("border texels need a 2D image of 16 texels a side at least, without mip-maps");
    }
  }
  if (sampler.color_key.operation == ColorKeyOperation::disable) return {};
  if (texture.format != InternalFormat::rgba8 && texture.format != InternalFormat::rgb8) {
    return fault("a colour key needs texels of rgba8 or rgb8");
  }
  if (!is_nearest) return fault("a colour key needs the nearest texel: what linear filters do with it is not known");
  return {};
}

std::array<float, 4> TextureSampler::color(const TextureCoordinates& at, std::size_t i) const {
  if (clears(sampler_.color_key.operation)) {  // keys are for texels of bytes
    const Bytes4 value = texel(at, i).value;
    return {value[0] / 255.0F, value[1] / 255.0F, value[2] / 255.0F, value[3] / 255.0F};
  }
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
