#include "ninebit/study/index_steps.h"

#include <algorithm>
#include <utility>

#include "ninebit/shadow/index_cube.h"
#include "src/study/index_steps/false_matches.h"

namespace ninebit {
namespace {

constexpr std::array kVariants{IndexVariant{"both-x4", Scale::by_four, Scale::by_four, false},
                               IndexVariant{"first-x4", Scale::by_four, Scale::none, false},
                               IndexVariant{"second-x4", Scale::none, Scale::by_four, false},
                               IndexVariant{"no-scale", Scale::none, Scale::none, false},
                               IndexVariant{"both-x4-separate", Scale::by_four, Scale::by_four, true},
                               IndexVariant{"first-x4-separate", Scale::by_four, Scale::none, true},
                               IndexVariant{"second-x4-separate", Scale::none, Scale::by_four, true},
                               IndexVariant{"no-scale-separate", Scale::none, Scale::none, true}};

}  // namespace

std::string_view name_of(StudyFormat format) {
  constexpr std::array<std::string_view, 5> names{"channel", "rgb", "la", "l", "a"};
  return names[static_cast<std::size_t>(format)];
}

int channels_of(StudyFormat format) {
  return static_cast<int>(digits_of(format).size());
}

std::span<const IndexVariant> index_variants() {
  return kVariants;
}

Result<CombinerState> index_variant_state(const HardwareProfile& profile, StudyFormat format,
                                          const IndexVariant& variant) {
  const IndexFormat held = format == StudyFormat::luminance_alpha ? IndexFormat::luminance_alpha
                           : format == StudyFormat::luminance     ? IndexFormat::luminance
                           : format == StudyFormat::alpha         ? IndexFormat::alpha
                                                                  : IndexFormat::rgb;
  auto state = index_comparison_state(profile, held);
  if (!state) return state;
  const auto rescale = [](GeneralCombiner& stage, Scale scale) {
    for (Portion* portion : {&stage.rgb, &stage.alpha}) {
      if (is_live(portion->out)) portion->out.scale = scale;
    }
  };
  rescale(state->general[0], variant.first);
  rescale(state->general[1], variant.second);
  return state;
}

Result<FalseMatches> count_false_matches(const Program& program, const HardwareProfile& profile, StudyFormat format,
                                         int step, bool separate, const GoOn& go_on) {
  if (step < 1 || step > 255) {
    return Diagnostic{.message = "step " + std::to_string(step) + " is out of range; expected 1 to 255"};
  }
  const auto counter = FalseMatchCounter::prepare(program, profile, format, go_on);
  if (!counter) return counter.error();
  return counter->count(values_of_step(step), separate, go_on);
}

std::optional<int> smallest_safe_step(std::span<const IndexStepRow> rows, std::string_view profile, StudyFormat format,
                                      std::string_view variant) {
  std::vector<std::pair<int, bool>> steps;  // step; true if it has no false match
  for (const IndexStepRow& row : rows) {
    if (row.profile == profile && row.format == format && row.variant == variant) {
      steps.emplace_back(row.step, row.count.false_matches == 0);
    }
  }
  std::sort(steps.begin(), steps.end());
  std::optional<int> safe;
  for (auto step = steps.rbegin(); step != steps.rend() && step->second; ++step) safe = step->first;
  return safe;
}

}  // namespace ninebit
