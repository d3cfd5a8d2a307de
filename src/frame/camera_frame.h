// The camera's passes that all techniques share: depth before the shadows are marked in the stencil buffer; after that,
// colour where there is light and where there is none.
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/frame/rendering.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/scene/scene_io.h"
#include "src/frame/shading.h"
#include "src/frame/surface_groups.h"

namespace ninebit {

// The pipeline state of the passes that every technique draws from the camera.
struct FramePasses {
  PipelineState depth;   // depth only, the nearest stays
  PipelineState lit;     // colour where the stencil is 0
  PipelineState shadow;  // colour where it is not
};
[[nodiscard]] FramePasses frame_passes(const RenderSettings& settings);

// The state of a pass that marks the stencil buffer with 1 where it draws on the surfaces that the depth pass left: no
// colour, depth test EQUAL without writing, stencil REPLACE 1.
[[nodiscard]] PipelineState marking_pass(const RenderSettings& settings);

// The state of a pass that draws the same surfaces and changes nothing, for its output planes.
[[nodiscard]] PipelineState surface_pass(const RenderSettings& settings);

// A colour pass with textures of its own.
struct SurfaceUnit {
  std::span<const TextureUnit> before{};  // the pass's textures; the scene's is in the unit after them
  RenderTarget* target = nullptr;         // nullptr: the frame's
  // The state for a group; empty: SurfaceGroups::shaded_state.
  std::function<PipelineState(const SurfaceGroup&)> state_of{};
};

// One scene seen from its camera, lit by its light.
class CameraFrame {
 public:
  // The scene must outlive the frame. Reports invalid scenes, one without exactly one camera and one light of these
  // kinds, sizes out of range, and a depth-stencil format without stencil bits.
  [[nodiscard]] static Result<CameraFrame> make(const Scene& scene, const RenderSettings& settings,
                                                const LightKinds& lights);

  // Clears the frame and draws its depth.
  Status draw_depth();
  // Draws colour where the stencil is 0, then where it is not. The times of both passes go into the rendering's.
  Status draw_lit_and_shadow();
  // Draws only the second of these passes, for a technique with its own lit pass.
  Status draw_shadow();
  // Counts lit, shadowed and background pixels; with settings.layers adds stencil, depth, polygon and object.
  void finish();

  // Calls rasterize() with the camera's projection. Positions and indices are the scene's if the arrays have none. With
  // settings.pixels, adds a ProbedPass of that name for each. Their fragments carry the scene's triangle numbers:
  // `scene_triangles` is the number of each triangle drawn; empty: all of the scene's triangles are drawn in order.
  Status draw(std::string_view name, const PipelineState& state, VertexArrays arrays,
              std::span<const TextureUnit> units, RenderTarget& target,
              std::span<const std::uint32_t> scene_triangles = {});

  // Draws all the scene's triangles in a colour pass of that name: group by group if the scene has textures. `arrays`
  // has the colours.
  Status draw_colors(std::string_view name, const PipelineState& state, VertexArrays arrays,
                     const SurfaceUnit& unit = {});

  // For settings.light_facing, which shadows every polygon that faces away from the light: draws the scene's triangles
  // for which faces_light(number of the triangle) is false, as the pass "averted".
  Status draw_averted(const PipelineState& state, const std::function<bool(std::size_t triangle)>& faces_light);

  // The arrays of a draw of all the scene's triangles, with these positions, one per vertex of the scene.
  [[nodiscard]] VertexArrays all_triangles(std::span<const glm::vec3> positions) const {
    return {.positions = positions, .indices = index_list(scene_->triangles)};
  }

  // The frame as a target. With settings.layers it captures, for the polygon that the depth pass left at each pixel,
  // primary, texture0 and texture1 where `units` has them, spare0, spare1 and the final combiner's alpha, as layers
  // whose parts begin with `prefix`.
  [[nodiscard]] RenderTarget capturing_target(int units, const std::string& prefix = "");

  // With settings.layers, the triangle that the depth pass left at each pixel: the owner of captured values.
  [[nodiscard]] Plane<const std::uint32_t> owner() const { return {owner_.data(), settings_.width}; }

  // Whether primitives must have the scene's triangle numbers: they are output or probed.
  [[nodiscard]] bool numbered() const { return settings_.layers || settings_.evidence || !settings_.pixels.empty(); }

  [[nodiscard]] const Scene& scene() const { return *scene_; }
  [[nodiscard]] const SurfaceGroups& groups() const { return groups_; }
  [[nodiscard]] const Light& light() const { return scene_->lights[0]; }
  [[nodiscard]] const RenderSettings& settings() const { return settings_; }
  [[nodiscard]] const FramePasses& passes() const { return passes_; }
  [[nodiscard]] const glm::mat4& projection() const { return projection_; }
  // Replaces the camera's projection for all later passes.
  void set_projection(const glm::mat4& projection);
  // Colours per vertex (with settings.cartoon per triangle). A technique with other lighting changes them before
  // draw_lit_and_shadow.
  [[nodiscard]] VertexShading& shading() { return shading_; }
  [[nodiscard]] const VertexShading& shading() const { return shading_; }
  // Sets the colours, from shading(), for a draw of all the scene's triangles.
  void set_colors(VertexArrays& arrays, const std::vector<ColorBytes>& colors) const {
    (settings_.cartoon ? arrays.primitive_colors : arrays.vertex_colors) = colors;
  }
  [[nodiscard]] Rendering& rendering() { return rendering_; }
  [[nodiscard]] const Rendering& rendering() const { return rendering_; }

  static constexpr ColorBytes kBackground{38, 42, 51, 255};

 private:
  CameraFrame(const Scene& scene, const RenderSettings& settings, Surface frame, SurfaceGroups groups);

  // Adds the masked groups to a depth pass.
  Status draw_masked(std::string_view name, const PipelineState& plain, RenderTarget& target);
  // After a pass of several groups, `draws` at most: removes the probed groups that have no fragment.
  void keep_probed_groups(std::size_t draws);
  Status draw_shaded(std::string_view name, const PipelineState& state, const std::vector<ColorBytes>& colors,
                     double& milliseconds);

  const Scene* scene_;
  RenderSettings settings_;
  FramePasses passes_;
  Rendering rendering_;
  VertexShading shading_;
  SurfaceGroups groups_;
  glm::mat4 projection_;
  // With settings.layers: for each pixel the number of the scene's triangle that the depth pass left; ~0: none. Of
  // triangles at equal depth it is the first one drawn, as the depth test is LESS.
  std::vector<std::uint32_t> owner_;
};

// Reports a map size that is not a power of two from 1 to kMaxSurfaceSize.
[[nodiscard]] Status check_map_size(int size);

// Adds a layer of width × height samples, all zero, and returns its samples.
template <class Sample>
std::vector<Sample>& add_layer(std::deque<Layer>& layers, std::string part, std::string channel, int width,
                               int height) {
  Layer& layer = layers.emplace_back(Layer{std::move(part), std::move(channel), width, height, {}});
  return layer.samples.emplace<std::vector<Sample>>(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
}

}  // namespace ninebit
