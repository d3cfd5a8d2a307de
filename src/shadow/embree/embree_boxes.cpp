// Candidates by Embree: each triangle is a box of its own geometry.
#include <embree3/rtcore.h>

#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <new>
#include <string>
#include <string_view>
#include <utility>

#include "src/shadow/ground_truth/ground_truth_rays.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

class EmbreeBoxes final : public BoxSearch {
 public:
  static Result<std::unique_ptr<EmbreeBoxes>> make(const Scene& scene);
  [[nodiscard]] bool search(const LightRay& ray, CandidateTest& test) const override;

 private:
  explicit EmbreeBoxes(double margin) : margin_(margin) {}

  struct Releaser {
    void operator()(RTCDevice released) const { rtcReleaseDevice(released); }
    void operator()(RTCScene released) const { rtcReleaseScene(released); }
  };
  double margin_;
  // Declared before `boxes_`, so it is released after the scene: if the scene has the last reference to its device,
  // Embree 3.13 frees the device and then reads it.
  std::unique_ptr<RTCDeviceTy, Releaser> device_{};
  std::unique_ptr<RTCSceneTy, Releaser> boxes_{};
};

// Passed to the callback that computes boxes.
struct BoxSource {
  const Scene& scene;
  double margin;
};

void bounds_of_triangle(const RTCBoundsFunctionArguments* arguments) {
  const auto& source = *static_cast<const BoxSource*>(arguments->geometryUserPtr);
  const TriangleBox box = box_of(source.scene, arguments->primID, source.margin);
  RTCBounds& bounds = *arguments->bounds_o;
  bounds.lower_x = box.low.x;
  bounds.lower_y = box.low.y;
  bounds.lower_z = box.low.z;
  bounds.upper_x = box.high.x;
  bounds.upper_y = box.high.y;
  bounds.upper_z = box.high.z;
}

// Passed with a ray to the callback.
struct Query {
  RTCIntersectContext context;  // must be first: Embree passes its address on
  CandidateTest* test;
};

void test_triangle(const RTCOccludedFunctionNArguments* arguments) {
  if (arguments->valid[0] == 0) return;
  const auto* query = reinterpret_cast<const Query*>(arguments->context);
  if (!query->test->take(arguments->primID)) return;
  RTCRayN_tfar(arguments->ray, arguments->N, 0) = -std::numeric_limits<float>::infinity();
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

Result<std::unique_ptr<EmbreeBoxes>> EmbreeBoxes::make(const Scene& scene) {
  const double margin = box_margin(scene);
  std::unique_ptr<EmbreeBoxes> made(new EmbreeBoxes(margin));
  // oneTBB keeps the floating-point settings of a thread's first parallel work for all later work. If that were
  // Embree's, which flushes denormals, all later work would flush them.
  parallel_for(2, [](std::size_t) {});
  made->device_.reset(rtcNewDevice(nullptr));
  const RTCDevice device = made->device_.get();
  Complaint complaint;
  if (device == nullptr) {
    complaint.code = rtcGetDeviceError(nullptr);
    return refused(complaint);
  }
  rtcSetDeviceErrorFunction(device, keep_first, &complaint);
  made->boxes_.reset(rtcNewScene(device));
  const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_USER);
  rtcSetGeometryUserPrimitiveCount(geometry, static_cast<unsigned>(scene.triangles.size()));
  BoxSource source{scene, margin};  // read until the scene is committed
  rtcSetGeometryUserData(geometry, &source);
  const auto bounds = [](const RTCBoundsFunctionArguments* arguments) { bounds_of_triangle(arguments); };
  rtcSetGeometryBoundsFunction(geometry, bounds, nullptr);
  rtcSetGeometryOccludedFunction(geometry, &test_triangle);
  rtcCommitGeometry(geometry);
  rtcAttachGeometry(made->boxes_.get(), geometry);
  rtcReleaseGeometry(geometry);
  rtcSetSceneFlags(made->boxes_.get(), RTC_SCENE_FLAG_ROBUST);
  rtcCommitScene(made->boxes_.get());
  rtcSetDeviceErrorFunction(device, nullptr, nullptr);
  if (complaint.code != RTC_ERROR_NONE) {
    // Leaked on purpose: releasing a scene whose preparation ran out of memory ends the program.
    static_cast<void>(made->boxes_.release());
    return refused(complaint);
  }
  return made;
}

bool EmbreeBoxes::search(const LightRay& ray, CandidateTest& test) const {
  Query query{{}, &test};
  rtcInitIntersectContext(&query.context);
  const double length = std::sqrt(glm::dot(ray.way, ray.way));
  const glm::vec3 from(ray.from), way(ray.way / length);
  RTCRay boxed{};
  boxed.org_x = from.x;
  boxed.org_y = from.y;
  boxed.org_z = from.z;
  boxed.dir_x = way.x;
  boxed.dir_y = way.y;
  boxed.dir_z = way.z;
  boxed.tfar = ray.endless ? std::numeric_limits<float>::infinity() : static_cast<float>(length + margin_);
  boxed.mask = 0xFFFFFFFFU;
  rtcOccluded1(boxes_.get(), &query.context, &boxed);
  return boxed.tfar < 0.0F;
}

}  // namespace

Result<GroundTruthScene> GroundTruthScene::make(const Scene& scene) {
  if (Status good = check_judged(scene); !good) return good.error();
  auto boxes = EmbreeBoxes::make(scene);
  if (!boxes) return boxes.error();
  return GroundTruthScene(std::make_unique<Rays>(scene, std::move(*boxes)));
}

}  // namespace ninebit
