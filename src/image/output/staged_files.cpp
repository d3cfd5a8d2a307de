#include "ninebit/image/staged_files.h"

#include <algorithm>
#include <chrono>
#include <string_view>
#include <system_error>
#include <utility>

#include "src/image/output/faults.h"
#include "src/system/file_lock.h"
#include "src/system/files.h"

namespace ninebit {

namespace fs = std::filesystem;

namespace {

using image_detail::cannot_write;

constexpr std::size_t kLongestStem = 64;  // bytes; keeps the temporary name within the limits of file systems
constexpr std::size_t kLongestExtension = 16;

// The longest wait for the lock of another process. Renaming takes milliseconds.
constexpr std::chrono::seconds kLongestWait{10};

// An unused, unpredictable name in the folder, with the extension of `name`, from which libraries derive the format.
fs::path unused_name(const fs::path& folder, std::string name) {
  std::replace_if(
      name.begin(), name.end(), [](char c) { return c == '/' || c == '\0'; }, '_');
  const std::string stem = fs::path(name).stem().string().substr(0, kLongestStem);
  const std::string extension = fs::path(name).extension().string().substr(0, kLongestExtension);
  return folder / ("." + stem + ".ninebit-" + posix::unpredictable_digits() + extension);
}

bool is_plain_name(const std::string& name) {
  return !name.empty() && name != "." && name != ".." &&
         name.find_first_of(std::string_view("/\0", 2)) == std::string::npos;
}

void remove_quietly(const fs::path& path) noexcept {
  std::error_code ignored;
  fs::remove(path, ignored);
}

// The moves of one commit. The destructor removes their links to older files.
struct Moves {
  std::vector<posix::Move> all;

  Moves() = default;
  Moves(const Moves&) = delete;
  Moves& operator=(const Moves&) = delete;
  ~Moves() {
    for (const posix::Move& move : all) {
      if (!move.older.empty()) remove_quietly(move.older);
    }
  }
};

// Links an older file at the target, so that it can be restored; impossible if the file system has no hard links.
posix::Move prepare(const fs::path& folder, const std::string& name, const fs::path& temporary) {
  posix::Move move{temporary, folder / name, {}, false};
  std::error_code error;
  move.replaces = fs::exists(fs::symlink_status(move.to, error));
  if (!move.replaces) return move;
  move.older = unused_name(folder, name);
  fs::create_hard_link(move.to, move.older, error);
  if (error) move.older.clear();
  return move;
}

}  // namespace

StagedFiles::StagedFiles(fs::path folder) : folder_(std::move(folder)) {}

StagedFiles::StagedFiles(StagedFiles&& other) noexcept
    : folder_(std::move(other.folder_)),
      made_folders_(std::exchange(other.made_folders_, {})),
      entries_(std::exchange(other.entries_, {})) {}

StagedFiles& StagedFiles::operator=(StagedFiles&& other) noexcept {
  if (this != &other) {
    discard();
    folder_ = std::move(other.folder_);
    made_folders_ = std::exchange(other.made_folders_, {});
    entries_ = std::exchange(other.entries_, {});
  }
  return *this;
}

StagedFiles::~StagedFiles() {
  discard();
}

void StagedFiles::discard() noexcept {
  for (const Entry& entry : entries_) {
    if (!entry.committed) remove_quietly(entry.temporary);
  }
  // Only empty folders are removed: one with a committed or a foreign file stays.
  for (auto folder = made_folders_.rbegin(); folder != made_folders_.rend(); ++folder) remove_quietly(*folder);
}

Result<StagedFiles> StagedFiles::open(const fs::path& folder) {
  StagedFiles staged(folder.empty() ? fs::path(".") : folder);
  fs::path step;
  for (const fs::path& name : staged.folder_) {
    step /= name;
    std::error_code error;
    if (fs::is_directory(step, error)) continue;
    if (fs::create_directory(step, error)) {
      staged.made_folders_.push_back(step);
    } else if (std::error_code ignored;
               !fs::is_directory(step, ignored)) {  // and no other process created it meanwhile
      if (!error) error = std::make_error_code(std::errc::not_a_directory);
      return cannot_write(folder, "the folder " + step.string() + " cannot be created: " + error.message());
    }
  }
  const fs::path probe = unused_name(staged.folder_, "probe");
  if (const std::error_code error = posix::create_new(probe)) {
    return cannot_write(folder, "the folder cannot be written into: " + error.message());
  }
  remove_quietly(probe);
  return staged;
}

fs::path StagedFiles::stage(const std::string& name) {
  for (const Entry& entry : entries_) {
    if (entry.name == name && !entry.committed) return entry.temporary;
  }
  return entries_.emplace_back(Entry{name, unused_name(folder_, name)}).temporary;
}

Status StagedFiles::check_before_commit() const {
  for (const Entry& entry : entries_) {
    if (entry.committed) continue;
    const fs::path target = folder_ / entry.name;
    std::error_code error;
    if (!is_plain_name(entry.name)) return cannot_write(target, "\"" + entry.name + "\" is not a plain file name");
    if (!fs::is_regular_file(fs::symlink_status(entry.temporary, error)))
      return cannot_write(target, "was not written");
    if (fs::is_directory(target, error)) return cannot_write(target, "a folder of that name exists");
    if ((error = posix::finish_file(entry.temporary, target))) {
      return cannot_write(target, "could not be flushed to the disk: " + error.message());
    }
  }
  return {};
}

Status StagedFiles::commit() {
  if (Status status = check_before_commit(); !status) return status;
  std::error_code error;
  const posix::FolderLock lock(folder_, kLongestWait, error);
  if (error) return cannot_write(folder_, "another program holds the lock of the folder");
  Moves moves;
  moves.all.reserve(entries_.size());
  for (const Entry& entry : entries_) {
    if (!entry.committed) moves.all.push_back(prepare(folder_, entry.name, entry.temporary));
  }
  if (const auto [move, why] = posix::move_all(moves.all); why != 0) {
    return cannot_write(moves.all[move].to, "could not be renamed into place: " + std::generic_category().message(why));
  }
  for (Entry& entry : entries_) entry.committed = true;
  return {};
}

std::vector<fs::path> StagedFiles::files() const {
  std::vector<fs::path> paths;
  paths.reserve(entries_.size());
  for (const Entry& entry : entries_) paths.push_back(folder_ / entry.name);
  return paths;
}

}  // namespace ninebit
