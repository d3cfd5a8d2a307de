// Weights of a primitive's vertices at its fragments (OpenGL 1.3, 3.4.1 and 3.5.1), in floats and in a fixed
// order that does not depend on other fragments.
#pragma once

#include <array>
#include <cstddef>
#include <glm/glm.hpp>
#include <span>

#include "ninebit/combiner/evaluate.h"
#include "src/raster/setup/window_primitives.h"

namespace ninebit {

// Where a fragment lies in its primitive.
struct FragmentPlace {
  const SetupPrimitive* primitive = nullptr;
  const SetupCorners* corners = nullptr;
  const glm::mat3* weights = nullptr;  // see SetupBlock::weights_of
  // Barycentric coordinates up to a factor: a triangle's edge functions, each twice the area opposite its corner; of a
  // line's ends the distances along it; of a point 1, 0, 0.
  std::array<float, 3> edge{};
};

// One float a fragment for each of the three vertices.
using WeightPlanes = std::array<std::array<float, kBatchSize>, 3>;

// A value at fragment i from those at the vertices.
[[nodiscard]] inline float interpolate(const WeightPlanes& weight, std::size_t i, float a, float b, float c) {
  return (weight[0][i] * a + weight[1][i] * b) + weight[2][i] * c;
}

// The change of FragmentPlace::edge from pixel to pixel, in x and in y.
struct EdgeSteps {
  std::array<float, 3> x{}, y{};
};
[[nodiscard]] EdgeSteps edge_steps(const SetupPrimitive& primitive);

class Interpolation {
 public:
  // At most kBatchSize places. `affine` and `changes` select the optional results.
  void compute(std::span<const FragmentPlace> places, bool affine, bool changes);

  [[nodiscard]] const WeightPlanes& perspective() const { return perspective_; }
  // Linear in the window.
  [[nodiscard]] const WeightPlanes& affine() const { return affine_; }
  // The change of the perspective weights from pixel to pixel in x and y: derivatives at the fragment, exact except for
  // rounding. For a line, dx is the change along it and dy is 0, as OpenGL 1.3, 3.8.8 computes its level of detail; for
  // a point both are 0.
  [[nodiscard]] const WeightPlanes& dx() const { return dx_; }
  [[nodiscard]] const WeightPlanes& dy() const { return dy_; }

 private:
  void compute_changes(std::span<const FragmentPlace> places);

  WeightPlanes perspective_, affine_, dx_, dy_;
  std::array<float, kBatchSize> sum_;  // of the perspective weights before they were divided by it
};

}  // namespace ninebit
