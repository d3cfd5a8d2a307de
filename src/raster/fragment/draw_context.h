// Data that all tiles of one draw call share.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/texture_stages.h"
#include "src/raster/fragment/fragment_operations.h"
#include "src/raster/fragment/interpolation.h"
#include "src/raster/fragment/output_planes.h"
#include "src/raster/setup/primitive_assembly.h"
#include "src/raster/setup/window_transform.h"

namespace ninebit {

struct RegisterComponent {
  Register reg;
  int component;
};

// The units as stages take them.
[[nodiscard]] StageUnits stage_units(std::span<const TextureUnit> units);

struct DrawContext {
  // The arguments must outlive the context and have been checked. Units of incomplete textures are off. For a probe,
  // every fragment goes through a batch, with all its registers.
  DrawContext(const PipelineState& pipeline, const VertexArrays& vertices, std::span<const TextureUnit> units,
              const RenderTarget& target, bool for_probe = false);

  // Whether primary and secondary colours are constant over a primitive.
  [[nodiscard]] bool shades_flat() const {
    return state.shade_model == ShadeModel::flat || (arrays.vertex_colors.empty() && arrays.secondary_colors.empty());
  }
  // The same of one of them, whose colours at the vertices these are.
  [[nodiscard]] bool shades_flat(std::span<const ColorBytes> colors) const {
    return state.shade_model == ShadeModel::flat || colors.empty();
  }
  // The primary colour that flat shading gives a primitive.
  [[nodiscard]] ColorBytes flat_primary(std::uint32_t primitive) const {
    return arrays.primitive_colors.empty() ? flat_primary_of_vertex(primitive) : arrays.primitive_colors[primitive];
  }

  // The same of the secondary colours, which are there.
  [[nodiscard]] ColorBytes flat_secondary(std::uint32_t primitive) const {
    return arrays.secondary_colors[assembly.provoking_vertex(primitive)];
  }

  [[nodiscard]] VertexCoordinates coordinates(std::size_t unit) const {
    return {arrays.texture_coordinates[unit], cylinder[unit]};
  }

  // Whether a unit's coordinates, of a texture that is on, have to be divided by q.
  [[nodiscard]] bool reads_q(std::size_t unit) const {
    return !arrays.texture_q[unit].empty() && samplers[unit]->divides_by_q();
  }

  const PipelineState& state;
  const VertexArrays& arrays;
  const PrimitiveAssembly assembly;
  const FragmentOperations operations;
  const OutputPlanes outputs;
  const WindowDepth depth;

  std::optional<TextureStages> stages;  // if they are enabled: then no unit has a sampler of its own
  bool stages_decide = false;           // whether fragments may be culled or their depth replaced
  std::uint32_t largest_depth;          // code of the target
  std::array<std::optional<TextureSampler>, kMaxTextureUnits> samplers;
  // The change of s at points, where rho is 1 (OpenGL 1.3, 3.8.8), for units and stages that read at s/q, t/q, r/q.
  std::array<float, kMaxTextureUnits> point_change{};
  bool needs_texture_changes = false;
  bool draws_lines, draws_points;  // whether primitives may be lines, or points, by their type or by polygon modes
  bool kills_by_key = false;       // whether a unit's colour key may kill fragments
  std::array<std::array<bool, 2>, kMaxTextureUnits> cylinder{};  // which units' s and t wrap around one

  // Whether every fragment's final colour is its primitive's flat_primary and no plane needs more of the fragment. (Of
  // smoothed primitives, vectors gather the coverage of fragments.)
  bool has_flat_result = false;
  // Whether registers have to be filled at all, and which units and registers are then read.
  bool fills_registers = false;
  std::optional<BatchProgram> program;                       // of the state, prepared for batches
  std::array<bool, 4> wanted_color{true, true, true, true};  // components of its output that are used
  std::array<bool, kRegisterCount> reads{};
  std::array<bool, kMaxTextureUnits> reads_unit{};
  RegisterFile initial;  // values that all fragments share
  // Components of constant registers that the program overwrites; filled again for each batch.
  std::vector<RegisterComponent> refilled;

 private:
  [[nodiscard]] ColorBytes flat_primary_of_vertex(std::uint32_t primitive) const;
  void prepare_units(std::span<const TextureUnit> units);
  void prepare_stages(std::span<const TextureUnit> units);
  void prepare_program(const RenderTarget& target, bool for_probe);
  [[nodiscard]] bool gives_signed_codes() const;
};

}  // namespace ninebit
