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
  PipelineState state;    // changes only the stencil plane
};

// The passes that count volumes in the stencil buffer, against the camera's depth: depth test LESS, neither colour nor
// depth is written.
//   depth_pass: where a volume's face passes the depth test, a front adds 1 and a back subtracts 1.
//   depth_fail: where it fails, a back adds 1 and a front subtracts 1.
// Both wrap around. With settings.shadow_volume.two_sided there is one pass, otherwise one for fronts and one for
// backs.
[[nodiscard]] std::vector<VolumePass> volume_passes(const RenderSettings& settings);

// Draws the scene's shadows in these passes:
//   1. the camera's depth, with a projection that has no far plane;
//   2. the volumes of everything that casts a shadow, from the casters to infinity: volume_passes;
//   3. the lit pass where the stencil is 0, then the shadow pass where it is not.
//
// A closed object, whose edges each have two triangles that run along it in opposite directions, casts with the
// triangles whose front faces the light; vertices at equal positions count as one. Any other object casts with all its
// triangles, each with its own volume; sides along shared edges cancel. A volume begins at its caster: the unlit side
// of a sheet is in shadow. With settings.light_facing a triangle whose back faces the light is in shadow on both sides.
//
// A spot light shines through the square pyramid of its opening angle: the stencil begins with 1, and the pyramid
// subtracts 1 inside. With depth_pass no shadow volume, and no side of the pyramid, may reach into the view in front of
// its near plane.
//
// Facts: closed_objects and open_objects; if there are open ones, open_object_names; open_edges (used by one triangle)
// and nonmanifold_edges (used by more than two, or by two in one direction); silhouette_edges; volume_triangles that
// were drawn. Picture volume.png: the stencil's counts, the largest one white. With layers and one-sided stencil, part
// stencil_fronts is the stencil after the first of the two passes. The stencil is 0 in the background.
//
// Reports what Technique::render reports. settings.map_size is not used.
[[nodiscard]] Result<Rendering> render_shadow_volume(const Scene& scene, const RenderSettings& settings,
                                                     const Progress& progress);

}  // namespace ninebit
