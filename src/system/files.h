// Files beyond the standard library: created exclusively, finished, renamed together.
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>
#include <string>
#include <system_error>

namespace ninebit::posix {

// 128 random bits as hexadecimal digits. A file name with them cannot be guessed, so nobody can put a link in its way.
[[nodiscard]] std::string unpredictable_digits();

// Makes `file`, which is to replace `target`, ready for that: gives it the permission bits of the regular file that
// stands there, if one does, and waits until its content is on the disk. A link at `file` is an error.
[[nodiscard]] std::error_code finish_file(const std::filesystem::path& file, const std::filesystem::path& target);

// Creates an empty file; an existing one, or a link of that name, is an error.
[[nodiscard]] std::error_code create_new(const std::filesystem::path& file);

// A file on its way to its name.
struct Move {
  std::filesystem::path from, to;
  std::filesystem::path older;  // a hard link to what stands at `to`; empty: nothing does, or there is no such link
  bool replaces = false;        // something stands at `to`
};

// Which move failed, and why; 0: none did.
struct MoveFailure {
  std::size_t move = 0;
  int error = 0;
};

// Renames all files, or none: what was renamed before a failure is taken back, as far as there are links to what was
// replaced; these are removed. Several files are renamed by a process of its own, which goes on where this one is
// killed meanwhile: so no signal leaves some renamed and some not.
[[nodiscard]] MoveFailure move_all(std::span<const Move> moves);

}  // namespace ninebit::posix
