// Facts about this build.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ninebit::tools {

// Names and values in the order of printing: compiler, build type, processor, SIMD target.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> build_facts();

// "ninebit VERSION" and a line for each fact.
[[nodiscard]] std::string version_text();

}  // namespace ninebit::tools
