// Inputs read piece by piece: a stream of any length needs constant memory, and an interrupt ends a wait.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "src/system/stream.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

class InputFile {
 public:
  // "-" is standard input. Reports a file that cannot be opened, and anything but a regular file.
  [[nodiscard]] static Result<InputFile> open(const std::string& path);

  [[nodiscard]] const std::string& name() const { return name_; }

  // The next bytes, valid until the next call; empty at the end. An interrupt ends the wait with a Diagnostic of
  // Fault::cancelled.
  [[nodiscard]] Result<std::string_view> read();

 private:
  InputFile(std::string name, posix::Stream stream);

  std::string name_;
  posix::Stream stream_;
  std::vector<char> buffer_;
};

}  // namespace ninebit::tools
