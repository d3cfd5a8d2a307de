// Position, normal and colour of surfaces as attributes of vertices and as output planes.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <vector>

#include "ninebit/raster/rasterizer.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

struct SurfaceAttributes {
  static constexpr int kPosition = 0, kNormal = 1, kColor = 2;
  std::array<std::vector<glm::vec4>, 3> values{};

  // Arrays that hold only these attributes, which must outlive them.
  [[nodiscard]] VertexArrays arrays() const;
};

// The world position, the normal, and base colour × `color` of every vertex.
[[nodiscard]] SurfaceAttributes surface_attributes(const Scene& scene, const glm::vec3& color);

// Adds an output plane for the first three components of an attribute.
template <class Sample>
void capture_surface(std::array<std::vector<Sample>, 3>& planes, int attribute, int width, RenderTarget& target) {
  for (int c = 0; c < 3; ++c) {
    target.outputs.push_back({.source = OutputSource::attribute,
                              .attribute = attribute,
                              .component = c,
                              .plane = Plane<Sample>{planes[static_cast<std::size_t>(c)].data(), width}});
  }
}

// The vector at unit length; zero stays zero.
[[nodiscard]] glm::vec3 unit_or_zero(const glm::vec3& v);

}  // namespace ninebit
