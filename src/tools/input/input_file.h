// Inputs read piece by piece, so that a stream of any length needs constant memory and an interrupt is seen in time.
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
  // "-" is standard input. A folder is refused here, too.
  [[nodiscard]] static Result<InputFile> open(const std::string& path);

  [[nodiscard]] const std::string& name() const { return name_; }

  // The next bytes, valid until the next call; empty at the end. With `stoppable`, for verbs that have a ProgressLine,
  // an interrupt ends the wait for more with a cancelled Diagnostic.
  [[nodiscard]] Result<std::string_view> read(bool stoppable = false);

 private:
  InputFile(std::string name, posix::Stream stream);

  std::string name_;
  posix::Stream stream_;
  std::vector<char> buffer_;
};

}  // namespace ninebit::tools
