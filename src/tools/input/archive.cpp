#include "src/tools/input/archive.h"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <fstream>
#include <optional>
#include <set>
#include <string_view>
#include <system_error>
#include <vector>

#include "ninebit/language/source_text.h"
#include "src/language/json/text_kind.h"
#include "src/system/archive_limits.h"
#include "src/system/files.h"
#include "src/system/stream.h"
#include "src/tools/input/printable.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

namespace fs = std::filesystem;

constexpr std::uint32_t kInZip64 = 0xFFFFFFFF;  // the number is elsewhere
constexpr std::uint64_t kMostDeflated = 1032;   // bytes from one
constexpr std::string_view kFileHeading = "PK\3\4", kDirectoryHeading = "PK\1\2", kEndHeading = "PK\5\6";
constexpr std::size_t kFileHeadingSize = 30, kDirectoryHeadingSize = 46, kEndHeadingSize = 22;

struct Entry {
  std::string name;
  std::string_view packed;
  unsigned method = 0;
  std::uint32_t crc = 0, size = 0;
};

// Little-endian; `at` and what follows lie in the text.
std::uint32_t number_at(std::string_view text, std::size_t at, std::size_t bytes) {
  std::uint32_t value = 0;
  for (std::size_t i = bytes; i-- > 0;) value = value << 8U | static_cast<unsigned char>(text[at + i]);
  return value;
}

// Whether a text is an effect, or would be one without its mistakes.
bool is_effect_text(std::string_view text) {
  const std::string_view content = without_heading(text);
  return content.starts_with('{') && json_kind(content) == "effect";
}

// Whether a name leads to a file below the folder in which the archive is unpacked.
bool leads_below(const std::string& name) {
  const fs::path path(name);
  return path.has_filename() && path.filename() != "." && name.find('\\') == std::string::npos &&
         name.find('\0') == std::string::npos && path.is_relative() &&
         std::none_of(path.begin(), path.end(), [](const fs::path& part) { return part == ".."; });
}

// The files of an archive, or what is wrong with it.
class Directory {
 public:
  explicit Directory(std::string_view archive) : archive_(archive) { read(); }
  [[nodiscard]] const std::vector<Entry>& entries() const { return entries_; }
  [[nodiscard]] const std::string& fault() const { return fault_; }

 private:
  void read() {
    const std::size_t end = archive_.rfind(kEndHeading);
    if (end == std::string_view::npos || archive_.size() - end < kEndHeadingSize) {
      fault_ = "is an archive that ends early";
      return;
    }
    std::size_t at = number_at(archive_, end + 16, 4);
    const std::size_t count = number_at(archive_, end + 10, 2);
    if (count == 0xFFFF || at == kInZip64) {
      fault_ = "is a ZIP64 archive, which is not read";
    } else if (count > kMostArchiveFiles) {
      fault_ = fmt::format("has {} files; at most {} are read", count, kMostArchiveFiles);
    }
    for (std::size_t i = 0; i < count && fault_.empty(); ++i) at = read_entry(at, end);
  }

  // Returns where the next one begins.
  std::size_t read_entry(std::size_t at, std::size_t end) {
    if (at > end || end - at < kDirectoryHeadingSize || !archive_.substr(at).starts_with(kDirectoryHeading)) {
      fault_ = "is a damaged archive: its directory is not whole";
      return end;
    }
    const std::size_t name_size = number_at(archive_, at + 28, 2);
    const std::size_t next =
        at + kDirectoryHeadingSize + name_size + number_at(archive_, at + 30, 2) + number_at(archive_, at + 32, 2);
    if (next > end) {
      fault_ = "is a damaged archive: its directory is not whole";
      return end;
    }
    Entry entry{.name = std::string(archive_.substr(at + kDirectoryHeadingSize, name_size)),
                .packed = {},
                .method = number_at(archive_, at + 10, 2),
                .crc = number_at(archive_, at + 16, 4),
                .size = number_at(archive_, at + 24, 4)};
    if (!entry.name.ends_with('/')) {
      check(entry, number_at(archive_, at + 8, 2), number_at(archive_, at + 42, 4), number_at(archive_, at + 20, 4));
      if (fault_.empty()) entries_.push_back(std::move(entry));
    }
    return next;
  }

  void check(Entry& entry, unsigned flags, std::size_t at, std::size_t packed) {
    const std::string given = std::move(entry.name), name = printable(given);
    entry.name = fs::path(given).lexically_normal().generic_string();  // one name for t/x.png and t//x.png
    bytes_ += entry.size;
    if (!leads_below(given)) {
      fault_ = fmt::format("names '{}', which does not lie in it", name);
    } else if (!names_.insert(entry.name).second) {
      fault_ = fmt::format("has '{}' twice", printable(entry.name));
    } else if ((flags & 1U) != 0) {
      fault_ = fmt::format("has '{}' encrypted", name);
    } else if (entry.size == kInZip64 || packed == kInZip64 || at == kInZip64) {
      fault_ = fmt::format("has '{}' as a ZIP64 entry, which is not read", name);
    } else if (entry.method != 0 && entry.method != 8) {
      fault_ = fmt::format("has '{}' packed in another way than by deflate", name);
    } else if (entry.method == 0 ? entry.size != packed : entry.size > kMostDeflated * packed) {
      fault_ = fmt::format("is a damaged archive: '{}' cannot have {} bytes", name, entry.size);
    } else if (bytes_ > kMostArchiveBytes) {
      fault_ = fmt::format("has more than {} bytes unpacked", kMostArchiveBytes);
    } else if (at > archive_.size() || archive_.size() - at < kFileHeadingSize ||
               !archive_.substr(at).starts_with(kFileHeading)) {
      fault_ = fmt::format("is a damaged archive: '{}' is not there", name);
    } else {
      const std::size_t name_size = number_at(archive_, at + 26, 2);
      const std::size_t begin = at + kFileHeadingSize + name_size + number_at(archive_, at + 28, 2);
      if (archive_.substr(at + kFileHeadingSize, name_size) != given) {
        fault_ = fmt::format("is a damaged archive: '{}' has another name in its own heading", name);
      } else if (begin > archive_.size() || archive_.size() - begin < packed) {
        fault_ = fmt::format("is a damaged archive: '{}' ends early", name);
      } else {
        entry.packed = archive_.substr(begin, packed);
      }
    }
  }

  std::string_view archive_;
  std::vector<Entry> entries_;
  std::set<std::string> names_;
  std::uint64_t bytes_ = 0;
  std::string fault_;
};

// Empty: the entry is damaged.
std::optional<std::string> unpacked(const Entry& entry) {
  std::string content;
  if (entry.method == 0) {
    content = entry.packed;
  } else {
    content.resize(entry.size);
    z_stream stream{};
    if (inflateInit2(&stream, -MAX_WBITS) != Z_OK) throw std::bad_alloc();              // without a heading
    stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(entry.packed.data()));  // zlib does not write there
    stream.avail_in = static_cast<uInt>(entry.packed.size());
    stream.next_out = reinterpret_cast<Bytef*>(content.data());
    stream.avail_out = static_cast<uInt>(content.size());
    const int state = inflate(&stream, Z_FINISH);
    content.resize(stream.total_out);
    inflateEnd(&stream);
    if (state != Z_STREAM_END) return std::nullopt;
  }
  const auto* const bytes = reinterpret_cast<const Bytef*>(content.data());
  const uLong crc = crc32(0, bytes, static_cast<uInt>(content.size()));
  if (content.size() != entry.size || crc != entry.crc) return std::nullopt;
  return content;
}

// The archive that a name leads to or through, and the rest of the name.
struct Named {
  fs::path archive, inside;
};

Named archive_in(const std::string& name) {
  Named named{name, {}};
  std::error_code error;
  while (named.archive.has_parent_path() && named.archive.has_filename() && !fs::exists(named.archive, error)) {
    named.inside = named.inside.empty() ? named.archive.filename() : named.archive.filename() / named.inside;
    named.archive = named.archive.parent_path();
  }
  return named;
}

bool is_archive(const fs::path& file) {
  std::error_code error;
  return fs::is_regular_file(file, error) && posix::read_file(file, kFileHeading.size(), error) == kFileHeading;
}

}  // namespace

EffectFile::Folder::~Folder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}

bool EffectFile::is_effect() const {
  std::error_code error;
  if (folder_ != nullptr) return true;
  return path_ != "-" && is_effect_text(posix::read_file(path_, kMaxSourceBytes, error));
}

Result<EffectFile> EffectFile::open(const std::string& name) {
  EffectFile file;
  file.path_ = name;
  const Named named = archive_in(name);
  const fs::path &archive = named.archive, &inside = named.inside;
  if (name == "-" || !is_archive(archive)) return file;
  const auto fault = [&](std::string message) {
    return Diagnostic{.message = std::move(message), .file = archive.string()};
  };
  std::error_code error;
  const std::string content = posix::read_file(archive, kMostArchiveBytes + 1, error);
  if (error) return fault("cannot be read: " + error.message());
  if (content.size() > kMostArchiveBytes) return fault(fmt::format("has more than {} bytes", kMostArchiveBytes));
  const Directory directory(content);
  if (!directory.fault().empty()) return fault(directory.fault());

  const ProgressLine interrupts(true);  // otherwise they would leave the folder behind
  const fs::path temporary = fs::temp_directory_path(error);
  const fs::path folder = error ? fs::path() : posix::create_private_folder(temporary / "ninebit-", error);
  if (error) return fault("cannot be unpacked: " + error.message());
  file.folder_ = std::make_shared<const Folder>(folder);
  show_folder_as(folder.string(), archive.string());
  std::vector<std::string> effects;
  for (const Entry& entry : directory.entries()) {
    if (ProgressLine::stopped()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    const std::optional<std::string> text = unpacked(entry);
    if (!text)
      return fault(fmt::format("is a damaged archive: '{}' has other bytes than it should", printable(entry.name)));
    fs::create_directories((folder / entry.name).parent_path(), error);
    std::ofstream stream(folder / entry.name, std::ios::binary);
    stream << *text;
    stream.close();
    if (!stream)
      return fault(fmt::format("'{}' cannot be unpacked into {}", printable(entry.name), temporary.string()));
    if (is_effect_text(*text)) effects.push_back(entry.name);
  }
  if (effects.empty()) return fault("has no effect");
  const std::string first = fmt::format("{}/{}", printable(archive.string()), printable(effects[0]));
  const auto found = inside.empty()
                         ? effects.begin()
                         : std::find(effects.begin(), effects.end(), inside.lexically_normal().generic_string());
  if (found == effects.end()) {
    return fault(fmt::format("has no effect '{}'; expected one of its {}, such as {}", printable(inside.string()),
                             effects.size(), first));
  }
  file.path_ = (folder / *found).string();
  if (inside.empty() && effects.size() > 1) {
    file.note_ =
        fmt::format("{} is taken, the first of {} effects; name another one in the same way", first, effects.size());
  }
  if (fs::exists(folder / "profile.json", error)) {
    if (!file.note_.empty()) file.note_ += "; ";
    file.note_ +=
        fmt::format("{} has a profile of its own, which is not used; unpack it and give --profile profile.json",
                    printable(archive.string()));
  }
  return file;
}

}  // namespace ninebit::tools
