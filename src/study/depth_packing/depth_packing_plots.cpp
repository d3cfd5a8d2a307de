#include "src/study/depth_packing/depth_packing_plots.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "src/study/depth_packing/depth_packing_report.h"

namespace ninebit {
namespace {

double error_of(const DepthPacking& packing, ChannelStorage storage, float depth) {
  return static_cast<double>(read_depth(packing, store_depth(packing, depth, storage))) - static_cast<double>(depth);
}

DigitGrid grid_of(const DepthPacking& packing, ChannelStorage storage) {
  DigitGrid grid{.packing = &packing, .storage = storage, .shift = {}};
  grid.shift.reserve(65536);
  for (int i = 0; i < 65536; ++i) {
    grid.shift.push_back(static_cast<float>(store_two_digits(packing, storage, i / 256, i % 256).shift));
    grid.largest = std::max(grid.largest, std::fabs(grid.shift.back()));
  }
  return grid;
}

// The largest absolute error in each of 512 parts of the range.
Plot error_plot(const std::vector<DigitGrid>& grids, ChannelStorage storage) {
  constexpr int kStretches = 512, kDepths = 512;
  Plot plot{
      .file = fmt::format("error-by-depth-{}", name_of(storage)),
      .title = fmt::format("Error by depth, components {}", storage == ChannelStorage::round ? "rounded" : "truncated"),
      .x_label = "depth",
      .y_label = "largest absolute error",
      .log_y = true,
      .series = {}};
  for (const DigitGrid& grid : grids) {
    if (grid.storage != storage || !grid.keeps_depth()) continue;
    PlotSeries series{.name = std::string(grid.packing->name), .points = {}};
    for (int s = 0; s < kStretches; ++s) {
      double largest = 0.0;
      for (int i = 0; i < kDepths; ++i) {
        const float depth = static_cast<float>(s * kDepths + i) / (kStretches * kDepths);
        largest = std::max(largest, std::fabs(error_of(*grid.packing, storage, depth)));
      }
      series.points.emplace_back((s + 0.5) / kStretches, largest);
    }
    plot.series.push_back(std::move(series));
  }
  plot.caption =
      "For each 512th of the range, the largest absolute error among 512 depths. Where a line has a gap, these depths "
      "are "
      "exact.";
  return plot;
}

// Adds the series, or its name to `left_out` if all of it would lie on the plot's line of 0.
void put_visible(Plot& plot, PlotSeries series, double least, std::vector<std::string>& left_out) {
  const bool visible = std::any_of(series.points.begin(), series.points.end(),
                                   [least](const auto& point) { return std::fabs(point.second) >= least; });
  if (visible) {
    plot.series.push_back(std::move(series));
  } else {
    left_out.push_back(std::move(series.name));
  }
}

std::string left_out_in_words(std::string_view least, const std::vector<std::string>& left_out) {
  if (left_out.empty()) return {};
  return fmt::format(" Below {} everywhere, and not drawn: {}.", least, fmt::join(left_out, ", "));
}

// In a scene 256 units deep. The error ranges from half a unit too far to half a unit too near.
Plot middle_plot(const std::vector<DigitGrid>& grids) {
  Plot plot{.file = "error-halfway",
            .title = "Error halfway through a range of 256 units, components rounded",
            .x_label = "depth in units of 1/256",
            .y_label = "error in units of 1/256",
            .series = {}};
  std::vector<std::string> left_out;
  for (const DigitGrid& grid : grids) {
    if (grid.storage != ChannelStorage::round || !grid.keeps_depth()) continue;
    PlotSeries series{.name = std::string(grid.packing->name), .points = {}};
    for (int i = 126 * 128; i <= 132 * 128; ++i) {
      const float depth = static_cast<float>(i) / 32768.0F;
      series.points.emplace_back(i / 128.0, 256.0 * error_of(*grid.packing, grid.storage, depth));
    }
    put_visible(plot, std::move(series), 0.01, left_out);
  }
  plot.caption = "Where a surface is deeper than its stored depth, it shades itself; before the jump, light leaks." +
                 left_out_in_words("0.01", left_out);
  return plot;
}

Plot digit_plot(const std::vector<DigitGrid>& grids) {
  Plot plot{.file = "second-digit",
            .title = fmt::format("Shift of the second component where the highest is {}", kChartDigit),
            .x_label = "second digit",
            .y_label = "shift in steps of the second digit",
            .series = {}};
  std::vector<std::string> left_out;
  for (const DigitGrid& grid : grids) {
    if (!grid.keeps_depth()) continue;
    PlotSeries series{.name = grid.name(), .points = {}};
    for (std::size_t digit = 0; digit < 256; ++digit) {
      series.points.emplace_back(digit, grid.shift[kChartDigit * 256 + digit]);
    }
    put_visible(plot, std::move(series), 2.0, left_out);
  }
  plot.caption =
      "The value read back for a depth of two digits in base 256, minus the depth." + left_out_in_words("2", left_out);
  return plot;
}

HeatMap digits_map(const DigitGrid& grid) {
  return {.file = fmt::format("shift-{}", grid.name()),
          .title = fmt::format("Shift by both digits: {}", grid.name()),
          .x_label = "second digit",
          .y_label = "highest digit",
          .x_first = 0.0,
          .x_last = 255.0,
          .y_first = 0.0,
          .y_last = 255.0,
          .width = 256,
          .height = 256,
          .values = grid.shift,
          .low = -grid.largest,
          .high = grid.largest,
          .caption = "In steps of the second digit, 1/65536 of the range."};
}

}  // namespace

std::vector<DigitGrid> digit_grids(const DepthPackingOptions& options) {
  std::vector<DigitGrid> grids;
  for (const std::string& name : options.packings) {
    for (const ChannelStorage storage : options.storages) grids.push_back(grid_of(*find_depth_packing(name), storage));
  }
  return grids;
}

std::vector<Plot> depth_packing_plots(const DepthPackingOptions& options, const std::vector<DigitGrid>& grids) {
  std::vector<Plot> plots;
  for (const ChannelStorage storage : options.storages) plots.push_back(error_plot(grids, storage));
  plots.push_back(middle_plot(grids));
  plots.push_back(digit_plot(grids));
  std::erase_if(plots, [](const Plot& plot) { return plot.series.empty(); });
  return plots;
}

std::vector<HeatMap> depth_packing_maps(const std::vector<DigitGrid>& grids) {
  std::vector<HeatMap> maps;
  for (const DigitGrid& grid : grids) {
    if (grid.largest >= 1.0F && grid.keeps_depth()) maps.push_back(digits_map(grid));
  }
  return maps;
}

}  // namespace ninebit
