#include "src/tools/common/scene_flags.h"

#include <fmt/format.h>

#include <utility>

#include "src/system/number_list.h"
#include "src/system/parallel/parallel_loop.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/common/technique_flags.h"

namespace ninebit::tools {
namespace {

CLI::Validator checked(std::string (*check)(const std::string&)) {
  return CLI::Validator([check](std::string& text) { return check(text); }, "");
}

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
      ->check(checked(check_file_name));
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
      ->check(checked(check_size));
  verb.add_flag("--light-facing", flags.settings.light_facing,
                "Also shadow surfaces that face away from the light (default: off)");
  verb.add_option("--camera", flags.camera, "Camera position (default: the file's; else a view of the whole scene)")
      ->type_name("X,Y,Z")
      ->check(checked(check_point));
  verb.add_option("--look-at", flags.look_at, "Point to look at (default: the file's; else the middle of the scene)")
      ->type_name("X,Y,Z")
      ->check(checked(check_point));
  verb.add_option("--fov", flags.fov, "Vertical field of view, in degrees (default: the file's; else 50)")
      ->type_name("DEGREES")
      ->check(checked(check_fov));
  verb.add_option("--light", flags.light, "Light position (default: the file's; else above and beside the camera)")
      ->type_name("X,Y,Z")
      ->check(checked(check_point));
  verb.add_option("--floor", flags.floor, "Floor below the scene: auto adds one if the file has no camera and no light")
      ->type_name("auto|none|HEIGHT")
      ->capture_default_str()
      ->check(checked(check_floor));
  verb.add_option("--light-type", flags.light_type, "Kind of light (default: from the file or the technique)")
      ->check(CLI::IsMember({"point", "spot", "directional"}));
  verb.add_option("--light-target", flags.light_target,
                  "Target of a spot or directional light (default: the file's; else the middle of the scene, or see "
                  "--spot-angle)")
      ->type_name("X,Y,Z")
      ->check(checked(check_point));
  verb.add_option(
          "--spot-angle", flags.spot_angle,
          "Opening angle of a spot light, in degrees (default: the file's; else all that the camera sees, or 90 with "
          "--light-target)")
      ->type_name("DEGREES")
      ->check(checked(check_spot_angle));
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

}  // namespace ninebit::tools
