#include "src/tools/common/number_flag.h"

#include <fmt/format.h>

namespace ninebit::tools {

CLI::Validator real_in_range(double least, double greatest) {
  const auto check = [=](const std::string& text) -> std::string {
    if (are_numbers_in<double>(text, ',', 1, least, greatest)) return {};
    return fmt::format("'{}' is out of range; expected a number from {:g} to {:g}", text, least, greatest);
  };
  return CLI::Validator(check, "");
}

}  // namespace ninebit::tools
