// Reading textures from files.
//
// - DDS: DXT1, DXT3, DXT5, decoded by s3tc.h under the given profile (DXT1 has alpha where the header's ALPHAPIXELS
// says
//   so); RGB, RGBA, luminance, luminance with alpha and alpha of 8 to 32 bits, each component of at most 8, which
//   becomes a byte as v × 255 / max, rounded to nearest; RGBA of 16-bit or 32-bit floats. With mip-maps or without, 2D
//   or cube maps of six faces, which DDS has in GL's order.
// - Every other picture that OpenImageIO reads (PNG, JPEG, TGA, EXR, ...), its first subimage: one channel becomes
//   luminance, two luminance and alpha, three RGB, four RGBA. Integers become bytes, floats stay floats, as RGBA.
//   Samples are taken as stored: no conversion between colour spaces, and alpha is not multiplied in (in EXR, colours
//   already are, and stay so).
//
// Row 0 of a file, its top, is at t = 0: so do Direct3D and glTF count, and so do the faces of a cube map stand. With
// `flip` the last row is at t = 0, which puts a picture upright in window coordinates.
#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <span>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/texture.h"

namespace NINEBIT_PUBLIC ninebit {

// What is made of a file's picture beyond reading it.
struct TextureReadOptions {
  bool mipmaps = false;  // adds with_mipmaps() where the file has level 0 alone
  bool flip = false;     // the file's last row is at t = 0
  // OpenImageIO reads in a child process, which can only read that file, and has 1.5 GiB of memory and 8 s of processor
  // time (64 bytes more for each byte of the file, 1 s for each 4 MiB). A file that crashes it, or is beyond these, is
  // reported like any other fault; without `isolated` it may end this process. The child is a fork of this one: no
  // other thread may be inside OpenImageIO meanwhile. DDS files are read in this process always.
  bool isolated = false;
  std::function<bool()> go_on{};  // called while a child reads; false ends it with Fault::cancelled. Empty: it goes on
};

// A 2D texture, or from a DDS file of six faces a cube map. Reports, naming the file: what cannot be read or is cut
// short; sides that are no powers of two from 1 to 16384; other files than DDS of more than 2^26 pixels; a header that
// contradicts itself or the file's size; a chain of mip-maps that is neither one level nor all; cube maps with faces
// missing or not square; formats beyond the above; a file that is not a regular one.
[[nodiscard]] Result<Texture> read_texture(const HardwareProfile& profile, const std::filesystem::path& file,
                                           const TextureReadOptions& options = {});

// A cube map of six 2D files, +X -X +Y -Y +Z -Z. Reports what read_texture reports, and the first file whose face is
// not square, is itself a cube map, or has another size, format or number of levels than the first file's.
[[nodiscard]] Result<Texture> read_cube_texture(const HardwareProfile& profile,
                                                std::span<const std::filesystem::path, 6> files,
                                                const TextureReadOptions& options = {});

}  // namespace ninebit
