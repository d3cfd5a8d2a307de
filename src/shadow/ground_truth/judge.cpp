#include "src/shadow/ground_truth/judge.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src/frame/views.h"
#include "src/shadow/ground_truth/ground_truth_causes.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

Status check_rendering(const RenderSettings& settings, const Rendering& rendering) {
  const Surface& frame = rendering.frame;
  if (!rendering.evidence || frame.primitive().empty()) {
    return Diagnostic{.message = "the rendering has no evidence to judge it by"};
  }
  if (frame.width() != settings.width || frame.height() != settings.height) {
    return Diagnostic{.message = fmt::format("the rendering has {} x {} pixels, its settings {} x {}", frame.width(),
                                             frame.height(), settings.width, settings.height)};
  }
  return {};
}

Judge::Judge(const GroundTruthScene::Rays& rays, const RenderSettings& settings, const Rendering& rendering)
    : rays_(rays),
      scene_(*rays.scene),
      light_(scene_.lights[0]),
      settings_(settings),
      rendering_(rendering),
      pixel_rays_(scene_.cameras[0], settings.width, settings.height) {
  if (light_.kind == LightKind::spot) spot_ = glm::dmat4(light_projection(scene_, light_));
  truth_.truth.resize(rendering.frame.stencil().size(), PixelTruth::background);
  truth_.cause.resize(rendering.frame.stencil().size(), ErrorCause::none);
}

void Judge::judge_rows(int first, int last) {
  parallel_ranges(static_cast<std::size_t>(last - first), 1, [&](std::size_t begin, std::size_t end) {
    std::vector<RayCrossing> between;
    for (std::size_t row = begin; row < end; ++row) {
      for (int x = 0; x < settings_.width; ++x) judge_pixel(x, first + static_cast<int>(row), between);
    }
  });
}

GroundTruth Judge::finish() {
  for (std::size_t i = 0; i < truth_.cause.size(); ++i) {
    if (truth_.cause[i] == ErrorCause::none) continue;
    ++truth_.by_cause[static_cast<std::size_t>(truth_.cause[i])];
    ++(truth_.truth[i] == PixelTruth::shadowed ? truth_.false_lit : truth_.false_shadowed);
  }
  return std::move(truth_);
}

void Judge::judge_pixel(int x, int y, std::vector<RayCrossing>& between) {
  const std::size_t i =
      static_cast<std::size_t>(y) * static_cast<std::size_t>(settings_.width) + static_cast<std::size_t>(x);
  const std::uint32_t own = rendering_.frame.primitive()[i];
  if (own >= scene_.triangles.size()) return;
  const Corners corners = corners_of(scene_, own);
  const LightRay ray = light_ray(light_, pixel_rays_.point_on(corners, x, y));
  const bool shadowed = turns_away(corners) || outside_spot(ray.from) || rays_.blocked(ray, own);
  truth_.truth[i] = shadowed ? PixelTruth::shadowed : PixelTruth::lit;
  const bool drawn_lit = rendering_.frame.stencil()[i] == 0;
  if (drawn_lit != shadowed) return;
  rays_.find_all(ray, own, between);
  const ShadowEvidence& evidence = *rendering_.evidence;
  const std::uint32_t fetched = evidence.fetched.empty() ? 0 : evidence.fetched[i];
  truth_.cause[i] = cause_of(scene_, evidence, {.lit = drawn_lit, .own = own, .fetched = fetched, .between = between});
}

bool Judge::turns_away(const Corners& t) const {
  return settings_.light_facing && glm::dot(glm::cross(t.b - t.a, t.c - t.a), light_ray(light_, t.a).way) <= 0.0;
}

bool Judge::outside_spot(const glm::dvec3& point) const {
  return light_.kind == LightKind::spot && !in_spot(spot_, point);
}

}  // namespace ninebit
