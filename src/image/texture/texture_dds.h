// The header of a DDS file (DirectDraw surface), and the pixel format that it describes.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "ninebit/numerics/result.h"
#include "ninebit/raster/s3tc.h"

namespace ninebit::image_detail {

inline constexpr std::size_t kDdsHeaderBytes = 128;  // the magic number included

struct DdsHeader {
  std::uint32_t header_size = 0;
  std::uint32_t flags = 0;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::uint32_t pitch_or_linear_size = 0;
  std::uint32_t depth = 0;
  std::uint32_t mipmap_count = 0;
  std::uint32_t pixel_format_size = 0;
  std::uint32_t pixel_flags = 0;
  std::uint32_t four_cc = 0;
  std::uint32_t bit_count = 0;
  std::array<std::uint32_t, 4> mask{};  // red, green, blue, alpha
  std::uint32_t caps2 = 0;
};

// Parses the header. `bytes` must have at least kDdsHeaderBytes.
[[nodiscard]] DdsHeader parse_dds_header(std::span<const std::uint8_t> bytes);

// How the pixels of a file are stored.
struct DdsPixels {
  InternalFormat format = InternalFormat::rgb8;
  std::optional<S3tcFormat> s3tc{};
  int bytes_per_pixel = 0;              // uncompressed
  std::array<std::uint32_t, 4> mask{};  // uncompressed bytes: of red or luminance, green, blue, alpha
};

// The pixel format of a header. Reports unsupported formats; the caller adds the name of the file.
[[nodiscard]] Result<DdsPixels> dds_pixels(const DdsHeader& header);

// The size of one level in bytes.
[[nodiscard]] std::size_t dds_level_bytes(const DdsPixels& pixels, int width, int height);

// Decodes one level from exactly dds_level_bytes bytes.
[[nodiscard]] Result<TextureSamples> decode_dds_level(const DdsPixels& pixels, Dxt1Palette palette, int width,
                                                      int height, std::span<const std::uint8_t> bytes);

}  // namespace ninebit::image_detail
