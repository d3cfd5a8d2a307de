#include "src/scene/files/ply_header.h"

#include <algorithm>
#include <utility>

namespace ninebit {
namespace {

PlyType type_of(std::string_view name) {
  if (name == "char" || name == "int8") return {1, false, true};
  if (name == "uchar" || name == "uint8") return {1, false, false};
  if (name == "short" || name == "int16") return {2, false, true};
  if (name == "ushort" || name == "uint16") return {2, false, false};
  if (name == "int" || name == "int32") return {4, false, true};
  if (name == "uint" || name == "uint32") return {4, false, false};
  if (name == "float" || name == "float32") return {4, true, true};
  if (name == "double" || name == "float64") return {8, true, true};
  return {};
}

PlyKind kind_of(std::string_view element) {
  if (element == "vertex") return PlyKind::vertex;
  if (element == "face") return PlyKind::face;
  if (element == "tristrips") return PlyKind::strip;
  return element == "material" ? PlyKind::material : PlyKind::other;
}

PlyRole role_of(PlyKind kind, const PlyProperty& property) {
  // In the order of PlyRole; programs have several names for texture coordinates.
  constexpr std::array<std::string_view, kPlyValues> kOfVertices{"x",
                                                                 "y",
                                                                 "z",
                                                                 "nx",
                                                                 "ny",
                                                                 "nz",
                                                                 "red",
                                                                 "green",
                                                                 "blue",
                                                                 "alpha",
                                                                 "s",
                                                                 "t",
                                                                 "secondary_red",
                                                                 "secondary_green",
                                                                 "secondary_blue",
                                                                 "secondary_alpha",
                                                                 "fog_factor"};
  constexpr std::array<std::string_view, 6> kOtherCoordinates{"u",         "v",          "texture_u",
                                                              "texture_v", "texcoord_s", "texcoord_t"};
  constexpr std::array<std::string_view, 3> kOfMaterials{"diffuse_red", "diffuse_green", "diffuse_blue"};
  const bool list = property.count.size > 0;
  if (kind == PlyKind::vertex && !list) {
    const auto* found = std::find(kOfVertices.begin(), kOfVertices.end(), property.name);
    if (found != kOfVertices.end()) return static_cast<PlyRole>(found - kOfVertices.begin());
    const auto* other = std::find(kOtherCoordinates.begin(), kOtherCoordinates.end(), property.name);
    if (other != kOtherCoordinates.end()) return (other - kOtherCoordinates.begin()) % 2 == 0 ? PlyRole::s : PlyRole::t;
  }
  if (kind == PlyKind::material && !list) {
    const auto* found = std::find(kOfMaterials.begin(), kOfMaterials.end(), property.name);
    if (found != kOfMaterials.end())
      return static_cast<PlyRole>(static_cast<std::ptrdiff_t>(PlyRole::red) + (found - kOfMaterials.begin()));
  }
  if (kind == PlyKind::face && list && (property.name == "vertex_indices" || property.name == "vertex_index"))
    return PlyRole::corners;
  return kind == PlyKind::strip && list ? PlyRole::corners : PlyRole::none;
}

std::optional<std::string> read_property(const std::vector<std::string_view>& words, PlyHeader& header) {
  if (header.elements.empty()) return "a property comes before the first element";
  PlyElement& element = header.elements.back();
  PlyProperty property;
  if (words.size() == 5 && words[1] == "list") {
    property = {std::string(words[4]), type_of(words[3]), type_of(words[2])};
    if (property.count.size == 0 || property.count.real) return "a list needs an integer type for its count";
  } else if (words.size() == 3) {
    property = {std::string(words[2]), type_of(words[1]), {}};
  } else {
    return "a property needs a type and a name";
  }
  if (property.type.size == 0) return fmt::format("the property '{}' has an unknown type", property.name);
  property.role = role_of(element.kind, property);
  if (property.role == PlyRole::corners && property.type.real) return "vertex indices must be integers";
  if (property.role != PlyRole::none && element.has(property.role))
    return fmt::format("the element '{}' declares the property '{}' twice", element.name, property.name);
  element.properties.push_back(std::move(property));
  return std::nullopt;
}

std::optional<std::string> read_element(const std::vector<std::string_view>& words, PlyHeader& header) {
  const std::optional<std::uint32_t> count = number_of<std::uint32_t>(words[2]);
  if (!count) return fmt::format("'{}' is not a count of elements", words[2]);
  const PlyKind kind = kind_of(words[1]);
  const auto is = [&](PlyKind other) {
    return std::any_of(header.elements.begin(), header.elements.end(),
                       [&](const PlyElement& element) { return element.kind == other; });
  };
  if (kind != PlyKind::other && is(kind)) return fmt::format("the element '{}' is declared twice", words[1]);
  if ((kind == PlyKind::face || kind == PlyKind::strip) && !is(PlyKind::vertex))
    return fmt::format("the element '{}' is declared before the vertices", words[1]);
  header.elements.push_back({std::string(words[1]), kind, *count, {}});
  return std::nullopt;
}

}  // namespace

bool PlyElement::has(PlyRole role) const {
  return std::any_of(properties.begin(), properties.end(),
                     [role](const PlyProperty& property) { return property.role == role; });
}

Result<PlyHeader> read_ply_header(LineScanner& lines) {
  PlyHeader header;
  std::string_view line;
  std::vector<std::string_view> words;
  if (!lines.next(line) || (line.substr(0, 3) != "ply" && line.substr(0, 3) != "PLY"))
    return at_line(1, "is not a PLY file: it does not start with 'ply'");
  bool format = false;
  while (lines.next(line)) {
    split_words(line, words);
    if (words.empty() || words[0] == "comment" || words[0] == "obj_info") continue;
    if (words[0] == "end_header") {
      if (!format) return at_line(lines.number(), "its header has no format line");
      return header;
    }
    std::optional<std::string> fault;
    if (words[0] == "format" && words.size() >= 2) {
      format = words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian";
      if (!format) fault = fmt::format("the format '{}' is unknown", words[1]);
      header.binary = words[1] != "ascii";
      header.big_endian = words[1] == "binary_big_endian";
    } else if (words[0] == "element" && words.size() >= 3) {
      fault = read_element(words, header);
    } else if (words[0] == "property") {
      fault = read_property(words, header);
    }  // anything else is a comment: old exporters omit the keyword
    if (fault) return at_line(lines.number(), *fault);
  }
  return at_line(0, "ends within its header");
}

}  // namespace ninebit
