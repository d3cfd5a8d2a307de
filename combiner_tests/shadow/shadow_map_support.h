// What the tests of the shadow map share: scenes under a spot or directional light, and rays in doubles that judge
// them.
#pragma once

#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "combiner_tests/shadow/support.h"
#include "ninebit/shadow/shadow_map.h"

namespace shadow_test {

ninebit::Light spot_light(const glm::vec3& position, const glm::vec3& target, float degrees);
ninebit::Light directional_light(const glm::vec3& direction);

// Renders by the technique shadow-map, throwing where that fails.
ninebit::Rendering render_map(const ninebit::Scene& scene, const ninebit::RenderSettings& settings);

// A thin wall that stands on a floor under a spot light, seen from its dark side.
ninebit::Scene wall_on_floor();

// The pixels of wall_on_floor() that are drawn wrong, by rays in doubles: lit where the wall, the floor or the beam's
// end keeps the light away (leaks), shadowed where nothing does (acne). Only pixels whose answer is the same everywhere
// within `margin` world units around count as judged.
struct WallErrors {
  int judged_lit = 0, judged_shadowed = 0;
  int acne = 0, leaks = 0;
};
WallErrors wall_errors(const ninebit::Scene& scene, const ninebit::RenderSettings& settings,
                       const ninebit::Rendering& rendering, double margin);

}  // namespace shadow_test
