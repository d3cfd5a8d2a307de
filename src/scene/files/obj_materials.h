// The materials of an OBJ file: their names, and their colours from its libraries.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"
#include "src/scene/files/named_files.h"
#include "src/scene/files/scene_readers.h"

namespace ninebit {

// The statements of an OBJ file's material libraries besides the diffuse colour: textures, and what is left out.

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

// The words of a name joined by single blanks.
[[nodiscard]] std::string joined_words(const std::vector<std::string_view>& words, std::size_t first);

class ObjMaterials {
 public:
  ObjMaterials();

  // Selects the material of the following faces; returns its number in the order of the file's material names. 0 is the
  // material of faces before any `usemtl`; an empty name is the default material's.
  [[nodiscard]] std::uint32_t use(const std::string& name);

  // Stores the libraries of a `mtllib` line. Returns a fault if there are too many.
  [[nodiscard]] std::optional<std::string> add_library(const std::vector<std::string_view>& words);

  // Appends the materials to the scene's. Reads the libraries only if `used`: a face has a material. Returns the
  // scene's material for each number of use(). A missing library is noted in the scene.
  [[nodiscard]] Result<std::vector<std::uint32_t>> resolve(const NamedFiles& beside, bool used, Scene& scene);

 private:
  [[nodiscard]] std::optional<Diagnostic> read_libraries(const NamedFiles& beside, Scene& scene);
  [[nodiscard]] std::optional<Diagnostic> try_library(const NamedFiles& beside, const std::string& name, Scene& scene,
                                                      bool& found);
  // For a missing library: reads the one with the OBJ file's own name, if it exists.
  [[nodiscard]] std::optional<Diagnostic> read_missing(const NamedFiles& beside, const std::string& name, Scene& scene);
  void read_library(const NamedFiles& beside, std::string_view text, Scene& scene);
  [[nodiscard]] std::uint32_t index_in(Scene& scene, const std::string& name);

  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
  ObjSurfaces statements_;
  std::set<std::filesystem::path> read_;
  std::uint64_t left_ = kMostSceneBytes;                    // bytes of libraries that may still be read
  std::vector<std::vector<std::string>> libraries_;         // per line: the whole text as one name, then each word
  std::unordered_map<std::string, std::uint32_t> indices_;  // of the scene's materials, by name
};

}  // namespace ninebit
