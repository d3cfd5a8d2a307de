// What the comparison makes of one channel: every pair of its 256 values, and every difference at every step.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>

#include "ninebit/combiner/batch_program.h"
#include "src/study/digits.h"
#include "src/study/false_matches.h"
#include "src/study/index_steps_study.h"

namespace ninebit {
namespace {

constexpr int kBytes = 256;

// The alpha byte of each pair: 256 own + other.
std::vector<std::uint8_t> alphas_of(const Program& program, const HardwareProfile& profile) {
  static_assert(kBatchSize >= kBytes);
  const BatchProgram run(program, {.color = {false, false, false, true}, .registers = false});
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  std::vector<std::uint8_t> alphas;
  for (int own = 0; own < kBytes; ++own) {
    for (std::size_t other = 0; other < kBytes; ++other) {
      const RegisterFile file = comparison_registers(profile, StudyFormat::channel, {static_cast<std::uint8_t>(own)},
                                                     {static_cast<std::uint8_t>(other)});
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        for (std::size_t c = 0; c < 4; ++c) registers->plane[r][c][other] = file.value[r][c];
      }
    }
    run.run(*registers, kBytes, *out);
    for (std::size_t other = 0; other < kBytes; ++other) {
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
              .x_last = kBytes - 1,
              .y_last = kBytes - 1,
              .width = kBytes,
              .height = kBytes,
              .values = {alphas.begin(), alphas.end()},
              .low = 0.0F,
              .high = 255.0F,
              .caption = "0 means equal: the diagonal, and whatever else has its colour."};
  return map;
}

// Which differences come out equal among the values of each step.
HeatMap step_map(const IndexStepsOptions& options, const std::string& name, std::string_view file,
                 const std::vector<std::uint8_t>& alphas) {
  const int reach = std::max(32, options.last_step), width = 2 * reach + 1;
  HeatMap map{.file = fmt::format("equal-{}", file),
              .title = fmt::format("Differences that come out equal: {}", name),
              .x_label = "difference of the channel values",
              .y_label = "step",
              .x_first = -static_cast<double>(reach),
              .x_last = static_cast<double>(reach),
              .y_first = static_cast<double>(options.first_step),
              .y_last = static_cast<double>(options.last_step),
              .width = width,
              .height = options.last_step - options.first_step + 1,
              .values = {},
              .low = -1.0F,
              .high = 1.0F,
              .caption =
                  "The share of the step's pairs with that difference that come out equal: only 0 should. -1: "
                  "the step has no such pair."};
  for (int step = options.first_step; step <= options.last_step; ++step) {
    std::vector<int> pairs(static_cast<std::size_t>(width)), equal(pairs);
    for (int own = 0; own < kBytes; own += step) {
      for (int other = 0; other < kBytes; other += step) {
        if (std::abs(own - other) > reach) continue;
        const auto at = static_cast<std::size_t>(own - other + reach);
        ++pairs[at];
        if (alphas[static_cast<std::size_t>(kBytes * own + other)] == 0) ++equal[at];
      }
    }
    for (std::size_t i = 0; i < pairs.size(); ++i) {
      map.values.push_back(pairs[i] == 0 ? -1.0F : static_cast<float>(equal[i]) / static_cast<float>(pairs[i]));
    }
  }
  return map;
}

// The smallest alpha that a pair with each difference gives.
PlotSeries smallest_alphas(const std::string& name, const std::vector<std::uint8_t>& alphas) {
  constexpr int kReach = 40;
  PlotSeries series{name, {}};
  for (int difference = -kReach; difference <= kReach; ++difference) {
    int least = 255;
    for (int own = std::max(0, difference); own < kBytes && own - difference < kBytes; ++own) {
      least = std::min(least, int{alphas[static_cast<std::size_t>(kBytes * own + own - difference)]});
    }
    series.points.emplace_back(difference, least);
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
              .title = fmt::format("What becomes of a channel's difference: {}", profile.name),
              .x_label = "difference of the channel values",
              .y_label = "smallest alpha",
              .series = {},
              .caption = "An alpha of 0 means equal. What is flat around 0 is what a step has to jump over."};
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
