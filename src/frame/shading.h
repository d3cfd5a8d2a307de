// The colours of the lit and the shadow pass: per-vertex diffuse lighting, as OpenGL of that time did it, or flat
// colours as in a cartoon.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/frame/settings.h"
#include "ninebit/language/gl_nv.h"
#include "ninebit/numerics/result.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

// The brightness of a white surface that faces a white light.
inline constexpr float kDiffuseLight = 0.78F;

// The material of each vertex: that of the last triangle that uses it.
[[nodiscard]] std::vector<std::uint32_t> vertex_materials(const Scene& scene);

// One colour per vertex, or with settings.cartoon per triangle.
struct VertexShading {
  std::vector<ColorBytes> lit;
  std::vector<ColorBytes> shadowed;
};

// Base colour × the vertex's own colour × (ambient + diffuse · cos), with the profile's conversion of float colours to
// bytes. With `settings.light_facing` surfaces that face away from the light get no diffuse light; otherwise both sides
// are lit the same, as in the article's pictures. In shadow a quarter of the diffuse light stays, so that shapes remain
// visible.
//
// With `settings.cartoon` a triangle has a single colour: its base colour at one of a few brightnesses, by its angle to
// the light. Vertex colours have no effect. In shadow it is ink: nearly black, with a trace of the base colour.
[[nodiscard]] VertexShading shade_vertices(const Scene& scene, const Light& light, const RenderSettings& settings);

// The summands of the lit colours, separately, for passes that change the light before it reaches the surface.
struct VertexLight {
  std::vector<ColorBytes> ambient;  // base colour × ambient
  std::vector<ColorBytes> diffuse;  // base colour × diffuse · cos, what the light adds
};
[[nodiscard]] VertexLight light_vertices(const Scene& scene, const Light& light, const RenderSettings& settings);

// The register-combiner programs of textured and masked surfaces.

// The colour that a surface program returns.
enum class SurfaceColor : std::uint8_t {
  primary_times_texture,  // primary × texture0, for the colour passes
  primary                 // for passes that draw an index, or no colour
};

// One general combiner: spare0 = the colour, spare0.alpha = texture0.alpha × alpha / 255. The final combiner passes
// spare0 on. Reports a profile that refuses the set-up.
[[nodiscard]] Result<CombinerState> surface_state(const HardwareProfile& profile, SurfaceColor color,
                                                  std::uint8_t alpha);
[[nodiscard]] Result<Program> surface_program(const HardwareProfile& profile, SurfaceColor color, std::uint8_t alpha);

// Helpers for the techniques' register-combiner set-ups: GL calls in, a state out.

// The state after the GL calls that `set` makes, with the register combiners enabled. Reports a call that the profile
// refuses; `what` names the set-up.
template <class SetUp>
Result<CombinerState> combiner_state_after(const HardwareProfile& profile, std::string_view what, const SetUp& set) {
  gl::Context context(profile);
  const gl::CurrentContext current(context);
  set();
  gl::glEnable(gl::GL_REGISTER_COMBINERS_NV);
  if (context.error() != GlError::no_error) {
    return Diagnostic{.message = "profile " + std::string(profile.name) + " refuses the " + std::string(what) + ": " +
                                 std::string(name_of(context.error()))};
  }
  if (!context.register_combiners_enabled()) {
    return Diagnostic{.message = "the register combiners of the " + std::string(what) + " are not enabled"};
  }
  return context.state();
}

// Discards all outputs of one portion of a stage.
inline void discard_portion(gl::GLenum stage, gl::GLenum portion) {
  using namespace gl;
  glCombinerOutputNV(stage, portion, GL_DISCARD_NV, GL_DISCARD_NV, GL_DISCARD_NV, GL_NONE, GL_NONE, GL_FALSE, GL_FALSE,
                     GL_FALSE);
}

}  // namespace ninebit
