// One output of a verb: a file that appears when it is complete, or standard output.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ninebit/image/staged_files.h"
#include "ninebit/numerics/result.h"
#include "src/page/diagram_page.h"
#include "src/system/stream.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

class OutputFile {
 public:
  // The empty path is standard output. Devices and pipes are written directly. Any other file is written under a
  // temporary name and renamed by finish(), through symbolic links, so that an older file stays whole until then. The
  // new file gets the permission bits of the older one.
  [[nodiscard]] static Result<OutputFile> open(const std::string& path);

  [[nodiscard]] Status write(std::string_view bytes);
  [[nodiscard]] Status finish();

 private:
  OutputFile(std::string name, posix::Stream stream, std::optional<StagedFiles> staged);

  std::string name_;
  bool is_answer_ = false;  // standard output
  posix::Stream stream_;
  std::optional<StagedFiles> staged_;
};

// Writes a text as one output.
[[nodiscard]] Status write_output(const std::string& path, std::string_view text);

// Opens the folder that a verb writes into; the empty path is none.
[[nodiscard]] Result<std::optional<StagedFiles>> open_folder(const std::string& path);

// Writes a text under the staged name of a file.
[[nodiscard]] Status write_staged(StagedFiles& files, const std::string& name, std::string_view text);

// -o PAGE.html of the verbs that write one page.

// Adds -o, --output.
CLI::Option* add_page_flag(CLI::App& verb, std::string& output);

// Writes the page under a temporary name and renames it.
[[nodiscard]] Status write_page(const std::string& path, const DiagramPage& page);

}  // namespace ninebit::tools
