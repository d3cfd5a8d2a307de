#include "ninebit/raster/rasterizer.h"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <atomic>
#include <memory>
#include <string>
#include <vector>

#include "ninebit/combiner/initial_registers.h"
#include "src/raster/fragment_batch.h"
#include "src/raster/fragment_operations.h"
#include "src/raster/pixel_probe.h"
#include "src/raster/tile.h"
#include "src/raster/triangle_setup.h"

namespace ninebit {
namespace {

// How a draw is cut: blocks are set up and binned in parallel, a chunk of blocks is then drawn tile by tile.
struct Cut {
  std::size_t triangles_per_block;
  std::size_t blocks_per_chunk;
};

// Enough blocks to keep the threads busy, and so few triangles that a chunk's lists stay within 2^28 entries even if
// clipping makes eight pieces of every triangle and every piece covers every tile.
Cut cut_for(std::size_t tiles) {
  const std::size_t pieces = (std::size_t{1} << 28) / tiles;
  const std::size_t block = std::clamp(pieces / 8, std::size_t{64}, std::size_t{2048});
  return {block, std::clamp(pieces / (8 * block), std::size_t{1}, std::size_t{64})};
}

// One block's triangles sorted by tile, in drawing order within each tile.
struct BinnedBlock {
  SetupBlock setup;
  std::vector<std::uint32_t> indices;  // into setup.triangles
  std::vector<std::uint32_t> first;    // for each tile its first place in indices; one more at the end
};

struct TileGrid {
  int columns;
  int rows;
  explicit TileGrid(const RenderTarget& target)
      : columns((target.width + kTileSize - 1) / kTileSize), rows((target.height + kTileSize - 1) / kTileSize) {}
  [[nodiscard]] std::size_t count() const { return static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows); }
};

// Calls visit(tile) for every tile that the triangle's box meets.
template <class Visit>
void for_each_tile(const TileGrid& grid, const SetupTriangle& t, Visit visit) {
  constexpr int kShift = 10;  // 64 pixels of 16 steps
  const auto [x_low, x_high] = std::minmax({t.x_q4[0], t.x_q4[1], t.x_q4[2]});
  const auto [y_low, y_high] = std::minmax({t.y_q4[0], t.y_q4[1], t.y_q4[2]});
  const int left = std::max(x_low >> kShift, 0), right = std::min(x_high >> kShift, grid.columns - 1);
  const int bottom = std::max(y_low >> kShift, 0), top = std::min(y_high >> kShift, grid.rows - 1);
  for (int row = bottom; row <= top; ++row) {
    for (int column = left; column <= right; ++column) {
      visit(static_cast<std::size_t>(row) * static_cast<std::size_t>(grid.columns) + static_cast<std::size_t>(column));
    }
  }
}

void sort_into_tiles(const TileGrid& grid, BinnedBlock& block) {
  block.first.assign(grid.count() + 1, 0);
  for (const SetupTriangle& t : block.setup.triangles) {
    for_each_tile(grid, t, [&](std::size_t tile) { ++block.first[tile + 1]; });
  }
  for (std::size_t tile = 0; tile < grid.count(); ++tile) block.first[tile + 1] += block.first[tile];
  block.indices.resize(block.first.back());
  std::vector<std::uint32_t> next(block.first.begin(), block.first.end() - 1);
  for (std::uint32_t i = 0; i < block.setup.triangles.size(); ++i) {
    for_each_tile(grid, block.setup.triangles[i], [&](std::size_t tile) { block.indices[next[tile]++] = i; });
  }
}

glm::vec4 transform(const glm::mat4& m, const glm::vec3& p) {
  glm::vec4 out;
  for (int i = 0; i < 4; ++i) out[i] = ((m[0][i] * p.x + m[1][i] * p.y) + m[2][i] * p.z) + m[3][i];
  return out;
}

Diagnostic fault(std::string message) {
  return Diagnostic{.message = std::move(message)};
}

// What the registers of every fragment start with. Secondary colour and fog are not drawn: black, without fog. The
// texel of a unit that is on has the alpha of an RGB texture.
RegisterFile initial_registers_of(const PipelineState& state, std::span<const CubeMap* const> textures) {
  FragmentInputs inputs;
  inputs.secondary[kAlpha] = 255;
  for (std::size_t unit = 0; unit < textures.size(); ++unit) {
    if (textures[unit] != nullptr) inputs.texture[unit] = Texel{.format = TextureFormat::rgb};
  }
  return initial_registers(state.profile, inputs);
}

Status check(const PipelineState& state, const TriangleArrays& arrays, std::span<const CubeMap* const> textures,
             const RenderTarget& target) {
  if (target.width < 1 || target.height < 1 || target.width > kMaxSurfaceSize || target.height > kMaxSurfaceSize) {
    return fault("the render target is " + std::to_string(target.width) + "x" + std::to_string(target.height) +
                 "; each side goes from 1 to " + std::to_string(kMaxSurfaceSize));
  }
  if (state.stencil_test.enabled && !target.stencil) return fault("the stencil test needs a stencil plane");
  if (state.depth_test.enabled && !target.depth_z24) return fault("the depth test needs a depth plane");
  if (const FragmentProbe* probe = target.probe) {
    if (probe->x < 0 || probe->y < 0 || probe->x >= target.width || probe->y >= target.height) {
      return fault("the probe's pixel (" + std::to_string(probe->x) + ", " + std::to_string(probe->y) +
                   ") lies outside of the render target");
    }
  }
  for (const RegisterCapture& c : target.captures) {
    const bool holds_value = !c.reg || (*c.reg >= Register::fog && *c.reg <= Register::texture3);
    if (!holds_value || c.component < kRed || c.component > kAlpha) {
      return fault("a capture names no component of a register that fragments have, nor of the output");
    }
  }
  if (state.program && state.program->datapath != datapath_of(state.profile)) {
    return fault("the program was compiled for another profile than " + std::string(state.profile.name));
  }
  if (state.profile.subpixel_bits < 0 || state.profile.subpixel_bits > 4) {
    return fault("the rasterizer's integers hold 0 to 4 subpixel bits, not " +
                 std::to_string(state.profile.subpixel_bits.value));
  }
  const std::size_t vertices = arrays.positions.size(), triangles = arrays.triangles.size();
  if (triangles > 0xFFFFFFFE) return fault("one draw call takes at most 4,294,967,294 triangles");
  if (!arrays.vertex_colors.empty() && arrays.vertex_colors.size() != vertices) {
    return fault("there are " + std::to_string(arrays.vertex_colors.size()) + " vertex colours for " +
                 std::to_string(vertices) + " vertices");
  }
  if (!arrays.triangle_colors.empty() && arrays.triangle_colors.size() != triangles) {
    return fault("there are " + std::to_string(arrays.triangle_colors.size()) + " triangle colours for " +
                 std::to_string(triangles) + " triangles");
  }
  if (!arrays.vertex_colors.empty() && !arrays.triangle_colors.empty()) {
    return fault("primary colours are given both a vertex and a triangle; give one of them");
  }
  const int units = std::clamp(state.profile.texture_units.value, 0, kMaxTextureUnits);
  if (textures.size() > static_cast<std::size_t>(units)) {
    return fault("profile " + std::string(state.profile.name) + " has " + std::to_string(units) +
                 " texture units, not " + std::to_string(textures.size()));
  }
  for (std::size_t unit = 0; unit < textures.size(); ++unit) {
    if (textures[unit] == nullptr) continue;
    if (arrays.texture_coordinates[unit].size() != vertices) {
      return fault("texture unit " + std::to_string(unit) + " has " +
                   std::to_string(arrays.texture_coordinates[unit].size()) + " texture coordinates for " +
                   std::to_string(vertices) + " vertices");
    }
    bool complete = textures[unit]->size >= 1;
    for (const auto& face : textures[unit]->faces) {
      for (const auto& plane : face) complete = complete && plane;
    }
    if (!complete) return fault("the cube map of texture unit " + std::to_string(unit) + " lacks a size or a plane");
  }
  std::atomic<bool> in_range = true;
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, triangles, 65536), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i) {
      const glm::uvec3 v = arrays.triangles[i];
      if (std::max({v.x, v.y, v.z}) >= vertices) in_range = false;
    }
  });
  if (!in_range) return fault("a triangle names a vertex beyond the " + std::to_string(vertices) + " that there are");
  return {};
}

}  // namespace

Status rasterize(const PipelineState& state, const glm::mat4& clip_from_object, const TriangleArrays& arrays,
                 std::span<const CubeMap* const> textures, RenderTarget& target) {
  if (Status checked = check(state, arrays, textures, target); !checked) return checked;

  std::vector<glm::vec4> clip(arrays.positions.size());
  tbb::parallel_for(tbb::blocked_range<std::size_t>(0, clip.size(), 4096), [&](const auto& range) {
    for (std::size_t i = range.begin(); i != range.end(); ++i)
      clip[i] = transform(clip_from_object, arrays.positions[i]);
  });

  const FragmentOperations operations(state, target);
  const DrawContext context{state, arrays, textures, target, operations, initial_registers_of(state, textures)};
  const bool flat_result = has_flat_result(context);
  const auto probe = target.probe != nullptr ? std::make_unique<PixelProbe>(context, *target.probe) : nullptr;
  const TileGrid grid(target);
  const Viewport viewport{target.width, target.height, state.profile.subpixel_bits};
  const bool cull_front = state.cull_face == CullFace::front, cull_back = state.cull_face == CullFace::back;

  const Cut cut = cut_for(grid.count());
  const std::size_t blocks = (arrays.triangles.size() + cut.triangles_per_block - 1) / cut.triangles_per_block;
  std::vector<BinnedBlock> chunk(std::min(blocks, cut.blocks_per_chunk));
  for (std::size_t first_block = 0; first_block < blocks; first_block += cut.blocks_per_chunk) {
    const std::size_t count = std::min(cut.blocks_per_chunk, blocks - first_block);
    tbb::parallel_for(std::size_t{0}, count, [&](std::size_t b) {
      BinnedBlock& block = chunk[b];
      block.setup.triangles.clear();
      block.setup.weights.clear();
      const std::size_t begin = (first_block + b) * cut.triangles_per_block;
      const std::size_t end = std::min(begin + cut.triangles_per_block, arrays.triangles.size());
      for (std::size_t i = begin; i < end; ++i) {
        const glm::uvec3 v = arrays.triangles[i];
        set_up_triangle(viewport, {clip[v.x], clip[v.y], clip[v.z]}, static_cast<std::uint32_t>(i), cull_front,
                        cull_back, block.setup);
      }
      sort_into_tiles(grid, block);
    });
    tbb::parallel_for(std::size_t{0}, grid.count(), [&](std::size_t tile) {
      const int column = static_cast<int>(tile) % grid.columns, row = static_cast<int>(tile) / grid.columns;
      const TileRect rect{column * kTileSize, row * kTileSize, std::min((column + 1) * kTileSize, target.width),
                          std::min((row + 1) * kTileSize, target.height)};
      const auto indices_of = [tile](const BinnedBlock& block) {
        return std::span<const std::uint32_t>(block.indices.data() + block.first[tile],
                                              block.first[tile + 1] - block.first[tile]);
      };
      if (probe && probe->lies_in(rect)) {
        probe->meet_planes();
        for (std::size_t b = 0; b < count; ++b) probe->run(chunk[b].setup, indices_of(chunk[b]));
      }
      FragmentBatch batch(context);
      for (std::size_t b = 0; b < count; ++b) {
        draw_in_tile(context, rect, chunk[b].setup, indices_of(chunk[b]), flat_result, batch);
      }
      batch.flush();
    });
  }
  return {};
}

}  // namespace ninebit
