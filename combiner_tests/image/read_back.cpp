#include "combiner_tests/image/read_back.h"

#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace image_test {

namespace fs = std::filesystem;

std::string read_bytes(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write_bytes(const fs::path& file, std::string_view bytes) {
  std::ofstream(file, std::ios::binary) << bytes;
}

std::vector<std::string> png_chunks(std::string_view png) {
  std::vector<std::string> names;
  std::size_t at = 8;
  while (at + 12 <= png.size()) {
    std::size_t size = 0;
    for (std::size_t b = 0; b < 4; ++b) size = (size << 8) | static_cast<std::uint8_t>(png[at + b]);
    names.emplace_back(png.substr(at + 4, 4));
    at += 12 + size;
  }
  return names;
}

FileSizeLimit::FileSizeLimit(std::uint64_t bytes) {
  handler_before_ = std::signal(SIGXFSZ, SIG_IGN);
  rlimit limit = {};
  if (::getrlimit(RLIMIT_FSIZE, &limit) != 0) throw std::runtime_error("getrlimit failed");
  before_ = limit.rlim_cur;
  limit.rlim_cur = bytes;
  if (::setrlimit(RLIMIT_FSIZE, &limit) != 0) throw std::runtime_error("setrlimit failed");
}

FileSizeLimit::~FileSizeLimit() {
  rlimit limit = {};
  if (::getrlimit(RLIMIT_FSIZE, &limit) == 0) {
    limit.rlim_cur = before_;
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  std::signal(SIGXFSZ, handler_before_);
}

}  // namespace image_test
