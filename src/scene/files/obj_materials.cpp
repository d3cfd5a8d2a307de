#include "src/scene/files/obj_materials.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <system_error>

#include "src/scene/files/scene_readers.h"
#include "src/scene/files/text_scan.h"
#include "src/scene/scene_check.h"
#include "src/system/lines.h"

namespace ninebit {
namespace {

constexpr const char* kUnnamed = "DefaultMaterial";
constexpr glm::vec3 kDefaultColor(0.6F);

// The colour of a Kd line; nothing for a spectral curve, CIE coordinates or invalid numbers.
std::optional<glm::vec3> diffuse_of(const std::vector<std::string_view>& words) {
  glm::vec3 color(0.0F);
  for (glm::length_t i = 0; i < 3; ++i) {
    const auto at = static_cast<std::size_t>(i) + 1;
    if (at >= words.size()) {
      if (i == 0) return std::nullopt;
      color[i] = color[0];  // one number is a grey
      continue;
    }
    const std::optional<float> value = real_of<float>(words[at]);
    if (!value || !std::isfinite(*value)) return std::nullopt;
    color[i] = *value;
  }
  return glm::clamp(color, 0.0F, 1.0F);
}

std::string with_slashes(std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  return name;
}

}  // namespace

std::string joined_words(const std::vector<std::string_view>& words, std::size_t first) {
  std::string out;
  for (std::size_t i = first; i < words.size(); ++i) {
    if (i > first) out.push_back(' ');
    out.append(words[i]);
  }
  return out;
}

ObjMaterials::ObjMaterials() : names_{kUnnamed} {}

std::uint32_t ObjMaterials::use(const std::string& name) {
  const auto [place, added] =
      numbers_.try_emplace(name.empty() ? kUnnamed : name, static_cast<std::uint32_t>(names_.size()));
  if (added) names_.push_back(place->first);
  return place->second;
}

std::optional<std::string> ObjMaterials::add_library(const std::vector<std::string_view>& words) {
  if (words.size() < 2) return std::nullopt;
  // A blank may separate the names of libraries, or be part of one name: both are tried.
  std::vector<std::string> names{with_slashes(joined_words(words, 1))};
  for (std::size_t i = 1; i < words.size() && words.size() > 2; ++i)
    names.push_back(with_slashes(std::string(words[i])));
  if (std::find(libraries_.begin(), libraries_.end(), names) != libraries_.end()) return std::nullopt;
  libraries_.push_back(std::move(names));
  std::size_t count = 0;
  for (const std::vector<std::string>& line : libraries_) count += line.size();
  if (count <= kMostLibraries) return std::nullopt;
  return fmt::format("names more than {} material libraries", kMostLibraries);
}

std::uint32_t ObjMaterials::index_in(Scene& scene, const std::string& name) {
  const auto [place, added] = indices_.try_emplace(name, static_cast<std::uint32_t>(scene.materials.size()));
  if (added) scene.materials.push_back({.name = name, .base_color = kDefaultColor});
  return place->second;
}

void ObjMaterials::read_library(const NamedFiles& beside, std::string_view text, Scene& scene) {
  LineScanner lines(without_mark(text));
  std::string_view line;
  std::vector<std::string_view> words;
  std::optional<std::uint32_t> current;
  while (lines.next(line)) {
    if (line.size() > kLongestTextLine) continue;  // not a name or a colour
    split_words(line, words);
    if (words.empty()) continue;
    if (words[0] == "newmtl") {
      current = index_in(scene, words.size() > 1 ? joined_words(words, 1) : kUnnamed);
    } else if ((words[0] == "Kd" || words[0] == "kd") && current) {
      if (const auto color = diffuse_of(words)) scene.materials[*current].base_color = *color;
    } else if (current) {
      statements_.read(beside, words, scene, scene.materials[*current]);
    }
  }
}

std::optional<Diagnostic> ObjMaterials::try_library(const NamedFiles& beside, const std::string& name, Scene& scene,
                                                    bool& found) {
  if (const Status allowed = beside.check(name); !allowed) return allowed.error();
  const std::filesystem::path path = beside.path_of(name);
  std::error_code error;
  found = std::filesystem::exists(path, error);
  if (!found || !read_.insert(path).second) return std::nullopt;
  if (std::filesystem::is_regular_file(path, error) && std::filesystem::file_size(path, error) == 0)
    return std::nullopt;
  const Result<std::string> text = beside.read(name, left_);
  if (!text) return fault_of(fmt::format("its material library '{}' {}", name, text.error().message));
  left_ -= text->size();
  read_library(beside, *text, scene);
  return std::nullopt;
}

std::optional<Diagnostic> ObjMaterials::read_missing(const NamedFiles& beside, const std::string& name, Scene& scene) {
  bool found = false;
  const std::string other = beside.sibling(".mtl");
  if (auto fault = try_library(beside, other, scene, found)) return fault;
  scene.notes.push_back(found
                            ? fmt::format("the material library '{}' was not found; '{}' was read instead", name, other)
                            : fmt::format("the material library '{}' was not found; its materials are grey", name));
  return std::nullopt;
}

std::optional<Diagnostic> ObjMaterials::read_libraries(const NamedFiles& beside, Scene& scene) {
  for (const std::vector<std::string>& line : libraries_) {
    bool found = false;
    if (auto fault = try_library(beside, line[0], scene, found)) return fault;
    if (found) continue;
    if (line.size() == 1) {
      if (auto fault = read_missing(beside, line[0], scene)) return fault;
    }
    for (std::size_t i = 1; i < line.size(); ++i) {
      if (auto fault = try_library(beside, line[i], scene, found)) return fault;
      if (found) continue;
      if (auto fault = read_missing(beside, line[i], scene)) return fault;
    }
  }
  return std::nullopt;
}

Result<std::vector<std::uint32_t>> ObjMaterials::resolve(const NamedFiles& beside, bool used, Scene& scene) {
  static_cast<void>(index_in(scene, kUnnamed));
  if (used) {
    if (auto fault = read_libraries(beside, scene)) return *fault;
  }
  statements_.add_notes(scene);
  std::vector<std::uint32_t> indices;
  for (const std::string& name : names_) indices.push_back(index_in(scene, name));
  return indices;
}

namespace {

constexpr Sampler kTrilinear{.min_filter = MinFilter::linear_mipmap_linear};

// An option of a texture statement: how many words follow it. Those beyond `least` are numbers.
struct TextureOption {
  std::string_view name;
  std::size_t least, most;
  bool moves;  // it changes where or how strongly the picture appears
};
constexpr std::array kOptions{TextureOption{"-o", 1, 3, true},       TextureOption{"-s", 1, 3, true},
                              TextureOption{"-t", 1, 3, true},       TextureOption{"-mm", 2, 2, true},
                              TextureOption{"-bm", 1, 1, false},     TextureOption{"-boost", 1, 1, false},
                              TextureOption{"-texres", 1, 1, false}, TextureOption{"-blendu", 1, 1, false},
                              TextureOption{"-blendv", 1, 1, false}, TextureOption{"-cc", 1, 1, false},
                              TextureOption{"-clamp", 1, 1, false},  TextureOption{"-imfchan", 1, 1, false},
                              TextureOption{"-type", 1, 1, false}};

std::string lower(std::string_view word) {
  std::string out(word);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

bool is_number(std::string_view word) {
  const auto value = real_of<float>(word);
  return value.has_value();
}

}  // namespace

void ObjSurfaces::read(const NamedFiles& beside, const std::vector<std::string_view>& words, Scene& scene,
                       Material& material) {
  const std::string key = lower(words[0]);
  if (key == "map_kd") {
    read_texture(beside, words, scene, material);
  } else if ((key == "d" || key == "tr") && words.size() > 1) {
    // "d -halo factor" depends on the view.
    const auto value = real_of<float>(words[words[1] == "-halo" && words.size() > 2 ? 2 : 1]);
    if (!value || !std::isfinite(*value)) return;
    material.alpha = std::clamp(key == "d" ? *value : 1.0F - *value, 0.0F, 1.0F);
    material.alpha_mode = material.alpha < 1.0F ? AlphaMode::blend : AlphaMode::opaque;
    transparent_ = transparent_ || material.alpha < 1.0F;
  } else if (key == "map_bump" || key == "bump" || key == "norm" || key == "map_kn") {
    normal_maps_ = true;
  } else if (key == "map_d" || key == "map_opacity") {
    opacity_maps_ = true;
  } else if (key.starts_with("map_") || key == "disp" || key == "decal" || key == "refl") {
    other_maps_ = true;
  }
}

void ObjSurfaces::read_texture(const NamedFiles& beside, const std::vector<std::string_view>& words, Scene& scene,
                               Material& material) {
  Sampler sampler = kTrilinear;
  std::size_t at = 1;
  while (at < words.size() && words[at].starts_with('-')) {
    const auto option =
        std::find_if(kOptions.begin(), kOptions.end(), [&](const TextureOption& o) { return o.name == words[at]; });
    if (option == kOptions.end()) break;  // a name that begins with '-'
    if (option->name == "-clamp" && at + 1 < words.size() && lower(words[at + 1]) == "on")
      sampler.wrap_s = sampler.wrap_t = Wrap::clamp_to_edge;
    placed_ = placed_ || option->moves;
    at += 1 + option->least;
    for (std::size_t more = option->least; more < option->most && at + 1 < words.size() && is_number(words[at]); ++more)
      ++at;
  }
  if (at >= words.size()) return;
  std::string name = joined_words(words, at);
  std::replace(name.begin(), name.end(), '\\', '/');
  const auto [place, added] = textures_.try_emplace(name, static_cast<std::uint32_t>(scene.textures.size()));
  if (added) name_picture(beside, name, scene.textures.emplace_back());
  material.base_texture = place->second;
  material.sampler = sampler;
}

void ObjSurfaces::add_notes(Scene& scene) const {
  if (normal_maps_) scene.notes.emplace_back("normal maps");
  if (opacity_maps_) scene.notes.emplace_back("opacity maps");
  if (other_maps_) scene.notes.emplace_back("textures other than map_Kd");
  if (placed_) scene.notes.emplace_back("offset, scale and turbulence of textures");
  if (transparent_) scene.notes.emplace_back("alpha blending");
}

}  // namespace ninebit
