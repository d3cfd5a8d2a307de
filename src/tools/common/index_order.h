// The order of indices in the words of the program: warnings, the summary, JSON.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/shadow/technique.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// Why --index-order neighbour has no effect with a technique: it draws no indices. Empty if it draws some, or if the
// settings ask for the order of the file.
[[nodiscard]] std::string order_without_indices(std::string_view technique, const RenderSettings& settings);

// Prints a warning to stderr, unless quiet, if --index-order neighbour had no effect on a rendering: the technique
// draws no indices, or the rendering used the order of the file.
void warn_of_unused_order(std::string_view technique, const RenderSettings& settings, const IndexOrderReport& report,
                          bool quiet);

// "index order: 40 patches, 60 borders, 3 broken (5.0 % of their length), 0 false neighbours", with a line break; empty
// for the order of the file.
[[nodiscard]] std::string order_text(const IndexOrderReport& report);

// Adds `order` to the object and, for IndexOrder::neighbour, the counts of the report.
void add_order(Json& index, const IndexOrderReport& report);

}  // namespace ninebit::tools
