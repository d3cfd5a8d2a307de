// Stencil shadow volumes (Crow 1977; Heidmann 1991; depth-fail: Bilodeau and Songy 1999, Carmack 2000).
#pragma once

#include <string_view>
#include <vector>

#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/pipeline_state.h"
#include "ninebit/shadow/technique.h"

namespace NINEBIT_PUBLIC ninebit {

// A draw of all volumes.
struct VolumePass {
  std::string_view name;  // for reports
  PipelineState state;    // changes the stencil plane alone
};

// The passes that count volumes in the stencil buffer, over the depth that the camera sees: neither colour nor depth is
// written, depth test LESS.
//   depth_pass: where a volume's face passes the depth test, a front adds 1 and a back takes 1 away.
//   depth_fail: where it fails, a back adds 1 and a front takes 1 away.
// Both wrap around. With settings.shadow_volume.two_sided it is one pass, otherwise fronts and backs have one each.
[[nodiscard]] std::vector<VolumePass> volume_passes(const RenderSettings& settings);

// Draws the scene's shadows in these passes:
//   1. the camera's depth, with a projection that has no far plane;
//   2. the volumes of everything that casts a shadow, from the casters to infinity: volume_passes;
//   3. the lit pass where the stencil is 0, then the shadow pass where it is not.
//
// A closed object, whose edges each have two triangles that run along it in opposite directions, casts with the
// triangles that turn their front to the light; vertices at equal positions count as one. Any other object casts with
// all of its triangles, each with a volume of its own, whose sides along shared edges cancel. A volume begins at its
// caster: the side of a sheet that the light does not meet is in shadow. With settings.light_facing a triangle that has
// its back to the light is in shadow on both sides.
//
// A spot light shines through the square pyramid of its opening angle: the stencil begins with 1, and the pyramid takes
// 1 away inside. With depth_pass no shadow volume, and no side of the pyramid, may reach into the view before its near
// plane.
//
// Facts: closed_objects, open_objects; where there are such, open_object_names, and open_edges (of one triangle) and
// nonmanifold_edges (of more than two, or of two in one direction) of them; silhouette_edges and volume_triangles that
// were drawn. Picture volume.png: the stencil's counts, the largest one white. With layers and one-sided stencil, part
// stencil_fronts is the stencil after the first of the two passes. The stencil is 0 where nothing but the background
// shows.
//
// Reports what Technique::render says. settings.map_size is not used.
[[nodiscard]] Result<Rendering> render_shadow_volume(const Scene& scene, const RenderSettings& settings,
                                                     const Progress& progress);

}  // namespace ninebit
