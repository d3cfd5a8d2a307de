#include <charconv>
#include <limits>
#include <system_error>

#include "src/language/gl_calls/gl_calls_execute.h"

namespace ninebit::detail {
namespace {

// Whether a suffix is one of C's: f and l for floats; u, l, ul, ll, … for integers, in any order and case.
bool is_suffix(std::string_view suffix, std::string_view letters, std::size_t most) {
  return suffix.size() <= most && suffix.find_first_not_of(letters) == std::string_view::npos;
}

// Reads an integer; false if it is not valid C or its type cannot hold it.
bool read_integer(std::string_view text, GlArgument& out) {
  const bool pascal = text.starts_with("$");
  const bool hex = pascal || text.starts_with("0x") || text.starts_with("0X");
  const int base = hex ? 16 : text.size() > 1 && text.front() == '0' ? 8 : 10;
  if (hex) text.remove_prefix(pascal ? 1 : 2);
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), out.integer, base);
  const std::string_view rest(end, static_cast<std::size_t>(text.data() + text.size() - end));
  if (error != std::errc{} || !is_suffix(rest, "uUlL", 3)) return false;
  out.real = static_cast<double>(out.integer);
  return out.integer <= std::int64_t{std::numeric_limits<gl::GLenum>::max()};
}

bool read_real(std::string_view text, GlArgument& out) {
  out.is_integer = false;
  const char* const last = text.data() + text.size();
  const auto [end, error] = std::from_chars(text.data(), last, out.real);
  const std::string_view rest(end, static_cast<std::size_t>(last - end));
  if (error != std::errc{} || !is_suffix(rest, "fFlLdD", 1)) return false;
  if (rest != "f" && rest != "F") return true;
  // A float constant is the float nearest to the digits, not the float nearest to the double nearest to them.
  float single = 0;
  if (std::from_chars(text.data(), end, single).ec != std::errc{}) return false;
  out.real = single;
  return true;
}

}  // namespace

bool read_gl_number(std::string_view text, GlArgument& out) {
  const bool hex = text.starts_with("$") || text.starts_with("0x") || text.starts_with("0X");
  const bool real = !hex && text.find_first_of(".eE") != std::string_view::npos;
  // In Java and C#, 1f and 1d are real numbers.
  const bool javas = !hex && !real && text.size() > 1 && is_suffix(text.substr(text.size() - 1), "fFdD", 1);
  return real || javas ? read_real(text, out) : read_integer(text, out);
}

}  // namespace ninebit::detail
