// A file that no disk holds, for what reads files by their names.
#pragma once

#include <string>
#include <string_view>

namespace ninebit::fuzz {

class MemoryFile {
 public:
  explicit MemoryFile(std::string_view bytes);
  MemoryFile(const MemoryFile&) = delete;
  MemoryFile& operator=(const MemoryFile&) = delete;
  ~MemoryFile();

  // A path to it, which opens it anew.
  [[nodiscard]] std::string path() const;

 private:
  int descriptor_ = -1;
};

}  // namespace ninebit::fuzz
