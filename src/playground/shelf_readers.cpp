#include <algorithm>
#include <bit>
#include <charconv>
#include <utility>

#include "ninebit/effect/generated_meshes.h"
#include "src/playground/drawing.h"
#include "src/playground/texts.h"
#include "src/raster/texture/resample.h"
#include "src/scene/files/named_files.h"

namespace ninebit::playground {
namespace {

std::size_t texels_of(const EffectTexture& texture, const Shelf& shelf) {
  const auto side = static_cast<std::size_t>(std::max(texture.size, 0));
  if (texture.origin == TextureOrigin::normalize_cube) return 6 * side * side;
  if (texture.origin == TextureOrigin::checker) return side * side;
  std::size_t texels = 0;
  for (const std::string& file : texture.files) {
    const auto found = shelf.pixels.find(file);
    if (found == shelf.pixels.end()) continue;
    texels += std::bit_ceil(static_cast<std::size_t>(found->second.width)) *
              std::bit_ceil(static_cast<std::size_t>(found->second.height));
  }
  return texels;
}

int segments_of(std::string_view mesh) {
  const std::size_t colon = mesh.find(':');
  int segments = 0;
  if (colon != std::string_view::npos) std::from_chars(mesh.data() + colon + 1, mesh.data() + mesh.size(), segments);
  return segments;
}

bool is_opaque(const PutPixels& picture) {
  for (std::size_t i = 3; i < picture.rgba.size(); i += 4) {
    if (picture.rgba[i] != 255) return false;
  }
  return true;
}

std::string put_names(const Shelf& shelf) {
  std::string names;
  for (const auto& [name, picture] : shelf.pixels) names += (names.empty() ? "" : ", ") + json::in_quotes(name);
  return names.empty() ? "none was put" : "there are " + names.substr(0, 200);
}

}  // namespace

std::string complaint_about_mesh(const std::string& mesh) {
  if (!is_generated_mesh(mesh) || segments_of(mesh) <= kMaxDrawnSegments) return {};
  const std::string most = std::to_string(kMaxDrawnSegments);
  return "a generated mesh of the playground has at most " + most + " segments, as sphere:" + most;
}

std::string complaint_about_amount(const Effect& effect, const Shelf& shelf) {
  const auto area = [](int width, int height) {
    return static_cast<std::size_t>(width) * static_cast<std::size_t>(height);
  };
  std::size_t pixels = area(effect.width, effect.height), texels = 0;
  for (const EffectTarget& target : effect.targets) pixels += (target.cube ? 6 : 1) * area(target.width, target.height);
  for (const EffectTexture& texture : effect.textures) texels += texels_of(texture, shelf);
  if (pixels > kMaxDrawnPixels) {
    return "the picture and the targets have " + std::to_string(pixels) + " pixels; the playground draws at most " +
           std::to_string(kMaxDrawnPixels);
  }
  if (texels > kMaxTexels) {
    return "the textures have " + std::to_string(texels) + " texels; the playground takes at most " +
           std::to_string(kMaxTexels);
  }
  return complaint_about_mesh(effect.scene.mesh);
}

Result<Scene> shelf_scene(const std::string& name, const Shelf& shelf, std::optional<UpAxis> up) {
  const auto found = shelf.files.find(name);
  const bool is_room = found == shelf.files.end() && (name == kRoomName || name.ends_with(kRoomFile));
  if (is_room) return scene_of_bytes(kRoomText, std::string(kRoomFile), up, kMaxFileTriangles);
  if (found == shelf.files.end()) {
    return Diagnostic{.message = "is no file that was put; take room, sphere:N, torus:N, plane:N or cube",
                      .file = name};
  }
  const std::vector<std::uint8_t>& bytes = found->second;
  return scene_of_bytes({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, name, up, kMaxFileTriangles);
}

EffectReaders ShelfReaders::readers() {
  EffectReaders readers;
  readers.program = [this](const std::filesystem::path& file, const HardwareProfile& profile) {
    return read_program(file.string(), profile);
  };
  readers.texture = [this](std::span<const std::filesystem::path> files, const HardwareProfile&) {
    std::vector<std::string> names;
    for (const std::filesystem::path& file : files) names.push_back(file.string());
    return read_texture(names, false);
  };
  readers.rectangle = [this](const std::filesystem::path& file, const HardwareProfile&) {
    return read_texture({file.string()}, true);
  };
  readers.kept = [this](const TextureRecipe& recipe, const std::function<Result<Texture>()>& make) {
    return kept_texture(recipe, make);
  };
  readers.scene = [this](const std::filesystem::path& file, std::optional<UpAxis> up) {
    return shelf_scene(file.string(), shelf_, up);
  };
  return readers;
}

Result<TextProgram> ShelfReaders::read_program(const std::string& name, const HardwareProfile& profile) {
  program_faults_.clear();
  const NumberedName named = numbered_name(name, texts_);
  const auto found = texts_.find(named.file);
  if (found == texts_.end()) return Diagnostic{.message = "is not among the files of the request", .file = name};
  const auto choice = choices_.find(named.file);
  SourceSelection selection = choice == choices_.end() ? SourceSelection{} : choice->second;
  if (named.number) selection.program = *named.number;
  const auto parsed = valid_program({found->second, name}, profile, texts_, selection);
  if (parsed) return *parsed;
  program_faults_ = refusals(parsed.faults(), found->second).faults();
  return Diagnostic{.message = parsed.faults()[0].message, .file = name, .line = parsed.faults()[0].line};
}

Result<Texture> ShelfReaders::kept_texture(const TextureRecipe& recipe, const std::function<Result<Texture>()>& make) {
  const auto is_it = [&](const CachedTexture& kept) { return kept.recipe == recipe; };
  if (const auto found = std::find_if(reused_.begin(), reused_.end(), is_it); found != reused_.end()) {
    kept_.push_back(std::move(*found));
    reused_.erase(found);
  }
  if (const auto found = std::find_if(kept_.begin(), kept_.end(), is_it); found != kept_.end()) {
    warnings_.insert(warnings_.end(), found->warnings.begin(), found->warnings.end());
    return found->texture;
  }
  const auto before = static_cast<std::ptrdiff_t>(warnings_.size());
  auto made = make();
  if (!made) return made;
  const auto& image = made->faces[0][0];
  const auto side = [](int texels) { return static_cast<std::size_t>(texels); };
  if (made->faces.size() * side(image.width) * side(image.height) <= kMaxKeptTexels) {
    kept_.push_back({recipe, *made, {warnings_.begin() + before, warnings_.end()}});
  }
  return made;
}

Result<TextureSamples> ShelfReaders::samples_of(const std::string& name, bool opaque, bool any_sides) {
  const PutPixels& picture = shelf_.pixels.find(name)->second;
  const std::size_t count = picture.rgba.size() / 4;
  const std::size_t planes = opaque ? 3 : 4;
  std::vector<std::uint8_t> samples(count * planes);
  for (std::size_t c = 0; c < planes; ++c) {
    for (std::size_t i = 0; i < count; ++i) samples[c * count + i] = picture.rgba[4 * i + c];
  }
  TextureSamples out{picture.width, picture.height, std::move(samples)};
  const auto is_power = [](int side) { return std::has_single_bit(static_cast<unsigned>(side)); };
  if (any_sides || (is_power(out.width) && is_power(out.height))) return out;
  warnings_.push_back(
      name + ": " + std::to_string(out.width) + " x " + std::to_string(out.height) +
      " is resampled to powers of two, as textures of the time have no other sizes but those named 'rectangle:'");
  resample_to_powers_of_two(out);
  return out;
}

Result<Texture> ShelfReaders::read_texture(const std::vector<std::string>& names, bool is_rectangle) {
  bool opaque = true;
  for (const std::string& name : names) {
    const auto found = shelf_.pixels.find(name);
    if (found == shelf_.pixels.end()) {
      return Diagnostic{.message = "is no picture that was put; " + put_names(shelf_), .file = name};
    }
    opaque = opaque && is_opaque(found->second);
  }
  std::vector<std::vector<TextureSamples>> faces;
  for (const std::string& name : names) {
    auto samples = samples_of(name, opaque, is_rectangle);
    if (!samples) return samples.error();
    faces.push_back({std::move(*samples)});
  }
  const auto target = is_rectangle        ? TextureTarget::rectangle
                      : names.size() == 6 ? TextureTarget::cube_map
                                          : TextureTarget::texture_2d;
  auto texture = make_texture(target, opaque ? InternalFormat::rgb8 : InternalFormat::rgba8, std::move(faces));
  if (texture && !is_rectangle) texture = with_mipmaps(*texture);
  if (texture) return texture;
  return Diagnostic{.message = texture.error().message, .file = names[0]};
}

}  // namespace ninebit::playground
