// The rasterizer's rate of triangles and pixels.
#pragma once

#include <cstddef>
#include <cstdint>

#include "ninebit/raster/surface.h"
#include "src/bench/meshes.h"

namespace ninebit::bench {

// Depth test LESS with depth writes, flat colours, no program: a typical depth-tested pass of that time.
[[nodiscard]] PipelineState flat_depth_state();

// The number of pixels that a mesh's triangles cover, summed over triangles and independent of depth. At most 255
// triangles may cover the same pixel.
[[nodiscard]] Result<std::uint64_t> covered_pixels(const Mesh& mesh, int width, int height);

// The shortest time in seconds of one rasterize() of the mesh, among the calls that fit into `seconds`, at least two.
// The surface is cleared before each call, untimed.
[[nodiscard]] Result<double> seconds_to_draw(const Mesh& mesh, Surface& surface, double seconds);

// The same for prepare() and drawing the prepared mesh. The memory is kept for the next call.
[[nodiscard]] Result<double> seconds_to_prepare_and_draw(const Mesh& mesh, Surface& surface, double seconds);

// How fast memory is written, as a measure for filled pixels.

// GB/s at which `threads` threads together fill `bytes` with memset, in the shortest run of those that fit into
// `seconds`.
[[nodiscard]] double memset_rate(std::size_t bytes, int threads, double seconds);

}  // namespace ninebit::bench
