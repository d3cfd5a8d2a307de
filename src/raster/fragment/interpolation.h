// Weights of a primitive's vertices at its fragments (OpenGL 1.3, 3.4.1 and 3.5.1), in floats and in a fixed
// order that does not depend on other fragments.
#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
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

// The texture coordinates of a unit at all vertices.
struct VertexCoordinates {
  std::span<const glm::vec3> at_vertex;
  std::array<bool, 2> cylinder{};  // whether s and t wrap around one (rule 53)

  // Those of the three vertices of a primitive.
  [[nodiscard]] std::array<glm::vec3, 3> of(const std::array<std::uint32_t, 3>& vertex) const {
    std::array<glm::vec3, 3> corner{at_vertex[vertex[0]], at_vertex[vertex[1]], at_vertex[vertex[2]]};
    for (int k = 0; k < 2; ++k) {
      if (!cylinder[static_cast<std::size_t>(k)]) continue;
      for (std::size_t n = 1; n < 3; ++n) corner[n][k] = around_cylinder(corner[0][k], corner[n][k]);
    }
    return corner;
  }

 private:
  // The coordinate b of a vertex beside a's: the nearest of b, b ± 1, …. A difference of exactly one half stays.
  static float around_cylinder(float a, float b) {
    const float turns = std::ceil(std::fabs(b - a) - 0.5F);
    return turns > 0.0F ? b - std::copysign(turns, b - a) : b;
  }
};

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
