#include <fmt/format.h>

#include "src/scene/files/mesh_builder.h"
#include "src/scene/files/scene_readers.h"
#include "src/scene/files/text_scan.h"
#include "src/system/lines.h"

namespace ninebit {
namespace {

// Reads the next line that has words; false at the end of the file.
bool next_words(LineScanner& lines, std::vector<std::string_view>& words) {
  std::string_view line;
  while (lines.next(line)) {
    split_words(line, words);
    if (!words.empty()) return true;
  }
  return false;
}

Diagnostic ends_early(const char* what, std::uint64_t read, std::uint64_t declared) {
  return at_line(0, fmt::format("ends early: it declares {} {} and has {}", declared, what, read));
}

class OffReader {
 public:
  explicit OffReader(std::string_view content) : content_(content), lines_(content), builder_(out_) {}

  Result<Scene> read() {
    if (auto fault = overlong_line(content_)) return *fault;
    if (auto fault = read_counts()) return *fault;
    if (auto fault = read_vertices()) return *fault;
    out_.materials.push_back({"", glm::vec3(0.6F)});
    builder_.begin_object("<OFFRoot>");
    vertices_.assign(positions_.size(), VertexTable::kFree);
    if (auto fault = read_faces()) return *fault;
    builder_.end_object();
    return std::move(out_);
  }

 private:
  std::optional<Diagnostic> read_counts() {
    if (!next_words(lines_, words_) || !words_[0].ends_with("OFF"))
      return at_line(lines_.number(), "is not an OFF file: it does not start with 'OFF'");
    const std::string_view kind = words_[0];
    const bool known = kind == "OFF" || kind == "COFF" || kind == "NOFF" || kind == "CNOFF" || kind == "STOFF";
    if (!known || (words_.size() > 1 && words_[1] == "BINARY"))
      return at_line(lines_.number(),
                     "is an unsupported kind of OFF file; expected OFF, COFF, NOFF, CNOFF or STOFF as text");
    has_normals_ = kind.find('N') != std::string_view::npos;
    words_.erase(words_.begin());
    if (words_.empty() && !next_words(lines_, words_)) return at_line(0, "ends before its counts");
    const std::optional<std::uint32_t> vertices = number_of<std::uint32_t>(words_[0]);
    const std::optional<std::uint32_t> faces = words_.size() > 1 ? number_of<std::uint32_t>(words_[1]) : std::nullopt;
    if (words_.size() != 3 || !vertices || !faces || !number_of<std::uint32_t>(words_[2]))
      return at_line(lines_.number(), "expected the numbers of vertices, faces and edges in this line");
    vertex_count_ = *vertices;
    face_count_ = *faces;
    return std::nullopt;
  }

  std::optional<Diagnostic> read_vertices() {
    const std::size_t needed = has_normals_ ? 6 : 3;
    for (std::uint32_t i = 0; i < vertex_count_; ++i) {
      if (!next_words(lines_, words_)) return ends_early("vertices", i, vertex_count_);
      if (words_.size() < needed)
        return at_line(lines_.number(), has_normals_ ? "a vertex needs three coordinates and a normal"
                                                     : "a vertex needs three coordinates");
      glm::vec3 position;
      glm::vec3 normal(0.0F);
      for (glm::length_t k = 0; k < 3; ++k) {
        auto fault = read_coordinate(words_[static_cast<std::size_t>(k)], position[k]);
        if (!fault && has_normals_) fault = read_normal_part(words_[static_cast<std::size_t>(k) + 3], normal[k]);
        if (fault) return at_line(lines_.number(), *fault);
      }
      positions_.push_back(position);
      if (has_normals_) normals_.push_back(normal);
    }
    return std::nullopt;
  }

  std::optional<Diagnostic> read_faces() {
    for (std::uint32_t i = 0; i < face_count_; ++i) {
      if (!next_words(lines_, words_)) return ends_early("faces", i, face_count_);
      const std::optional<std::uint32_t> corners = number_of<std::uint32_t>(words_[0]);
      if (!corners) return at_line(lines_.number(), fmt::format("'{}' is not a number of corners", words_[0]));
      if (words_.size() - 1 < *corners) return at_line(lines_.number(), "a face lists fewer corners than it declares");
      if (auto fault = read_face(*corners)) return at_line(lines_.number(), *fault);
    }
    return std::nullopt;
  }

  std::optional<std::string> read_face(std::uint32_t corners) {
    corners_.clear();
    for (std::size_t k = 1; k <= corners; ++k) {
      const std::optional<std::uint32_t> index = number_of<std::uint32_t>(words_[k]);
      if (!index || *index >= vertex_count_)
        return fmt::format("vertex index {} is out of range: the file has {}, counted from 0", words_[k],
                           vertex_count_);
      corners_.push_back(*index);
    }
    if (corners < 3) return std::nullopt;  // points and lines have no surface
    for (std::uint32_t& corner : corners_) {
      std::uint32_t& vertex = vertices_[corner];
      if (vertex == VertexTable::kFree) {
        const glm::vec3 normal = has_normals_ ? normals_[corner] : glm::vec3(0.0F);
        if (auto fault = builder_.vertex_at(place_, {.position = positions_[corner], .normal = normal}, vertex))
          return fault;
      }
      corner = vertex;
    }
    return builder_.polygon(corners_, 0);
  }

  std::string_view content_;
  LineScanner lines_;
  std::vector<std::string_view> words_;
  bool has_normals_ = false;
  std::uint32_t vertex_count_ = 0;
  std::uint32_t face_count_ = 0;
  std::vector<glm::vec3> positions_;
  std::vector<glm::vec3> normals_;
  std::vector<std::uint32_t> vertices_;  // the scene's vertex for each vertex of the file that a face uses
  std::vector<std::uint32_t> corners_;
  const MeshPlace place_;
  Scene out_;
  MeshBuilder builder_;
};

}  // namespace

Result<Scene> read_off(std::string_view content) {
  return OffReader(without_mark(content)).read();
}

}  // namespace ninebit
