#include "src/language/gl_nv/extra_extensions.h"

namespace ninebit {

std::optional<Extras> parse_extras(std::string_view list, std::string& unknown) {
  Extras extras;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::string_view word = list.substr(begin, list.find(',', begin) - begin);
    begin += word.size() + 1;
    bool known = word == "none";
    for (const ExtraExtension& one : kExtraExtensions) {
      if (word != "all" && word != one.name && word != one.name.substr(3)) continue;
      extras.add(one.extra);
      known = true;
    }
    if (extras.have(Extra::vertex_program1_1)) extras.add(Extra::vertex_program);
    if (extras.have(Extra::shared_texture_palette)) extras.add(Extra::paletted_texture);
    if (known) continue;
    unknown = word;
    return std::nullopt;
  }
  return extras;
}

}  // namespace ninebit
