#include "src/gl_layer/capture/zip.h"

#include <cstdint>
#include <exception>
#include <fstream>
#include <initializer_list>
#include <string>
#include <system_error>

#include "src/gl_layer/capture/png.h"
#include "src/gl_layer/driver/log.h"
#include "src/system/archive_limits.h"

namespace ninebit::gl_layer {
namespace {

namespace fs = std::filesystem;

// More than the headings of one file take.
constexpr std::uint64_t kHeadings = 512;

struct Field {
  int bytes = 0;
  std::size_t value = 0;
};

std::string little_endian(std::initializer_list<Field> fields) {
  std::string text;
  for (const Field& field : fields) {
    for (int i = 0; i < field.bytes; ++i) text += static_cast<char>(field.value >> 8 * i & 255U);
  }
  return text;
}

// One file after the other: a frame has hundreds of megabytes.
class ZipStream {
 public:
  explicit ZipStream(const fs::path& archive) : stream_(archive, std::ios::binary) {}

  void add(const std::string& name, const std::string& content) {
    constexpr std::size_t kVersion = 20, kFirstOfJanuary2000 = 20U << 9U | 1U << 5U | 1U;
    // Version, flags, stored, time, date, checksum, both sizes, sizes of the name and of further fields.
    const std::string facts = little_endian({{2, kVersion},
                                             {2, 0},
                                             {2, 0},
                                             {2, 0},
                                             {2, kFirstOfJanuary2000},
                                             {4, crc_of(content)},
                                             {4, content.size()},
                                             {4, content.size()},
                                             {2, name.size()},
                                             {2, 0}});
    const std::string heading = "PK\3\4" + facts + name;
    directory_ += "PK\1\2" + little_endian({{2, kVersion}}) + facts +
                  little_endian({{2, 0}, {2, 0}, {2, 0}, {4, 0}, {4, size_}}) + name;
    stream_ << heading << content;
    size_ += heading.size() + content.size();
    ++count_;
  }

  // Returns whether all of it is written.
  [[nodiscard]] bool finish() {
    stream_ << directory_ << "PK\5\6"
            << little_endian({{2, 0}, {2, 0}, {2, count_}, {2, count_}, {4, directory_.size()}, {4, size_}, {2, 0}});
    stream_.close();
    return stream_.good();
  }

 private:
  std::ofstream stream_;
  std::string directory_{};
  std::size_t size_ = 0, count_ = 0;
};

// Returns what is wrong; empty: nothing.
std::string write_files(const fs::path& archive, const std::vector<fs::path>& files) {
  std::vector<std::size_t> sizes;
  std::uint64_t bytes = 0;
  for (const fs::path& file : files) {
    std::error_code fault;
    const bool regular = fs::is_regular_file(file, fault);
    const std::uint64_t size = regular ? fs::file_size(file, fault) : 0;
    if (!regular || fault) return file.string() + " cannot be read";
    bytes += size + kHeadings;
    sizes.push_back(static_cast<std::size_t>(size));
  }
  if (files.size() > kMostArchiveFiles || bytes > kMostArchiveBytes) {
    return "the frame has " + std::to_string(files.size()) + " files with " + std::to_string(bytes) +
           " bytes; an archive has at most " + std::to_string(kMostArchiveFiles) + " files and " +
           std::to_string(kMostArchiveBytes) + " bytes";
  }
  ZipStream zip(archive);
  for (std::size_t i = 0; i < files.size(); ++i) {
    std::ifstream stream(files[i], std::ios::binary);
    std::string content(sizes[i], '\0');
    if (!stream.read(content.data(), static_cast<std::streamsize>(content.size()))) {
      return files[i].string() + " cannot be read";
    }
    zip.add(files[i].filename().string(), content);
  }
  return zip.finish() ? "" : "the file cannot be written";
}

}  // namespace

bool write_zip(const fs::path& archive, const std::vector<fs::path>& files) {
  const fs::path unfinished = archive.string() + ".part";
  std::string wrong;
  std::error_code fault;
  try {
    wrong = write_files(unfinished, files);
  } catch (const std::exception& error) {  // memory runs out: the program that draws goes on
    wrong = error.what();
  }
  if (wrong.empty()) fs::rename(unfinished, archive, fault);
  if (fault) wrong = fault.message();
  if (wrong.empty()) return true;
  log_line(archive.string() + " is not written: " + wrong);
  fs::remove(unfinished, fault);
  return false;
}

}  // namespace ninebit::gl_layer
