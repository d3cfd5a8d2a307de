#include "src/tools/common/pixel_flag.h"

#include <fmt/format.h>

#include "src/system/number_list.h"

namespace ninebit::tools {
namespace {

std::string check_pixel(const std::string& text) {
  const auto n = numbers<int>(text, ',');
  if (n && n->size() == 2 && n->at(0) >= 0 && n->at(1) >= 0) return {};
  return fmt::format("invalid pixel '{}'; expected X,Y, counted from the top left", text);
}

}  // namespace

CLI::Option* add_pixel_flag(CLI::App& verb, const std::string& flag, std::string& text, const std::string& help) {
  return verb.add_option(flag, text, help)
      ->type_name("X,Y")
      ->check(CLI::Validator([](std::string& value) { return check_pixel(value); }, ""));
}

Result<glm::ivec2> window_pixel(const std::string& flag, const std::string& text, const RenderSettings& settings) {
  const auto at = *numbers<int>(text, ',');
  if (at[0] < settings.width && at[1] < settings.height) return glm::ivec2(at[0], settings.height - 1 - at[1]);
  return Diagnostic{.message =
                        fmt::format("{}: {} is outside of the picture; expected X from 0 to {} and Y from 0 to {}",
                                    flag, text, settings.width - 1, settings.height - 1)};
}

}  // namespace ninebit::tools
