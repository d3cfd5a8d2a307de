// Textures: pictures with their mip-maps, one or six faces, that the rasterizer samples.
//
// Texel (0, 0) is at s = t = 0, the first sample of row 0: a rendered surface is the texture that glCopyTexImage2D
// would make of it. sampler.h says how a texture is read, s3tc.h decodes compressed ones, image/texture_io.h reads
// files.
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

// The point where a direction hits the cube: the face and the position on it, s and t in [0, 1].
struct CubeCoordinate {
  CubeFace face = CubeFace::positive_x;  // face that the direction hits
  float s = 0.5F;                        // on the face
  float t = 0.5F;                        // on the face
};

// The major-axis table of ARB_texture_cube_map; s is (sc / |ma| + 1) × 0.5 in floats, in this order. The extension
// leaves ties open; here x wins over y and y over z, and a zero counts as positive. The zero direction gives the middle
// of +X; NaN gives its first texel; a component that is infinite beside others that are finite gives 0.5 for both, and
// infinity beside infinity gives 0.
[[nodiscard]] CubeCoordinate cube_coordinate(float rx, float ry, float rz);

// The six axes of a face in the extension's table: s grows along `s`, t along `t`, the face looks along `major`.
struct CubeFaceAxes {
  std::array<int, 3> s;      // x, y, z, each -1, 0 or 1
  std::array<int, 3> t;      // likewise
  std::array<int, 3> major;  // likewise
};
[[nodiscard]] const CubeFaceAxes& cube_face_axes(CubeFace face);

// One face, or the six of ARB_texture_cube_map.
enum class TextureTarget : std::uint8_t { texture_2d, cube_map };

// How texels are stored. The last two are not formats of the hardware: floats, which reach a combiner register clamped
// to [0, 1] and rounded to a byte.
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
  rgba32f
};

// The base internal format, which decides what a register reads (`depth` also where a comparison makes it
// `depth_comparison`).
[[nodiscard]] TextureFormat base_format(InternalFormat format);

// Which of red, green, blue, alpha are stored. Luminance, intensity and depth stand in red.
[[nodiscard]] std::array<bool, 4> stored_components(InternalFormat format);

// One level of one face: planes of its samples for red, green, blue, alpha; planes that the format does not store are
// not read. Bytes for the formats ending in 8, 32-bit codes for depth.
using TexelPlanes = std::variant<std::array<Plane<const std::uint8_t>, 4>, std::array<Plane<const std::uint32_t>, 4>,
                                 std::array<Plane<const Half>, 4>, std::array<Plane<const float>, 4>>;
// One level of one face.
struct TextureImage {
  int width = 0;         // texels
  int height = 0;        // texels
  TexelPlanes planes{};  // row 0 at t = 0
};

inline constexpr int kMaxTextureLevels = 15;  // 16384 to 1

// A texture views planes that somebody else owns, such as six surfaces that were drawn, or planes that `storage` keeps
// alive; copies share it. Level 0 comes first, each next one has half its width and height, at least 1.
struct Texture {
  TextureTarget target = TextureTarget::texture_2d;  // how many faces there are
  InternalFormat format = InternalFormat::rgb8;      // of all levels and faces
  std::array<std::vector<TextureImage>, 6> faces{};  // by CubeFace; texture_2d uses only the first
  std::shared_ptr<const void> storage{};             // keeps the planes alive; empty: the caller does

  [[nodiscard]] std::size_t face_count() const { return target == TextureTarget::cube_map ? 6 : 1; }  // 1 or 6
};

// Reports what GL rejects when a texture is created: sides that are not powers of two from 1 to kMaxSurfaceSize, more
// than kMaxTextureLevels levels, planes that are missing or have the wrong type for the format, cube-map faces that are
// not square, cube maps of depth (ARB_depth_texture has none), images beyond the target's faces. The other functions on
// textures and samplers require a texture that passes this check.
[[nodiscard]] Status check_texture(const Texture& texture);

// GL's completeness (OpenGL 1.3, 3.8.9): there is a level 0; the faces of a cube map have the same size; with mip-maps,
// all levels down to 1 × 1 are there, each of its proper size. A unit with an incomplete texture counts as off.
[[nodiscard]] bool is_complete(const Texture& texture, bool with_mipmaps);

// A texture of one level on planes that the caller keeps: one face, or six for a cube map. Any other number of faces
// gives a texture without a level, which is incomplete.
[[nodiscard]] Texture texture_view(InternalFormat format, std::span<const TextureImage> faces);

// Samples of one image, row by row from t = 0, plane after plane: those of stored_components in their order.
struct TextureSamples {
  int width = 0;   // texels
  int height = 0;  // texels
  std::variant<std::vector<std::uint8_t>, std::vector<std::uint32_t>, std::vector<Half>, std::vector<float>>
      samples{};  // of the format's type
};

// A texture that owns its samples: faces[face][level]. Reports too many or too few samples, samples of the wrong
// type for the format, depth codes beyond the format's, and what check_texture reports.
[[nodiscard]] Result<Texture> make_texture(TextureTarget target, InternalFormat format,
                                           std::vector<std::vector<TextureSamples>> faces);

// Level 0 of the texture, which it shares with it, and mip-maps down to 1 × 1: each texel is the mean of the two by two
// (or two, once the level before is one texel wide or high) above it, of integers rounded to nearest, halves up, as
// (a + b + c + d + 2) / 4; of floats computed as ((a + b) + (c + d)) × 0.25, and of half floats rounded again.
// Reports the errors of check_texture, and a texture without level 0.
[[nodiscard]] Result<Texture> with_mipmaps(const Texture& texture);

}  // namespace ninebit
