#include "src/tools/common/scene_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "src/image/texture/picture_loader.h"
#include "src/tools/input/file_kind.h"
#include "src/tools/input/printable.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

namespace {

constexpr std::size_t kMostTextures = 1024;
constexpr std::int64_t kMostTexels = std::int64_t{1} << 27;

// Whether each material is that of a triangle.
std::vector<bool> used_materials(const Scene& scene) {
  std::vector<bool> used(scene.materials.size(), false);
  for (const std::uint32_t material : scene.triangle_material) used[material] = true;
  return used;
}

template <class Test>
bool any_used(const Scene& scene, const Test& test) {
  const std::vector<bool> used = used_materials(scene);
  for (std::size_t m = 0; m < used.size(); ++m) {
    if (used[m] && test(scene.materials[m])) return true;
  }
  return false;
}

Result<Texture> read_picture_of(const RenderSettings& settings, const SceneTexture& from, std::string& resampled) {
  TextureReadOptions options{.mipmaps = true, .any_size = true, .isolated = true};
  options.go_on = [] { return !ProgressLine::stopped(); };
  options.on_resample = [&](int width, int height) {
    resampled += fmt::format("{}'{}' ({} x {})", resampled.empty() ? "" : ", ", printable(from.name), width, height);
  };
  if (from.file.empty()) {
    const std::span bytes(reinterpret_cast<const std::uint8_t*>(from.bytes.data()), from.bytes.size());
    return image_detail::read_texture(bytes, from.name, options, image_detail::kPictureModule);
  }
  return image_detail::read_texture(settings.profile, from.file, options, image_detail::kPictureModule);
}

Status read_one(const std::string& scene_file, const RenderSettings& settings, SceneTexture& texture,
                std::string& resampled) {
  const auto fault = [&](const Diagnostic& from) {
    Diagnostic out = from;
    out.message = fmt::format("its texture '{}' {}", printable(texture.name), from.message);
    out.file = scene_file;
    return out;
  };
  if (!texture.fault.empty()) return fault({.message = texture.fault, .fault = Fault::invalid_input});
  auto read = read_picture_of(settings, texture, resampled);
  if (!read) return read.error().fault == Fault::cancelled ? read.error() : fault(read.error());
  if (read->target != TextureTarget::texture_2d) {
    return fault({.message = "is a cube map; expected a 2D texture", .fault = Fault::invalid_input});
  }
  texture.texture = std::make_shared<const Texture>(std::move(*read));
  texture.bytes = {};
  return {};
}

Status read_textures(const std::string& scene_file, const RenderSettings& settings, Scene& scene) {
  if (scene.texture_coordinates.empty()) return {};
  const std::vector<bool> used = used_materials(scene);
  std::string resampled;
  std::size_t count = 0;
  std::int64_t texels = 0;
  for (std::size_t m = 0; m < used.size(); ++m) {
    const Material& material = scene.materials[m];
    // A cartoon still has holes.
    if (!used[m] || !material.base_texture || (settings.cartoon && material.alpha_mode != AlphaMode::mask)) continue;
    SceneTexture& texture = scene.textures[*material.base_texture];
    if (texture.texture) continue;
    if (++count > kMostTextures) {
      return Diagnostic{fmt::format("has more than {} textures", kMostTextures), scene_file};
    }
    if (Status read = read_one(scene_file, settings, texture, resampled); !read) return read;
    const TextureImage& image = texture.texture->faces[0][0];
    texels += std::int64_t{image.width} * image.height;
    if (texels > kMostTexels) {
      return Diagnostic{fmt::format("its textures have more than {} texels together", kMostTexels), scene_file};
    }
  }
  if (!resampled.empty()) {
    scene.notes.push_back("exact sizes of textures, resampled to powers of two: " + resampled);
  }
  return {};
}

// Lights and cameras of a file that the technique ignores.
void add_viewpoints(const Scene& scene, const SceneFlags& flags, std::vector<std::string>& out) {
  if (scene.cameras.size() > 1) out.emplace_back("cameras beyond the first");
  const LightKinds kinds = flags.light_kinds.value_or(find_technique(flags.technique)->lights);
  const auto drawn = std::count_if(scene.lights.begin(), scene.lights.end(),
                                   [&](const Light& light) { return kinds.has(light.kind); });
  if (drawn == 0 && kinds.point && !scene.lights.empty()) {
    out.push_back(fmt::format("spot and directional lights, by technique {}", flags.technique));
  } else if (scene.lights.size() > 1) {
    out.emplace_back("all lights but one");
  }
}

}  // namespace

std::vector<std::string> ignored_materials(const Scene& scene, const std::string& technique,
                                           const RenderSettings& settings) {
  std::vector<std::string> out;
  const bool textured = any_used(scene, [](const Material& m) { return m.base_texture.has_value(); });
  const bool masked = any_used(scene, [](const Material& m) { return m.alpha_mode == AlphaMode::mask; });
  const bool reflective = technique == "reflective";
  if (textured && scene.texture_coordinates.empty()) {
    out.emplace_back("textures: the scene has no texture coordinates");
  } else if (textured && settings.cartoon) {
    out.emplace_back("textures, by --style cartoon");
  } else if (textured && reflective) {
    out.emplace_back("textures, by technique reflective");
  }
  if (!scene.colors.empty() && settings.cartoon) out.emplace_back("vertex colours, by --style cartoon");
  if (!scene.colors.empty() && reflective) out.emplace_back("vertex colours, by technique reflective");
  if (!masked) return out;
  const bool index_in_alpha =
      settings.index.format == IndexFormat::luminance_alpha || settings.index.format == IndexFormat::alpha;
  if (reflective) {
    out.emplace_back("alpha masks, by technique reflective");
  } else if (technique == "shadow-volume" || technique == "depth-cube") {
    out.push_back(fmt::format("alpha masks in the shadows, by technique {}", technique));
  } else if (technique != "shadow-map" && index_in_alpha) {
    out.emplace_back("alpha masks in the shadows, by an --index-format with alpha");
  }
  if (settings.evidence) out.emplace_back("alpha masks in the ground truth");
  return out;
}

Result<DrawnScene> load_drawn_scene(const SceneFlags& flags, const RenderSettings& settings) {
  auto scene = read_scene_of(flags);
  if (!scene) return scene.error();
  if (Status read = read_textures(flags.file, settings, *scene); !read) return read.error();
  std::vector<std::string> ignored = scene->notes;
  add_viewpoints(*scene, flags, ignored);
  for (std::string& part : ignored_materials(*scene, flags.technique, settings)) ignored.push_back(std::move(part));
  auto complete = complete_scene_of(flags, settings, std::move(*scene));
  if (!complete) return complete.error();
  return DrawnScene{std::move(*complete), std::move(ignored)};
}

void warn_of_ignored(const std::string& scene_file, const std::vector<std::string>& ignored) {
  if (ignored.empty()) return;
  std::string all;
  for (const std::string& part : ignored) all += (all.empty() ? "" : "; ") + printable(part);
  say_warning(fmt::format("{}: ignored: {}", scene_file, all));
}

namespace {

std::vector<std::filesystem::path> files_of(const std::string& text) {
  std::vector<std::filesystem::path> files;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    files.emplace_back(text.substr(start, end - start));
    start = end + 1;
  }
  return files;
}

}  // namespace

std::string check_cookie(const std::string& text) {
  const auto files = files_of(text);
  const bool nameless = std::any_of(files.begin(), files.end(), [](const auto& file) { return file.empty(); });
  if (!nameless && (files.size() == 1 || files.size() == 6)) return {};
  return fmt::format("'{}' names {} file{}{}; expected one DDS file, or six pictures +X,-X,+Y,-Y,+Z,-Z", text,
                     files.size(), files.size() == 1 ? "" : "s", nameless ? ", one of them empty" : "");
}

Result<std::shared_ptr<const Texture>> read_cookie(const HardwareProfile& profile, const std::string& text) {
  const auto files = files_of(text);
  const TextureReadOptions options{.isolated = true, .go_on = [] { return !ProgressLine::stopped(); }};
  auto read = [&] {
    if (files.size() == 1) return image_detail::read_texture(profile, files[0], options, image_detail::kPictureModule);
    std::array<std::filesystem::path, 6> faces;
    std::copy(files.begin(), files.end(), faces.begin());
    return image_detail::read_cube_texture(profile, faces, options, image_detail::kPictureModule);
  }();
  if (!read) return explained_by_kind(read.error(), read.error().file, FileRole::picture);
  if (read->target != TextureTarget::cube_map) {
    return Diagnostic{
        .message = "is a 2D texture; expected a cube map, a DDS file of six faces or six pictures +X,-X,+Y,-Y,+Z,-Z",
        .file = files[0].string()};
  }
  return std::shared_ptr<const Texture>(std::make_shared<Texture>(std::move(read).value()));
}

}  // namespace ninebit::tools
