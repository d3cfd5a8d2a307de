#include "src/tools/common/output_file.h"

#include <filesystem>
#include <system_error>
#include <utility>

#include "src/tools/input/program.h"

namespace ninebit::tools {

namespace {

Diagnostic cannot_write(const std::string& name, std::error_code why) {
  return {.message = "could not be written: " + why.message(), .file = name, .fault = Fault::cannot_write};
}

}  // namespace

OutputFile::OutputFile(std::string name, posix::Stream stream, std::optional<StagedFiles> staged)
    : name_(std::move(name)), stream_(std::move(stream)), staged_(std::move(staged)) {}

Result<OutputFile> OutputFile::open(const std::string& path) {
  namespace fs = std::filesystem;
  if (path.empty()) {
    OutputFile out("standard output", posix::Stream(posix::kStandardOutput), std::nullopt);
    out.is_answer_ = true;
    return out;
  }
  std::error_code error;
  const fs::file_status about = fs::status(path, error);
  const bool exists = fs::exists(about);
  error.clear();
  if (exists && !fs::is_regular_file(about)) {
    posix::Stream stream(path, posix::Access::write, error);
    if (error) return cannot_write(path, error);
    return OutputFile(path, std::move(stream), std::nullopt);
  }
  const fs::path target = exists ? fs::canonical(path, error) : fs::path(path);
  if (error) return cannot_write(path, error);
  if (!target.has_filename()) return cannot_write(path, std::make_error_code(std::errc::is_a_directory));
  auto staged = StagedFiles::open(target.parent_path());
  if (!staged) return staged.error();
  // finish() copies the older file's permission bits; until then only the owner may read the new file.
  const auto access = exists ? posix::Access::create_private : posix::Access::create;
  posix::Stream stream(staged->stage(target.filename().string()), access, error);
  if (error) return cannot_write(path, error);
  return OutputFile(path, std::move(stream), std::move(*staged));
}

Status OutputFile::write(std::string_view bytes) {
  if (is_answer_) log_answer();
  std::error_code error;
  stream_.write(bytes, error);
  if (error) return cannot_write(name_, error);
  return {};
}

Status OutputFile::finish() {
  std::error_code error;
  stream_.close(error);
  if (error) return cannot_write(name_, error);
  return staged_ ? staged_->commit() : Status();
}

Status write_output(const std::string& path, std::string_view text) {
  auto file = OutputFile::open(path);
  if (!file) return file.error();
  if (Status written = file->write(text); !written) return written;
  return file->finish();
}

Result<std::optional<StagedFiles>> open_folder(const std::string& path) {
  if (path.empty()) return std::optional<StagedFiles>();
  auto files = StagedFiles::open(path);
  if (!files) return files.error();
  return std::optional<StagedFiles>(std::move(*files));
}

Status write_staged(StagedFiles& files, const std::string& name, std::string_view text) {
  return write_output(files.stage(name).string(), text);
}

CLI::Option* add_page_flag(CLI::App& verb, std::string& output) {
  return verb
      .add_option("-o,--output", output, "Write a page with a diagram to this file, instead of text to standard output")
      ->type_name("FILE.html");
}

Status write_page(const std::string& path, const DiagramPage& page) {
  return write_output(path, diagram_page(page));
}

}  // namespace ninebit::tools
