#include "src/gl_layer/driver/log.h"

#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <set>
#include <string>

namespace ninebit::gl_layer {
namespace {

std::FILE* log_file() {
  static std::FILE* const file = [] {
    const char* const name = std::getenv("NINEBIT_GL_LOG");
    std::FILE* const opened = name != nullptr && *name != '\0' ? std::fopen(name, "a") : nullptr;
    return opened != nullptr ? opened : stderr;
  }();
  return file;
}

}  // namespace

void log_line(std::string_view message) {
  const std::string line = "ninebit: " + std::string(message) + '\n';
  std::fwrite(line.data(), 1, line.size(), log_file());
  std::fflush(log_file());
}

void log_once(std::string_view message) {
  // Never destroyed: programs draw from their own destructors.
  static auto& mutex = *new std::mutex;
  static auto& written = *new std::set<std::string, std::less<>>;
  const std::lock_guard lock(mutex);
  if (written.emplace(message).second) log_line(message);
}

}  // namespace ninebit::gl_layer
