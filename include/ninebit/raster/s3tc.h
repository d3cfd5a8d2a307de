// S3TC (EXT_texture_compression_s3tc), decoded as the hardware of a profile would: the exact colours between a block's
// two depend on the hardware.
//
// - The two colours of a block have 5, 6 and 5 bits; a component becomes a byte by repeating its upper bits below it
//   (measured on the NV2A).
// - The middle colours (2 a + b) / 3, (a + 2 b) / 3 and (a + b) / 2 are rounded to nearest, halves up (measured on the
//   NV2A). DXT3 and DXT5 compute them on bytes; DXT1 on bytes or, with Dxt1Palette::rgb565, on the 5, 6 and 5 bits, and
//   only the result becomes bytes, as the GeForce 256 and 2 are said to do it. Dxt1Palette::dithered565 dithers the
//   bytes to 5, 6 and 5 bits, as the NV2A does: rule 24 of docs/numerics.md.
// - A DXT3 alpha of 4 bits is multiplied by 17. DXT5's middle alphas are rounded to nearest (both measured there).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/texture.h"

namespace NINEBIT_PUBLIC ninebit {

// EXT_texture_compression_s3tc's formats; DXT1 without and with the transparent fourth colour.
enum class S3tcFormat : std::uint8_t { dxt1_rgb, dxt1_rgba, dxt3, dxt5 };

// Bytes in one block of 4 × 4 texels: 8, or 16 for DXT3 and DXT5.
[[nodiscard]] constexpr std::size_t s3tc_block_bytes(S3tcFormat format) {
  return format == S3tcFormat::dxt1_rgb || format == S3tcFormat::dxt1_rgba ? 8 : 16;
}

// Bytes in an image of positive size; its last blocks may reach beyond its edges.
[[nodiscard]] constexpr std::size_t s3tc_image_bytes(S3tcFormat format, int width, int height) {
  return static_cast<std::size_t>((width + 3) / 4) * static_cast<std::size_t>((height + 3) / 4) *
         s3tc_block_bytes(format);
}

// The format of a decoded image: rgb8 for dxt1_rgb, otherwise rgba8.
[[nodiscard]] constexpr InternalFormat s3tc_internal_format(S3tcFormat format) {
  return format == S3tcFormat::dxt1_rgb ? InternalFormat::rgb8 : InternalFormat::rgba8;
}

// Texel (x, y) of the block at 4 y + x. `block` holds s3tc_block_bytes(format); dxt1_rgb gives an alpha of 255.
[[nodiscard]] std::array<Bytes4, 16> decode_s3tc_block(S3tcFormat format, Dxt1Palette palette,
                                                       std::span<const std::uint8_t> block);

// An image for make_texture. Reports sides outside 1 to kMaxSurfaceSize and data whose size differs from
// s3tc_image_bytes.
[[nodiscard]] Result<TextureSamples> decode_s3tc(S3tcFormat format, Dxt1Palette palette, int width, int height,
                                                 std::span<const std::uint8_t> data);

}  // namespace ninebit
