// The materials of an OBJ file: their names, and their colours from the libraries that it names.
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
#include "src/scene/named_files.h"
#include "src/scene/read_limits.h"

namespace ninebit {

// The words of a name as one text, with one blank between them.
[[nodiscard]] std::string joined_words(const std::vector<std::string_view>& words, std::size_t first);

class ObjMaterials {
 public:
  ObjMaterials();

  // The material of the faces that follow, by its number among those that the file names. 0 is that of faces before
  // any; an empty name is the default material's.
  [[nodiscard]] std::uint32_t use(const std::string& name);

  // Remembers the libraries that a `mtllib` line names. Reports too many of them.
  [[nodiscard]] std::optional<std::string> add_library(const std::vector<std::string_view>& words);

  // Reads the libraries where a face has a material, and appends to the scene's materials. The result gives for each
  // number of use() the scene's material. A library that is not there is noted in the scene.
  [[nodiscard]] Result<std::vector<std::uint32_t>> resolve(const NamedFiles& beside, bool used, Scene& scene);

 private:
  [[nodiscard]] std::optional<Diagnostic> read_libraries(const NamedFiles& beside, Scene& scene);
  [[nodiscard]] std::optional<Diagnostic> try_library(const NamedFiles& beside, const std::string& name, Scene& scene,
                                                      bool& found);
  // In place of a library that is not there: the one that has the file's own name, if there is one.
  [[nodiscard]] std::optional<Diagnostic> read_missing(const NamedFiles& beside, const std::string& name, Scene& scene);
  void read_library(std::string_view text, Scene& scene);
  [[nodiscard]] std::uint32_t index_in(Scene& scene, const std::string& name);

  std::vector<std::string> names_;
  std::unordered_map<std::string, std::uint32_t> numbers_;
  std::set<std::filesystem::path> read_;
  std::uint64_t left_ = kMostSceneBytes;                    // bytes of libraries that may still be read
  std::vector<std::vector<std::string>> libraries_;         // each line's names, as one name and as several
  std::unordered_map<std::string, std::uint32_t> indices_;  // of the scene's materials by their names
};

}  // namespace ninebit
