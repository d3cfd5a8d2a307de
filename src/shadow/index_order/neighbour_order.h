// Index codes that neighbours cannot be told apart by.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/settings.h"
#include "ninebit/shadow/technique.h"
#include "src/shadow/index_order/lost_differences.h"

namespace ninebit {

struct NeighbourOrder {
  std::vector<std::uint32_t> patch_of_polygon;
  std::vector<CodeBytes> code;  // of each patch
  IndexOrderReport report;      // if report.order is `file`, nothing else is set but the reason
};

// Orders the patches of a valid scene. units: the unit of each polygon, numbered from 0 without gaps, if units are not
// polygons; otherwise empty, and patches are grown. The same on every run. Reports more patches than codes, and what
// index_comparison_state reports.
[[nodiscard]] Result<NeighbourOrder> order_by_neighbours(const Scene& scene, const IndexSettings& settings,
                                                         const HardwareProfile& profile,
                                                         std::span<const std::uint32_t> units = {});

}  // namespace ninebit
