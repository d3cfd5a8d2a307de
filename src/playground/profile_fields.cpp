#include "src/playground/profile_fields.h"

#include <array>
#include <utility>

namespace ninebit::playground {
namespace {

// The words are those of parse_json_profile, in the order of the enumeration.
template <class T>
FieldRow word_row(const Choice<T>& choice, std::vector<std::string_view> words) {
  FieldRow row{words[static_cast<std::size_t>(choice.value)], choice.evidence, choice.source};
  row.choices = std::move(words);
  return row;
}

FieldRow number_row(const Choice<int>& choice, int lowest, int highest) {
  FieldRow row{choice.value, choice.evidence, choice.source};
  row.lowest = lowest;
  row.highest = highest;
  return row;
}

FieldRow flag_row(const Choice<bool>& choice) {
  return {choice.value, choice.evidence, choice.source};
}

constexpr std::array kProfileFields{
    ProfileField{"arithmetic", false,
                 "The numbers that the combiners compute in: whole codes as the chip has them, exact fractions, or "
                 "32-bit floats as shaders have them.",
                 [](const HardwareProfile& p) {
                   return word_row(p.arithmetic, {"integer", "exact", "float32"});
                 }},
    ProfileField{"one", false, "The code that stands for 1.0.",
                 [](const HardwareProfile& p) {
                   return number_row(p.one, 255 >> p.byte_shift.value, 255 >> p.byte_shift.value);
                 }},
    ProfileField{"lowest", true, "The lowest code that a register can hold before the first general combiner.",
                 [](const HardwareProfile& p) { return number_row(p.lowest, -p.one.value - 1, -p.one.value); }},
    ProfileField{"lowest_output", true, "The lowest code that a general combiner writes; anything below is cut to it.",
                 [](const HardwareProfile& p) { return number_row(p.lowest_output, p.lowest.value, -p.one.value); }},
    ProfileField{"half", true, "The code of one half: of the bias, of the half-bias mappings and of the mux.",
                 [](const HardwareProfile& p) { return number_row(p.half, 0, p.one.value); }},
    ProfileField{"expand_offset", true, "What the expanding mappings take from twice the value.",
                 [](const HardwareProfile& p) { return number_row(p.expand_offset, p.one.value, p.one.value + 1); }},
    ProfileField{"byte_shift", false, "How many low bits of a byte a register drops.",
                 [](const HardwareProfile& p) { return number_row(p.byte_shift, 0, 4); }},
    ProfileField{"general_narrowing", true, "How a general combiner drops the bits that a register cannot hold.",
                 [](const HardwareProfile& p) {
                   return word_row(p.general_narrowing, {"toward-zero", "nearest-halves-up"});
                 }},
    ProfileField{"narrowing_point", true, "Whether a general combiner drops bits after the scale or before it.",
                 [](const HardwareProfile& p) {
                   return word_row(p.narrowing_point, {"after-scale", "before-scale"});
                 }},
    ProfileField{"final_narrowing", true, "How the final combiner drops the bits that a byte cannot hold.",
                 [](const HardwareProfile& p) {
                   return word_row(p.final_narrowing, {"toward-zero", "nearest-halves-up"});
                 }},
    ProfileField{"general_combiners", false, "How many general combiners the chip has.",
                 [](const HardwareProfile& p) { return number_row(p.general_combiners, 1, 8); }},
    ProfileField{"texture_units", false, "How many texture units the chip has.",
                 [](const HardwareProfile& p) { return number_row(p.texture_units, 1, 4); }},
    ProfileField{"per_stage_constants", false,
                 "Whether each general combiner may have constants of its own (NV_register_combiners2).",
                 [](const HardwareProfile& p) { return flag_row(p.per_stage_constants); }},
    ProfileField{"blue_to_alpha", false,
                 "Whether an RGB portion may copy its blue to the alpha of the register that it writes.",
                 [](const HardwareProfile& p) { return flag_row(p.blue_to_alpha); }},
    ProfileField{"mux_by_lowest_bit", false,
                 "Whether the mux may look at the lowest bit of spare0's alpha instead of one half.",
                 [](const HardwareProfile& p) { return flag_row(p.mux_by_lowest_bit); }},
    ProfileField{"color_sum_inverts", false,
                 "Whether spare0 and the secondary colour may go into the colour sum as 1 - x.",
                 [](const HardwareProfile& p) { return flag_row(p.color_sum_inverts); }},
    ProfileField{"spare0_alpha_without_texture0", false,
                 "The byte in spare0's alpha at the start while texture unit 0 is off.",
                 [](const HardwareProfile& p) { return number_row(p.spare0_alpha_without_texture0, 0, 255); }},
    ProfileField{"disabled_texture_alpha", false, "The alpha byte of a texture unit that is off; its colour is black.",
                 [](const HardwareProfile& p) { return number_row(p.disabled_texture_alpha, 0, 255); }},
    ProfileField{"secondary_alpha", false, "Whether the secondary colour's alpha is 1.0 or as given.",
                 [](const HardwareProfile& p) {
                   return word_row(p.secondary_alpha, {"one", "as-given"});
                 }},
    ProfileField{"fog_alpha_without_fog", false, "The byte in the fog register's alpha while fog is off.",
                 [](const HardwareProfile& p) { return number_row(p.fog_alpha_without_fog, 0, 255); }},
    ProfileField{"subpixel_bits", false, "Window positions are cut to this many fraction bits of a pixel.",
                 [](const HardwareProfile& p) { return number_row(p.subpixel_bits, 0, 4); }},
    ProfileField{"line_shape", false, "Which pixels a line draws.",
                 [](const HardwareProfile& p) {
                   return word_row(p.line_shape, {"diamonds", "rectangles"});
                 }},
    ProfileField{"point_shape", false, "Which pixels a point draws.",
                 [](const HardwareProfile& p) {
                   return word_row(p.point_shape, {"whole-pixels", "squares"});
                 }},
    ProfileField{"vertex_color_mantissa_bits", false,
                 "How many fraction bits of a vertex colour count before it becomes a byte.",
                 [](const HardwareProfile& p) { return number_row(p.vertex_color_mantissa_bits, 1, 23); }},
    ProfileField{"polygon_offset_slope", false, "Which slope of a polygon the polygon offset multiplies.",
                 [](const HardwareProfile& p) {
                   return word_row(p.polygon_offset_slope, {"larger", "root"});
                 }},
    ProfileField{"color_interpolation", false,
                 "Whether smooth colours follow the perspective or run straight across the window.",
                 [](const HardwareProfile& p) {
                   return word_row(p.color_interpolation, {"perspective", "affine"});
                 }},
    ProfileField{"color_weights", false, "How fine the weights of a polygon's corners are in its smooth colours.",
                 [](const HardwareProfile& p) {
                   return word_row(p.color_weights, {"exact", "8-bits"});
                 }},
    ProfileField{"depth_narrowing", false, "How a fragment's depth becomes a depth code.",
                 [](const HardwareProfile& p) {
                   return word_row(p.depth_narrowing, {"toward-zero", "nearest-halves-up"});
                 }},
    ProfileField{"fog_narrowing", false, "How a fragment's fog factor becomes a byte.",
                 [](const HardwareProfile& p) {
                   return word_row(p.fog_narrowing, {"toward-zero", "nearest-halves-up"});
                 }},
    ProfileField{"texture_weight_bits", false, "How many fraction bits the weights of linear filters have.",
                 [](const HardwareProfile& p) { return number_row(p.texture_weight_bits, 1, 8); }},
    ProfileField{"texture_weight_narrowing", false, "How a place between two texels becomes such a weight.",
                 [](const HardwareProfile& p) {
                   return word_row(p.texture_weight_narrowing, {"toward-zero", "nearest-halves-up"});
                 }},
    ProfileField{"texture_filter_rounding", false, "Whether linear filters round once, or at each blend of two texels.",
                 [](const HardwareProfile& p) {
                   return word_row(p.texture_filter_rounding, {"once", "each-blend"});
                 }},
    ProfileField{"texture_bias_narrowing", false, "How a bias of the level of detail becomes a step of 1/256.",
                 [](const HardwareProfile& p) {
                   return word_row(p.texture_bias_narrowing, {"toward-zero", "nearest-halves-up"});
                 }},
    ProfileField{"dxt1_palette", false, "How the colours of a DXT1 texture are kept.", [](const HardwareProfile& p) {
                   return word_row(p.dxt1_palette, {"rgb565", "rgb888", "dithered565"});
                 }}};

}  // namespace

std::span<const ProfileField> profile_fields() {
  return kProfileFields;
}

Json profile_object(const HardwareProfile& profile) {
  Json fields = Json::array();
  for (const ProfileField& field : profile_fields()) {
    const FieldRow row = field.row(profile);
    Json object{{"name", field.name},
                {"value", row.value},
                {"evidence", name_of(row.evidence)},
                {"source", row.source},
                {"help", field.help},
                {"read", !field.integer_only || profile.arithmetic.value == Arithmetic::integer}};
    if (!row.choices.empty()) object["choices"] = row.choices;
    if (row.value.is_number()) object["range"] = {row.lowest, row.highest};
    fields.push_back(std::move(object));
  }
  return Json{{"name", profile.name}, {"summary", profile.chip}, {"fields", std::move(fields)}};
}

}  // namespace ninebit::playground
