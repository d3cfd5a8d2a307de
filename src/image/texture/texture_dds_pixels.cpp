// The pixel formats of DDS files.
#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>
#include <utility>

#include "src/image/texture/texture_dds.h"

namespace ninebit::image_detail {
namespace {

constexpr std::uint32_t kAlphaPixels = 0x1, kAlphaOnly = 0x2, kFourCc = 0x4, kRgb = 0x40, kLuminance = 0x20000;
constexpr std::uint32_t kFormatRgba16f = 113, kFormatRgba32f = 116;  // Direct3D's numbers, in place of a four_cc
constexpr int kLargestMaskBits = 8;

constexpr std::uint32_t four_cc(const char (&name)[5]) {
  std::uint32_t code = 0;
  for (std::size_t i = 4; i-- > 0;) code = (code << 8) | static_cast<std::uint8_t>(name[i]);
  return code;
}

std::uint32_t little_endian(std::span<const std::uint8_t> bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = (value << 8) | bytes[i];
  return value;
}

std::string name_of_four_cc(std::uint32_t code) {
  std::string name;
  for (int i = 0; i < 4; ++i) {
    const auto c = static_cast<char>((code >> (8 * i)) & 0xFF);
    if (c < 0x20 || c > 0x7E) return fmt::format("number {}", code);
    name += c;
  }
  return name;
}

Result<DdsPixels> four_cc_pixels(const DdsHeader& header) {
  DdsPixels pixels;
  switch (header.four_cc) {
    case four_cc("DXT1"):
      pixels.s3tc = (header.pixel_flags & kAlphaPixels) != 0 ? S3tcFormat::dxt1_rgba : S3tcFormat::dxt1_rgb;
      break;
    case four_cc("DXT3"):
      pixels.s3tc = S3tcFormat::dxt3;
      break;
    case four_cc("DXT5"):
      pixels.s3tc = S3tcFormat::dxt5;
      break;
    case kFormatRgba16f:
      return DdsPixels{.format = InternalFormat::rgba16f, .bytes_per_pixel = 8};
    case kFormatRgba32f:
      return DdsPixels{.format = InternalFormat::rgba32f, .bytes_per_pixel = 16};
    default:
      return Diagnostic{fmt::format(
          "the DDS pixel format {} is not supported; expected DXT1, DXT3, DXT5, uncompressed bytes or RGBA floats",
          name_of_four_cc(header.four_cc))};
  }
  pixels.format = s3tc_internal_format(*pixels.s3tc);
  return pixels;
}

// Empty, or what is wrong with a mask.
std::string complain_about_mask(std::uint32_t mask, std::uint32_t bit_count) {
  const int bits = std::popcount(mask);
  const bool contiguous =
      bits > 0 && std::bit_width(mask) - static_cast<unsigned>(std::countr_zero(mask)) == static_cast<unsigned>(bits);
  if (contiguous && bits <= kLargestMaskBits && std::bit_width(mask) <= bit_count) return {};
  return fmt::format("the DDS header has a component mask of {:#x}; expected 1 to {} adjacent bits within {} bits",
                     mask, kLargestMaskBits, bit_count);
}

std::uint8_t component(std::uint32_t pixel, std::uint32_t mask) {
  const int shift = std::countr_zero(mask);
  const std::uint32_t largest = mask >> shift;
  return static_cast<std::uint8_t>((((pixel & mask) >> shift) * 510 + largest) / (2 * largest));
}

// Planes of samples that are interleaved in `bytes`: four per pixel, little-endian.
template <class T, class Word>
std::vector<T> planes_of(std::span<const std::uint8_t> bytes, std::size_t pixels) {
  std::vector<T> samples(4 * pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      const auto word = static_cast<Word>(little_endian(bytes.subspan((4 * i + k) * sizeof(Word), sizeof(Word))));
      samples[k * pixels + i] = std::bit_cast<T>(word);
    }
  }
  return samples;
}

}  // namespace

Result<DdsPixels> dds_pixels(const DdsHeader& header) {
  if ((header.pixel_flags & kFourCc) != 0) return four_cc_pixels(header);
  const bool rgb = (header.pixel_flags & kRgb) != 0, luminance = (header.pixel_flags & kLuminance) != 0;
  const bool alpha_only = (header.pixel_flags & kAlphaOnly) != 0 && !rgb && !luminance;
  const bool alpha = alpha_only || (header.pixel_flags & kAlphaPixels) != 0;
  if ((rgb ? 1 : 0) + (luminance ? 1 : 0) + (alpha_only ? 1 : 0) != 1) {
    return Diagnostic{
        fmt::format("the DDS pixel format with flags {:#x} is not supported; expected a four-character code, RGB, "
                    "luminance or alpha",
                    header.pixel_flags)};
  }
  if (header.bit_count % 8 != 0 || header.bit_count < 8 || header.bit_count > 32) {
    return Diagnostic{fmt::format("the DDS header has {} bits per pixel; expected 8, 16, 24 or 32", header.bit_count)};
  }
  DdsPixels pixels{.bytes_per_pixel = static_cast<int>(header.bit_count / 8)};
  if (rgb) {
    pixels.format = alpha ? InternalFormat::rgba8 : InternalFormat::rgb8;
  } else if (luminance) {
    pixels.format = alpha ? InternalFormat::luminance8_alpha8 : InternalFormat::luminance8;
  } else {
    pixels.format = InternalFormat::alpha8;
  }
  const std::array<bool, 4> stored = stored_components(pixels.format);
  for (std::size_t k = 0; k < 4; ++k) {
    if (!stored[k]) continue;
    pixels.mask[k] = header.mask[k];
    if (std::string complaint = complain_about_mask(pixels.mask[k], header.bit_count); !complaint.empty()) {
      return Diagnostic{std::move(complaint)};
    }
  }
  return pixels;
}

std::size_t dds_level_bytes(const DdsPixels& pixels, int width, int height) {
  if (pixels.s3tc) return s3tc_image_bytes(*pixels.s3tc, width, height);
  return static_cast<std::size_t>(width) * static_cast<std::size_t>(height) *
         static_cast<std::size_t>(pixels.bytes_per_pixel);
}

Result<TextureSamples> decode_dds_level(const DdsPixels& pixels, Dxt1Palette palette, int width, int height,
                                        std::span<const std::uint8_t> bytes) {
  if (pixels.s3tc) return decode_s3tc(*pixels.s3tc, palette, width, height, bytes);
  const std::size_t count = static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  if (pixels.format == InternalFormat::rgba16f) {
    return TextureSamples{width, height, planes_of<Half, std::uint16_t>(bytes, count)};
  }
  if (pixels.format == InternalFormat::rgba32f) {
    return TextureSamples{width, height, planes_of<float, std::uint32_t>(bytes, count)};
  }
  const std::array<bool, 4> stored = stored_components(pixels.format);
  const auto step = static_cast<std::size_t>(pixels.bytes_per_pixel);
  std::vector<std::uint8_t> samples;
  samples.reserve(count * static_cast<std::size_t>(std::count(stored.begin(), stored.end(), true)));
  for (std::size_t k = 0; k < 4; ++k) {
    if (!stored[k]) continue;
    for (std::size_t i = 0; i < count; ++i) {
      samples.push_back(component(little_endian(bytes.subspan(i * step, step)), pixels.mask[k]));
    }
  }
  return TextureSamples{width, height, std::move(samples)};
}

}  // namespace ninebit::image_detail
