#include "ninebit/shadow/ground_truth.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src/shadow/frame/views.h"
#include "src/shadow/ground_truth/ground_truth_causes.h"
#include "src/shadow/ground_truth/ground_truth_geometry.h"
#include "src/shadow/ground_truth/ground_truth_rays.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

constexpr int kBandRows = 64;  // rows between two calls of the progress function

// Judges one rendering.
class Judge {
 public:
  Judge(const GroundTruthScene::Rays& rays, const RenderSettings& settings, const Rendering& rendering)
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

  void judge_rows(int first, int last) {
    parallel_ranges(static_cast<std::size_t>(last - first), 1, [&](std::size_t begin, std::size_t end) {
      std::vector<Crossed> between;
      for (std::size_t row = begin; row < end; ++row) {
        for (int x = 0; x < settings_.width; ++x) judge_pixel(x, first + static_cast<int>(row), between);
      }
    });
  }

  GroundTruth finish() {
    for (std::size_t i = 0; i < truth_.cause.size(); ++i) {
      if (truth_.cause[i] == ErrorCause::none) continue;
      ++truth_.by_cause[static_cast<std::size_t>(truth_.cause[i])];
      ++(truth_.truth[i] == PixelTruth::shadowed ? truth_.false_lit : truth_.false_shadowed);
    }
    return std::move(truth_);
  }

 private:
  void judge_pixel(int x, int y, std::vector<Crossed>& between) {
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
    truth_.cause[i] =
        cause_of(scene_, evidence, {.lit = drawn_lit, .own = own, .fetched = fetched, .between = between});
  }

  [[nodiscard]] bool turns_away(const Corners& t) const {
    return settings_.light_facing && glm::dot(glm::cross(t.b - t.a, t.c - t.a), light_ray(light_, t.a).way) <= 0.0;
  }
  [[nodiscard]] bool outside_spot(const glm::dvec3& point) const {
    return light_.kind == LightKind::spot && !in_spot(spot_, point);
  }

  const GroundTruthScene::Rays& rays_;
  const Scene& scene_;
  const Light& light_;
  const RenderSettings& settings_;
  const Rendering& rendering_;
  PixelRays pixel_rays_;
  glm::dmat4 spot_{1.0};
  GroundTruth truth_;
};

}  // namespace

GroundTruthScene::GroundTruthScene(std::unique_ptr<Rays> rays) : rays_(std::move(rays)) {}
GroundTruthScene::~GroundTruthScene() = default;
GroundTruthScene::GroundTruthScene(GroundTruthScene&& other) noexcept = default;
GroundTruthScene& GroundTruthScene::operator=(GroundTruthScene&& other) noexcept = default;

Result<GroundTruthScene> GroundTruthScene::make(const Scene& scene) {
  if (Status valid = validate(scene); !valid) return valid.error();
  if (scene.cameras.size() != 1 || scene.lights.size() != 1) {
    return Diagnostic{.message = fmt::format("the scene has {} cameras and {} lights; expected one of each",
                                             scene.cameras.size(), scene.lights.size())};
  }
  auto rays = Rays::make(scene);
  if (!rays) return rays.error();
  return GroundTruthScene(std::move(*rays));
}

Result<GroundTruth> measure(const GroundTruthScene& scene, const RenderSettings& settings, const Rendering& rendering,
                            const Progress& progress) {
  const Surface& frame = rendering.frame;
  if (!rendering.evidence || frame.primitive().empty()) {
    return Diagnostic{.message = "the rendering has no evidence to judge it by"};
  }
  if (frame.width() != settings.width || frame.height() != settings.height) {
    return Diagnostic{.message = fmt::format("the rendering has {} x {} pixels, its settings {} x {}", frame.width(),
                                             frame.height(), settings.width, settings.height)};
  }
  Judge judge(scene.rays(), settings, rendering);
  for (int y = 0; y < settings.height; y += kBandRows) {
    if (progress && !progress("ground truth", static_cast<double>(y) / settings.height)) {
      return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    }
    judge.judge_rows(y, std::min(y + kBandRows, settings.height));
  }
  return judge.finish();
}

}  // namespace ninebit
