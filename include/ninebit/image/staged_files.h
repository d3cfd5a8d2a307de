// Output files that appear all together or not at all: each is written under a temporary name in the target folder, and
// all are renamed after the last is complete.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// A set of output files in one folder. The destructor removes files that were not committed, and folders that open()
// created if nothing was committed into them. Older files of the same names stay whole until commit() renames the new
// ones over them.
class StagedFiles {
 public:
  // Creates the folder and its parents if they are missing. Reports a folder that cannot be created or written into.
  // The empty path is the current folder.
  [[nodiscard]] static Result<StagedFiles> open(const std::filesystem::path& folder);

  // A moved-from object has no files and removes nothing.
  StagedFiles(StagedFiles&& other) noexcept;
  StagedFiles& operator=(StagedFiles&& other) noexcept;
  StagedFiles(const StagedFiles&) = delete;
  StagedFiles& operator=(const StagedFiles&) = delete;
  ~StagedFiles();

  // The temporary path at which the writer must create the file `name`. `name` must be a plain file name; commit()
  // reports any other. The path has the extension of `name`; the same name returns the same path. The path cannot be
  // guessed before the file exists, so a writer that creates it exclusively never writes into a foreign file.
  [[nodiscard]] std::filesystem::path stage(const std::string& name);

  // Flushes every staged file to the disk and renames it to its name, in the order of staging. A file that replaces
  // another gets that file's permission bits. Reports a staged file that was not written, a name that is a folder, and
  // a failed rename; the files renamed before it are then removed and the older ones restored, if the file system has
  // hard links. A separate process renames several files, so that a signal that ends this process, including SIGKILL,
  // leaves either all of them renamed or none. The folder is locked meanwhile: if two programs commit the same names,
  // it holds the files of one of them. Reports a lock that another program holds for 10 s. A folder that cannot be
  // locked, because it is not readable or its file system has no locks, is written without a lock.
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
