#include "src/tools/verify/verify_rules.h"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "ninebit/combiner/program.h"
#include "ninebit/study/combiner_fields.h"
#include "src/combiner/given_registers.h"

namespace ninebit::tools {

namespace {

Narrowing other(Narrowing narrowing) {
  return narrowing == Narrowing::toward_zero ? Narrowing::nearest_halves_up : Narrowing::toward_zero;
}

const char* name(Narrowing narrowing) {
  return narrowing == Narrowing::toward_zero ? "toward-zero" : "nearest-halves-up";
}

}  // namespace

std::vector<Rival> rivals_of(const HardwareProfile& profile) {
  std::vector<Rival> rivals;
  if (profile.arithmetic != Arithmetic::integer) return rivals;
  for (const CombinerField& field : arithmetic_fields(profile)) {
    for (std::size_t i = 1; i < field.values.size(); ++i) {
      Rival rival{std::string(field.name), field.values[i].word, std::string(field.rules), profile};
      field.values[i].set(rival.profile);
      rivals.push_back(std::move(rival));
    }
  }
  rivals.push_back({"arithmetic", "float32", "", profile});
  rivals.back().profile.arithmetic.value = Arithmetic::float32;
  return rivals;
}

std::vector<Rival> pixel_rivals_of(const HardwareProfile& profile) {
  std::vector<Rival> rivals;
  const auto add = [&](const char* field, const char* value, const char* rules, auto replace) {
    Rival rival{field, value, rules, profile};
    replace(rival.profile);
    rivals.push_back(std::move(rival));
  };
  const auto add_others = [&](const char* field, const char* rules, auto current, auto member, const auto& words) {
    for (const auto& [word, value] : words) {
      if (value == current) continue;
      const auto other_value = value;  // clang 14 captures no structured binding
      add(field, word, rules, [&](HardwareProfile& p) { (p.*member).value = other_value; });
    }
  };
  using Lines = std::pair<const char*, LineShape>;
  add_others("line_shape", "30", profile.line_shape.value, &HardwareProfile::line_shape,
             std::array{Lines("diamonds", LineShape::diamonds), Lines("rectangles", LineShape::rectangles)});
  using Points = std::pair<const char*, PointShape>;
  add_others("point_shape", "31", profile.point_shape.value, &HardwareProfile::point_shape,
             std::array{Points("whole-pixels", PointShape::whole_pixels), Points("squares", PointShape::squares)});
  using Weights = std::pair<const char*, ColorWeights>;
  add_others("color_weights", "27", profile.color_weights.value, &HardwareProfile::color_weights,
             std::array{Weights("exact", ColorWeights::exact), Weights("8-bits", ColorWeights::eight_bits)});
  using Interpolation = std::pair<const char*, ColorInterpolation>;
  add_others("color_interpolation", "", profile.color_interpolation.value, &HardwareProfile::color_interpolation,
             std::array{Interpolation("perspective", ColorInterpolation::perspective),
                        Interpolation("affine", ColorInterpolation::affine)});
  const Narrowing depth = other(profile.depth_narrowing);
  add("depth_narrowing", name(depth), "28", [&](HardwareProfile& p) { p.depth_narrowing.value = depth; });
  const Narrowing weight = other(profile.texture_weight_narrowing);
  add("texture_weight_narrowing", name(weight), "26",
      [&](HardwareProfile& p) { p.texture_weight_narrowing.value = weight; });
  using Rounding = std::pair<const char*, FilterRounding>;
  add_others("texture_filter_rounding", "26", profile.texture_filter_rounding.value,
             &HardwareProfile::texture_filter_rounding,
             std::array{Rounding("once", FilterRounding::once), Rounding("each-blend", FilterRounding::each_blend)});
  const Narrowing bias = other(profile.texture_bias_narrowing);
  add("texture_bias_narrowing", name(bias), "26", [&](HardwareProfile& p) { p.texture_bias_narrowing.value = bias; });
  using Palette = std::pair<const char*, Dxt1Palette>;
  add_others("dxt1_palette", "24", profile.dxt1_palette.value, &HardwareProfile::dxt1_palette,
             std::array{Palette("rgb565", Dxt1Palette::rgb565), Palette("rgb888", Dxt1Palette::rgb888),
                        Palette("dithered565", Dxt1Palette::dithered565)});
  return rivals;
}

std::vector<int> computed(const VerifyRow& row, const HardwareProfile& profile) {
  if (row.format != nullptr) return row.format->draw(row.measured, profile);
  Program program = normalize(*row.program, profile);
  for (const auto& [column, code] : row.constants) replace_constant(program, column.reg, column.component, code);
  std::vector<int> codes;
  std::optional<int> ran;  // the general combiner that `fragment` was evaluated up to
  EvaluatedFragment fragment;
  for (const Expectation& expected : row.expected) {
    const auto component = static_cast<std::size_t>(expected.component);
    if (!expected.stage) {
      codes.push_back(evaluate_fragment(program, row.registers).color[component]);
      continue;
    }
    if (ran != expected.stage) {
      Program begin = program;
      begin.num_general_combiners = *expected.stage + 1;
      fragment = evaluate_fragment(begin, row.registers);
      ran = expected.stage;
    }
    codes.push_back(fragment.registers[expected.reg][component]);
  }
  return codes;
}

bool agrees(const VerifyRow& row, const std::vector<int>& codes) {
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (!row.expected[i].allows(codes[i])) return false;
  }
  return true;
}

}  // namespace ninebit::tools
