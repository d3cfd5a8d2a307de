// Reads and renders the scene of parsed flags.
#include <utility>

#include "src/system/number_list.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/common/scene_textures.h"
#include "src/tools/input/file_kind.h"

namespace ninebit::tools {
namespace {

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
  setup.light_kinds = flags.light_kinds.value_or(find_technique(flags.technique)->lights);
  if (const auto kind = given_light_kind(flags)) {
    setup.light_kinds = {.point = kind == LightKind::point,
                         .spot = kind == LightKind::spot,
                         .directional = kind == LightKind::directional};
  }
  setup.light_target = point(flags.light_target);
  if (flags.spot_angle) setup.spot_degrees = static_cast<float>(*flags.spot_angle);
  if (flags.fov) setup.fov_degrees = static_cast<float>(*flags.fov);
  if (flags.floor == "none") {
    setup.floor = FloorChoice::none;
  } else if (flags.floor != "auto") {
    setup.floor = FloorChoice::at_height;
    setup.floor_height = numbers<float>(flags.floor, ',')->at(0);
  }
  return setup;
}

// Names the scene's file in an error that names no other.
template <class T>
Result<T> naming(const SceneFlags& flags, Result<T> result) {
  if (result) return result;
  Diagnostic d = result.error();
  if (d.file.empty()) d.file = flags.file;
  return d;
}

}  // namespace

Result<Scene> read_scene_of(const SceneFlags& flags) {
  const auto go_on = [] { return !ProgressLine::stopped(); };
  auto scene = read_scene(
      flags.file, {.allow_outside = flags.allow_outside, .up = up_axis_of(flags.up), .isolated = true, .go_on = go_on});
  if (scene) return scene;
  return explained_by_kind(scene.error(), flags.file, FileRole::scene);
}

Result<Scene> load_scene(const SceneFlags& flags, const RenderSettings& settings, bool quiet) {
  auto read = read_scene_of(flags);
  if (!read) return read;
  warn_of_ignored(flags.file, read->notes, quiet);
  return complete_scene_of(flags, settings, std::move(*read));
}

Result<Scene> complete_scene_of(const SceneFlags& flags, const RenderSettings& settings, Scene scene) {
  const float aspect = static_cast<float>(settings.width) / static_cast<float>(settings.height);
  return naming(flags, complete_scene(std::move(scene), setup_of(flags), aspect));
}

Result<Rendering> render_scene(const SceneFlags& flags, const Scene& scene, const RenderSettings& settings,
                               const Progress& progress) {
  RenderSettings complete = settings;
  if (!flags.cookie.empty()) {
    auto cookie = read_cookie(settings.profile, flags.cookie);
    if (!cookie) return cookie.error();
    complete.light_cookie.cookie = std::move(cookie).value();
  }
  return naming(flags, find_technique(flags.technique)->render(scene, complete, progress));
}

}  // namespace ninebit::tools
