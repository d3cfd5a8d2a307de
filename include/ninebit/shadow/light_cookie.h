// A light cookie: a point light that shines differently in each direction, as a cube map says (Jason McKesson's
// "Cube Point Light").
#pragma once

#include <glm/glm.hpp>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// The factor on the cube map's colours: 1/6 in the map is the light's own intensity.
inline constexpr int kCookieScale = 6;

// How the cube map is sampled: only its level 0, even if it has others.
inline constexpr Sampler kCookieSampler{.min_filter = MinFilter::linear,
                                        .mag_filter = MagFilter::linear,
                                        .wrap_s = Wrap::clamp_to_edge,
                                        .wrap_t = Wrap::clamp_to_edge};

// The rotation from a light's own space to the world's: by `degrees` about the world's x axis, then y, then z, each
// counter-clockwise when seen against the axis. Its columns are the light's axes in the world. Quarter turns are exact,
// other angles correct to a float, with the same bits on every machine. The angles must be finite.
[[nodiscard]] glm::mat3 light_rotation(const glm::vec3& degrees);

// Two general combiners and a final combiner: RGB = min(1, kCookieScale · primary · texture 0) + secondary, clamped;
// alpha = 1. With `geforce2` the product is at most one code of 255 off. Reports a profile that refuses the set-up.
[[nodiscard]] Result<CombinerState> light_cookie_state(const HardwareProfile& profile);

// The lit pass: FramePasses::lit with that program. Reports what light_cookie_state reports.
[[nodiscard]] Result<PipelineState> light_cookie_pass(const RenderSettings& settings);

// The same for surfaces with a texture in unit 1: its colour multiplies the sum of light and ambient light, which the
// final combiner's register spare0 + secondary holds, clamped to 1.
[[nodiscard]] Result<CombinerState> light_cookie_textured_state(const HardwareProfile& profile);
[[nodiscard]] Result<PipelineState> light_cookie_textured_pass(const RenderSettings& settings);

// Draws the scene in the light of settings.light_cookie.cookie:
//   1. with settings.light_cookie.shadows, passes 1 to 3 of render_index_cube; without, the camera's depth only;
//   2. the lit pass where the stencil is 0: diffuse light as primary colour, ambient light as secondary, on unit 0 the
//      cube map, fetched along the interpolated position in the light's own space;
//   3. the shadow pass where it is 1: ambient light.
// Besides what Technique::render reports and, with shadows, render_index_cube, reports a cookie that is missing, is not
// a cube map, or is rejected by check_texture or is_complete.
[[nodiscard]] Result<Rendering> render_light_cookie(const Scene& scene, const RenderSettings& settings,
                                                    const Progress& progress);

}  // namespace ninebit
