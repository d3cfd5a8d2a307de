#include "src/language/gl_calls/gl_calls_dump.h"

#include <algorithm>

#include "src/language/gl_calls/gl_calls_names.h"
#include "src/language/gl_calls/gl_calls_spelling.h"
#include "src/language/source/source_blanks.h"

namespace ninebit::detail {
namespace {

bool is_space(char c) {
  return c == ' ' || c == '\t';
}

// The first byte from `at` on that is not one of these.
template <class Is>
std::size_t behind(std::string_view text, std::size_t at, const Is& is) {
  while (at < text.size() && is(text[at])) ++at;
  return at;
}

bool begins_line(std::string_view text, std::size_t at) {
  if (text.starts_with(kByteOrderMark)) {
    text.remove_prefix(kByteOrderMark.size());
    at -= kByteOrderMark.size();
  }
  while (at > 0 && is_space(text[at - 1])) --at;
  return at == 0 || text[at - 1] == '\n' || text[at - 1] == '\r';
}

// The end of a line. Text in quotes, such as that of a shader, may go on in the next lines.
std::size_t end_of_line(std::string_view text, std::size_t at) {
  for (bool quoted = false; at < text.size() && (quoted || text[at] != '\n'); ++at) {
    if (quoted && text[at] == '\\') {
      ++at;
    } else if (text[at] == '"') {
      quoted = !quoted;
    }
  }
  return std::min(at, text.size());
}

// Whether the arguments of glEnable or glDisable name a capability of the combiners.
bool names_capability(std::string_view arguments) {
  const auto has = [&](std::string_view part) { return arguments.find(part) != std::string_view::npos; };
  return has("REGISTER_COMBINERS") || has("PER_STAGE_CONSTANTS") || has("0x8522") || has("0x8535");
}

}  // namespace

std::optional<GlDumpLine> gl_dump_line(std::string_view text, std::size_t number) {
  if (!begins_line(text, number)) return std::nullopt;
  std::size_t at = behind(text, number, is_digit);
  const bool has_colon = at < text.size() && text[at] == ':';
  if (has_colon) ++at;
  const std::size_t blank = at;
  at = behind(text, at, is_space);
  if (at < text.size() && text[at] == '@') at = behind(text, behind(text, at + 1, is_digit), is_space);  // a thread
  if (at == blank && !has_colon) return std::nullopt;
  GlDumpLine line{.call = at};
  const std::size_t name_end = behind(text, at, is_word);
  line.name = text.substr(at, name_end - at);
  const std::size_t open = behind(text, name_end, is_space);
  if (line.name.empty() || is_digit(line.name.front()) || text.substr(open, 1) != "(") return std::nullopt;
  line.end = end_of_line(text, open);
  const GlSignature* const call = find_gl_call(line.name);
  const bool switches = call != nullptr && call->parameters == "e";
  line.sets_combiners = call != nullptr && (!switches || names_capability(text.substr(open, line.end - open)));
  return line;
}

}  // namespace ninebit::detail
