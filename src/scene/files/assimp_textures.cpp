#include "src/scene/files/assimp_textures.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <system_error>

namespace ninebit {
namespace {

bool is_there(const NamedFiles& beside, const std::string& name) {
  std::error_code error;
  return beside.check(name).ok() && std::filesystem::exists(beside.path_of(name), error);
}

// Whether a file was found; then the texture has its name.
bool find_picture(const NamedFiles& beside, SceneTexture& texture) {
  std::string name = texture.name;
  std::replace(name.begin(), name.end(), '\\', '/');
  for (const std::string& one : {name, name.substr(name.rfind('/') + 1)}) {
    if (one.empty() || !is_there(beside, one)) continue;
    name_picture(beside, one, texture);
    return true;
  }
  return false;
}

}  // namespace

void find_pictures(const NamedFiles& beside, Scene& scene) {
  for (std::size_t i = 0; i < scene.textures.size(); ++i) {
    SceneTexture& texture = scene.textures[i];
    if (!texture.bytes.empty() || !texture.fault.empty() || find_picture(beside, texture)) continue;
    scene.notes.push_back(fmt::format("the texture '{}', which was not found", texture.name));
    for (Material& material : scene.materials) {
      if (material.base_texture != static_cast<std::uint32_t>(i)) continue;
      material.base_texture.reset();
      material.base_color = Material{}.base_color;
    }
  }
}

}  // namespace ninebit
