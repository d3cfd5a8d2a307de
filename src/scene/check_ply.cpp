#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cstring>

#include "src/scene/file_check.h"
#include "src/scene/text_scan.h"

namespace ninebit {
namespace {

struct PlyType {
  std::size_t size = 0;  // bytes in a binary file; 0: not a PLY type
  bool real = false;
  bool is_signed = false;
};

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

struct PlyProperty {
  std::string name;
  PlyType type;
  PlyType count;  // size 0: not a list
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::vector<PlyProperty> properties;
};

struct PlyHeader {
  bool binary = false;
  bool big_endian = false;
  std::vector<PlyElement> elements;
  std::uint64_t vertices = 0;
};

Diagnostic out_of_range(const std::string& index, std::uint64_t vertices, int line) {
  return at_line(line,
                 fmt::format("vertex index {} is out of range: the file has {}, counted from 0", index, vertices));
}

Diagnostic ends_early(const PlyElement& element, std::uint64_t read) {
  return at_line(
      0, fmt::format("ends early: it declares {} of element '{}' and has {}", element.count, element.name, read));
}

bool lists_corners(const PlyProperty& property) {
  return property.count.size > 0 && (property.name == "vertex_indices" || property.name == "vertex_index");
}

std::optional<std::string> read_property(const std::vector<std::string_view>& words, PlyHeader& header) {
  if (header.elements.empty()) return "a property stands before any element";
  PlyProperty property;
  if (words.size() == 5 && words[1] == "list") {
    property = {std::string(words[4]), type_of(words[3]), type_of(words[2])};
    if (property.count.size == 0 || property.count.real) return "a list needs a whole number as its count";
  } else if (words.size() == 3) {
    property = {std::string(words[2]), type_of(words[1]), {}};
  } else {
    return "a property needs a type and a name";
  }
  if (property.type.size == 0) return fmt::format("the property '{}' has an unknown type", property.name);
  if (lists_corners(property) && property.type.real) return "vertex indices must be whole numbers";
  header.elements.back().properties.push_back(std::move(property));
  return std::nullopt;
}

Result<PlyHeader> read_header(LineScanner& lines) {
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
      if (!format) return at_line(lines.number(), "its header names no format");
      return header;
    }
    if (words[0] == "format" && words.size() >= 2) {
      format = words[1] == "ascii" || words[1] == "binary_little_endian" || words[1] == "binary_big_endian";
      if (!format) return at_line(lines.number(), fmt::format("the format '{}' is unknown", words[1]));
      header.binary = words[1] != "ascii";
      header.big_endian = words[1] == "binary_big_endian";
    } else if (words[0] == "element" && words.size() >= 3) {
      const std::optional<std::uint32_t> count = number_of<std::uint32_t>(words[2]);
      if (!count) return at_line(lines.number(), fmt::format("'{}' is not a count of elements", words[2]));
      header.elements.push_back({std::string(words[1]), *count, {}});
      if (words[1] == "vertex") header.vertices = *count;
    } else if (words[0] == "property") {
      if (auto fault = read_property(words, header)) return at_line(lines.number(), *fault);
    }  // anything else is a comment: old exporters left out the word
  }
  return at_line(0, "ends within its header");
}

// One line of an ASCII file: one row of an element.
std::optional<Diagnostic> check_row(const PlyElement& element, const std::vector<std::string_view>& words, int line,
                                    std::uint64_t vertices, std::uint64_t& triangles) {
  std::size_t at = 0;
  const auto short_row = [&] {
    return at_line(line, fmt::format("a row of element '{}' has too few values", element.name));
  };
  for (const PlyProperty& property : element.properties) {
    std::uint64_t values = 1;
    if (property.count.size > 0) {
      if (at >= words.size()) return short_row();
      const std::optional<std::uint32_t> count = number_of<std::uint32_t>(words[at]);
      if (!count) return at_line(line, fmt::format("'{}' is not the length of a list", words[at]));
      values = *count;
      ++at;
      if (element.name == "face" && lists_corners(property) && values >= 3) triangles += values - 2;
    }
    if (words.size() - at < values) return short_row();
    for (const std::size_t end = at + values; at < end; ++at) {
      if (element.name == "face" && lists_corners(property)) {
        const std::optional<std::uint64_t> index = number_of<std::uint64_t>(words[at]);
        if (!index || *index >= vertices) return out_of_range(std::string(words[at]), vertices, line);
      } else if (element.name == "vertex" && (property.name == "x" || property.name == "y" || property.name == "z")) {
        if (auto fault = coordinate_fault(words[at])) return at_line(line, *fault);
      }
    }
  }
  return std::nullopt;
}

class BinaryReader {
 public:
  BinaryReader(std::string_view data, bool big_endian) : data_(data), big_endian_(big_endian) {}

  bool skip(std::uint64_t bytes) {
    if (data_.size() < bytes) return false;
    data_.remove_prefix(bytes);
    return true;
  }

  // A whole number of the type; false at the end of the data.
  bool whole(const PlyType& type, std::int64_t& value) {
    if (type.size == 0 || data_.size() < type.size) return false;
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.size; ++i) {
      const std::size_t at = big_endian_ ? i : type.size - 1 - i;
      bits = (bits << 8U) | static_cast<unsigned char>(data_[at]);
    }
    const auto unused = static_cast<unsigned>(64 - 8 * type.size);
    value = type.is_signed ? static_cast<std::int64_t>(bits << unused) >> unused : static_cast<std::int64_t>(bits);
    return skip(type.size);
  }

 private:
  std::string_view data_;
  bool big_endian_;
};

std::optional<Diagnostic> check_binary_row(const PlyElement& element, std::uint64_t row, std::uint64_t vertices,
                                           BinaryReader& data, std::uint64_t& triangles) {
  for (const PlyProperty& property : element.properties) {
    if (property.count.size == 0) {
      if (!data.skip(property.type.size)) return ends_early(element, row);
      continue;
    }
    std::int64_t count = 0;
    if (!data.whole(property.count, count)) return ends_early(element, row);
    if (count < 0) return at_line(0, fmt::format("a list of element '{}' has a negative length", element.name));
    if (element.name != "face" || !lists_corners(property)) {
      if (!data.skip(static_cast<std::uint64_t>(count) * property.type.size)) return ends_early(element, row);
      continue;
    }
    for (std::int64_t i = 0; i < count; ++i) {
      std::int64_t index = 0;
      if (!data.whole(property.type, index)) return ends_early(element, row);
      if (index < 0 || static_cast<std::uint64_t>(index) >= vertices)
        return out_of_range(std::to_string(index), vertices, 0);
    }
    if (count >= 3) triangles += static_cast<std::uint64_t>(count) - 2;
  }
  return std::nullopt;
}

std::optional<Diagnostic> check_element(const PlyHeader& header, const PlyElement& element, LineScanner& lines,
                                        BinaryReader& data, std::uint64_t& triangles) {
  std::string_view line;
  std::vector<std::string_view> words;
  // Rows without properties take no room, so their count alone must cost neither time nor, in Assimp, memory.
  if (element.properties.empty()) {
    if (element.count == 0) return std::nullopt;
    return at_line(
        0, fmt::format("declares {} rows of element '{}', which has no properties", element.count, element.name));
  }
  for (std::uint64_t row = 0; row < element.count; ++row) {
    std::optional<Diagnostic> fault;
    if (header.binary) {
      fault = check_binary_row(element, row, header.vertices, data, triangles);
    } else {
      do {
        if (!lines.next(line)) return ends_early(element, row);
        split_words(line, words);
      } while (words.empty());
      fault = check_row(element, words, lines.number(), header.vertices, triangles);
    }
    if (fault) return fault;
  }
  return std::nullopt;
}

}  // namespace

Result<FileFacts> check_ply(std::string_view content) {
  if (auto fault = overlong_line(content.substr(0, content.find("end_header")))) return *fault;
  LineScanner lines(content);
  Result<PlyHeader> header = read_header(lines);
  if (!header) return header.error();
  if (!header->binary) {
    if (auto fault = overlong_line(content)) return *fault;
  }
  BinaryReader data(content.substr(lines.offset()), header->big_endian);
  std::uint64_t triangles = 0;
  bool strips = false;
  for (const PlyElement& element : header->elements) {
    strips = strips || element.name == "tristrips";
    if (auto fault = check_element(*header, element, lines, data, triangles)) return *fault;
  }
  FileFacts facts;
  if (!strips) facts.triangles = triangles;
  return facts;
}

}  // namespace ninebit
