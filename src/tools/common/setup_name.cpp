#include "src/tools/common/setup_name.h"

#include <algorithm>
#include <filesystem>
#include <system_error>

namespace ninebit::tools {

std::string_view without_setup(std::string_view name) {
  constexpr std::size_t kMostDigits = 9;
  const std::size_t hash = name.rfind('#');
  if (hash == std::string_view::npos || hash == 0) return name;
  const std::string_view digits = name.substr(hash + 1);
  const bool is_number = !digits.empty() && digits.size() <= kMostDigits &&
                         std::all_of(digits.begin(), digits.end(), [](char c) { return c >= '0' && c <= '9'; });
  return is_number ? name.substr(0, hash) : name;
}

SetupName setup_name(const std::string& name) {
  const std::string_view file = without_setup(name);
  std::error_code error;
  if (file.size() == name.size() || std::filesystem::exists(name, error)) return {name};
  return {std::string(file), std::stoul(name.substr(file.size() + 1))};
}

}  // namespace ninebit::tools
