// The triangles between a point and the light. Embree finds the triangles whose boxes a ray hits; whether the ray
// passes through a triangle is decided in doubles.
#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "src/shadow/ground_truth/ground_truth_geometry.h"

struct RTCDeviceTy;
struct RTCSceneTy;

namespace ninebit {

struct Crossed {
  std::uint32_t triangle;
  double at;  // along the ray, as crossing() returns it
};

struct GroundTruthScene::Rays {
  static Result<std::unique_ptr<Rays>> make(const Scene& scene);

  // Whether any triangle but `own` lies on the way to the light.
  [[nodiscard]] bool blocked(const LightRay& ray, std::uint32_t own) const;
  // All of them, by number.
  void find_all(const LightRay& ray, std::uint32_t own, std::vector<Crossed>& crossed) const;

  const Scene* scene;
  double touching;  // touching_distance
  double margin;    // by which boxes are larger than their triangles
  struct Releaser {
    void operator()(RTCDeviceTy* released) const;
    void operator()(RTCSceneTy* released) const;
  };
  // Declared before `boxes`, so it is released after the scene: if the scene has the last reference to its device,
  // Embree 3.13 frees the device and then reads it.
  std::unique_ptr<RTCDeviceTy, Releaser> device;
  std::unique_ptr<RTCSceneTy, Releaser> boxes;
};

}  // namespace ninebit
