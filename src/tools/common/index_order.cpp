#include "src/tools/common/index_order.h"

#include <fmt/format.h>

namespace ninebit::tools {

void warn_of_unused_order(const RenderSettings& settings, const IndexOrderReport& report, bool quiet) {
  if (quiet || settings.index.order == report.order) return;
  say_warning(fmt::format("--index-order neighbour has no effect, the order of the file is used: {}", report.reason));
}

std::string order_text(const IndexOrderReport& report) {
  if (report.order == IndexOrder::file) return {};
  return fmt::format("index order: {} patches, {} borders, {} broken ({:.1f} % of their length), {} false neighbours\n",
                     report.patches, report.borders, report.broken_borders, 100.0 * report.broken_share,
                     report.false_neighbours);
}

void add_order(Json& index, const IndexOrderReport& report) {
  index["order"] = name_of(report.order);
  if (!report.reason.empty()) index["reason"] = report.reason;
  if (report.order == IndexOrder::file) return;
  index["patches"] = report.patches;
  index["borders"] = report.borders;
  index["broken_borders"] = report.broken_borders;
  index["broken_share"] = report.broken_share;
  index["false_neighbours"] = report.false_neighbours;
}

}  // namespace ninebit::tools
