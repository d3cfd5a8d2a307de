// File operations beyond the standard library: exclusive creation, finishing, renaming several files together.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>

namespace ninebit::posix {

// 128 random bits as hexadecimal digits. A file name with them cannot be guessed, so nobody can place a link there in
// advance.
[[nodiscard]] std::string unpredictable_digits();

// Prepares `file` to replace `target`: copies the permission bits of `target` if it is a regular file, and waits until
// the content of `file` is on the disk. A link at `file` is an error.
[[nodiscard]] std::error_code finish_file(const std::filesystem::path& file, const std::filesystem::path& target);

// Creates an empty file; an existing one, or a link of that name, is an error. After an error there is no new file.
[[nodiscard]] std::error_code create_new(const std::filesystem::path& file);

// A rename from a temporary name to the final one.
struct Move {
  std::filesystem::path from, to;
  std::filesystem::path older;  // a hard link to the file at `to`; empty: there is no file, or no link
  bool replaces = false;        // a file exists at `to`
};

// The index of the failed move, and its errno; error 0: none failed.
struct MoveFailure {
  std::size_t move = 0;
  int error = 0;
};

// Renames all files or none. After a failure, earlier renames are undone as far as links to the replaced files exist;
// the links are removed in either case. A child process renames several files and continues if this process is killed,
// so a signal cannot leave only some of them renamed.
[[nodiscard]] MoveFailure move_all(std::span<const Move> moves);

}  // namespace ninebit::posix
