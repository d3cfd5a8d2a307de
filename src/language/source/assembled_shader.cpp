#include "src/language/source/assembled_shader.h"

#include <algorithm>
#include <charconv>
#include <utility>

#include "src/language/source/source_blanks.h"

namespace ninebit {
namespace {

// Moves to the next token. False: the text ends.
bool next_token_at(std::string_view text, std::size_t& at) {
  detail::SourceFaults none({text, {}});
  return detail::skip_blanks(text, at, {.hash_comments = true, .heading = {}}, none) && at < text.size();
}

// Moves behind the brace of "static const DWORD ps[] = {".
bool skip_array_head(std::string_view text, std::size_t& at) {
  constexpr std::string_view kMarks = "[]=:*()";
  bool has_brackets = false;
  while (next_token_at(text, at)) {
    const char c = text[at];
    if (c == '{') {
      ++at;
      return has_brackets;
    }
    if (!detail::is_word(c) && kMarks.find(c) == std::string_view::npos) return false;
    has_brackets = has_brackets || c == '[';
    do {
      ++at;
    } while (at < text.size() && detail::is_word(c) && detail::is_word(text[at]));
  }
  return false;
}

// Takes a number and the comma behind it.
std::optional<std::uint32_t> take_number(std::string_view text, std::size_t& at) {
  if (!next_token_at(text, at)) return std::nullopt;
  const bool hexadecimal = text.substr(at).starts_with("0x") || text.substr(at).starts_with("0X");
  if (hexadecimal) at += 2;
  std::uint32_t value = 0;
  const auto [end, error] = std::from_chars(text.data() + at, text.data() + text.size(), value, hexadecimal ? 16 : 10);
  if (error != std::errc()) return std::nullopt;
  at = static_cast<std::size_t>(end - text.data());
  while (at < text.size() && detail::is_word(text[at])) ++at;  // a suffix
  if (next_token_at(text, at) && text[at] == ',') ++at;
  return value;
}

}  // namespace

std::string assembled_shader(std::uint32_t first_token) {
  constexpr std::uint32_t kPixelShader = 0xffff, kVertexShader = 0xfffe;
  const std::uint32_t kind = first_token >> 16, major = first_token >> 8 & 0xff, minor = first_token & 0xff;
  if ((kind != kPixelShader && kind != kVertexShader) || major < 1 || major > 3 || minor > 4) return {};
  const std::string version = std::to_string(major) + "." + std::to_string(minor);
  if (kind == kPixelShader && major == 1) {
    return "these are the tokens of an assembled pixel shader (ps." + version +
           "), which ninebit does not read; disassemble it";
  }
  return "these are the tokens of an assembled " +
         (kind == kPixelShader ? "pixel shader (ps." : std::string("vertex shader (vs.")) + version +
         "), which register combiners cannot run";
}

std::optional<AssembledShader> assembled_shader_in(std::string_view text) {
  constexpr std::size_t kLookedAt = std::size_t{1} << 16;
  text = text.substr(0, kLookedAt);
  std::size_t at = text.starts_with(detail::kByteOrderMark) ? detail::kByteOrderMark.size() : 0;
  if (!skip_array_head(text, at) || !next_token_at(text, at)) return std::nullopt;
  const std::size_t offset = at;
  std::uint32_t token = take_number(text, at).value_or(0);
  for (int shift = 8; shift < 32 && token >> shift == 0; shift += 8) {  // bytes
    const std::uint32_t byte = take_number(text, at).value_or(0);
    if (byte > 0xff) break;
    token |= byte << shift;
  }
  std::string message = assembled_shader(token);
  if (message.empty()) return std::nullopt;
  return AssembledShader{offset, std::move(message)};
}

}  // namespace ninebit
