#include "src/shadow/ground_truth/ground_truth_rays.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "src/shadow/ground_truth/box_tree.h"

namespace ninebit {

bool CandidateTest::take(std::uint32_t triangle) {
  if (triangle == own_) return false;
  const auto at = crossing(ray_, corners_of(*rays_.scene, triangle), rays_.touching);
  if (!at) return false;
  if (all_ == nullptr) return true;
  all_->push_back({triangle, *at});
  return false;
}

GroundTruthScene::Rays::Rays(const Scene& judged, std::unique_ptr<BoxSearch> search)
    : scene(&judged), touching(touching_distance(judged)), boxes(std::move(search)) {}

bool GroundTruthScene::Rays::blocked(const LightRay& ray, std::uint32_t own) const {
  if (glm::dot(ray.way, ray.way) == 0.0) return false;  // at the light
  CandidateTest test(*this, ray, own, nullptr);
  return boxes->search(ray, test);
}

void GroundTruthScene::Rays::find_all(const LightRay& ray, std::uint32_t own, std::vector<RayCrossing>& crossed) const {
  crossed.clear();
  if (glm::dot(ray.way, ray.way) == 0.0) return;
  CandidateTest test(*this, ray, own, &crossed);
  static_cast<void>(boxes->search(ray, test));
  const auto by_number = [](const RayCrossing& l, const RayCrossing& r) { return l.triangle < r.triangle; };
  std::sort(crossed.begin(), crossed.end(), by_number);
}

TriangleBox box_of(const Scene& scene, std::uint32_t triangle, double margin) {
  const glm::uvec3& t = scene.triangles[triangle];
  const auto& p = scene.positions;
  const glm::vec3 wider(static_cast<float>(margin));
  return {glm::min(glm::min(p[t.x], p[t.y]), p[t.z]) - wider, glm::max(glm::max(p[t.x], p[t.y]), p[t.z]) + wider};
}

Status check_judged(const Scene& scene) {
  if (Status valid = validate(scene); !valid) return valid;
  if (scene.cameras.size() == 1 && scene.lights.size() == 1) return {};
  return Diagnostic{.message = fmt::format("the scene has {} cameras and {} lights; expected one of each",
                                           scene.cameras.size(), scene.lights.size())};
}

GroundTruthScene::GroundTruthScene(std::unique_ptr<Rays> rays) : rays_(std::move(rays)) {}
GroundTruthScene::~GroundTruthScene() = default;
GroundTruthScene::GroundTruthScene(GroundTruthScene&& other) noexcept = default;
GroundTruthScene& GroundTruthScene::operator=(GroundTruthScene&& other) noexcept = default;

Result<GroundTruthScene> GroundTruthScene::make_portable(const Scene& scene) {
  if (Status good = check_judged(scene); !good) return good.error();
  return GroundTruthScene(std::make_unique<Rays>(scene, std::make_unique<BoxTree>(scene)));
}

}  // namespace ninebit
