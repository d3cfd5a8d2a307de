#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <utility>

#include "src/scene/files/mesh_builder.h"
#include "src/scene/files/ply_header.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/scene_check.h"

namespace ninebit {
namespace {

// The used values of one row of an element.
struct PlyRow {
  std::array<float, kPlyValues> values{};  // of the roles before PlyRole::corners
  std::vector<std::int64_t> corners;       // of a face or of triangle strips
};

Diagnostic ends_early(const PlyElement& element, std::uint64_t read) {
  return at_line(
      0, fmt::format("ends early: it declares {} of element '{}' and has {}", element.count, element.name, read));
}

// A colour component of any type, scaled to 0 to 1.
float color_of(const PlyType& type, float value) {
  if (type.real) return value;
  if (type.size == 1) return (type.is_signed ? value + 127.0F : value) / 255.0F;
  if (type.size == 2 || !type.is_signed) return (type.is_signed ? value + 32767.0F : value) / 65535.0F;
  return value / 255.0F + 0.5F;
}

// The source of rows: lines of text, or packed bytes.
class PlyRows {
 public:
  PlyRows(const PlyHeader& header, std::string_view content, LineScanner lines)
      : header_(header), lines_(lines), data_(content.substr(lines.offset())) {}

  // Reads the next row of an element; `before`, the number of rows before it, is for messages.
  std::optional<Diagnostic> next(const PlyElement& element, std::uint64_t before, PlyRow& row) {
    if (header_.binary) return next_packed(element, before, row);
    std::string_view line;
    do {
      if (!lines_.next(line)) return ends_early(element, before);
      split_words(line, words_);
    } while (words_.empty());
    const std::optional<std::string> fault = next_text(element, row);
    return fault ? std::optional<Diagnostic>(at_line(lines_.number(), *fault)) : std::nullopt;
  }

  [[nodiscard]] int line() const { return header_.binary ? 0 : lines_.number(); }

 private:
  std::optional<std::string> next_text(const PlyElement& element, PlyRow& row) {
    std::size_t at = 0;
    const auto short_row = [&] { return fmt::format("a row of element '{}' has too few values", element.name); };
    for (const PlyProperty& property : element.properties) {
      if (at >= words_.size()) return short_row();
      if (property.count.size == 0) {
        if (auto fault = read_value(property, words_[at], row)) return fault;
        ++at;
        continue;
      }
      const std::optional<std::uint32_t> count = number_of<std::uint32_t>(words_[at]);
      if (!count) return fmt::format("'{}' is not the length of a list", words_[at]);
      ++at;
      if (words_.size() - at < *count) return short_row();
      if (property.role == PlyRole::corners) {
        row.corners.clear();
        for (std::size_t i = 0; i < *count; ++i) {
          const std::optional<std::int64_t> index = number_of<std::int64_t>(words_[at + i]);
          if (!index) return fmt::format("'{}' is not a vertex index", words_[at + i]);
          row.corners.push_back(*index);
        }
      }
      at += *count;
    }
    return std::nullopt;
  }

  static std::optional<std::string> read_value(const PlyProperty& property, std::string_view word, PlyRow& row) {
    if (property.role == PlyRole::none) return std::nullopt;
    float& value = row.values[static_cast<std::size_t>(property.role)];
    if (property.type.size == 8) {
      // A double is rounded only once, at the end.
      const std::optional<double> exact = real_of<double>(word);
      if (!exact) return fmt::format("'{}' is not a number", word);
      value = static_cast<float>(*exact);
    } else if (auto fault = read_normal_part(word, value)) {
      return fault;
    }
    if (property.role <= PlyRole::z && !std::isfinite(value))
      return fmt::format("the position '{}' is not finite", word);
    return std::nullopt;
  }

  std::optional<Diagnostic> next_packed(const PlyElement& element, std::uint64_t before, PlyRow& row) {
    for (const PlyProperty& property : element.properties) {
      if (property.count.size == 0) {
        if (data_.size() < property.type.size) return ends_early(element, before);
        if (property.role != PlyRole::none)
          row.values[static_cast<std::size_t>(property.role)] = static_cast<float>(number_at(property.type));
        data_.remove_prefix(property.type.size);
        if (property.role <= PlyRole::z && !std::isfinite(row.values[static_cast<std::size_t>(property.role)]))
          return at_line(0, fmt::format("the position of vertex {} is not finite", before));
        continue;
      }
      if (data_.size() < property.count.size) return ends_early(element, before);
      const double count = number_at(property.count);
      data_.remove_prefix(property.count.size);
      if (count < 0.0) return at_line(0, fmt::format("a list of element '{}' has a negative length", element.name));
      const auto bytes = static_cast<std::uint64_t>(count) * property.type.size;
      if (data_.size() < bytes) return ends_early(element, before);
      if (property.role == PlyRole::corners) {
        row.corners.clear();
        for (std::uint64_t i = 0; i < static_cast<std::uint64_t>(count); ++i) {
          row.corners.push_back(static_cast<std::int64_t>(number_at(property.type)));
          data_.remove_prefix(property.type.size);
        }
      } else {
        data_.remove_prefix(bytes);
      }
    }
    return std::nullopt;
  }

  // The number at the start of the data, which must be long enough. A double can hold all of these types.
  [[nodiscard]] double number_at(const PlyType& type) const {
    std::uint64_t bits = 0;
    for (std::size_t i = 0; i < type.size; ++i) {
      const std::size_t at = header_.big_endian ? i : type.size - 1 - i;
      bits = (bits << 8U) | static_cast<unsigned char>(data_[at]);
    }
    if (type.real && type.size == 4) return static_cast<double>(std::bit_cast<float>(static_cast<std::uint32_t>(bits)));
    if (type.real) return std::bit_cast<double>(bits);
    const auto unused = static_cast<unsigned>(64 - 8 * type.size);
    return type.is_signed ? static_cast<double>(static_cast<std::int64_t>(bits << unused) >> unused)
                          : static_cast<double>(bits);
  }

  const PlyHeader& header_;
  LineScanner lines_;
  std::string_view data_;
  std::vector<std::string_view> words_;
};

class PlyReader {
 public:
  PlyReader(const PlyHeader& header, std::string_view content, LineScanner lines)
      : header_(header), rows_(header, content, lines), builder_(out_) {}

  Result<Scene> read() {
    builder_.begin_object("");
    for (const PlyElement& element : header_.elements) {
      if (auto fault = read_element(element)) return *fault;
    }
    builder_.end_object();
    if (out_.materials.empty()) {
      const bool declared = std::any_of(header_.elements.begin(), header_.elements.end(),
                                        [](const PlyElement& e) { return e.kind == PlyKind::material; });
      out_.materials.push_back(declared ? Material{} : Material{"", glm::vec3(1.0F)});
    }
    return std::move(out_);
  }

 private:
  std::optional<Diagnostic> read_element(const PlyElement& element) {
    // Rows without properties take no bytes, so a file could declare any number of them.
    if (element.properties.empty() && element.count > 0)
      return at_line(
          0, fmt::format("declares {} rows of element '{}', which has no properties", element.count, element.name));
    if (element.kind == PlyKind::vertex) {
      has_normals_ = element.has(PlyRole::nx) || element.has(PlyRole::ny) || element.has(PlyRole::nz);
      has_colors_ = element.has(PlyRole::red) && element.has(PlyRole::green) && element.has(PlyRole::blue);
      has_coordinates_ = element.has(PlyRole::s) && element.has(PlyRole::t);
      has_secondary_ = element.has(PlyRole::secondary_red) || element.has(PlyRole::secondary_green) ||
                       element.has(PlyRole::secondary_blue) || element.has(PlyRole::secondary_alpha);
      has_fog_ = element.has(PlyRole::fog_factor);
      if (auto fault = missing_secondary(element)) return at_line(0, *fault);
    }
    for (std::uint64_t i = 0; i < element.count; ++i) {
      if (auto fault = rows_.next(element, i, row_)) return fault;
      std::optional<std::string> fault;
      if (element.kind == PlyKind::vertex) fault = add_vertex(element, i);
      if (element.kind == PlyKind::face) fault = add_face();
      if (element.kind == PlyKind::strip) fault = add_strips();
      if (element.kind == PlyKind::material) add_material(element);
      if (fault) return at_line(rows_.line(), *fault);
    }
    return std::nullopt;
  }

  [[nodiscard]] std::optional<std::string> missing_secondary(const PlyElement& element) const {
    constexpr std::array<std::pair<PlyRole, const char*>, 3> kNeeded{{{PlyRole::secondary_red, "secondary_red"},
                                                                      {PlyRole::secondary_green, "secondary_green"},
                                                                      {PlyRole::secondary_blue, "secondary_blue"}}};
    std::string missing;
    for (const auto& [role, name] : kNeeded) {
      if (!element.has(role)) missing += (missing.empty() ? "" : " and ") + std::string(name);
    }
    if (!has_secondary_ || missing.empty()) return std::nullopt;
    return fmt::format("declares a part of a secondary colour; expected {}, too", missing);
  }

  // Secondary colours and fog factors come from programs that know what they mean: unlike colours, which programs of
  // all kinds write, they are not clamped, as that would hide a mistake. `number` counts from 0.
  [[nodiscard]] std::optional<std::string> value_fault(const PlyElement& element, std::uint64_t number) const {
    for (const PlyProperty& property : element.properties) {
      if (property.role < PlyRole::secondary_red || property.role > PlyRole::fog_factor) continue;
      const float value = row_.values[static_cast<std::size_t>(property.role)];
      const float scaled = color_of(property.type, value);
      if (scaled >= 0.0F && scaled <= 1.0F) continue;
      return fmt::format("vertex {} has {} {}; expected {}", number, property.name, value,
                         property.type.real ? "a number from 0 to 1" : "one that its type scales to 0 to 1");
    }
    return std::nullopt;
  }

  std::optional<std::string> add_vertex(const PlyElement& element, std::uint64_t number) {
    if (has_secondary_ || has_fog_) {
      if (auto fault = value_fault(element, number)) return fault;
    }
    const std::array<float, kPlyValues>& v = row_.values;
    positions_.emplace_back(v[0], v[1], v[2]);
    if (has_normals_) normals_.emplace_back(v[3], v[4], v[5]);
    // The origin of pictures is the lower left corner, as in OpenGL.
    const glm::vec2 at(v[10], 1.0F - v[11]);
    if (has_coordinates_) coordinates_.push_back(is_finite(glm::vec3(at, 0.0F)) ? at : glm::vec2(0.0F));
    if (has_colors_) colors_.push_back(glm::clamp(color_of_row(element, PlyRole::red), 0.0F, 1.0F));
    if (has_secondary_) secondary_colors_.push_back(color_of_row(element, PlyRole::secondary_red));
    if (has_fog_) {
      const auto is_fog = [](const PlyProperty& property) { return property.role == PlyRole::fog_factor; };
      const PlyType& type = std::find_if(element.properties.begin(), element.properties.end(), is_fog)->type;
      fog_factors_.push_back(color_of(type, v[static_cast<std::size_t>(PlyRole::fog_factor)]));
    }
    vertices_.push_back(VertexTable::kFree);
    return std::nullopt;
  }

  // The row's colour, whose red has the given role, scaled by the types of its components; alpha is 1 without the
  // property.
  [[nodiscard]] glm::vec4 color_of_row(const PlyElement& element, PlyRole red) const {
    glm::vec4 color(0.0F, 0.0F, 0.0F, 1.0F);
    for (const PlyProperty& property : element.properties) {
      const auto channel = static_cast<glm::length_t>(property.role) - static_cast<glm::length_t>(red);
      if (channel < 0 || channel >= 4) continue;
      color[channel] = color_of(property.type, row_.values[static_cast<std::size_t>(property.role)]);
    }
    return is_finite(glm::vec3(color)) && std::isfinite(color.a) ? color : glm::vec4(Material{}.base_color, 1.0F);
  }

  std::optional<std::string> index_fault(std::int64_t index) const {
    if (index >= 0 && static_cast<std::uint64_t>(index) < positions_.size()) return std::nullopt;
    return fmt::format("vertex index {} is out of range: the file has {}, counted from 0", index, positions_.size());
  }

  std::optional<std::string> add_corner(std::int64_t index) {
    if (auto fault = index_fault(index)) return fault;
    const auto at = static_cast<std::size_t>(index);
    if (vertices_[at] == VertexTable::kFree) {
      MeshVertex corner{.position = positions_[at]};
      if (has_normals_) corner.normal = normals_[at];
      if (has_coordinates_) corner.texture_coordinate = coordinates_[at];
      if (has_colors_) corner.color = colors_[at];
      if (has_secondary_) corner.secondary_color = secondary_colors_[at];
      if (has_fog_) corner.fog_factor = fog_factors_[at];
      if (auto fault = builder_.vertex_at(place_, corner, vertices_[at])) return fault;
    }
    corners_.push_back(vertices_[at]);
    return std::nullopt;
  }

  std::optional<std::string> add_face() {
    corners_.clear();
    const bool surface = row_.corners.size() >= 3;  // not points and lines
    for (const std::int64_t index : row_.corners) {
      if (auto fault = surface ? add_corner(index) : index_fault(index)) return fault;
    }
    return surface ? builder_.polygon(corners_, 0) : std::nullopt;
  }

  // -1 ends a strip. Every second triangle of a strip has reversed winding.
  std::optional<std::string> add_strips() {
    std::size_t length = 0;
    corners_.clear();
    for (const std::int64_t index : row_.corners) {
      if (index == -1) {
        length = 0;
        corners_.clear();
        continue;
      }
      if (corners_.size() == 3) corners_.erase(corners_.begin());
      if (auto fault = add_corner(index)) return fault;
      if (++length < 3) continue;
      const std::array<std::uint32_t, 3> turned{corners_[1], corners_[0], corners_[2]};
      if (auto fault = length % 2 == 0 ? builder_.polygon(turned, 0) : builder_.polygon(corners_, 0)) return fault;
    }
    return std::nullopt;
  }

  void add_material(const PlyElement& element) {
    out_.materials.push_back({"", glm::clamp(glm::vec3(color_of_row(element, PlyRole::red)), 0.0F, 1.0F)});
  }

  const PlyHeader& header_;
  PlyRows rows_;
  PlyRow row_;
  bool has_normals_ = false, has_colors_ = false, has_coordinates_ = false, has_secondary_ = false, has_fog_ = false;
  std::vector<glm::vec3> positions_;
  std::vector<glm::vec3> normals_;
  std::vector<glm::vec2> coordinates_;
  std::vector<glm::vec4> colors_, secondary_colors_;
  std::vector<float> fog_factors_;
  std::vector<std::uint32_t> vertices_;  // the scene's vertex for each vertex of the file that a face uses
  std::vector<std::uint32_t> corners_;
  const MeshPlace place_;
  Scene out_;
  MeshBuilder builder_;
};

}  // namespace

Result<Scene> read_ply(std::string_view content) {
  if (auto fault = overlong_line(content.substr(0, content.find("end_header")))) return *fault;
  LineScanner lines(content);
  const Result<PlyHeader> header = read_ply_header(lines);
  if (!header) return header.error();
  if (!header->binary) {
    if (auto fault = overlong_line(content)) return *fault;
  }
  return PlyReader(*header, content, lines).read();
}

}  // namespace ninebit
