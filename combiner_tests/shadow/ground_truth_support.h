// Shared by the tests of ground truth.
#pragma once

#include <gtest/gtest.h>

#include <stdexcept>
#include <string>
#include <utility>

#include "combiner_tests/shadow/support.h"
#include "combiner_tests/support/index_room.h"
#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/ground_truth.h"
#include "src/frame/camera_frame.h"

namespace shadow_test {

inline ninebit::RenderSettings judged_settings(int width = 200, int height = 150) {
  ninebit::RenderSettings settings;
  settings.width = width;
  settings.height = height;
  settings.map_size = 256;
  settings.evidence = true;
  return settings;
}

// The scene without any shadow, for lights of any kind.
inline ninebit::Rendering all_lit(const ninebit::Scene& scene, const ninebit::RenderSettings& settings) {
  auto frame = ninebit::CameraFrame::make(scene, settings, {.point = true, .spot = true, .directional = true});
  if (!frame) throw std::runtime_error(frame.error().text());
  if (!frame->draw_depth() || !frame->draw_lit_and_shadow()) throw std::runtime_error("a pass was refused");
  frame->finish();
  return std::move(frame->rendering());
}

inline ninebit::GroundTruth judged(const ninebit::Scene& scene, const ninebit::RenderSettings& settings,
                                   const ninebit::Rendering& rendering) {
  const auto rays = ninebit::GroundTruthScene::make(scene);
  if (!rays) throw std::runtime_error(rays.error().text());
  auto truth = ninebit::measure(*rays, settings, rendering);
  if (!truth) throw std::runtime_error(truth.error().text());
  return std::move(*truth);
}

inline std::uint64_t count(const ninebit::GroundTruth& truth, ninebit::ErrorCause cause) {
  return truth.by_cause[static_cast<std::size_t>(cause)];
}

using ninebit::test::index_room;

}  // namespace shadow_test
