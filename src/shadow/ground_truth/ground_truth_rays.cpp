#include "src/shadow/ground_truth/ground_truth_rays.h"

#include <embree3/rtcore.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

using Rays = GroundTruthScene::Rays;

// Passed with a ray to the callback.
struct Query {
  RTCIntersectContext context;  // must be first: Embree passes its address on
  const Rays* rays;
  const LightRay* ray;
  std::uint32_t own;
  std::vector<Crossed>* all;  // nullptr: the first hit ends the ray
};

void bounds_of_triangle(const RTCBoundsFunctionArguments* arguments) {
  const Rays& rays = *static_cast<const Rays*>(arguments->geometryUserPtr);
  const glm::uvec3& t = rays.scene->triangles[arguments->primID];
  const auto& p = rays.scene->positions;
  const glm::vec3 margin(static_cast<float>(rays.margin));
  const glm::vec3 low = glm::min(glm::min(p[t.x], p[t.y]), p[t.z]) - margin;
  const glm::vec3 high = glm::max(glm::max(p[t.x], p[t.y]), p[t.z]) + margin;
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = low.x;
  bounds.lower_y = low.y;
  bounds.lower_z = low.z;
  bounds.upper_x = high.x;
  bounds.upper_y = high.y;
  bounds.upper_z = high.z;
}

void test_triangle(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto* query = reinterpret_cast<const Query*>(arguments->context);
  const std::uint32_t triangle = arguments->primID;
  if (triangle == query->own) return;
  const Rays& rays = *query->rays;
  const auto at = crossing(*query->ray, corners_of(*rays.scene, triangle), rays.touching);
  if (!at) return;
  if (query->all != nullptr) {
    query->all->push_back({triangle, *at});
  } else {
    RTCRayN_tfar(arguments->ray, arguments->N, 0) = -std::numeric_limits<float>::infinity();
  }
}

// Calls the callback for the triangles whose boxes the ray hits. Returns whether it ended the ray.
bool trace(const Rays& rays, const LightRay& ray, std::uint32_t own, std::vector<Crossed>* all) {
  Query query{{}, &rays, &ray, own, all};
  rtcInitIntersectContext(&query.context);
  const double length = std::sqrt(glm::dot(ray.way, ray.way));
  if (length == 0.0) return false;  // at the light
  const glm::vec3 from(ray.from), way(ray.way / length);
  RTCRay boxed{};
  boxed.org_x = from.x;
  boxed.org_y = from.y;
  boxed.org_z = from.z;
  boxed.dir_x = way.x;
  boxed.dir_y = way.y;
  boxed.dir_z = way.z;
  boxed.tfar = ray.endless ? std::numeric_limits<float>::infinity() : static_cast<float>(length + rays.margin);
  boxed.mask = 0xFFFFFFFFU;
  rtcOccluded1(rays.boxes.get(), &query.context, &boxed);
  return boxed.tfar < 0.0F;
}

// The first error that Embree reports.
struct Complaint {
  RTCError code = RTC_ERROR_NONE;
  std::array<char, 200> text{};
};

void keep_first(void* complaint, RTCError code, const char* text) noexcept {
  auto& first = *static_cast<Complaint*>(complaint);
  if (first.code != RTC_ERROR_NONE) return;
  first.code = code;
  if (text != nullptr) std::strncpy(first.text.data(), text, first.text.size() - 1);
}

// Throws std::bad_alloc if Embree ran out of memory or could not start its threads.
Diagnostic refused(const Complaint& complaint) {
  const std::string_view text = complaint.text.data();
  if (complaint.code == RTC_ERROR_OUT_OF_MEMORY || text.find("bad_alloc") != std::string_view::npos ||
      text.find("pthread_create has failed") != std::string_view::npos) {
    throw std::bad_alloc();
  }
  return Diagnostic{.message = "Embree cannot prepare the scene for rays: error " + std::to_string(complaint.code) +
                               ", " + std::string(text)};
}

}  // namespace

void Rays::Releaser::operator()(RTCDeviceTy* released) const {
  rtcReleaseDevice(released);
}

void Rays::Releaser::operator()(RTCSceneTy* released) const {
  rtcReleaseScene(released);
}

Result<std::unique_ptr<Rays>> Rays::make(const Scene& scene) {
  auto rays = std::make_unique<Rays>();
  rays->scene = &scene;
  rays->touching = touching_distance(scene);
  // Origin and direction of a ray become floats, each rounded by half a unit in the last place; across the scene the
  // direction moves it by as much again.
  rays->margin = 8.0 * rays->touching;
  // oneTBB keeps the floating-point settings of a thread's first parallel work for all later work. If that were
  // Embree's, which flushes denormals, all later work would flush them.
  parallel_for(2, [](std::size_t) {});
  rays->device.reset(rtcNewDevice(nullptr));
  const RTCDevice device = rays->device.get();
  Complaint complaint;
  if (device == nullptr) {
    complaint.code = rtcGetDeviceError(nullptr);
    return refused(complaint);
  }
  rtcSetDeviceErrorFunction(device, keep_first, &complaint);
  rays->boxes.reset(rtcNewScene(device));
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.triangles.size()));
  rtcSetGeometryUserData(geometry, rays.get());
  const auto bounds = [](const RTCBoundsFunctionArguments* arguments) { bounds_of_triangle(arguments); };
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, &test_triangle);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(rays->boxes.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(rays->boxes.get(), RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(rays->boxes.get());
  rtcSetDeviceErrorFunction(device, nullptr, nullptr);
  if (complaint.code != RTC_ERROR_NONE) {
    // Leaked on purpose: releasing a scene whose preparation ran out of memory ends the program.
    static_cast<void>(rays->boxes.release());
    return refused(complaint);
  }
  return rays;
}

bool Rays::blocked(const LightRay& ray, std::uint32_t own) const {
  return trace(*this, ray, own, nullptr);
}

void Rays::find_all(const LightRay& ray, std::uint32_t own, std::vector<Crossed>& crossed) const {
  crossed.clear();
  trace(*this, ray, own, &crossed);
  const auto by_number = [](const Crossed& l, const Crossed& r) { return l.triangle < r.triangle; };
  std::sort(crossed.begin(), crossed.end(), by_number);
}

}  // namespace ninebit
