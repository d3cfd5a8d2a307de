// One output of a verb: a file that appears when it is complete, or standard output.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "ninebit/image/staged_files.h"
#include "ninebit/numerics/result.h"

namespace ninebit::tools {

class OutputFile {
 public:
  // The empty path is standard output. Devices and pipes are written to as they are; any other file is made aside and
  // takes its name in finish(), through symbolic links, so that an older one stays whole until then.
  [[nodiscard]] static Result<OutputFile> open(const std::string& path);

  OutputFile(OutputFile&& other) noexcept;
  OutputFile& operator=(OutputFile&&) = delete;
  OutputFile(const OutputFile&) = delete;
  OutputFile& operator=(const OutputFile&) = delete;
  ~OutputFile();

  [[nodiscard]] Status write(std::string_view bytes);
  [[nodiscard]] Status finish();

 private:
  OutputFile(std::string name, int descriptor, std::optional<StagedFiles> staged);

  std::string name_;
  int descriptor_ = -1;
  std::optional<StagedFiles> staged_;
};

}  // namespace ninebit::tools
