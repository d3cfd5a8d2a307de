#include "src/tools/draw/color_flags.h"

#include <fmt/format.h>

#include "ninebit/combiner/state.h"
#include "src/system/number_list.h"

namespace ninebit::tools {
namespace {

// Parses the given count of numbers from 0 to 1.
std::string check_color(const std::string& text, std::size_t count) {
  const auto n = numbers<float>(text, ',');
  bool valid = n && n->size() == count;
  if (valid) {
    for (const float x : *n) valid = valid && x >= 0.0F && x <= 1.0F;
  }
  return valid ? "" : fmt::format("'{}' is not a colour; expected {} numbers from 0 to 1", text, count);
}

}  // namespace

std::pair<std::string_view, std::string> split_constant(std::string_view text) {
  const std::size_t colon = text.find(':');
  if (colon == std::string_view::npos) return {{}, std::string(text)};
  return {text.substr(0, colon), std::string(text.substr(colon + 1))};
}

std::string check_constant(const std::string& text) {
  const auto [combiner, color] = split_constant(text);
  const bool numbered = combiner.size() == 1 && combiner[0] >= '0' && combiner[0] < '0' + kMaxGeneralCombiners;
  if (text.find(':') != std::string::npos && !numbered) {
    return fmt::format("'{}' is not a general combiner; expected 0 to {}", combiner, kMaxGeneralCombiners - 1);
  }
  return check_color(color, 4);
}
std::string check_rgb(const std::string& text) {
  return check_color(text, 3);
}

}  // namespace ninebit::tools
