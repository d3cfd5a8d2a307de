#include "src/tools/output_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <system_error>
#include <utility>

namespace ninebit::tools {
namespace {

constexpr ::mode_t kMode = 0666;

Diagnostic cannot_write(const std::string& name, int why) {
  return {.message = "could not be written: " + std::generic_category().message(why),
          .file = name,
          .fault = Fault::cannot_write};
}

}  // namespace

OutputFile::OutputFile(std::string name, int descriptor, std::optional<StagedFiles> staged)
    : name_(std::move(name)), descriptor_(descriptor), staged_(std::move(staged)) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : name_(std::move(other.name_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      staged_(std::move(other.staged_)) {}

OutputFile::~OutputFile() {
  if (descriptor_ > STDERR_FILENO) ::close(descriptor_);
}

Result<OutputFile> OutputFile::open(const std::string& path) {
  namespace fs = std::filesystem;
  if (path.empty()) return OutputFile("standard output", STDOUT_FILENO, std::nullopt);
  struct stat about {};
  const bool exists = ::stat(path.c_str(), &about) == 0;
  if (exists && S_ISDIR(about.st_mode)) return cannot_write(path, EISDIR);
  if (exists && !S_ISREG(about.st_mode)) {
    const int descriptor = ::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_NOCTTY);
    if (descriptor < 0) return cannot_write(path, errno);
    return OutputFile(path, descriptor, std::nullopt);
  }
  std::error_code error;
  fs::path target = exists ? fs::canonical(path, error) : fs::path(path);
  if (error) return cannot_write(path, error.value());
  if (!target.has_filename()) return cannot_write(path, EISDIR);
  auto staged = StagedFiles::open(target.parent_path());
  if (!staged) return staged.error();
  const std::string aside = staged->stage(target.filename().string()).string();
  const int descriptor = ::open(aside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, kMode);
  if (descriptor < 0) return cannot_write(path, errno);
  return OutputFile(path, descriptor, std::move(*staged));
}

Status OutputFile::write(std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(descriptor_, bytes.data(), bytes.size());
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannot_write(name_, errno);
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return {};
}

Status OutputFile::finish() {
  if (descriptor_ > STDERR_FILENO && ::close(std::exchange(descriptor_, -1)) != 0) return cannot_write(name_, errno);
  return staged_ ? staged_->commit() : Status();
}

}  // namespace ninebit::tools
