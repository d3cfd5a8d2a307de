// The files that a scene's file names.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>

#include "ninebit/numerics/result.h"

namespace ninebit {

// Reads a whole file: a regular one that is not empty and has at most `most` bytes. Diagnostics come without the name.
[[nodiscard]] Result<std::string> read_whole_file(const std::filesystem::path& file, std::uint64_t most);

// Finds and reads the files that stand beside a scene's file and that it names.
class NamedFiles {
 public:
  // `file`: the scene's. `allow_outside`: names may lead out of its folder.
  NamedFiles(const std::filesystem::path& file, bool allow_outside)
      : folder_(file.parent_path()), stem_(file.stem().string()), allow_outside_(allow_outside) {}

  // The name of the scene's file with another extension.
  [[nodiscard]] std::string sibling(const std::string& extension) const { return stem_ + extension; }

  // Nothing if the file may be read as far as its name says; otherwise why not, naming it.
  [[nodiscard]] Status check(std::string_view name) const;

  // The path that a name means, with one spelling for "a.bin" and "./a.bin".
  [[nodiscard]] std::filesystem::path path_of(std::string_view name) const;

  // Its content. Only after check().
  [[nodiscard]] Result<std::string> read(std::string_view name, std::uint64_t most) const;

 private:
  std::filesystem::path folder_;
  std::string stem_;
  bool allow_outside_;
};

}  // namespace ninebit
