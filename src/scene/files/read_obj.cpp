#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <deque>
#include <numeric>
#include <unordered_map>

#include "src/scene/files/mesh_builder.h"
#include "src/scene/files/obj_materials.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/files/text_scan.h"
#include "src/scene/scene_check.h"
#include "src/system/lines.h"

namespace ninebit {
namespace {

constexpr std::array<const char*, 3> kKinds{"vertex", "texture coordinate", "normal"};
constexpr std::uint32_t kNone = 0xFFFFFFFFU;

// A file of 2^31 bytes has fewer than 2^30 corners.
struct ObjFace {
  std::uint32_t first_corner = 0;  // the next face's first corner is this one's end
  int line = 0;
};

// Consecutive faces with the same material and object.
struct ObjRun {
  std::uint32_t first_face = 0;  // the next run's first face is this one's end
  std::uint32_t material = 0;    // as ObjMaterials numbers them
  std::uint32_t object = 0;
};

// Reads the statements of a file in order. A face may use vertices that come later, so no vertex is placed yet.
class ObjStatements {
 public:
  std::optional<std::string> add(const std::vector<std::string_view>& words, int line) {
    const std::string_view key = words[0];
    if (key == "v" || key == "vn") return add_vector(words, key == "v");
    if (key == "f" || key == "fo") return add_face(words, line);
    if (key == "vt") return add_texture_coordinate(words);
    if (key == "o") {
      if (words.size() > 1) object_ = object_named(std::string(words[1]));
    } else if (key == "g") {
      begin_group(joined_words(words, 1));
    } else if (key == "usemtl") {
      if (words.size() > 1 || material_ == 0) material_ = materials.use(joined_words(words, 1));
    } else if (key == "mtllib") {
      return materials.add_library(words);
    }
    return std::nullopt;
  }

  // Reports an index beyond the elements that the whole file defines.
  [[nodiscard]] std::optional<Diagnostic> index_fault() const {
    for (std::size_t kind = 0; kind < 3; ++kind) {
      if (highest_[kind] <= defined_[kind]) continue;
      return at_line(highest_line_[kind], fmt::format("{} index {} is out of range: the file has {}", kKinds[kind],
                                                      highest_[kind], defined_[kind]));
    }
    return std::nullopt;
  }

  std::vector<glm::vec3> positions;
  std::vector<glm::vec3> normals;
  std::vector<glm::vec2> texture_coordinates;
  // A short line is enough for a face, so a face is stored in few bytes, in containers that do not copy when they grow.
  std::deque<std::uint32_t> corner_positions;
  std::deque<std::uint32_t> corner_textures;  // kNone: the corner has none; empty: no corner has one
  std::deque<std::uint32_t> corner_normals;   // likewise
  std::deque<ObjFace> faces;
  std::vector<ObjRun> runs;
  std::vector<std::string> objects;
  ObjMaterials materials;

 private:
  std::optional<std::string> add_vector(const std::vector<std::string_view>& words, bool position) {
    if (words.size() < 4) return fmt::format("'{}' needs three numbers", words[0]);
    glm::vec3 vector;
    float other = 1.0F;
    for (std::size_t i = 1; i < words.size(); ++i) {
      float& value = i < 4 ? vector[static_cast<glm::length_t>(i) - 1] : other;
      // A normal that is not finite is not a fault: it is computed instead.
      if (auto fault = position ? read_coordinate(words[i], value) : read_normal_part(words[i], value)) return fault;
    }
    // Four numbers are a weighted vertex; further ones are its colour.
    if (position && words.size() == 5) {
      if (other == 0.0F) return "the weight of a vertex is 0";
      vector /= other;
      if (!is_finite(vector)) return "the position of a vertex is not finite";
    }
    (position ? positions : normals).push_back(vector);
    ++defined_[position ? 0 : 2];
    return std::nullopt;
  }

  // "vt s t [r]": t counts upwards from a picture's bottom.
  std::optional<std::string> add_texture_coordinate(const std::vector<std::string_view>& words) {
    glm::vec2 at(0.0F);
    for (std::size_t i = 1; i < words.size() && i < 3; ++i) {
      // A coordinate that is not finite is not a fault, like a normal.
      if (auto fault = read_normal_part(words[i], at[static_cast<glm::length_t>(i) - 1])) return fault;
    }
    const bool finite = is_finite(glm::vec3(at, 0.0F));
    texture_coordinates.push_back(finite ? glm::vec2(at.x, 1.0F - at.y) : glm::vec2(0.0F));
    ++defined_[1];
    return std::nullopt;
  }

  // One corner of a face, "v", "v/vt", "v//vn" or "v/vt/vn"; indices count from 1, or, if negative, back from the last.
  std::optional<std::string> add_corner(std::string_view word, int line) {
    const std::string_view whole = word;
    std::uint32_t position = 0, texture = kNone, normal = kNone;
    for (std::size_t kind = 0; kind < 3; ++kind) {
      const std::size_t slash = std::min(word.find('/'), word.size());
      const std::string_view part = word.substr(0, slash);
      if (!part.empty() || kind == 0) {
        const std::optional<std::int64_t> index = number_of<std::int64_t>(part);
        if (!index) return fmt::format("'{}' is not a face corner", whole);
        if (*index == 0 || *index < -defined_[kind] || *index >= static_cast<std::int64_t>(kNone))
          return fmt::format("{} index {} is out of range", kKinds[kind], part);
        if (*index > highest_[kind]) {
          highest_[kind] = *index;
          highest_line_[kind] = line;
        }
        const auto from_zero = static_cast<std::uint32_t>(*index > 0 ? *index - 1 : defined_[kind] + *index);
        if (kind == 0) position = from_zero;
        if (kind == 1) texture = from_zero;
        if (kind == 2) normal = from_zero;
      }
      if (slash == word.size()) {
        add_optional(corner_textures, texture);
        add_optional(corner_normals, normal);
        corner_positions.push_back(position);
        return std::nullopt;
      }
      word.remove_prefix(slash + 1);
    }
    return fmt::format("'{}' is not a face corner", whole);
  }

  // The next corner's number in a list that stays empty as long as no corner has one.
  void add_optional(std::deque<std::uint32_t>& list, std::uint32_t number) {
    if (number != kNone) list.resize(corner_positions.size(), kNone);
    if (number != kNone || !list.empty()) list.push_back(number);
  }

  std::optional<std::string> add_face(const std::vector<std::string_view>& words, int line) {
    if (words.size() < 4) return "a face needs at least three corners";
    if (object_ == kNone) object_ = new_object("defaultobject");
    if (runs.empty() || runs.back().material != material_ || runs.back().object != object_)
      runs.push_back({static_cast<std::uint32_t>(faces.size()), material_, object_});
    faces.push_back({static_cast<std::uint32_t>(corner_positions.size()), line});
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (auto fault = add_corner(words[i], line)) return fault;
    }
    return std::nullopt;
  }

  std::uint32_t new_object(const std::string& name) {
    objects.push_back(name);
    const auto number = static_cast<std::uint32_t>(objects.size() - 1);
    objects_by_name_.try_emplace(name, number);
    return number;
  }

  // `o` with a known name continues that object; `g` begins a new object whenever its name changes.
  std::uint32_t object_named(const std::string& name) {
    const auto found = objects_by_name_.find(name);
    return found != objects_by_name_.end() ? found->second : new_object(name);
  }

  void begin_group(std::string name) {
    if (name == group_) return;
    object_ = new_object(name);
    group_ = std::move(name);
  }

  std::array<std::int64_t, 3> defined_{};  // v, vt, vn so far
  std::array<std::int64_t, 3> highest_{};  // the highest index used of each
  std::array<int, 3> highest_line_{};      // the line of that index
  std::unordered_map<std::string, std::uint32_t> objects_by_name_;
  std::string group_;
  std::uint32_t object_ = kNone;
  std::uint32_t material_ = 0;
};

std::optional<Diagnostic> read_statements(std::string_view content, ObjStatements& statements) {
  LineScanner lines(content);
  std::string_view line;
  std::string joined;
  std::vector<std::string_view> words;
  while (lines.next(line)) {
    const int number = lines.number();
    // A backslash at the end of a line continues it.
    if (!line.empty() && line.back() == '\\') {
      joined.clear();
      bool more = true;
      while (more && !line.empty() && line.back() == '\\') {
        joined.append(line.substr(0, line.size() - 1)).push_back(' ');
        if (joined.size() > kLongestTextLine) return overlong(number);
        more = lines.next(line);
      }
      if (more) joined.append(line);
      line = joined;
    }
    split_words(line, words);
    if (words.empty()) continue;
    if (auto fault = statements.add(words, number)) return at_line(number, *fault);
  }
  return statements.index_fault();
}

// The numbers of the runs, ordered by object.
std::vector<std::uint32_t> runs_by_object(const ObjStatements& read) {
  std::vector<std::uint32_t> order(read.runs.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::uint32_t a, std::uint32_t b) { return read.runs[a].object < read.runs[b].object; });
  return order;
}

std::optional<std::string> place_face(const ObjStatements& read, std::size_t face, std::uint32_t material,
                                      std::vector<std::uint32_t>& corners, MeshBuilder& builder) {
  const MeshPlace place;
  const std::size_t first = read.faces[face].first_corner;
  const std::size_t end =
      face + 1 < read.faces.size() ? read.faces[face + 1].first_corner : read.corner_positions.size();
  corners.clear();
  for (std::size_t i = first; i < end; ++i) {
    const auto number_in = [i](const std::deque<std::uint32_t>& list) { return i < list.size() ? list[i] : kNone; };
    MeshVertex corner{.position = read.positions[read.corner_positions[i]]};
    if (const std::uint32_t number = number_in(read.corner_normals); number != kNone) {
      corner.normal = read.normals[number];
    }
    if (const std::uint32_t number = number_in(read.corner_textures); number != kNone) {
      corner.texture_coordinate = read.texture_coordinates[number];
    }
    corners.emplace_back();
    if (auto fault = builder.vertex_at(place, corner, corners.back())) return fault;
  }
  return builder.polygon(corners, material);
}

Result<Scene> scene_of(ObjStatements& read, const NamedFiles& beside) {
  Scene out;
  const bool used = std::any_of(read.runs.begin(), read.runs.end(), [](const ObjRun& r) { return r.material > 0; });
  const Result<std::vector<std::uint32_t>> materials = read.materials.resolve(beside, used, out);
  if (!materials) return materials.error();
  MeshBuilder builder(out);
  std::uint32_t open = kNone;
  std::vector<std::uint32_t> corners;
  for (const std::uint32_t number : runs_by_object(read)) {
    const ObjRun& run = read.runs[number];
    if (run.object != open) {
      if (open != kNone) builder.end_object();
      builder.begin_object(read.objects[run.object]);
      open = run.object;
    }
    const std::size_t end = number + 1 < read.runs.size() ? read.runs[number + 1].first_face : read.faces.size();
    for (std::size_t face = run.first_face; face < end; ++face) {
      if (auto fault = place_face(read, face, (*materials)[run.material], corners, builder))
        return at_line(read.faces[face].line, *fault);
    }
  }
  if (open != kNone) builder.end_object();
  return out;
}

}  // namespace

Result<Scene> read_obj(std::string_view content, const NamedFiles& beside) {
  if (content.starts_with("\xFF\xFE") || content.starts_with("\xFE\xFF"))
    return at_line(0, "is UTF-16 text; OBJ files are read as ASCII or UTF-8");
  if (content.find('\0') != std::string_view::npos) return at_line(0, "is not an OBJ file: it holds binary data");
  if (auto fault = overlong_line(content)) return *fault;
  ObjStatements statements;
  if (auto fault = read_statements(without_mark(content), statements)) return *fault;
  return scene_of(statements, beside);
}

}  // namespace ninebit
