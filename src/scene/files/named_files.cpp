#include "src/scene/files/named_files.h"

#include <fmt/format.h>

#include <fstream>
#include <optional>
#include <system_error>

#include "src/scene/fault_of.h"
#include "src/system/inside_folder.h"

namespace ninebit {

Result<std::string> read_whole_file(const std::filesystem::path& file, std::uint64_t most) {
  std::error_code error;
  const std::filesystem::file_status status = std::filesystem::status(file, error);
  if (status.type() == std::filesystem::file_type::not_found)
    return fault_of("cannot be opened: there is no such file");
  if (status.type() == std::filesystem::file_type::directory) return fault_of("is a folder, not a scene file");
  if (status.type() == std::filesystem::file_type::none)
    return fault_of(fmt::format("cannot be opened: {}", error.message()));
  if (status.type() != std::filesystem::file_type::regular) return fault_of("is not a regular file");
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) return fault_of(fmt::format("cannot be opened: {}", error.message()));
  if (size == 0) return fault_of("is empty");
  if (size > most) return fault_of(fmt::format("has {} bytes; at most {} are read", size, most));
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return fault_of("cannot be opened for reading");
  std::string content(static_cast<std::size_t>(size), '\0');
  stream.read(content.data(), static_cast<std::streamsize>(size));
  if (stream.gcount() != static_cast<std::streamsize>(size)) return fault_of("could not be read to its end");
  return content;
}

Status NamedFiles::check(std::string_view name) const {
  if (name.empty() || name.find('\0') != std::string_view::npos)
    return fault_of("names a file whose name is empty or has a byte 0");
  if (alone_) return fault_of("names another file, and files are read alone here");
  if (allow_outside_) return {};
  if (const std::optional<std::string> why = posix::why_outside(folder_, name))
    return fault_of(fmt::format("names a file that is not allowed without --allow-outside: {}", *why));
  return {};
}

std::filesystem::path NamedFiles::path_of(std::string_view name) const {
  // After a symbolic link, ".." is not the folder in the text; such names are only read if the user allows them.
  const std::filesystem::path path = folder_ / name;
  return allow_outside_ ? path : path.lexically_normal();
}

Result<std::string> NamedFiles::read(std::string_view name, std::uint64_t most) const {
  return read_whole_file(path_of(name), most);
}

void name_picture(const NamedFiles& beside, const std::string& name, SceneTexture& out) {
  out.name = name;
  if (const Status allowed = beside.check(name); !allowed) {
    out.fault = allowed.error().message;
  } else {
    out.file = beside.path_of(name);
  }
}

}  // namespace ninebit
