#include "ninebit/raster/s3tc.h"

#include <algorithm>
#include <string>

namespace ninebit {
namespace {

using Rgb = std::array<int, 3>;

std::uint64_t little_endian(std::span<const std::uint8_t> bytes) {
  std::uint64_t value = 0;
  for (std::size_t i = bytes.size(); i-- > 0;) value = (value << 8) | bytes[i];
  return value;
}

Rgb components565(std::uint64_t color) {
  return {static_cast<int>(color >> 11), static_cast<int>((color >> 5) & 63), static_cast<int>(color & 31)};
}

Rgb bytes_of(const Rgb& c) {
  return {(c[0] << 3) | (c[0] >> 2), (c[1] << 2) | (c[1] >> 4), (c[2] << 3) | (c[2] >> 2)};
}

// (weight_a × a + weight_b × b) / (weight_a + weight_b), to nearest, halves up.
int between(int a, int b, int weight_a, int weight_b) {
  const int sum = weight_a + weight_b;
  return (2 * (weight_a * a + weight_b * b) + sum) / (2 * sum);
}

Rgb between(const Rgb& a, const Rgb& b, int weight_a, int weight_b) {
  Rgb result{};
  for (std::size_t i = 0; i < 3; ++i) result[i] = between(a[i], b[i], weight_a, weight_b);
  return result;
}

// The four colours of a block; `black` tells whether the last one is black instead of a mixture.
std::array<Rgb, 4> palette_of(const Rgb& a, const Rgb& b, bool black) {
  if (black) return {a, b, between(a, b, 1, 1), Rgb{}};
  return {a, b, between(a, b, 2, 1), between(a, b, 1, 2)};
}

std::array<std::uint8_t, 8> alphas_of(std::uint8_t a0, std::uint8_t a1) {
  std::array<std::uint8_t, 8> alphas{a0, a1, 0, 0, 0, 0, 0, 255};
  const int steps = a0 > a1 ? 7 : 5;
  for (int k = 1; k < steps; ++k) {
    alphas[static_cast<std::size_t>(k + 1)] = static_cast<std::uint8_t>(between(a0, a1, steps - k, k));
  }
  return alphas;
}

// The dither values that the NV2A adds below the bits that it keeps of red and green, by row and column of a block.
// Blue takes the rows of red from below.
constexpr std::array<std::array<int, 4>, 4> kDitherRed{{{0, 4, 1, 5}, {2, 6, 3, 7}, {5, 1, 4, 0}, {7, 3, 6, 2}}};
constexpr std::array<std::array<int, 4>, 4> kDitherGreen{{{3, 1, 2, 0}, {2, 0, 1, 3}, {1, 3, 0, 2}, {0, 2, 3, 1}}};

// Rule 24. Keeps `bits` bits of a byte, dithered by `r`, and widens them again: 0 stays 0, and all ones become 255.
int dithered(int byte, int bits, int r) {
  const int step = 1 << (8 - bits), largest = (1 << bits) - 1;
  if (byte < r + step) return 0;
  const int kept = (byte - r) / step;
  return kept >= largest ? 255 : step * kept + (bits == 5 ? 3 : 1) + r;
}

Rgb dithered(const Rgb& bytes, std::size_t x, std::size_t y) {
  return {dithered(bytes[0], 5, kDitherRed[y][x]), dithered(bytes[1], 6, kDitherGreen[y][x]),
          dithered(bytes[2], 5, kDitherRed[3 - y][x])};
}

}  // namespace

std::array<Bytes4, 16> decode_s3tc_block(S3tcFormat format, Dxt1Palette palette, std::span<const std::uint8_t> block) {
  const bool dxt1 = s3tc_block_bytes(format) == 8;
  const std::span<const std::uint8_t> colors = block.subspan(dxt1 ? 0 : 8);
  const std::uint64_t first = little_endian(colors.first(2)), second = little_endian(colors.subspan(2, 2));
  const std::uint64_t indices = little_endian(colors.subspan(4, 4));
  const bool black = dxt1 && first <= second;
  const Rgb a = components565(first), b = components565(second);
  std::array<Rgb, 4> rgb;
  if (dxt1 && palette == Dxt1Palette::rgb565) {
    rgb = palette_of(a, b, black);
    for (Rgb& color : rgb) color = bytes_of(color);
  } else {
    rgb = palette_of(bytes_of(a), bytes_of(b), black);
  }
  const std::uint64_t alpha_bits = dxt1 ? 0 : little_endian(block.first(8));
  const std::array<std::uint8_t, 8> alphas =
      format == S3tcFormat::dxt5 ? alphas_of(block[0], block[1]) : std::array<std::uint8_t, 8>{};
  std::array<Bytes4, 16> texels;
  for (std::size_t i = 0; i < 16; ++i) {
    const auto index = static_cast<std::size_t>((indices >> (2 * i)) & 3);
    int alpha = 255;
    if (format == S3tcFormat::dxt1_rgba) alpha = black && index == 3 ? 0 : 255;
    if (format == S3tcFormat::dxt3) alpha = 17 * static_cast<int>((alpha_bits >> (4 * i)) & 15);
    if (format == S3tcFormat::dxt5) alpha = alphas[(alpha_bits >> (16 + 3 * i)) & 7];
    Rgb color = rgb[index];
    if (dxt1 && palette == Dxt1Palette::dithered565) color = dithered(color, i % 4, i / 4);
    texels[i] = {static_cast<std::uint8_t>(color[0]), static_cast<std::uint8_t>(color[1]),
                 static_cast<std::uint8_t>(color[2]), static_cast<std::uint8_t>(alpha)};
  }
  return texels;
}

Result<TextureSamples> decode_s3tc(S3tcFormat format, Dxt1Palette palette, int width, int height,
                                   std::span<const std::uint8_t> data) {
  if (width < 1 || height < 1 || width > kMaxSurfaceSize || height > kMaxSurfaceSize) {
    return Diagnostic{"an S3TC image is " + std::to_string(width) + " x " + std::to_string(height) +
                      "; each side must be 1 to " + std::to_string(kMaxSurfaceSize)};
  }
  const std::size_t needed = s3tc_image_bytes(format, width, height);
  if (data.size() != needed) {
    return Diagnostic{"an S3TC image of " + std::to_string(width) + " x " + std::to_string(height) + " has " +
                      std::to_string(data.size()) + " bytes where " + std::to_string(needed) + " are needed"};
  }
  const std::size_t planes = format == S3tcFormat::dxt1_rgb ? 3 : 4;
  const auto columns = static_cast<std::size_t>(width), rows = static_cast<std::size_t>(height);
  const std::size_t block_bytes = s3tc_block_bytes(format);
  std::vector<std::uint8_t> samples(columns * rows * planes);
  for (std::size_t y0 = 0, at = 0; y0 < rows; y0 += 4) {
    for (std::size_t x0 = 0; x0 < columns; x0 += 4, at += block_bytes) {
      const std::array<Bytes4, 16> texels = decode_s3tc_block(format, palette, data.subspan(at, block_bytes));
      for (std::size_t y = y0; y < std::min(y0 + 4, rows); ++y) {
        for (std::size_t x = x0; x < std::min(x0 + 4, columns); ++x) {
          for (std::size_t k = 0; k < planes; ++k) {
            samples[(k * rows + y) * columns + x] = texels[4 * (y - y0) + (x - x0)][k];
          }
        }
      }
    }
  }
  return TextureSamples{width, height, std::move(samples)};
}

}  // namespace ninebit
