#include "src/system/inside_folder.h"

#include <algorithm>
#include <system_error>

namespace ninebit::posix {

namespace {

namespace fs = std::filesystem;

constexpr std::string_view kSeparators = "/\\";

// The name quoted for a message.
std::string shown(std::string_view name) {
  constexpr std::size_t kLongest = 200;
  std::string text(name.substr(0, kLongest));
  if (name.size() > kLongest) text += "...";
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  }
  return "'" + text + "'";
}

bool has_parent_step(std::string_view name) {
  while (!name.empty()) {
    const std::size_t end = std::min(name.find_first_of(kSeparators), name.size());
    if (name.substr(0, end) == "..") return true;
    name.remove_prefix(std::min(end + 1, name.size()));
  }
  return false;
}

// "http:", "file:", "C:": letters, digits, '+', '-' and '.' before a colon in the first part of the name. A name such
// as "a b:c" is that of a file.
bool is_address(std::string_view name) {
  const std::size_t colon = name.find(':');
  if (colon == std::string_view::npos || colon == 0) return false;
  return std::all_of(name.begin(), name.begin() + static_cast<std::ptrdiff_t>(colon), [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '+' || c == '-' ||
           c == '.';
  });
}

bool is_below(const fs::path& folder, const fs::path& file) {
  return std::mismatch(folder.begin(), folder.end(), file.begin(), file.end()).first == folder.end();
}

// The fault in the text of a name; empty: none.
std::string wrong_with_text(std::string_view name) {
  if (name.empty()) return "is empty";
  if (name.find('\0') != std::string_view::npos) return "contains a zero byte";
  if (kSeparators.find(name.front()) != std::string_view::npos) return "is an absolute path";
  if (is_address(name)) return "is an address";
  if (has_parent_step(name)) return "leaves the folder of the file that names it";
  return {};
}

// Whether a part of the name is a dangling link: it may lead to a file outside by the time the file is opened.
bool has_dangling_link(const fs::path& top, std::string_view name) {
  fs::path part = top;
  for (const fs::path& step : fs::path(name)) {
    part /= step;
    std::error_code error;
    if (!fs::is_symlink(fs::symlink_status(part, error))) continue;
    if (!fs::exists(fs::status(part, error))) return true;
  }
  return false;
}

// The fault in the place that a name leads to; empty: none.
std::string wrong_with_place(const fs::path& folder, std::string_view name) {
  std::error_code error;
  const fs::path top = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
  if (error) return "cannot be found: " + error.message();
  const fs::path place = fs::weakly_canonical(top / name, error);
  if (error) return "cannot be followed: " + error.message();
  if (!is_below(top, place)) return "is a link out of the folder of the file that names it";
  if (has_dangling_link(top, name)) return "is a dangling link";
  const fs::file_status status = fs::status(place, error);
  if (fs::exists(status) && !fs::is_regular_file(status)) return "is not a regular file";
  return {};
}

}  // namespace

std::optional<std::string> why_outside(const fs::path& folder, std::string_view name) {
  std::string wrong = wrong_with_text(name);
  if (wrong.empty()) wrong = wrong_with_place(folder, name);
  if (wrong.empty()) wrong = wrong_with_place(folder, without_setup(name));
  if (wrong.empty()) return std::nullopt;
  return shown(name) + ' ' + wrong +
         "; expected a regular file below the folder of the file that names it, or --allow-outside";
}

std::string_view without_setup(std::string_view name) {
  constexpr std::size_t kMostDigits = 9;
  const std::size_t hash = name.rfind('#');
  if (hash == std::string_view::npos || hash == 0) return name;
  const std::string_view digits = name.substr(hash + 1);
  const bool is_number = !digits.empty() && digits.size() <= kMostDigits &&
                         std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  return is_number ? name.substr(0, hash) : name;
}

}  // namespace ninebit::posix
