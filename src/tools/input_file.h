// Inputs read piece by piece, so that a stream of any length needs constant memory and an interrupt is seen in time.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"
#include "src/tools/program.h"

namespace ninebit::tools {

class InputFile {
 public:
  // "-" is standard input. A folder is refused here, too.
  [[nodiscard]] static Result<InputFile> open(const std::string& path);

  InputFile(InputFile&& other) noexcept;
  InputFile& operator=(InputFile&&) = delete;
  InputFile(const InputFile&) = delete;
  InputFile& operator=(const InputFile&) = delete;
  ~InputFile();

  [[nodiscard]] const std::string& name() const { return name_; }

  // The next bytes, valid until the next call; empty at the end. With `stoppable`, for verbs that have a ProgressLine,
  // an interrupt ends the wait for more with a cancelled Diagnostic.
  [[nodiscard]] Result<std::string_view> read(bool stoppable = false);

 private:
  explicit InputFile(std::string name, int descriptor);

  std::string name_;
  int descriptor_ = -1;
  std::vector<char> buffer_;
};

}  // namespace ninebit::tools
