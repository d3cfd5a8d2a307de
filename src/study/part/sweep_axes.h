// The settings that a shadow sweep changes, and their fields in a row.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/shadow/ground_truth.h"
#include "ninebit/study/shadow_sweep.h"

namespace ninebit {

// The axes of a sweep over a technique's settings, and how they are shown.
struct SweptSettings {
  std::string_view technique;
  std::vector<const TechniqueSetting*> settings{};  // the axes that the technique has
  std::vector<const TechniqueSetting*> columns{};   // those that rows show

  [[nodiscard]] bool has(std::string_view axis) const;         // among the settings
  [[nodiscard]] bool has_column(std::string_view name) const;  // among the columns
};

// The settings of a sweep over the grid. Reports a technique that draws no shadows.
[[nodiscard]] Result<SweptSettings> swept_settings(const Technique& technique, const RenderSettings& settings,
                                                   const ShadowGrid& grid = {});

// One axis of a grid.
struct SweepAxis {
  const TechniqueSetting* setting = nullptr;
  std::vector<SettingValue> values{};

  [[nodiscard]] std::string flag() const;  // "--map-sizes"
};

// The axes of a grid, the slowest first. Reports axes that the technique does not support, and invalid values.
[[nodiscard]] Result<std::vector<SweepAxis>> axes_of(const SweptSettings& known, const ShadowGrid& grid);

// The settings that the technique reads, as a row's fields. A value that the technique chooses itself comes from the
// rendering's facts, and has no value without a rendering.
using RowFields = std::vector<std::pair<std::string, StudyValue>>;
[[nodiscard]] RowFields settings_fields(const SweptSettings& known, const RenderSettings& settings,
                                        const Rendering* rendering);

// The possible causes of the technique's errors.
[[nodiscard]] std::span<const ErrorCause> causes_of(const SweptSettings& known);

}  // namespace ninebit
