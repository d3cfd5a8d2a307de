#include "src/scene/files/isolated_import.h"

#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <optional>
#include <utility>

#include "src/scene/scene_check.h"
#include "src/system/isolated_call.h"

namespace ninebit {
namespace {

std::string reader_of(const std::filesystem::path& file) {
  return "Assimp's reader of " + file.extension().string() + " files";
}

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
    to.value(std::int64_t{material.base_texture ? std::int64_t{*material.base_texture} : -1});
    to.value(material.sampler);
  }
  to.value(std::uint64_t{scene.textures.size()});
  for (const SceneTexture& texture : scene.textures) {
    to.text(texture.name);
    to.text(texture.bytes);
    to.text(texture.fault);
  }
  to.value(std::uint64_t{scene.notes.size()});
  for (const std::string& note : scene.notes) to.text(note);
  to.value(std::array{std::uint8_t{imported->has_viewpoints}, std::uint8_t{imported->z_up}});
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

// The answer's bytes may hold any numbers in the enumerations.
bool is_valid(const Sampler& sampler) {
  const auto known = [](Wrap wrap) {
    return wrap == Wrap::repeat || wrap == Wrap::mirrored_repeat || wrap == Wrap::clamp_to_edge;
  };
  const bool filters =
      sampler.min_filter == MinFilter::linear_mipmap_linear || sampler.min_filter == Sampler{}.min_filter;
  return filters && sampler.mag_filter == Sampler{}.mag_filter && known(sampler.wrap_s) && known(sampler.wrap_t) &&
         sampler.comparison == DepthComparison::none && sampler.lod_bias == 0.0F;
}

bool read_materials(posix::AnswerReader& from, Scene& scene) {
  return read_each(from, scene.materials, [&](Material& material) {
    std::int64_t texture = -1;
    if (!from.text(material.name) || !from.value(material.base_color) || !from.value(texture) ||
        !from.value(material.sampler)) {
      return false;
    }
    if (texture >= 0) material.base_texture = static_cast<std::uint32_t>(texture);
    return is_finite(material.base_color) && is_valid(material.sampler);
  });
}

bool read_textures(posix::AnswerReader& from, Scene& scene) {
  return read_each(from, scene.textures, [&](SceneTexture& texture) {
    return from.text(texture.name) && from.text(texture.bytes) && from.text(texture.fault);
  });
}

bool read_facts(posix::AnswerReader& from, Imported& imported) {
  std::array<std::uint8_t, 2> facts{};
  const bool whole =
      read_each(from, imported.scene.notes, [&](std::string& note) { return from.text(note); }) && from.value(facts);
  imported.has_viewpoints = facts[0] != 0;
  imported.z_up = facts[1] != 0;
  return whole;
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
                     read_textures(from, scene) && read_facts(from, imported) && from.bytes_left() == 0;
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
  if (call.end != posix::CallEnd::answered) return fault_of(posix::describe(call.end, limits, reader_of(file).c_str()));
  std::optional<Result<Imported>> imported = read(call.answer);
  if (!imported) return fault_of(reader_of(file) + " gave no scene");
  return *std::move(imported);
}

}  // namespace ninebit
