// The settings that a shadow sweep can change: the techniques that support each, and their fields in a row.
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

// The settings for a sweep that a technique reads.
struct SweptSettings {
  std::string_view technique;
  bool map_size = true;
  bool index = false;
  bool index_order = false;   // a column; by default there is none
  bool index_scales = false;  // a column; by default there is none
  bool depth_cube = false;
  bool shadow_map = false;
};

// The settings of a sweep over the grid. Reports a technique that draws no shadows.
[[nodiscard]] Result<SweptSettings> swept_settings(const Technique& technique, const RenderSettings& settings,
                                                   const ShadowGrid& grid = {});

// One axis of a grid that has values.
struct SweepAxis {
  std::string flag;                  // "--map-sizes"
  std::vector<std::string> columns;  // fields of a row: "map_size"
  std::size_t size = 0;
  std::function<void(RenderSettings& settings, std::size_t value)> set;
};

// The axes of a grid, the slowest first. The grid must outlive them. Reports axes that the technique does not support.
[[nodiscard]] Result<std::vector<SweepAxis>> axes_of(const SweptSettings& known, const ShadowGrid& grid);

// The settings that the technique reads, as a row's fields. A bias or an offset that the technique chooses itself comes
// from the rendering's facts, and has no value without a rendering.
using RowFields = std::vector<std::pair<std::string, StudyValue>>;
[[nodiscard]] RowFields settings_fields(const SweptSettings& known, const RenderSettings& settings,
                                        const Rendering* rendering);

// The possible causes of the technique's errors.
[[nodiscard]] std::span<const ErrorCause> causes_of(const SweptSettings& known);

}  // namespace ninebit
