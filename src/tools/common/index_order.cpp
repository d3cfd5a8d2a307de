#include "src/tools/common/index_order.h"

#include <fmt/format.h>

#include "src/tools/common/scene_flags.h"

namespace ninebit::tools {

std::string order_without_indices(std::string_view technique, const RenderSettings& settings) {
  if (settings.index.order == IndexOrder::file || technique == "index-cube") return {};
  if (technique != "light-cookie") return fmt::format("technique {} draws no indices", technique);
  return settings.light_cookie.shadows ? "" : "technique light-cookie with --cookie-shadows none draws no indices";
}

void warn_of_unused_order(std::string_view technique, const RenderSettings& settings, const IndexOrderReport& report,
                          bool quiet) {
  if (quiet || settings.index.order == IndexOrder::file) return;
  const std::string none = order_without_indices(technique, settings);
  if (!none.empty()) {
    say_warning(fmt::format("--index-order neighbour has no effect: {}", none));
  } else if (report.order == IndexOrder::file) {
    say_warning(fmt::format("--index-order neighbour has no effect, the order of the file is used: {}", report.reason));
  }
}

std::string order_text(const IndexOrderReport& report) {
  if (report.order == IndexOrder::file) return {};
  return fmt::format("index order: {} patches, {} borders, {} broken ({:.1f} % of their length), {} false neighbours\n",
                     report.patches, report.borders, report.broken_borders, 100.0 * report.broken_share,
                     report.false_neighbours);
}

void add_order(Json& index, const IndexOrderReport& report) {
  index["order"] = name_in(kIndexOrders, report.order);
  if (!report.reason.empty()) index["reason"] = report.reason;
  if (report.order == IndexOrder::file) return;
  index["patches"] = report.patches;
  index["borders"] = report.borders;
  index["broken_borders"] = report.broken_borders;
  index["broken_share"] = report.broken_share;
  index["false_neighbours"] = report.false_neighbours;
}

}  // namespace ninebit::tools
