// Textures: pictures with their mip-maps, one or six faces, that the rasterizer samples.
//
// Texel (0, 0) is at s = t = 0, the first sample of row 0: a rendered surface used as a texture is what
// glCopyTexImage2D copies. See sampler.h for reading, s3tc.h for compressed textures, image/texture_io.h for files.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <variant>
#include <vector>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/surface.h"

namespace NINEBIT_PUBLIC ninebit {

// The faces in the order of ARB_texture_cube_map.
enum class CubeFace : std::uint8_t { positive_x, negative_x, positive_y, negative_y, positive_z, negative_z };
inline constexpr std::array kCubeFaces{CubeFace::positive_x, CubeFace::negative_x, CubeFace::positive_y,
                                       CubeFace::negative_y, CubeFace::positive_z, CubeFace::negative_z};

// The point where a direction intersects the cube: the face, and s and t on it in [0, 1].
struct CubeCoordinate {
  CubeFace face = CubeFace::positive_x;  // the face
  float s = 0.5F;                        // on the face
  float t = 0.5F;                        // on the face
};

// The major-axis table of ARB_texture_cube_map; s is (sc / |ma| + 1) × 0.5 in floats, in this order. The extension
// leaves ties open; here x wins over y and y over z, and a zero counts as positive. The zero direction, as NaN,
// gives the first texel of +X (rule 41). One infinite component gives 0.5 for s and t; a coordinate that divides
// infinity by infinity is 0.
[[nodiscard]] CubeCoordinate cube_coordinate(float rx, float ry, float rz);

// The six axes of a face in the extension's table: s grows along `s`, t along `t`, the face looks along `major`.
struct CubeFaceAxes {
  std::array<int, 3> s;      // x, y, z, each -1, 0 or 1
  std::array<int, 3> t;      // likewise
  std::array<int, 3> major;  // likewise
};

// The axes of one face.
[[nodiscard]] const CubeFaceAxes& cube_face_axes(CubeFace face);

// The kinds of textures. Coordinates are from 0 to 1 but for rectangles, whose s and t count texels.
enum class TextureTarget : std::uint8_t {
  texture_2d,  // one face
  cube_map,    // the six faces of ARB_texture_cube_map
  texture_1d,  // one row; t is not read
  texture_3d,  // layers, from r = 0
  rectangle    // NV_texture_rectangle: sides of any length, no mip-maps
};

// Storage formats of texels. The last two are beyond the hardware: floats, which are clamped to [0, 1] and rounded to a
// byte for a combiner register.
enum class InternalFormat : std::uint8_t {
  alpha8,
  luminance8,
  luminance8_alpha8,
  intensity8,
  rgb8,
  rgba8,
  depth16,  // codes of 0 to 2^16 - 1 in 32 bits, as a surface holds them
  depth24,
  rgba16f,
  rgba32f,
  // NV_texture_shader's, as bytes; signed ones by Sampler::is_signed, ds and dt always.
  hilo16,                // two words of 16 bits: HI = 256 A + R, LO = 256 G + B
  dsdt8,                 // ds in blue, dt in green
  dsdt8_mag8,            // the same, and MAG in red
  dsdt8_mag8_intensity8  // the same, and I in alpha
};

// The base internal format, which decides what a register reads. With a comparison, `depth` becomes
// `depth_comparison`.
[[nodiscard]] TextureFormat base_format(InternalFormat format);

// The stored components of red, green, blue, alpha. Luminance, intensity and depth are stored in red.
[[nodiscard]] std::array<bool, 4> stored_components(InternalFormat format);

// Whether the filter reads a format's bytes as two words of 16 bits.
[[nodiscard]] constexpr bool has_words(InternalFormat format) {
  return format == InternalFormat::hilo16;
}

// The samples of one level of one face: planes for red, green, blue, alpha. Planes that the format does not store are
// not read. Bytes for the formats ending in 8, 32-bit codes for depth.
using TexelPlanes = std::variant<std::array<Plane<const std::uint8_t>, 4>, std::array<Plane<const std::uint32_t>, 4>,
                                 std::array<Plane<const Half>, 4>, std::array<Plane<const float>, 4>>;
// One level of one face.
struct TextureImage {
  int width = 0;         // texels
  int height = 0;        // texels
  TexelPlanes planes{};  // row 0 at t = 0
  int depth = 1;         // layers of a 3D texture: row y of layer z is row y + height × z of the planes
};

inline constexpr int kMaxTextureLevels = 15;   // 16384 to 1
inline constexpr int kMax3dTextureSize = 512;  // texels a side

// A view of planes: the caller's, such as six rendered surfaces, or those that `storage` keeps alive; copies share
// them. Level 0 comes first; each further level has half the width and height, at least 1.
struct Texture {
  TextureTarget target = TextureTarget::texture_2d;  // its kind
  InternalFormat format = InternalFormat::rgb8;      // of all levels and faces
  std::array<std::vector<TextureImage>, 6> faces{};  // by CubeFace; texture_2d has only the first
  std::shared_ptr<const void> storage{};             // owns the planes; empty: the caller owns them

  [[nodiscard]] std::size_t face_count() const { return target == TextureTarget::cube_map ? 6 : 1; }  // 1 or 6
};

// Reports what GL refuses when a texture is specified: sides that are not powers of two from 1 to kMaxSurfaceSize
// (kMax3dTextureSize for 3D textures; rectangles may have any sides up to kMaxSurfaceSize), 1D textures of several
// rows, several layers of other textures than 3D ones, more than kMaxTextureLevels levels (one for rectangles), planes
// that are missing or of another type than the format's, cube-map faces that are not square, cube maps of depth
// (ARB_depth_texture has none), images beyond the target's faces. All other functions on textures and samplers require
// a texture that passes this check.
[[nodiscard]] Status check_texture(const Texture& texture);

// GL's completeness (OpenGL 1.3, 3.8.9): there is a level 0; the faces of a cube map have the same size; with mip-maps,
// all levels down to 1 × 1 are there, each of its proper size. A unit with an incomplete texture is off.
[[nodiscard]] bool is_complete(const Texture& texture, bool with_mipmaps);

// A texture of one level on the caller's planes: one face, or six for a cube map. Any other number of faces gives an
// incomplete texture without levels.
[[nodiscard]] Texture texture_view(InternalFormat format, std::span<const TextureImage> faces);

// Samples of one image, row by row from t = 0, plane after plane, in the order of stored_components.
struct TextureSamples {
  int width = 0;   // texels
  int height = 0;  // texels
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint32_t>, std::vector<Half>, std::vector<float>>
      samples{};  // of the format's type
  int depth = 1;  // layers; each component's samples of layer 0 come first
};

// A texture that owns its samples: faces[face][level]. Bytes of rgb8 and rgba8 are kept texel by texel, four each.
// Reports a wrong number or type of samples, depth codes out of the format's range, and what check_texture reports.
[[nodiscard]] Result<Texture> make_texture(TextureTarget target, InternalFormat format,
                                           std::vector<std::vector<TextureSamples>> faces);

// A copy of the texture's level 0, and mip-maps down to 1 × 1. Each texel is the mean of two by two texels of
// the previous level (by two layers, in a 3D texture), or of fewer if that level is one texel wide, high or deep.
// Integers are rounded to nearest, halves up, as (a + b + c + d + 2) / 4; floats are computed as
// ((a + b) + (c + d)) × 0.25, and half floats are rounded again. Components that `is_signed`, as Sampler has them, and
// ds and dt are two's complement. HILO textures have means of words of 16 bits, by the signs of alpha (HI) and green
// (LO). Reports what check_texture reports, a texture without level 0, and rectangles.
[[nodiscard]] Result<Texture> with_mipmaps(const Texture& texture, const std::array<bool, 4>& is_signed = {});

}  // namespace ninebit
