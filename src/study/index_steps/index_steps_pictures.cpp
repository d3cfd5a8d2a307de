// Pictures of one channel's comparison: every pair of its 256 values, and every difference at every step.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <limits>
#include <memory>

#include "ninebit/combiner/batch_program.h"
#include "src/study/digits/digits.h"
#include "src/study/index_steps/false_matches.h"
#include "src/study/index_steps/index_steps_study.h"

namespace ninebit {
namespace {

constexpr int kByteValues = 256;

// The alpha byte of each pair, at index 256 own + other.
std::vector<std::uint8_t> alphas_of(const Program& program, const HardwareProfile& profile) {
  static_assert(kBatchSize >= kByteValues);
  const BatchProgram run(program, {.color = {false, false, false, true}, .registers = false});
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  std::vector<std::uint8_t> alphas;
  for (int own = 0; own < kByteValues; ++own) {
    for (std::size_t other = 0; other < kByteValues; ++other) {
      const RegisterFile file = comparison_registers(profile, StudyFormat::channel, {static_cast<std::uint8_t>(own)},
                                                     {static_cast<std::uint8_t>(other)});
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        for (std::size_t c = 0; c < 4; ++c) registers->plane[r][c][other] = file.value[r][c];
      }
    }
    run.run(*registers, kByteValues, *out);
    for (std::size_t other = 0; other < kByteValues; ++other) {
      alphas.push_back(to_byte(profile, out->plane[kAlpha][other]));
    }
  }
  return alphas;
}

HeatMap pair_map(const std::string& name, std::string_view file, const std::vector<std::uint8_t>& alphas) {
  HeatMap map{.file = fmt::format("alpha-{}", file),
              .title = fmt::format("Alpha of every pair of channel values: {}", name),
              .x_label = "texture's value",
              .y_label = "own value",
              .x_last = kByteValues - 1,
              .y_last = kByteValues - 1,
              .width = kByteValues,
              .height = kByteValues,
              .values = {alphas.begin(), alphas.end()},
              .low = 0.0F,
              .high = 255.0F,
              .caption = "Grey: different values that compare equal (alpha 0).",
              .none = "0, compares equal"};
  for (std::size_t i = 0; i < map.values.size(); ++i) {
    if (i / kByteValues != i % kByteValues && alphas[i] == 0) map.values[i] = std::numeric_limits<float>::quiet_NaN();
  }
  return map;
}

// The differences that compare equal among the values of each step.
HeatMap step_map(const IndexStepsOptions& options, const std::string& name, std::string_view file,
                 const std::vector<std::uint8_t>& alphas) {
  const int reach = std::max(32, options.last_step), width = 2 * reach + 1;
  HeatMap map{.file = fmt::format("equal-{}", file),
              .title = fmt::format("Differences that compare equal: {}", name),
              .x_label = "difference of the channel values",
              .y_label = "step",
              .x_first = -static_cast<double>(reach),
              .x_last = static_cast<double>(reach),
              .y_first = static_cast<double>(options.first_step),
              .y_last = static_cast<double>(options.last_step),
              .width = width,
              .height = options.last_step - options.first_step + 1,
              .values = {},
              .low = 0.0F,
              .high = 1.0F,
              .caption =
                  "The share of the step's pairs with that difference that compare equal. It should be 0 except at "
                  "difference 0. Grey: the step has no such pair.",
              .none = "no such pair"};
  for (int step = options.first_step; step <= options.last_step; ++step) {
    std::vector<int> pairs(static_cast<std::size_t>(width)), equal(pairs);
    for (int own = 0; own < kByteValues; own += step) {
      for (int other = 0; other < kByteValues; other += step) {
        if (std::abs(own - other) > reach) continue;
        const auto at = static_cast<std::size_t>(own - other + reach);
        ++pairs[at];
        if (alphas[static_cast<std::size_t>(kByteValues * own + other)] == 0) ++equal[at];
      }
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      const float share = static_cast<float>(equal[i]) / static_cast<float>(std::max(pairs[i], 1));
      map.values.push_back(pairs[i] > 0 ? share : std::numeric_limits<float>::quiet_NaN());
    }
  }
  return map;
}

// For each difference, the smallest alpha of the pairs with it.
PlotSeries smallest_alphas(const std::string& name, const std::vector<std::uint8_t>& alphas) {
  constexpr int kReach = 32;
  std::array<int, kReach + 1> least{};
  least.fill(255);
  for (int own = 0; own < kByteValues; ++own) {
    for (int other = std::max(0, own - kReach); other <= std::min(kByteValues - 1, own + kReach); ++other) {
      int& of_difference = least[static_cast<std::size_t>(std::abs(own - other))];
      of_difference = std::min(of_difference, int{alphas[static_cast<std::size_t>(kByteValues * own + other)]});
    }
  }
  PlotSeries series{name, {}};
  for (std::size_t difference = 1; difference < least.size(); ++difference) {
    series.points.emplace_back(static_cast<double>(difference), least[difference]);
  }
  return series;
}

}  // namespace

void add_channel_pictures(const IndexStepsOptions& options, std::span<const IndexStepsUnit> units,
                          StudyReport& report) {
  std::vector<HeatMap> pair_maps;
  for (std::size_t p = 0; p < options.profiles.size(); ++p) {
    const HardwareProfile& profile = options.profiles[p];
    Plot plot{.file = fmt::format("alpha-of-difference-{}", profile.name),
              .title = fmt::format("Smallest alpha by size of a channel's difference: {}", profile.name),
              .x_label = "size of the difference",
              .y_label = "smallest alpha",
              .log_y = true,
              .series = {},
              .caption = "Differences below the start of a line have alpha 0: they compare equal."};
    for (const IndexStepsUnit& unit : units) {
      if (unit.profile != p || unit.format != StudyFormat::channel) continue;
      const std::vector<std::uint8_t> alphas = alphas_of(unit.program, profile);
      const std::string name = fmt::format("{}, {}", profile.name, unit.variant);
      const std::string file = fmt::format("{}-{}", profile.name, unit.variant);
      if (plot.series.empty()) pair_maps.push_back(pair_map(name, file, alphas));
      report.heat_maps.push_back(step_map(options, name, file, alphas));
      plot.series.push_back(smallest_alphas(unit.variant, alphas));
    }
    if (!plot.series.empty()) report.plots.push_back(std::move(plot));
  }
  report.heat_maps.insert(report.heat_maps.end(), pair_maps.begin(), pair_maps.end());
}

}  // namespace ninebit
