#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "src/scene/file_check.h"
#include "src/scene/text_scan.h"

namespace ninebit {
namespace {

struct ObjScan {
  std::array<std::int64_t, 3> defined{};  // v, vt, vn so far
  std::array<std::int64_t, 3> highest{};  // the highest index used of each
  std::array<int, 3> highest_line{};      // and where
  std::uint64_t triangles = 0;
};

constexpr std::array<const char*, 3> kKinds{"vertex", "texture coordinate", "normal"};

// One corner of a face, "v", "v/vt", "v//vn" or "v/vt/vn"; indices count from 1, or back from the last with a sign.
std::optional<std::string> check_corner(std::string_view word, int line, ObjScan& scan) {
  const std::string_view whole = word;
  for (std::size_t kind = 0; kind < 3; ++kind) {
    const std::size_t slash = std::min(word.find('/'), word.size());
    const std::string_view part = word.substr(0, slash);
    if (!part.empty() || kind == 0) {
      const std::optional<std::int64_t> index = number_of<std::int64_t>(part);
      if (!index) return fmt::format("'{}' is not a face corner", whole);
      if (*index == 0 || *index < -scan.defined[kind])
        return fmt::format("{} index {} is out of range", kKinds[kind], part);
      if (*index > scan.highest[kind]) {
        scan.highest[kind] = *index;
        scan.highest_line[kind] = line;
      }
    }
    if (slash == word.size()) return std::nullopt;
    word.remove_prefix(slash + 1);
  }
  return fmt::format("'{}' is not a face corner", whole);
}

std::optional<std::string> check_statement(const std::vector<std::string_view>& words, int line, ObjScan& scan) {
  const std::string_view key = words[0];
  if (key == "v" || key == "vn") {
    if (words.size() < 4) return fmt::format("'{}' needs three numbers", key);
    for (std::size_t i = 1; i < words.size(); ++i) {
      // A normal that is no number is no reason to refuse the geometry: it is computed anew.
      if (key == "v" || !number_of<double>(words[i])) {
        if (auto fault = coordinate_fault(words[i])) return fault;
      }
    }
    ++scan.defined[key == "v" ? 0 : 2];
  } else if (key == "vt") {
    ++scan.defined[1];
  } else if (key == "f" || key == "fo") {
    if (words.size() < 4) return "a face needs at least three corners";
    for (std::size_t i = 1; i < words.size(); ++i) {
      if (auto fault = check_corner(words[i], line, scan)) return fault;
    }
    scan.triangles += words.size() - 3;
  }
  return std::nullopt;
}

}  // namespace

Result<FileFacts> check_obj(std::string_view content) {
  if (content.size() >= 2 && (content.substr(0, 2) == "\xFF\xFE" || content.substr(0, 2) == "\xFE\xFF"))
    return at_line(0, "is UTF-16 text; OBJ files are read as ASCII or UTF-8");
  if (content.find('\0') != std::string_view::npos) return at_line(0, "is not an OBJ file: it holds binary data");
  if (auto fault = overlong_line(content)) return *fault;
  ObjScan scan;
  std::string plain;
  plain.reserve(content.size());
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
    append_line(plain, words);
    if (words.empty()) continue;
    if (auto fault = check_statement(words, number, scan)) return at_line(number, *fault);
  }
  // A face may name vertices that follow it, so the upper limit is known only now.
  for (std::size_t kind = 0; kind < 3; ++kind) {
    if (scan.highest[kind] <= scan.defined[kind]) continue;
    return at_line(scan.highest_line[kind], fmt::format("{} index {} is out of range: the file has {}", kKinds[kind],
                                                        scan.highest[kind], scan.defined[kind]));
  }
  FileFacts facts;
  facts.triangles = scan.triangles;
  facts.for_assimp = std::move(plain);
  return facts;
}

}  // namespace ninebit
