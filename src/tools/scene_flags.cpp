#include "src/tools/scene_flags.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "ninebit/image/image_io.h"
#include "ninebit/scene/scene_io.h"
#include "src/tools/number_list.h"

namespace ninebit::tools {
namespace {

std::string check_size(const std::string& text) {
  const auto n = numbers<int>(text, 'x');
  if (n && n->size() == 2 && n->at(0) >= 1 && n->at(1) >= 1 && std::max(n->at(0), n->at(1)) <= kMaxSurfaceSize)
    return {};
  return fmt::format("'{}' is no picture size; expected WIDTHxHEIGHT, each from 1 to {}", text, kMaxSurfaceSize);
}

std::string check_map_size(const std::string& text) {
  const auto n = numbers<int>(text, ',');
  if (n && n->size() == 1 && n->at(0) >= 1 && n->at(0) <= kMaxSurfaceSize && (n->at(0) & (n->at(0) - 1)) == 0)
    return {};
  return fmt::format("'{}' is no map size; expected a power of two from 1 to {}", text, kMaxSurfaceSize);
}

std::string check_point(const std::string& text) {
  const auto n = numbers<float>(text, ',');
  if (n && n->size() == 3 && std::isfinite(n->at(0)) && std::isfinite(n->at(1)) && std::isfinite(n->at(2))) return {};
  return fmt::format("'{}' is no point; expected X,Y,Z", text);
}

std::string check_floor(const std::string& text) {
  const auto n = numbers<float>(text, ',');
  if (text == "auto" || text == "none" || (n && n->size() == 1 && std::isfinite(n->at(0)))) return {};
  return fmt::format("'{}' is no floor; expected auto, none or a height", text);
}

std::string check_fov(const std::string& text) {
  const auto n = numbers<float>(text, ',');
  if (n && n->size() == 1 && n->at(0) >= 0.01F && n->at(0) <= 170.0F) return {};
  return fmt::format("'{}' is no field of view; expected degrees from 0.01 to 170", text);
}

std::string check_file_name(const std::string& text) {
  return text.empty() ? "the file name is empty" : "";
}

std::optional<glm::vec3> point(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto n = numbers<float>(text, ',');
  return glm::vec3(n->at(0), n->at(1), n->at(2));
}

SceneSetup setup_of(const SceneFlags& flags) {
  SceneSetup setup;
  setup.camera = point(flags.camera);
  setup.look_at = point(flags.look_at);
  setup.light = point(flags.light);
  if (flags.fov) setup.fov_degrees = static_cast<float>(*flags.fov);
  if (flags.floor == "none") {
    setup.floor = FloorChoice::none;
  } else if (flags.floor != "auto") {
    setup.floor = FloorChoice::at_height;
    setup.floor_height = numbers<float>(flags.floor, ',')->at(0);
  }
  return setup;
}

// The scene's file is at fault where nothing else is named.
template <class T>
Result<T> naming(const SceneFlags& flags, Result<T> result) {
  if (result) return result;
  Diagnostic d = result.error();
  if (d.file.empty()) d.file = flags.file;
  return d;
}

CLI::Validator checked(std::string (*check)(const std::string&)) {
  return CLI::Validator([check](std::string& text) { return check(text); }, "");
}

}  // namespace

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0) {
    limit_.emplace(tbb::global_control::max_allowed_parallelism, static_cast<std::size_t>(threads));
  }
  set_image_threads(threads > 0 ? threads : tbb::this_task_arena::max_concurrency());
}

CLI::Option* add_scene_file(CLI::App& verb, const std::string& name, SceneFlags& flags) {
  return verb.add_option(name, flags.file, "glTF 2.0, OBJ, PLY, OFF or 3DS file")
      ->type_name("FILE")
      ->check(checked(check_file_name));
}

std::vector<CLI::Option*> add_scene_flags(CLI::App& verb, SceneFlags& flags) {
  const std::size_t before = verb.get_options().size();
  std::vector<std::string> names;
  for (const Technique& technique : techniques()) names.emplace_back(technique.name);
  verb.add_option("--technique", flags.technique, "How shadows are drawn")
      ->capture_default_str()
      ->check(CLI::IsMember(names));
  verb.add_option("--size", flags.size, "Picture size in pixels")
      ->capture_default_str()
      ->type_name("WxH")
      ->check(checked(check_size));
  verb.add_option("--map-size", flags.settings.map_size, "Texels a side of a cube-map face, a power of two")
      ->type_name("N")
      ->capture_default_str()
      ->check(checked(check_map_size));
  verb.add_option("--index-format", flags.index_format, "What holds an index")
      ->capture_default_str()
      ->check(CLI::IsMember({"rgb"}));
  verb.add_option("--index-scope", flags.index_scope, "What gets an index of its own")
      ->capture_default_str()
      ->check(CLI::IsMember({"polygon", "object"}));
  verb.add_option("--index-step", flags.settings.index_step, "Step between indices in a channel")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxIndexStep));
  verb.add_flag("--light-facing", flags.settings.light_facing, "Shadow what faces away from the light");
  verb.add_option("--camera", flags.camera, "Camera position")->type_name("X,Y,Z")->check(checked(check_point));
  verb.add_option("--look-at", flags.look_at, "Point that the camera looks at")
      ->type_name("X,Y,Z")
      ->check(checked(check_point));
  verb.add_option("--fov", flags.fov, "Vertical field of view")->type_name("DEGREES")->check(checked(check_fov));
  verb.add_option("--light", flags.light, "Light position")->type_name("X,Y,Z")->check(checked(check_point));
  verb.add_option("--floor", flags.floor, "auto, none, or the height of a floor")
      ->type_name("auto|none|HEIGHT")
      ->capture_default_str()
      ->check(checked(check_floor));
  verb.add_option("--cull", flags.cull, "Faces to leave out, in every pass")
      ->capture_default_str()
      ->check(CLI::IsMember({"none", "back", "front"}));
  std::vector<CLI::Option*> added = verb.get_options();
  added.erase(added.begin(), added.begin() + static_cast<std::ptrdiff_t>(before));
  return added;
}

RenderSettings settings_of(const SceneFlags& flags, const CommonFlags& common) {
  RenderSettings settings = flags.settings;
  const auto size = *numbers<int>(flags.size, 'x');
  settings.width = size[0];
  settings.height = size[1];
  settings.profile = profile_of(common);
  settings.index_scope = flags.index_scope == "object" ? IndexScope::object : IndexScope::polygon;
  settings.cull_face = flags.cull == "back" ? CullFace::back : flags.cull == "front" ? CullFace::front : CullFace::none;
  return settings;
}

Result<Scene> load_scene(const SceneFlags& flags, const RenderSettings& settings) {
  auto read = read_scene(flags.file);
  if (!read) return read;
  return complete_scene_of(flags, settings, std::move(*read));
}

Result<Scene> complete_scene_of(const SceneFlags& flags, const RenderSettings& settings, Scene scene) {
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  return naming(flags, complete_scene(std::move(scene), setup_of(flags), aspect));
}

Result<Rendering> render_scene(const SceneFlags& flags, const Scene& scene, const RenderSettings& settings,
                               const Progress& progress) {
  return naming(flags, find_technique(flags.technique)->render(scene, settings, progress));
}

}  // namespace ninebit::tools
