// `ninebit profiles`: every modelled hardware behaviour and its evidence.
#include <fmt/format.h>

#include <iterator>
#include <memory>

#include "src/tools/input/printable.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

std::string text_of(int v) {
  return std::to_string(v);
}
std::string text_of(bool v) {
  return v ? "yes" : "no";
}
std::string text_of(Arithmetic v) {
  return v == Arithmetic::integer ? "integer" : v == Arithmetic::exact ? "exact" : "float32";
}
std::string text_of(Narrowing v) {
  return v == Narrowing::toward_zero ? "toward zero" : "to nearest, halves up";
}
std::string text_of(NarrowingPoint v) {
  return v == NarrowingPoint::after_scale ? "after scaling" : "before scaling";
}
std::string text_of(SecondaryAlpha v) {
  return v == SecondaryAlpha::one ? "1.0" : "as given";
}

std::string text_of(LineShape v) {
  return v == LineShape::diamonds ? "diamonds" : "rectangles";
}
std::string text_of(PointShape v) {
  return v == PointShape::squares ? "squares" : "whole pixels";
}
std::string text_of(OffsetSlope v) {
  return v == OffsetSlope::larger ? "the larger of |dz/dx| and |dz/dy|" : "the root of their squares' sum";
}
std::string text_of(ColorInterpolation v) {
  return v == ColorInterpolation::perspective ? "in perspective" : "affine";
}
std::string text_of(ColorWeights v) {
  return v == ColorWeights::exact ? "exact" : "8 bits";
}
std::string text_of(FilterRounding v) {
  return v == FilterRounding::once ? "once" : "each blend of two";
}
std::string text_of(Dxt1Palette v) {
  if (v == Dxt1Palette::dithered565) return "5, 6, 5 bits, dithered";
  return v == Dxt1Palette::rgb565 ? "5, 6, 5 bits" : "8, 8, 8 bits";
}

struct ProfileRow {
  std::string field, value, evidence, source;
};

std::vector<ProfileRow> rows_of(const HardwareProfile& p) {
  std::vector<ProfileRow> rows;
  const auto add = [&](const char* field, const auto& choice) {
    rows.push_back({field, text_of(choice.value), std::string(name_of(choice.evidence)), std::string(choice.source)});
  };
  add("arithmetic", p.arithmetic);
  add("one", p.one);
  add("lowest", p.lowest);
  add("lowest_output", p.lowest_output);
  add("half", p.half);
  add("expand_offset", p.expand_offset);
  add("byte_shift", p.byte_shift);
  add("general_narrowing", p.general_narrowing);
  add("narrowing_point", p.narrowing_point);
  add("final_narrowing", p.final_narrowing);
  add("general_combiners", p.general_combiners);
  add("texture_units", p.texture_units);
  add("per_stage_constants", p.per_stage_constants);
  add("blue_to_alpha", p.blue_to_alpha);
  add("mux_by_lowest_bit", p.mux_by_lowest_bit);
  add("color_sum_inverts", p.color_sum_inverts);
  add("spare0_alpha_without_texture0", p.spare0_alpha_without_texture0);
  add("disabled_texture_alpha", p.disabled_texture_alpha);
  add("secondary_alpha", p.secondary_alpha);
  add("fog_alpha_without_fog", p.fog_alpha_without_fog);
  add("subpixel_bits", p.subpixel_bits);
  add("line_shape", p.line_shape);
  add("point_shape", p.point_shape);
  add("vertex_color_mantissa_bits", p.vertex_color_mantissa_bits);
  add("polygon_offset_slope", p.polygon_offset_slope);
  add("color_interpolation", p.color_interpolation);
  add("color_weights", p.color_weights);
  add("depth_narrowing", p.depth_narrowing);
  add("fog_narrowing", p.fog_narrowing);
  add("texture_weight_bits", p.texture_weight_bits);
  add("texture_weight_narrowing", p.texture_weight_narrowing);
  add("texture_filter_rounding", p.texture_filter_rounding);
  add("texture_bias_narrowing", p.texture_bias_narrowing);
  add("dxt1_palette", p.dxt1_palette);
  return rows;
}

// `chosen`: only the profile of --profile; else all that ninebit has.
int print_profiles(const CommonFlags& flags, bool chosen) {
  std::vector<HardwareProfile> profiles(hardware_profiles().begin(), hardware_profiles().end());
  if (chosen) profiles = {profile_of(flags)};
  if (!flags.json) {
    std::string text;
    const auto out = std::back_inserter(text);
    for (const HardwareProfile& profile : profiles) {
      fmt::format_to(out, "{}: {}\n", printable(profile.name), printable(profile.chip));
      for (const ProfileRow& r : rows_of(profile)) {
        fmt::format_to(out, "  {:<30} {:<22} {:<10} {}\n", r.field, r.value, r.evidence, printable(r.source));
      }
      text += '\n';
    }
    return answer(text);
  }
  Json rows = Json::array();
  for (const HardwareProfile& profile : profiles) {
    for (const ProfileRow& r : rows_of(profile)) {
      rows.push_back({{"profile", profile.name},
                      {"field", r.field},
                      {"value", r.value},
                      {"evidence", r.evidence},
                      {"source", r.source}});
    }
  }
  const Json out{
      {"command", "profiles"}, {"version", NINEBIT_VERSION}, {"profile", flags.profile}, {"rows", std::move(rows)}};
  return answer(out);
}

}  // namespace

void add_profiles(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("profiles", "List the hardware profiles: every field, its value and its evidence");
  verb->footer(
      "Examples:\n  ninebit profiles --json\n  ninebit profiles --profile nv2a\n  ninebit profiles --profile "
      "mine.json");
  auto flags = std::make_shared<CommonFlags>();
  add_answer_flags(*verb, *flags);
  add_profile_flag(*verb, *flags);
  verb->get_option("--profile")
      ->description("List only this profile: a name, or a .json file (default: all that ninebit has)")
      ->default_str("");
  verb->callback([flags, verb, &exit_code] { exit_code = print_profiles(*flags, verb->count("--profile") > 0); });
}

}  // namespace ninebit::tools
