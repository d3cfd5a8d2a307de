#include <fmt/format.h>

#include "src/scene/file_check.h"
#include "src/scene/text_scan.h"

namespace ninebit {
namespace {

// The next line that holds words; false at the end of the file.
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

}  // namespace

Result<FileFacts> check_off(std::string_view content) {
  FileFacts facts;
  std::string& plain = facts.for_assimp.emplace();
  if (auto fault = overlong_line(content)) return *fault;
  LineScanner lines(content);
  std::vector<std::string_view> words;
  if (!next_words(lines, words) || !words[0].ends_with("OFF"))
    return at_line(lines.number(), "is not an OFF file: it does not start with 'OFF'");
  const std::string_view kind = words[0];
  const bool known = kind == "OFF" || kind == "COFF" || kind == "NOFF" || kind == "CNOFF" || kind == "STOFF";
  if (!known || (words.size() > 1 && words[1] == "BINARY"))
    return at_line(lines.number(), "is of an OFF kind that is not read; OFF, COFF, NOFF, CNOFF and STOFF text are");
  plain.append(kind).push_back('\n');
  words.erase(words.begin());
  if (words.empty() && !next_words(lines, words)) return at_line(0, "ends before its counts");
  std::optional<std::uint32_t> vertices = number_of<std::uint32_t>(words[0]);
  std::optional<std::uint32_t> faces = words.size() > 1 ? number_of<std::uint32_t>(words[1]) : std::nullopt;
  if (words.size() != 3 || !vertices || !faces || !number_of<std::uint32_t>(words[2]))
    return at_line(lines.number(), "should give the numbers of vertices, faces and edges here");

  append_line(plain, words);
  for (std::uint32_t i = 0; i < *vertices; ++i) {
    if (!next_words(lines, words)) return ends_early("vertices", i, *vertices);
    if (words.size() < 3) return at_line(lines.number(), "a vertex needs three coordinates");
    for (std::size_t k = 0; k < 3; ++k) {
      if (auto fault = coordinate_fault(words[k])) return at_line(lines.number(), *fault);
    }
    append_line(plain, words);
  }
  facts.triangles = 0;
  for (std::uint32_t i = 0; i < *faces; ++i) {
    if (!next_words(lines, words)) return ends_early("faces", i, *faces);
    const std::optional<std::uint32_t> corners = number_of<std::uint32_t>(words[0]);
    if (!corners) return at_line(lines.number(), fmt::format("'{}' is not a number of corners", words[0]));
    if (words.size() - 1 < *corners) return at_line(lines.number(), "a face lists fewer corners than it declares");
    for (std::size_t k = 1; k <= *corners; ++k) {
      const std::optional<std::uint32_t> index = number_of<std::uint32_t>(words[k]);
      if (!index || *index >= *vertices)
        return at_line(lines.number(), fmt::format("vertex index {} is out of range: the file has {}, counted from 0",
                                                   words[k], *vertices));
    }
    append_line(plain, words);
    if (*corners >= 3) *facts.triangles += *corners - 2;
  }
  return facts;
}

}  // namespace ninebit
