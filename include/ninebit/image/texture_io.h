// Reading textures from files.
//
// - DDS: DXT1, DXT3 and DXT5, decoded by s3tc.h under the given profile (DXT1 has alpha if the header has ALPHAPIXELS);
//   RGB, RGBA, luminance, luminance with alpha, and alpha, of 8 to 32 bits per pixel. Each component has at most 8 bits
//   and becomes a byte as v × 255 / max, rounded to nearest. RGBA of 16-bit or 32-bit floats. With or without mip-maps;
//   2D textures, or cube maps of six faces, which DDS stores in GL's order.
// - Every other picture that OpenImageIO reads (PNG, JPEG, TGA, EXR, ...), its first subimage: one channel becomes
//   luminance, two luminance and alpha, three RGB, four RGBA. Integers become bytes; floats stay floats, as RGBA.
//   Samples are used as stored: no conversion between colour spaces, no multiplication by alpha (EXR colours are
//   already multiplied, and stay so).
//
// Row 0 of a file, its top, is at t = 0, as in Direct3D and glTF and in the faces of a cube map. With `flip`, the last
// row is at t = 0: the picture is upright in window coordinates.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>
#include <string>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/texture.h"

namespace NINEBIT_PUBLIC ninebit {

// How a file is read and processed.
struct TextureReadOptions {
  bool mipmaps = false;  // adds with_mipmaps() if the file has only level 0
  bool flip = false;     // the file's last row is at t = 0
  // Pictures may have any sides from 1 to 16384, as glTF permits; a side that is not a power of two is resampled to the
  // next one (resample_to_powers_of_two). Not for DDS files and the faces of cube maps.
  bool any_size = false;
  bool rectangle =
      false;  // any sides from 1 to 16384, which are kept: a rectangle texture of level 0. Not for cube maps
  std::function<void(int width, int height)> on_resample{};  // called with a resampled picture's own size; may be empty
  // OpenImageIO runs in a child process that can read only that file and is limited to 1.5 GiB of memory and 8 s of
  // processor time, plus 64 bytes per byte of the file and 1 s per 4 MiB. A file that crashes it or exceeds the limits
  // is reported like any other fault; without `isolated` it may end this process. The child is a fork of this process:
  // no other thread may be inside OpenImageIO meanwhile. DDS files are always read in this process.
  bool isolated = false;
  std::function<bool()> go_on{};  // called while a child reads; false ends it with Fault::cancelled. May be empty
};

// Reads a 2D texture, or a cube map from a DDS file with six faces. Reports, with the file's name: a file that is not
// regular, cannot be read or is cut short; sides that are not powers of two from 1 to 16384; more than 2^26 pixels,
// except in DDS files; a header that contradicts itself or the size of the file; mip-maps that are neither one level
// nor all; cube maps with missing faces or faces that are not square; formats not listed above.
[[nodiscard]] Result<Texture> read_texture(const HardwareProfile& profile, const std::filesystem::path& file,
                                           const TextureReadOptions& options = {});

// Reads a cube map from six 2D files, +X -X +Y -Y +Z -Z. Reports what read_texture reports, and the first file whose
// face is not square, is itself a cube map, or differs from the first file in size, format or number of levels.
[[nodiscard]] Result<Texture> read_cube_texture(const HardwareProfile& profile,
                                                std::span<const std::filesystem::path, 6> files,
                                                const TextureReadOptions& options = {});

// Reads a 2D texture from the bytes of a PNG or JPEG file, such as a picture inside another file. `name` stands for the
// file in Diagnostics. Reports what read_texture reports, and bytes that are neither.
[[nodiscard]] Result<Texture> read_texture(std::span<const std::uint8_t> bytes, const std::string& name,
                                           const TextureReadOptions& options = {});

}  // namespace ninebit
