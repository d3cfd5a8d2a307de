#pragma once

#include "combiner_tests/shadow/support.h"
#include "ninebit/shadow/depth_cube.h"

namespace shadow_test {

inline ninebit::Rendering draw_depth_cube(const ninebit::Scene& scene, const ninebit::RenderSettings& settings) {
  return render_by("depth-cube", scene, settings);
}

inline ninebit::RenderSettings depth_cube_settings(ninebit::DepthCubeBits bits) {
  ninebit::RenderSettings settings = small_settings();
  settings.depth_cube.bits = bits;
  return settings;
}

}  // namespace shadow_test
