// The order of indices in the words of the program: warnings, the summary, JSON.
#pragma once

#include <string>

#include "ninebit/shadow/technique.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// Prints a warning to stderr, unless quiet, if a rendering with --index-order neighbour used the order of the file.
void warn_of_unused_order(const RenderSettings& settings, const IndexOrderReport& report, bool quiet);

// "index order: 40 patches, 60 borders, 3 broken (5.0 % of their length), 0 false neighbours", with a line break; empty
// for the order of the file.
[[nodiscard]] std::string order_text(const IndexOrderReport& report);

// Adds `order` to the object and, for IndexOrder::neighbour, the counts of the report.
void add_order(Json& index, const IndexOrderReport& report);

}  // namespace ninebit::tools
