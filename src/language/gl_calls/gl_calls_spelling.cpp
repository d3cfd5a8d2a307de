#include "src/language/gl_calls/gl_calls_spelling.h"

#include <algorithm>
#include <array>
#include <vector>

#include "src/language/source/nearest_name.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {
namespace {

constexpr std::size_t kLongestName = 64;

char lower(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool same_letters(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower(x) == lower(y); });
}

std::size_t find_letters(std::string_view text, std::string_view part) {
  const auto found = std::search(text.begin(), text.end(), part.begin(), part.end(),
                                 [](char x, char y) { return lower(x) == lower(y); });
  return found == text.end() ? std::string_view::npos : static_cast<std::size_t>(found - text.begin());
}

// Whether a function pointer's name may begin like this: gl, pgl, qgl, _gl, __glew, m_gl_, …
bool is_gl_prefix(std::string_view prefix) {
  if (prefix.ends_with('_')) prefix.remove_suffix(1);
  for (const std::string_view end : {"gl", "glew", "GL", "Gl"}) {
    if (prefix.ends_with(end)) return true;
  }
  return false;
}

// Whether it may end like this, in upper or lower case, with or without an underscore before it.
bool is_pointer_suffix(std::string_view suffix) {
  if (suffix.empty()) return true;
  if (suffix.front() == '_') suffix.remove_prefix(1);
  for (const std::string_view known : {"ext", "proc", "ptr", "func", "fn", "fp", "nv", "arb"}) {
    if (same_letters(suffix, known)) return true;
  }
  return false;
}

// How the words before a call's own name and after it are judged. Names of combiners are their own proof; Enable and
// Disable need a prefix of GL. Without NV, a combiner's name is one only as GL's own, or bare.
bool is_call(const GlSignature& call, std::string_view prefix, std::string_view suffix, bool has_nv) {
  constexpr std::size_t kLongestPrefix = 20;
  if (prefix.size() > kLongestPrefix || !is_pointer_suffix(suffix)) return false;
  if (call.command == GlCommand::enable || call.command == GlCommand::disable) return is_gl_prefix(prefix);
  if (prefix.empty() || is_gl_prefix(prefix)) return true;
  const bool other = prefix.ends_with("Get") || prefix.ends_with("Final") || prefix.ends_with("get");
  return has_nv && !other;
}

// The letters and digits of an enumerant that tell it from others: without GL, without NV, ARB or EXT at the end,
// without underscores, in upper case.
std::string core_of(std::string_view name) {
  std::string core;
  for (const char c : name) {
    if (c != '_') core += c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
  }
  if (core.starts_with("GL")) core.erase(0, 2);
  for (const std::string_view end : {"NV", "ARB", "EXT", "SGIS"}) {
    if (core.ends_with(end)) {
      core.erase(core.size() - end.size());
      break;
    }
  }
  return core;
}

// Whether a name without its GL_ is also a word of everyday sources.
bool is_ordinary(std::string_view core) {
  constexpr std::array<std::string_view, 10> kOrdinary{"RGB",  "ALPHA", "BLUE", "FOG",   "ZERO",
                                                       "NONE", "ONE",   "TRUE", "FALSE", "DISCARD"};
  return core.starts_with("TEXTURE") || core.starts_with("SPARE") ||
         std::find(kOrdinary.begin(), kOrdinary.end(), core) != kOrdinary.end();
}

// Whether a name ends as only names of extensions do.
bool has_ending(std::string_view name) {
  return name.ends_with("_NV") || name.ends_with("_ARB") || name.ends_with("_EXT");
}

struct Core {
  std::string core;
  gl::GLenum value;
};

const std::vector<Core>& cores() {
  static const std::vector<Core> all = [] {
    std::vector<Core> made;
    for (const std::string_view name : gl_names()) made.push_back({core_of(name), *value_of_name(name)});
    return made;
  }();
  return all;
}

}  // namespace

const GlSignature* find_gl_call(std::string_view name) {
  // Most names of a source are none of these.
  const bool may_be =
      find_letters(name, "combiner") != std::string_view::npos || find_letters(name, "able") != std::string_view::npos;
  if (name.size() > kLongestName || !may_be) return nullptr;
  for (const GlSignature& call : gl_calls()) {
    const bool is_nv = call.name.ends_with("NV");
    const std::string_view base = is_nv ? call.name.substr(0, call.name.size() - 2) : call.name;
    const std::size_t at = name.find(base);
    if (at == std::string_view::npos) continue;
    std::string_view suffix = name.substr(at + base.size());
    const bool has_nv = is_nv && same_letters(suffix.substr(0, 2), "nv");
    if (has_nv) suffix.remove_prefix(2);
    if (is_call(call, name.substr(0, at), suffix, has_nv)) return &call;
  }
  return nullptr;
}

const GlSignature* find_gl_method(std::string_view name) {
  if (same_letters(name, "enable")) return find_gl_call("glEnable");
  return same_letters(name, "disable") ? find_gl_call("glDisable") : nullptr;
}

bool is_conversion(std::string_view name) {
  constexpr std::array<std::string_view, 16> kTypes{"byte", "bytebool", "boolean", "bool",     "int",   "integer",
                                                    "uint", "cardinal", "longint", "longword", "dword", "word",
                                                    "ord",  "float",    "single",  "wrap"};
  if (name.ends_with("_cast")) return true;
  const auto is_gls = [&](std::string_view start) {
    return name.starts_with(start) && name.size() > start.size() && name[start.size()] != '_' &&
           find_gl_call(name) == nullptr;
  };
  if (is_gls("GL") || is_gls("TGL") || is_gls("PGL")) return true;
  return std::any_of(kTypes.begin(), kTypes.end(), [&](std::string_view one) { return same_letters(name, one); });
}

std::optional<gl::GLenum> value_of_spelling(std::string_view name, bool qualified) {
  if (name.empty() || name.size() > kLongestName) return std::nullopt;
  const std::string core = core_of(name);
  const bool has_gl = name.starts_with("GL") || name.starts_with("gl");
  if (!has_gl && !qualified && !has_ending(name) && is_ordinary(core)) return std::nullopt;
  for (const Core& known : cores()) {
    if (known.core == core) return known.value;
  }
  return std::nullopt;
}

// GL_ is no letter in which names are alike.
std::string meant_enumerant(std::string_view name) {
  constexpr std::string_view kStart = "GL_";
  std::vector<std::string_view> names = gl_names();
  for (std::string_view& one : names) one.remove_prefix(kStart.size());
  const auto nearest = nearest_name(name.starts_with(kStart) ? name.substr(kStart.size()) : name, names);
  return nearest ? "; did you mean '" + std::string(kStart) + *nearest + "'?" : "";
}

std::string meant_call(std::string_view name) {
  std::vector<std::string> names;
  for (const GlSignature& call : gl_calls()) names.push_back("gl" + std::string(call.name));
  return did_you_mean(name, names);
}

}  // namespace ninebit::detail
