#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <system_error>

#include "ninebit/scene/scene_io.h"
#include "src/scene/assimp_import.h"
#include "src/scene/fault_of.h"
#include "src/scene/file_check.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

Result<std::string> read_file(const std::filesystem::path& file) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found)
    return fault_of("cannot be opened: there is no such file");
  if (status.type() == std::filesystem::file_type::directory) return fault_of("is a folder, not a scene file");
  if (status.type() == std::filesystem::file_type::none)
    return fault_of(fmt::format("cannot be opened: {}", error.message()));
  if (status.type() != std::filesystem::file_type::regular) return fault_of("is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) return fault_of(fmt::format("cannot be opened: {}", error.message()));
  if (size == 0) return fault_of("is empty");
  if (size > kMostSceneBytes) return fault_of(fmt::format("has {} bytes; at most {} are read", size, kMostSceneBytes));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return fault_of("cannot be opened for reading");
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size)) return fault_of("could not be read to its end");
  return content;
}

std::string lower_extension(const std::filesystem::path& file) {
  std::string extension = file.extension().string();
  for (char& c : extension) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return extension;
}

Result<FileFacts> check_content(std::string_view content, const std::filesystem::path& file,
                                const std::string& extension) {
  if (extension == ".obj") return check_obj(content);
  if (extension == ".off") return check_off(content);
  if (extension == ".ply") return check_ply(content);
  if (extension == ".3ds") return check_3ds(content);
  return check_gltf(content, file, extension == ".glb");
}

glm::vec3 moved(const glm::dmat4& by, const glm::vec3& point) {
  return glm::vec3(glm::dvec3(by * glm::dvec4(glm::dvec3(point), 1.0)));
}

// A point on the view axis beside the scene's middle: where a viewer of this file would say that the camera looks. What
// lies behind the camera gives no such point; then any distance serves.
void move_look_at(Camera& camera, const Bounds& bounds) {
  const glm::dvec3 position(camera.position);
  const glm::dvec3 ahead = glm::normalize(glm::dvec3(camera.look_at) - position);
  const double diagonal = static_cast<double>(bounds.diagonal());
  double distance = glm::dot(glm::dvec3(bounds.center()) - position, ahead);
  if (distance < 1e-3 * diagonal) distance = diagonal > 0.0 ? diagonal : 1.0;
  const glm::vec3 on_axis(position + ahead * distance);
  if (is_finite(on_axis)) camera.look_at = on_axis;
}

std::optional<Diagnostic> add_viewpoints(const FileFacts& facts, const glm::dmat4& root, Scene& scene) {
  const glm::dmat4 place = facts.in_root_space ? root : glm::dmat4(1.0);
  const Bounds bounds = bounds_of(scene);
  for (Camera camera : facts.cameras) {
    camera.position = moved(place, camera.position);
    camera.look_at = moved(place, camera.look_at);
    camera.up = glm::vec3(glm::dmat3(place) * glm::dvec3(camera.up));
    if (!is_finite(camera.position) || !is_finite(camera.look_at) || !is_finite(camera.up))
      return fault_of("a camera's place is not finite");
    if (camera.look_at == camera.position) return fault_of("a camera looks in no direction");
    if (!facts.in_root_space) move_look_at(camera, bounds);
    scene.cameras.push_back(camera);
  }
  for (Light light : facts.lights) {
    light.position = moved(place, light.position);
    if (!is_finite(light.position)) return fault_of("a light's position is not finite");
    if (light.kind != LightKind::point) {
      const glm::dvec3 direction = glm::dmat3(place) * glm::dvec3(light.direction);
      const double length = glm::length(direction);
      if (!(length > 0.0) || !std::isfinite(length)) return fault_of("a spot or directional light has no direction");
      light.direction = glm::vec3(direction / length);
    }
    const glm::vec3 color = is_finite(light.color) ? glm::max(light.color, 0.0F) : glm::vec3(1.0F);
    const float largest = std::max({color.r, color.g, color.b});
    light.color = largest > 0.0F ? glm::min(color / largest, 1.0F) : glm::vec3(0.0F);
    scene.lights.push_back(light);
  }
  return std::nullopt;
}

// Messages quote the file and what Assimp says of it, either of which may hold anything.
void make_one_line(std::string& message) {
  constexpr std::size_t kLongest = 400;
  if (message.size() > kLongest) message.resize(kLongest);
  for (char& c : message) {
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  }
}

Result<Scene> read_unnamed(const std::filesystem::path& file) {
  constexpr std::array<const char*, 6> kKnown{".gltf", ".glb", ".obj", ".ply", ".off", ".3ds"};
  const std::string extension = lower_extension(file);
  std::error_code error;
  const bool known = std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
  if (!known && std::filesystem::is_regular_file(file, error))
    return fault_of(
        fmt::format("{}; scenes are read from .gltf, .glb, .obj, .ply, .off and .3ds files",
                    extension.empty() ? "has no extension" : fmt::format("has the unknown extension '{}'", extension)));
  Result<std::string> content = read_file(file);
  if (!content) return content.error();
  Result<FileFacts> facts = check_content(*content, file, extension);
  if (!facts) return facts.error();
  if (facts->triangles && *facts->triangles == 0) return fault_of("has no triangles");
  if (facts->triangles && *facts->triangles > kMostTriangles)
    return fault_of(fmt::format("has {} triangles; at most {} are read", *facts->triangles, kMostTriangles));
  Result<Imported> imported = import_geometry(file, facts->for_assimp ? *facts->for_assimp : *content);
  if (!imported) return imported.error();
  Scene& scene = imported->scene;
  if (scene.triangles.empty()) return fault_of("has no triangles");
  const std::uint64_t read = scene.triangles.size();
  if (facts->triangles && (read < *facts->triangles || (read > *facts->triangles && !facts->at_least)))
    return fault_of(
        fmt::format("is malformed: it declares {} triangles, and {} could be read; an index out of range or missing "
                    "data is the usual cause",
                    *facts->triangles, read));
  if (auto fault = add_viewpoints(*facts, imported->root_transform, scene)) return *fault;
  scene.name = file.filename().string();
  return std::move(imported->scene);
}

}  // namespace

Result<Scene> read_scene(const std::filesystem::path& file) {
  Result<Scene> scene = read_unnamed(file);
  if (scene) return scene;
  Diagnostic fault = scene.error();
  make_one_line(fault.message);
  fault.file = file.string();
  return fault;
}

}  // namespace ninebit
