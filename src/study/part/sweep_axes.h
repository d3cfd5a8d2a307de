// The settings that a sweep of shadows can change: which technique knows which, and how a row tells them.
#pragma once

#include <cstddef>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "ninebit/study/shadow_sweep.h"

namespace ninebit {

// What a technique reads of the settings that can be swept.
struct SweptSettings {
  std::string_view technique;
  bool map_size = true;
  bool index = false;
  bool depth_cube = false;
  bool shadow_map = false;
};

// Reports a technique that draws no shadows.
[[nodiscard]] Result<SweptSettings> swept_settings(const Technique& technique, const RenderSettings& settings);

// One axis of a grid that has values.
struct SweepAxis {
  std::string flag;                  // "--map-sizes"
  std::vector<std::string> columns;  // of a row: "map_size"
  std::size_t size = 0;
  std::function<void(RenderSettings& settings, std::size_t value)> set;
};

// The axes of a grid, which must outlive them; the slowest first. Reports one that the technique does not know.
[[nodiscard]] Result<std::vector<SweepAxis>> axes_of(const SweptSettings& known, const ShadowGrid& grid);

// The settings that the technique reads, as a row's fields. A bias or an offset that it chooses by itself is what the
// rendering's facts say, and nothing where there is no rendering.
using RowFields = std::vector<std::pair<std::string, StudyValue>>;
[[nodiscard]] RowFields settings_fields(const SweptSettings& known, const RenderSettings& settings,
                                        const Rendering* rendering);

// The causes that its errors can have.
[[nodiscard]] std::span<const ErrorCause> causes_of(const SweptSettings& known);

}  // namespace ninebit
