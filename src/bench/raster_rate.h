// Triangles and pixels a second that the rasterizer draws.
#pragma once

#include <cstdint>

#include "ninebit/raster/surface.h"
#include "src/bench/meshes.h"

namespace ninebit::bench {

// Depth test LESS with writing, flat colours, no program: what a depth-tested pass of that time was.
[[nodiscard]] PipelineState flat_depth_state();

// The pixels that a mesh's triangles cover, each triangle counted for itself, whatever their depth. At most 255 of them
// may meet in a pixel.
[[nodiscard]] Result<std::uint64_t> covered_pixels(const Mesh& mesh, int width, int height);

// The shortest seconds that one rasterize() of the mesh took, of those that fit into `seconds` and of at least two;
// before each the surface is cleared, which is not timed.
[[nodiscard]] Result<double> seconds_to_draw(const Mesh& mesh, Surface& surface, double seconds);

// The same with prepare() and a drawing of what it prepared, into memory that stays for the next run.
[[nodiscard]] Result<double> seconds_to_prepare_and_draw(const Mesh& mesh, Surface& surface, double seconds);

}  // namespace ninebit::bench
