#include "src/scene/isolated_import.h"

#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <utility>

#include "src/scene/fault_of.h"
#include "src/scene/scene_check.h"
#include "src/system/isolated_call.h"

namespace ninebit {
namespace {

constexpr const char* kWho = "Assimp's 3DS reader";

posix::CallLimits limits_for(std::uint64_t bytes) {
  return {.memory_bytes = (std::uint64_t{1} << 30U) + 64 * bytes, .seconds = 8 + static_cast<int>(bytes / 1'000'000)};
}

// The answer is 1 and the imported scene, or 0 and the fault's message.
void write(posix::AnswerWriter& to, const Result<Imported>& imported) {
  to.value(std::uint8_t{imported.ok()});
  if (!imported) return to.text(imported.error().message);
  const Scene& scene = imported->scene;
  to.values(std::span(glm::value_ptr(imported->root_transform), 16));
  to.values(std::span(scene.positions));
  to.values(std::span(scene.normals));
  to.values(std::span(scene.texture_coordinates));
  to.values(std::span(scene.colors));
  to.values(std::span(scene.triangles));
  to.values(std::span(scene.triangle_object));
  to.values(std::span(scene.triangle_material));
  to.value(std::uint64_t{scene.objects.size()});
  for (const SceneObject& object : scene.objects) {
    to.text(object.name);
    to.value(std::array{object.first_triangle, object.triangle_count});
  }
  to.value(std::uint64_t{scene.materials.size()});
  for (const Material& material : scene.materials) {
    to.text(material.name);
    to.value(material.base_color);
  }
}

// Reads a count and as many items; false if the answer has fewer.
template <class T, class Read>
bool read_each(posix::AnswerReader& from, std::vector<T>& all, Read read) {
  std::uint64_t count = 0;
  if (!from.value(count)) return false;
  for (std::uint64_t i = 0; i < count; ++i) {
    T one;
    if (!read(one)) return false;
    all.push_back(std::move(one));
  }
  return true;
}

bool read_objects(posix::AnswerReader& from, Scene& scene) {
  return read_each(from, scene.objects, [&](SceneObject& object) {
    std::array<std::uint32_t, 2> range{};
    const bool whole = from.text(object.name) && from.value(range);
    object.first_triangle = range[0];
    object.triangle_count = range[1];
    return whole;
  });
}

bool read_materials(posix::AnswerReader& from, Scene& scene) {
  return read_each(from, scene.materials, [&](Material& material) {
    if (!from.text(material.name) || !from.value(material.base_color)) return false;
    return is_finite(material.base_color);
  });
}

// Reads the answer without trusting it; nothing if it is not valid.
std::optional<Result<Imported>> read(posix::AnswerReader& from) {
  std::uint8_t good = 0;
  if (!from.value(good)) return std::nullopt;
  if (good == 0) {
    std::string message;
    if (!from.text(message)) return std::nullopt;
    return fault_of(std::move(message));
  }
  Imported imported;
  Scene& scene = imported.scene;
  std::vector<double> root;
  const bool whole = from.values(root) && root.size() == 16 && from.values(scene.positions) &&
                     from.values(scene.normals) && from.values(scene.texture_coordinates) &&
                     from.values(scene.colors) && from.values(scene.triangles) && from.values(scene.triangle_object) &&
                     from.values(scene.triangle_material) && read_objects(from, scene) && read_materials(from, scene) &&
                     from.bytes_left() == 0;
  if (!whole) return std::nullopt;
  // read_scene() reports a file without triangles, for all formats.
  if (!scene.triangles.empty() && !validate_geometry(scene)) return std::nullopt;
  imported.root_transform = glm::make_mat4(root.data());
  return imported;
}

}  // namespace

Result<Imported> import_isolated(GeometryImport import, const std::filesystem::path& file, std::string_view content,
                                 const std::function<bool()>& go_on) {
  const posix::CallLimits limits = limits_for(content.size());
  posix::CallResult call = posix::call_isolated(
      limits, {}, [&](posix::AnswerWriter& answer) { write(answer, import(file, content)); }, go_on);
  if (call.end == posix::CallEnd::stopped) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  if (call.end != posix::CallEnd::answered) return fault_of(posix::describe(call.end, limits, kWho));
  std::optional<Result<Imported>> imported = read(call.answer);
  if (!imported) return fault_of(std::string(kWho) + " gave no scene");
  return *std::move(imported);
}

}  // namespace ninebit
