// Outputs that appear all together or not at all: each is written aside under a temporary name in the target folder and
// renamed when everything has been written.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A set of output files in one folder. Files that are not committed are removed by the destructor, and so are folders
// that open() made when nothing was committed into them; older files of the same names stay whole until commit()
// renames the new ones over them.
class StagedFiles {
 public:
  // Makes the folder (and its parents) where it is missing. Reports a folder that cannot be made or written into. The
  // empty path is the current folder.
  [[nodiscard]] static Result<StagedFiles> open(const std::filesystem::path& folder);

  // What was moved from has no files and removes nothing.
  StagedFiles(StagedFiles&& other) noexcept;
  StagedFiles& operator=(StagedFiles&& other) noexcept;
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;
  ~StagedFiles();

  // The temporary path under which the writer must create the file that will be called `name` (a plain file name; any
  // other is reported by commit). It ends in the extension of `name`. The same name gives the same path. Nobody can
  // guess the path before the file is there, so a writer that creates it exclusively writes into no file of others.
  [[nodiscard]] std::filesystem::path stage(const std::string& name);

  // Brings every staged file to the disk and renames it to its name, in the order of staging. A file that replaces
  // another gets that one's permission bits. Reports a staged file that was not written, a name that is taken by a
  // folder, and what could not be renamed; the files that were renamed before are then taken back and the older ones
  // restored, as far as the file system has hard links. A process of its own renames several files, so that a signal
  // that ends this one, SIGKILL too, leaves all of them renamed or none. The folder is locked meanwhile: of two
  // programs that commit the same names, the folder holds the files of one. Reports a lock that is held for 10 s. A
  // folder that cannot be locked, because it may not be read or its file system has no locks, is written without one.
  [[nodiscard]] Status commit();

  // The final paths, in the order of staging.
  [[nodiscard]] std::vector<std::filesystem::path> files() const;

 private:
  struct Entry {
    std::string name;
    std::filesystem::path temporary;
    bool committed = false;
  };

  explicit StagedFiles(std::filesystem::path folder);
  void discard() noexcept;
  Status check_before_commit() const;

  std::filesystem::path folder_;
  std::vector<std::filesystem::path> made_folders_;  // by open(), outermost first
  std::vector<Entry> entries_;
};

}  // namespace ninebit
