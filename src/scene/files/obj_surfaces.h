// The statements of an OBJ file's material libraries besides the diffuse colour: textures, and what is left out.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ninebit/scene/scene.h"
#include "src/scene/files/named_files.h"

namespace ninebit {

class ObjSurfaces {
 public:
  // Reads one statement of a material: `map_Kd` with its options; `d` and `Tr`. Remembers statements that are left out.
  void read(const NamedFiles& beside, const std::vector<std::string_view>& words, Scene& scene, Material& material);

  // Adds a note of each kind that was left out.
  void add_notes(Scene& scene) const;

 private:
  void read_texture(const NamedFiles& beside, const std::vector<std::string_view>& words, Scene& scene,
                    Material& material);

  std::unordered_map<std::string, std::uint32_t> textures_;  // of the scene, by name
  // Whether it was found.
  bool normal_maps_ = false, opacity_maps_ = false, other_maps_ = false, placed_ = false, transparent_ = false;
};

}  // namespace ninebit
