#include "src/tools/common/scene_flags.h"

#include <fmt/format.h>

#include <utility>

#include "src/system/number_list.h"
#include "src/system/parallel/parallel_loop.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/common/scene_textures.h"
#include "src/tools/common/technique_flags.h"
#include "src/tools/input/file_kind.h"

namespace ninebit::tools {
namespace {

// Adds the checks that involve several flags.
void check_together(CLI::App& verb, const SceneFlags& flags) {
  verb.parse_complete_callback([&flags, &verb] {
    if (const std::string unread = unread_flag(verb, flags); !unread.empty()) throw CLI::ValidationError(unread);
    if (flags.technique == "light-cookie" && flags.cookie.empty()) {
      throw CLI::ValidationError("--technique light-cookie requires --cookie FILE");
    }
    const auto kind = given_light_kind(flags);
    if (kind && !find_technique(flags.technique)->lights.has(*kind)) {
      throw CLI::ValidationError(
          fmt::format("--light-type {}: not supported by technique {}", flags.light_type, flags.technique));
    }
  });
}

}  // namespace

std::optional<LightKind> given_light_kind(const SceneFlags& flags) {
  if (flags.light_type.empty()) return std::nullopt;
  return flags.light_type == "point"  ? LightKind::point
         : flags.light_type == "spot" ? LightKind::spot
                                      : LightKind::directional;
}

ThreadLimit::ThreadLimit(int threads) {
  if (threads > 0) limit_.emplace(static_cast<std::size_t>(threads));
}

void add_up_flag(CLI::App& verb, std::string& up) {
  verb.add_option("--up", up, "Axis that points up in the scene's file (default: as the file or its format says)")
      ->check(CLI::IsMember({"y", "z"}));
}

std::optional<UpAxis> up_axis_of(const std::string& up) {
  if (up.empty()) return std::nullopt;
  return up == "z" ? UpAxis::z : UpAxis::y;
}

CLI::Option* add_scene_file(CLI::App& verb, const std::string& name, SceneFlags& flags) {
  verb.add_flag("--allow-outside", flags.allow_outside,
                "Also read buffers, material libraries and textures outside of the scene's folder");
  add_up_flag(verb, flags.up);
  return verb.add_option(name, flags.file, "Scene to render: a glTF, OBJ, PLY, OFF, 3DS, STL, COLLADA or FBX file")
      ->type_name("FILE")
      ->check(checked_by(check_file_name));
}

std::vector<CLI::Option*> add_scene_flags(CLI::App& verb, SceneFlags& flags) {
  const std::size_t before = verb.get_options().size();
  std::vector<std::string> names;
  for (const Technique& technique : techniques()) names.emplace_back(technique.name);
  verb.add_option("--technique", flags.technique, "Shadow technique")
      ->capture_default_str()
      ->check(CLI::IsMember(names));
  verb.add_option("--size", flags.size, "Picture size in pixels")
      ->capture_default_str()
      ->type_name("WxH")
      ->check(checked_by(check_size));
  verb.add_flag("--light-facing", flags.settings.light_facing,
                "Also shadow surfaces that face away from the light (default: off)");
  verb.add_option("--camera", flags.camera, "Camera position (default: the file's; else a view of the whole scene)")
      ->type_name("X,Y,Z")
      ->check(checked_by(check_point));
  verb.add_option("--look-at", flags.look_at, "Point to look at (default: the file's; else the middle of the scene)")
      ->type_name("X,Y,Z")
      ->check(checked_by(check_point));
  verb.add_option("--fov", flags.fov, "Vertical field of view, in degrees (default: the file's; else 50)")
      ->type_name("DEGREES")
      ->check(checked_by(check_fov));
  verb.add_option("--light", flags.light, "Light position (default: the file's; else above and beside the camera)")
      ->type_name("X,Y,Z")
      ->check(checked_by(check_point));
  verb.add_option("--floor", flags.floor, "Floor below the scene: auto adds one if the file has no camera and no light")
      ->type_name("auto|none|HEIGHT")
      ->capture_default_str()
      ->check(checked_by(check_floor));
  verb.add_option("--light-type", flags.light_type, "Kind of light (default: from the file or the technique)")
      ->check(CLI::IsMember({"point", "spot", "directional"}));
  verb.add_option("--light-target", flags.light_target,
                  "Target of a spot or directional light (default: the file's; else the middle of the scene, or see "
                  "--spot-angle)")
      ->type_name("X,Y,Z")
      ->check(checked_by(check_point));
  verb.add_option(
          "--spot-angle", flags.spot_angle,
          "Opening angle of a spot light, in degrees (default: the file's; else all that the camera sees, or 90 with "
          "--light-target)")
      ->type_name("DEGREES")
      ->check(checked_by(check_spot_angle));
  add_technique_flags(verb, flags);
  check_together(verb, flags);
  group_scene_flags(verb);
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
  return settings;
}

// Reads and renders the scene of parsed flags.

namespace {

SceneSetup setup_of(const SceneFlags& flags) {
  SceneSetup setup;
  setup.camera = point_of(flags.camera);
  setup.look_at = point_of(flags.look_at);
  setup.light = point_of(flags.light);
  setup.light_kinds = flags.light_kinds.value_or(find_technique(flags.technique)->lights);
  if (const auto kind = given_light_kind(flags)) {
    setup.light_kinds = {.point = kind == LightKind::point,
                         .spot = kind == LightKind::spot,
                         .directional = kind == LightKind::directional};
  }
  setup.light_target = point_of(flags.light_target);
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

Result<Scene> load_scene(const SceneFlags& flags, const RenderSettings& settings) {
  auto read = read_scene_of(flags);
  if (!read) return read;
  warn_of_ignored(flags.file, read->notes);
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
