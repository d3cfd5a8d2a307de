// A scene for the shadow techniques: triangles in world space, each with its object and material; cameras; lights.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/texture.h"

namespace NINEBIT_PUBLIC ninebit {

// glTF's alpha modes. `blend` is drawn as `opaque`.
enum class AlphaMode : std::uint8_t { opaque, mask, blend };

// A picture that materials name. read_scene opens no picture: the caller reads the pictures that it wants to be drawn
// with read_texture (image/texture_io.h) and stores them in `texture`. One without `texture` is not drawn.
struct SceneTexture {
  std::string name;                          // as the scene's file names it, or "images[2]"; for messages
  std::filesystem::path file{};              // empty: `bytes` holds the picture
  std::string bytes{};                       // an embedded PNG or JPEG file
  std::string fault{};                       // why the picture may not be read; empty: it may
  std::shared_ptr<const Texture> texture{};  // a complete 2D texture, its first row at t = 0; may be empty
};

// A surface's appearance: a colour, multiplied by a texture and by the colours of the vertices.
struct Material {
  std::string name;                             // the file's; may be empty
  glm::vec3 base_color{0.8F};                   // linear factor as the file gives it, each channel in [0, 1]
  std::optional<std::uint32_t> base_texture{};  // an index into Scene::textures
  Sampler sampler{};                            // how the texture is read
  AlphaMode alpha_mode = AlphaMode::opaque;     // whether alpha has an effect
  float alpha = 1.0F;                           // multiplies the texture's alpha; in [0, 1]
  float alpha_cutoff = 0.5F;                    // AlphaMode::mask: fragments with less alpha are not drawn
};

// A mesh instance: one node of the file with all its triangles, whatever their materials.
struct SceneObject {
  std::string name;                  // the file's; may be empty
  std::uint32_t first_triangle = 0;  // index into Scene::triangles
  std::uint32_t triangle_count = 0;  // consecutive triangles
};

// KHR_lights_punctual's kinds.
enum class LightKind : std::uint8_t { point, spot, directional };

// A light without extent.
struct Light {
  std::string name;                        // the file's; may be empty
  glm::vec3 position{0.0F};                // world space; for a directional light any point
  glm::vec3 color{1.0F};                   // relative, each channel in [0, 1]; the file's intensity is dropped
  LightKind kind = LightKind::point;       // selects which of the following members are used
  glm::vec3 direction{0.0F, -1.0F, 0.0F};  // in which a spot or directional light shines; unit length
  float spot_degrees = 90.0F;              // the whole opening angle of a spot light, in (0, 180)
};

// A perspective view of the scene.
struct Camera {
  glm::vec3 position{0.0F, 0.0F, 1.0F};  // world space
  glm::vec3 look_at{0.0F};               // any point on the view axis, different from position
  glm::vec3 up{0.0F, 1.0F, 0.0F};        // not parallel to the view axis
  float vertical_fov_degrees = 50.0F;    // in (0, 180)
};

// A box with its sides along the axes, in world space.
struct Bounds {
  glm::vec3 low{0.0F};                                                      // smallest coordinates
  glm::vec3 high{0.0F};                                                     // largest coordinates
  [[nodiscard]] glm::vec3 center() const { return (low + high) * 0.5F; }    // halfway between both
  [[nodiscard]] float diagonal() const { return glm::length(high - low); }  // the distance between both
};

// The axis of a file's coordinates that points up.
enum class UpAxis : std::uint8_t { y, z };

// Vertices are shared by index. Every triangle index is < positions.size(); normals has the size of positions, and so
// have texture_coordinates, tangents, colors, secondary_colors and fog_factors unless they are empty; the triangles of
// one object are consecutive, and the objects cover all triangles in order.
struct Scene {
  std::string name;                              // the file's name, for reports
  std::vector<glm::vec3> positions;              // world space, finite
  std::vector<glm::vec3> normals;                // unit length (zero if the file's geometry gives none)
  std::vector<glm::vec2> texture_coordinates{};  // s and t, (0, 0) at a picture's top left; empty: the file has none
  // Along growing s, unit length, and in w 1, or -1 if the bitangent is -cross(normal, tangent); zero where the file
  // has none. The bitangent is along falling t. Empty: the file has no tangents.
  std::vector<glm::vec4> tangents{};
  std::vector<glm::vec4> colors{};               // red, green, blue, alpha in [0, 1]; empty: the file has none
  std::vector<glm::vec4> secondary_colors{};     // likewise
  std::vector<float> fog_factors{};              // in [0, 1], 1 is no fog; empty: the file has none
  std::vector<glm::uvec3> triangles;             // counter-clockwise seen from the front
  std::vector<std::uint32_t> triangle_object;    // for each triangle, an index into objects
  std::vector<std::uint32_t> triangle_material;  // for each triangle, an index into materials
  std::vector<SceneObject> objects;              // in the order of their triangles
  std::vector<Material> materials;               // at least one if there are triangles
  std::vector<SceneTexture> textures{};          // that materials name
  std::vector<Light> lights;                     // from the file, in its order; may be empty
  std::vector<Camera> cameras;                   // from the file, in its order; may be empty
  UpAxis up = UpAxis::y;                         // of the file, as read; the scene's is y
  std::vector<std::string> notes;                // what the file refers to and the reader left out; one line each
};

// The smallest axis-parallel box around all positions that a triangle uses; zero for a scene without triangles.
[[nodiscard]] Bounds bounds_of(const Scene& scene);

// The shortest distance from a point to any triangle of the scene, in world units; infinity without triangles.
[[nodiscard]] float distance_to_nearest_triangle(const Scene& scene, const glm::vec3& point);

// The same, for the triangles of one object.
[[nodiscard]] float distance_to_nearest_triangle(const Scene& scene, const SceneObject& object, const glm::vec3& point);

// How many times the triangles of a valid scene's object wind around a point: the sum of their signed solid angles over
// 4 pi (the generalized winding number). 1 inside a closed mesh that faces outward, 0 outside of it, -1 inside a room
// that faces inward, 1/2 on a face; in between for an open mesh. A triangle adds 0 if it is degenerate or the point
// lies in its plane.
[[nodiscard]] double winding_number(const Scene& scene, const SceneObject& object, const glm::vec3& point);

// Checks that a scene meets the requirements of Scene, as every function of the library expects: at least one triangle;
// sizes that agree; vertex, object and material indices in range; objects that cover all triangles in order; finite
// positions, normals, base colours, alphas, cameras and lights; materials with existing textures; cameras with a
// direction of view, an up vector that is not parallel to it, and a field of view between 0 and 180 degrees. Reports
// the first fault. A scene needs neither cameras nor lights to be valid.
[[nodiscard]] Status validate(const Scene& scene);

}  // namespace ninebit
