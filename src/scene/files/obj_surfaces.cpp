#include "src/scene/files/obj_surfaces.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "src/scene/files/obj_materials.h"
#include "src/scene/files/text_scan.h"

namespace ninebit {
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
