// Objects whose back sides the light never sees first.
#pragma once

#include <vector>

#include "ninebit/scene/scene.h"
#include "src/shadow/index_order/scene_surface.h"

namespace ninebit {

// For each object of the scene, whether a ray from the light always meets the front of one of its polygons before the
// back of another: solids that face outward, and rooms that face inward with the light inside. In the light's map,
// their polygons then face the light, except beside an edge. An object with edges that are not shared by two polygons
// counts as closed while these edges have at most kMostOpen of the length of all edges. The scene has a light.
[[nodiscard]] std::vector<bool> find_hidden_backs(const Scene& scene, const SceneSurface& surface);

inline constexpr double kMostOpen = 0.02;
// A light with this winding number or less is inside a room that faces inward; -1: entirely.
inline constexpr double kInsideRoom = -0.75;

}  // namespace ninebit
