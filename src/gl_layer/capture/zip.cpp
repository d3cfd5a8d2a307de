#include "src/gl_layer/capture/zip.h"

#include <initializer_list>

#include "src/gl_layer/capture/png.h"

namespace ninebit::gl_layer {
namespace {

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

}  // namespace

std::string zip_file(const std::vector<std::pair<std::string, std::string>>& files) {
  constexpr std::size_t kVersion = 20, kFirstOfJanuary2000 = 20U << 9U | 1U << 5U | 1U;
  std::string archive, directory;
  for (const auto& [name, content] : files) {
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
    directory += "PK\1\2" + little_endian({{2, kVersion}}) + facts +
                 little_endian({{2, 0}, {2, 0}, {2, 0}, {4, 0}, {4, archive.size()}}) + name;
    archive += "PK\3\4" + facts + name + content;
  }
  const std::size_t count = files.size(), at = archive.size();
  return archive + directory + "PK\5\6" +
         little_endian({{2, 0}, {2, 0}, {2, count}, {2, count}, {4, directory.size()}, {4, at}, {2, 0}});
}

}  // namespace ninebit::gl_layer
