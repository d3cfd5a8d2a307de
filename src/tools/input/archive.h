// Effects inside ZIP archives: a frame that `gl-run --dump-frame` captured, or what the playground saves.
#pragma once

#include <filesystem>
#include <memory>
#include <string>

#include "ninebit/numerics/result.h"

namespace ninebit::tools {

// An effect's file, unpacked if it lies in an archive. The unpacked files are removed with the object.
class EffectFile {
 public:
  // `name` is a file, an archive, whose first effect is taken, or ARCHIVE/NAME, an effect of an archive. A file that is
  // not an archive is left as it is, also if it is missing. Reports a damaged archive, and one without that effect.
  [[nodiscard]] static Result<EffectFile> open(const std::string& name);

  // Where the effect can be read.
  [[nodiscard]] const std::string& path() const { return path_; }
  // Whether it is an effect: what lies in an archive was chosen as one, and of another file the text says so.
  [[nodiscard]] bool is_effect() const;
  // Which effect was taken, if the archive has several, and a profile.json beside it; empty: nothing is to be said.
  [[nodiscard]] const std::string& note() const { return note_; }

 private:
  // A folder for temporary files.
  class Folder {
   public:
    explicit Folder(std::filesystem::path path) : path_(std::move(path)) {}
    ~Folder();
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    [[nodiscard]] const std::filesystem::path& path() const { return path_; }

   private:
    std::filesystem::path path_;
  };

  std::string path_{}, note_{};
  std::shared_ptr<const Folder> folder_{};
};

}  // namespace ninebit::tools
