// The files that a scene file refers to, and the formats that ninebit reads itself.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"
#include "ninebit/scene/scene_io.h"

namespace ninebit {

// Reads a whole regular file that is not empty and has at most `most` bytes. Diagnostics do not contain its name.
[[nodiscard]] Result<std::string> read_whole_file(const std::filesystem::path& file, std::uint64_t most);

// Finds and reads the files that a scene file refers to.
class NamedFiles {
 public:
  // `file`: the scene file. `allow_outside`: names may lead out of its folder.
  NamedFiles(const std::filesystem::path& file, bool allow_outside)
      : folder_(file.parent_path()), stem_(file.stem().string()), allow_outside_(allow_outside) {}
  // For a scene file that is in memory: no other file is read.
  [[nodiscard]] static NamedFiles alone(const std::filesystem::path& file) {
    NamedFiles files(file, false);
    files.alone_ = true;
    return files;
  }

  // The name of the scene file with another extension.
  [[nodiscard]] std::string sibling(const std::string& extension) const { return stem_ + extension; }

  // Reports a name whose file may not be read; the message contains the name.
  [[nodiscard]] Status check(std::string_view name) const;

  // The path of a named file, normalized: the same for "a.bin" and "./a.bin".
  [[nodiscard]] std::filesystem::path path_of(std::string_view name) const;

  // The content of a named file. Only after check().
  [[nodiscard]] Result<std::string> read(std::string_view name, std::uint64_t most) const;

 private:
  std::filesystem::path folder_;
  std::string stem_;
  bool allow_outside_;
  bool alone_ = false;
};

// Names a picture: sets its name and file, or the fault of a name that may not be read. Opens no file.
void name_picture(const NamedFiles& beside, const std::string& name, SceneTexture& out);

// The extension of a file in lower case: ".obj".
[[nodiscard]] std::string lower_extension(const std::filesystem::path& file);

struct SceneFile;

// Reads a file of a format that ninebit reads itself: .gltf, .glb, .obj, .ply or .off; glTF 1.0 and compressed meshes
// need their libraries. Nothing for another extension.
[[nodiscard]] std::optional<Result<Scene>> read_own_format(const SceneFile& from, std::string_view content,
                                                           std::string_view extension, const SceneReadOptions& options);

// Gives a scene its file's name, and the axis that is to point up.
void name_and_turn(const std::filesystem::path& file, std::optional<UpAxis> up, Scene& scene);

// Scenes from memory, where no other file is at hand.

// Reads the content of a .gltf, .glb, .obj, .ply or .off file, by the extension of its name, as read_scene() does.
// Reports what read_scene() reports, with the name as the file; files that the scene names, except pictures, which stay
// unread; glTF 1.0 and Draco in a build without their libraries; and more than `most_triangles`.
[[nodiscard]] Result<Scene> scene_of_bytes(std::string_view content, const std::string& name, std::optional<UpAxis> up,
                                           std::uint64_t most_triangles);

}  // namespace ninebit
