#include "src/tools/common/scene_flags.h"

#include <fmt/format.h>

#include <utility>

#include "src/system/parallel/parallel_loop.h"
#include "src/tools/common/cookie_file.h"
#include "src/tools/common/flag_groups.h"
#include "src/tools/common/number_flag.h"
#include "src/tools/common/number_list.h"
#include "src/tools/common/scene_flag_checks.h"
#include "src/tools/common/technique_flags.h"

namespace ninebit::tools {
namespace {

CLI::Validator checked(std::string (*check)(const std::string&)) {
  return CLI::Validator([check](std::string& text) { return check(text); }, "");
}

// Adds a flag whose value is one of the names.
template <class E>
void add_choice(CLI::App& verb, const std::string& flag, E& value, const Names<E>& names, const std::string& help) {
  std::vector<std::string> all;
  for (const auto& [name, v] : names) all.push_back(name);
  const auto set = [&value, &names](const std::string& text) {
    for (const auto& [name, v] : names) {
      if (name == text) value = v;
    }
  };
  verb.add_option_function<std::string>(flag, set, help)->default_str(name_in(names, value))->check(CLI::IsMember(all));
}

const Names<ChannelStorage> kStorages{{"round", ChannelStorage::round}, {"truncate", ChannelStorage::truncate}};
const Names<VolumeMethod> kVolumeMethods{{"depth-fail", VolumeMethod::depth_fail},
                                         {"depth-pass", VolumeMethod::depth_pass}};
const Names<bool> kStencilSides{{"two", true}, {"one", false}};
const Names<SamplePattern> kPatterns{{"poisson", SamplePattern::poisson}, {"polar", SamplePattern::polar}};
const Names<bool> kStyles{{"plain", false}, {"cartoon", true}};
const Names<bool> kCookieShadows{{"index", true}, {"none", false}};
const Names<CullFace> kCulls{{"none", CullFace::none}, {"back", CullFace::back}, {"front", CullFace::front}};
const Names<DepthStencilFormat> kDepthStencils{
    {"d24s8", DepthStencilFormat::d24s8}, {"d16", DepthStencilFormat::d16}, {"d15s1", DepthStencilFormat::d15s1}};

void add_index_flags(CLI::App& verb, RenderSettings& s) {
  add_choice(verb, "--index-format", s.index.format, kIndexFormats, "Texture format of an index");
  add_choice(verb, "--index-scope", s.index.scope, kIndexScopes, "Unit that gets its own index");
  verb.add_option("--index-step", s.index.step, "Difference between consecutive indices in a channel")
      ->capture_default_str()
      ->check(CLI::Range(1, kMaxIndexStep));
  verb.add_option("--section-size", s.index.section_size, "Maximum number of triangles per section")
      ->capture_default_str()
      ->type_name("N")
      ->check(CLI::Range(kMinSectionSize, kMaxSectionSize));
  add_choice(verb, "--index-order", s.index.order, kIndexOrders,
             "Order of indices: as in the file, or equal for the comparison where surfaces meet");
  verb.add_option("--patch-angle", s.index.patch_degrees, "Maximum angle within a patch of --index-order neighbour")
      ->capture_default_str()
      ->type_name("DEGREES")
      ->check(checked(check_patch_angle));
  add_choice(verb, "--index-scales", s.index.scales, kIndexScales, "Products that the comparison scales by four");
}

void add_depth_flags(CLI::App& verb, SceneFlags& flags) {
  RenderSettings& s = flags.settings;
  add_choice(verb, "--depth-bits", s.depth_cube.bits, kDepthBits, "Format of the depth cube map");
  verb.add_option("--bias", flags.bias,
                  "Bias of the depth comparison, in world units (default: three texels of the map)")
      ->type_name("DISTANCE")
      ->check(checked(check_bias));
  verb.add_option("--polygon-offset", flags.polygon_offset, "Polygon offset of the shadow map (default: 1.125,16)")
      ->type_name("FACTOR,UNITS")
      ->check(checked(check_offset));
  add_choice(verb, "--depth-encoding", s.shadow_map.encoding, kDepthEncodings, "Encoding of depth in the shadow map");
  add_choice(verb, "--depth-storage", s.shadow_map.storage, kStorages, "Conversion of rgba8 components to bytes");
  add_choice(verb, "--volume-method", s.shadow_volume.method, kVolumeMethods,
             "Count shadow volumes where the depth test fails or passes");
  add_choice(verb, "--stencil-sides", s.shadow_volume.two_sided, kStencilSides,
             "Sides of the shadow volumes drawn per pass");
}

void add_reflective_flags(CLI::App& verb, ReflectiveSettings& s) {
  verb.add_option("--samples", s.samples, "Number of pixel lights that a pixel gathers from")
      ->capture_default_str()
      ->type_name("N")
      ->check(CLI::Range(1, kMaxPixelLights));
  verb.add_option("--kernel", s.kernel, "Radius of the sample pattern, in texels")
      ->capture_default_str()
      ->type_name("TEXELS")
      ->check(real_in_range(1.0, kMaxSurfaceSize));
  add_choice(verb, "--pattern", s.pattern, kPatterns, "Sample pattern");
  verb.add_option("--gather-scale", s.gather_scale, "Gather once per block of N x N pixels")
      ->capture_default_str()
      ->type_name("N")
      ->check(CLI::Range(1, 16));
}

void add_cookie_flags(CLI::App& verb, SceneFlags& flags) {
  verb.add_option("--cookie", flags.cookie,
                  "Cube map of the light, required: one DDS file, or six pictures +X,-X,+Y,-Y,+Z,-Z")
      ->type_name("FILE[,FILE...]")
      ->check(checked(check_cookie));
  verb.add_option("--light-rotate", flags.light_rotate,
                  "Rotation of the light about x, then y, then z, in degrees (default: 0,0,0)")
      ->type_name("X,Y,Z")
      ->check(checked(check_degrees));
  add_choice(verb, "--cookie-shadows", flags.settings.light_cookie.shadows, kCookieShadows,
             "Shadows of the light cookie: by indices, or none");
}

// Adds the flags that only one technique reads, and the checks that involve several flags.
void add_technique_flags(CLI::App& verb, SceneFlags& flags) {
  add_index_flags(verb, flags.settings);
  add_depth_flags(verb, flags);
  add_reflective_flags(verb, flags.settings.reflective);
  add_cookie_flags(verb, flags);
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
  verb.add_option("--map-size", flags.settings.map_size, "Size of the light's map in texels per side, a power of two")
      ->type_name("N")
      ->capture_default_str()
      ->check(checked(check_map_size));
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
  add_choice(verb, "--cull", flags.settings.cull_face, kCulls, "Faces to cull, in every pass");
  add_choice(verb, "--depth-stencil", flags.settings.depth_stencil, kDepthStencils,
             "Depth and stencil bits of the frame");
  add_choice(verb, "--style", flags.settings.cartoon, kStyles, "Shading: plain, or flat colours with ink shadows");
  add_technique_flags(verb, flags);
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
  if (!flags.bias.empty()) settings.depth_cube.bias = numbers<float>(flags.bias, ',')->at(0);
  if (!flags.polygon_offset.empty()) {
    const auto offset = *numbers<float>(flags.polygon_offset, ',');
    settings.shadow_map.polygon_offset = {offset[0], offset[1]};
  }
  settings.light_cookie.rotate_degrees = glm::vec3(0.0F);
  if (!flags.light_rotate.empty()) {
    const auto angles = *numbers<float>(flags.light_rotate, ',');
    settings.light_cookie.rotate_degrees = {angles[0], angles[1], angles[2]};
  }
  return settings;
}

}  // namespace ninebit::tools
