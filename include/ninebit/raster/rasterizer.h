// Drawing triangles: vertices in, fragments through the combiners and the fragment operations, planes out.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>

#include "ninebit/raster/fragment_probe.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/surface.h"
#include "ninebit/raster/texture.h"

namespace ninebit {

using ColorBytes = std::array<std::uint8_t, 4>;  // red, green, blue, alpha

inline constexpr int kMaxTextureUnits = 4;

// Indexed triangles. The spans must outlive the call.
struct TriangleArrays {
  std::span<const glm::vec3> positions{};
  std::span<const glm::uvec3> triangles{};  // indices into positions

  // Primary colours: one a vertex, or one a triangle (what flat shading gives when the vertices are not shared); both
  // empty: opaque white.
  std::span<const ColorBytes> vertex_colors{};
  std::span<const ColorBytes> triangle_colors{};

  // Texture coordinates (s, t, r) a vertex, for each unit with a texture.
  std::array<std::span<const glm::vec3>, kMaxTextureUnits> texture_coordinates{};
};

// Draws the triangles in their order into the whole target (viewport = target, depth range [0, 1]).
//
// - Clip coordinates are clip_from_object * (position, 1), computed in floats in a fixed order. Triangles are clipped
//   against the near and far planes and against a guard band that keeps window positions within 8,192 pixels of the
//   viewport's centre. Triangles with a position that is not finite, or without area after snapping, draw nothing.
// - Window positions are truncated toward zero to 1/16 pixel (profile.subpixel_bits); a pixel is drawn when its centre
//   lies inside, or on a top or left edge (top: in the picture, y up).
// - Depth is the exact plane through the three vertices' 24-bit depths at the pixel's centre, rounded to nearest,
//   halves up: an integer computation, so that equal geometry gives equal depth in every pass.
// - Texture coordinates and smooth colours are perspective-correct, in floats, in a fixed order for each fragment.
// - Each fragment then goes through the program, alpha test, stencil test, depth test and masks, in GL's order; where
//   triangles overlap, earlier ones come first, whatever the number of threads.
//
// Reports arrays of unequal lengths, indices out of range, a target without the planes that the state needs,
// a probe outside of the target.
[[nodiscard]] Status rasterize(const PipelineState& state, const glm::mat4& clip_from_object,
                               const TriangleArrays& arrays,
                               std::span<const CubeMap* const> textures,  // for each unit; nullptr: the unit is off
                               RenderTarget& target);

}  // namespace ninebit
