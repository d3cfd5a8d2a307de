// The technique of docs/tutorials/adding-a-technique.md, whose page quotes it.
#include <gtest/gtest.h>

#include <cstdint>
#include <utility>
#include <vector>

#include "combiner_tests/shadow/support.h"
#include "src/frame/camera_frame.h"
#include "src/frame/drawn_passes.h"

namespace ninebit {
namespace {

// Marks what lies below the light: draws these triangles once more, which writes 1 into the stencil buffer where they
// are seen.
Status mark_below_light(CameraFrame& frame) {
  const Scene& scene = frame.scene();
  std::vector<std::uint32_t> corners, numbers;
  for (std::uint32_t i = 0; i < scene.triangles.size(); ++i) {
    const glm::uvec3 t = scene.triangles[i];
    const float middle = (scene.positions[t.x].y + scene.positions[t.y].y + scene.positions[t.z].y) / 3.0F;
    if (middle >= frame.light().position.y) continue;
    corners.insert(corners.end(), {t.x, t.y, t.z});
    numbers.push_back(i);
  }
  if (numbers.empty()) return {};
  VertexArrays arrays;
  arrays.indices = corners;
  RenderTarget target = frame.capturing_target(0);
  return frame.draw("table", marking_pass(frame.settings()), arrays, {}, target, numbers);
}

// A lamp on a table without end: nothing below it is lit.
Result<Rendering> render_table(const Scene& scene, const RenderSettings& settings, const Progress& progress) {
  auto made = CameraFrame::make(scene, settings, {.point = true});
  if (!made) return made.error();
  CameraFrame& frame = *made;
  PassTimes& times = frame.rendering().times;
  PassTimer timer(progress);
  double color = 0.0;  // draw_lit_and_shadow takes the times of its passes itself
  Status status = timer.run("depth", 0.0, times.camera, [&] { return frame.draw_depth(); });
  if (status) status = timer.run("table", 0.3, times.compare, [&] { return mark_below_light(frame); });
  if (status) status = timer.run("colour", 0.6, color, [&] { return frame.draw_lit_and_shadow(); });
  if (!status) return status.error();
  frame.finish();
  return std::move(frame.rendering());
}

const Technique kTable{"table", "nothing below the light is lit", {.point = true}, &render_table};

TEST(TechniqueTutorial, NothingBelowTheLightIsLit) {
  Scene scene = shadow_test::square_over_floor();  // a floor at 0, a square at 1
  RenderSettings settings = shadow_test::small_settings();
  settings.layers = true;
  scene.lights[0].position.y = 0.5F;
  const auto between = kTable.render(scene, settings, {});
  ASSERT_TRUE(between.ok());
  EXPECT_GT(between->lit, 0U);
  EXPECT_GT(between->shadowed, 0U);
  const auto& polygon = shadow_test::samples_of<std::uint32_t>(between->layers, "polygon", "polygon");
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const bool floor = polygon[i] == 1 || polygon[i] == 2;
    ASSERT_EQ(between->frame.stencil()[i], floor ? 1 : 0) << "pixel " << i << " of polygon " << polygon[i];
  }

  scene.lights[0].position.y = 3.0F;
  EXPECT_EQ(kTable.render(scene, settings, {}).value().lit, 0U);
  scene.lights[0].position.y = -1.0F;
  EXPECT_EQ(kTable.render(scene, settings, {}).value().shadowed, 0U);
  EXPECT_FALSE(kTable.render(scene, settings, [](std::string_view, double) { return false; }).ok());
}

}  // namespace
}  // namespace ninebit
