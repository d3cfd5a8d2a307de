#pragma once

#include <stdexcept>
#include <utility>

#include "combiner_tests/shadow/support.h"
#include "ninebit/shadow/depth_cube.h"

namespace shadow_test {

inline ninebit::Rendering draw_depth_cube(const ninebit::Scene& scene, const ninebit::RenderSettings& settings) {
  auto result = ninebit::render_depth_cube(scene, settings, {});
  if (!result) throw std::runtime_error(result.error().text());
  return std::move(*result);
}

inline ninebit::RenderSettings depth_cube_settings(ninebit::DepthCubeBits bits) {
  ninebit::RenderSettings settings = small_settings();
  settings.depth_cube.bits = bits;
  return settings;
}

}  // namespace shadow_test
