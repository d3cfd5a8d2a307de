// The scene's triangles by texture and alpha test, and the pipeline states that draw them.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "ninebit/frame/settings.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/scene/scene.h"

namespace ninebit {

// Triangles that are drawn together.
struct SurfaceGroup {
  const Texture* texture = nullptr;           // nullptr: none
  Sampler sampler{};                          // of the texture
  std::optional<std::uint8_t> least_alpha{};  // of AlphaMode::mask: fragments with less alpha are not drawn
  std::uint8_t alpha = 255;                   // multiplies the texture's
  std::uint32_t triangles = 0;                // their number
  std::optional<Program> shaded{};            // primary × texture0; empty: fixed function
  std::optional<Program> masked{};            // primary, with the masking alpha; of groups with least_alpha
};

// A part of the scene's triangles for one draw.
struct TrianglePart {
  std::vector<glm::uvec3> triangles;   // numbered as in the scene (see part()), or only those of the part
  std::vector<std::uint32_t> numbers;  // of the scene's triangle for each of them
};

// Groups by texture, sampler and alpha test, in the order of their first triangle, but triangles without either come
// first. Overlapping fragments of equal depth are drawn in the order of the groups, then of the scene; without textures
// and masks there is one group, in the scene's order. A texture counts if it is loaded and complete, the scene has
// texture coordinates, and settings.cartoon is off; a mask counts if its material's texture is loaded or there is none.
class SurfaceGroups {
 public:
  // Reports programs that the profile refuses, and textures that are not 2D or not valid.
  [[nodiscard]] static Result<SurfaceGroups> make(const Scene& scene, const RenderSettings& settings);

  [[nodiscard]] bool textured() const { return textured_; }  // whether a group has a texture in colour passes
  [[nodiscard]] bool masked() const { return masked_; }      // whether a group has an alpha test
  [[nodiscard]] const std::vector<SurfaceGroup>& groups() const { return groups_; }

  // The triangles of one group. With `numbered`, the list has the scene's length and numbers, and the triangles of
  // other groups have no area, so that primitive numbers are the scene's.
  [[nodiscard]] TrianglePart part(const Scene& scene, std::size_t group, bool numbered) const;
  // Those of all groups without an alpha test.
  [[nodiscard]] TrianglePart opaque_part(const Scene& scene, bool numbered) const;

  // The state of a colour pass for a group, from the state for plain triangles.
  [[nodiscard]] static PipelineState shaded_state(const PipelineState& plain, const SurfaceGroup& group);
  // The state of a pass that draws depth, or the primary colour, for a masked group.
  [[nodiscard]] static PipelineState masked_state(const PipelineState& plain, const SurfaceGroup& group);

  // Texture coordinates per vertex for unit 0.
  [[nodiscard]] std::span<const glm::vec3> coordinates() const { return coordinates_; }

 private:
  template <class Take>
  [[nodiscard]] TrianglePart select(const Scene& scene, bool numbered, const Take& take) const;

  std::vector<SurfaceGroup> groups_;
  std::vector<std::uint32_t> group_of_;  // for each triangle; empty with one group
  std::vector<glm::vec3> coordinates_;
  std::shared_ptr<const Texture> white_;  // for masks without a texture
  bool textured_ = false, masked_ = false;
};

// Position, normal and colour of surfaces as attributes of vertices and as output planes.

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

// Vertices at the same position.

// For each vertex its place: places are numbered in the order in which the triangles first use them, and vertices whose
// positions have the same bits share one. `of_vertex` is kNoPlace for vertices that no triangle uses.
inline constexpr unsigned int kNoPlace = ~0U;
struct WeldedVertices {
  std::vector<unsigned int> of_vertex{};
  std::size_t places = 0;
};
[[nodiscard]] WeldedVertices weld_vertices(std::span<const glm::uvec3> triangles, std::span<const glm::vec3> positions);

}  // namespace ninebit
