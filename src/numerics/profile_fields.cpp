#include "ninebit/numerics/profile_fields.h"

#include <algorithm>
#include <array>

namespace ninebit {
namespace {

using enum FieldGroup;

// The member's type of a Choice.
template <class T>
T type_of_choice(Choice<T> HardwareProfile::*);

template <auto Member>
constexpr Choice<int> get(const HardwareProfile& profile) {
  const auto& choice = profile.*Member;
  return {static_cast<int>(choice.value), choice.evidence, choice.source};
}

template <auto Member>
constexpr void set(HardwareProfile& profile, const Choice<int>& choice) {
  using T = decltype(type_of_choice(Member));
  profile.*Member = {static_cast<T>(choice.value), choice.evidence, choice.source};
}

using Numbers = FieldNumbers (*)(const HardwareProfile&);

template <int First, int Second>
constexpr FieldNumbers numbers_of(const HardwareProfile&) {
  return {First, Second};
}

template <auto Member>
constexpr ProfileField number(std::string_view name, FieldGroup group, Numbers range, Numbers rivals,
                              std::string_view rules, std::string_view help) {
  return {name, group, FieldKind::number, {}, range, rivals, rules, help, get<Member>, set<Member>};
}

template <auto Member>
constexpr ProfileField flag(std::string_view name, FieldGroup group, std::string_view rules, std::string_view help) {
  return {name, group, FieldKind::flag, {}, nullptr, nullptr, rules, help, get<Member>, set<Member>};
}

template <auto Member>
constexpr ProfileField word(std::string_view name, FieldGroup group, std::span<const FieldWord> words,
                            std::string_view rules, std::string_view help) {
  return {name, group, FieldKind::word, words, nullptr, nullptr, rules, help, get<Member>, set<Member>};
}

// In the order of the enumerations.
constexpr std::array kArithmetics{FieldWord{"integer", "integer"}, FieldWord{"exact", "exact"},
                                  FieldWord{"float32", "float32"}};
constexpr std::array kNarrowings{FieldWord{"toward-zero", "toward zero"},
                                 FieldWord{"nearest-halves-up", "to nearest, halves up"}};
constexpr std::array kNarrowingPoints{FieldWord{"after-scale", "after scaling"},
                                      FieldWord{"before-scale", "before scaling"}};
constexpr std::array kSecondaryAlphas{FieldWord{"one", "1.0"}, FieldWord{"as-given", "as given"}};
constexpr std::array kSlopes{FieldWord{"larger", "the larger of |dz/dx| and |dz/dy|"},
                             FieldWord{"root", "the root of their squares' sum"}};
constexpr std::array kOffsetFractions{FieldWord{"kept", "kept"}, FieldWord{"rounded", "rounded"}};
constexpr std::array kInterpolations{FieldWord{"perspective", "in perspective"}, FieldWord{"affine", "affine"}};
constexpr std::array kWeights{FieldWord{"exact", "exact"}, FieldWord{"8-bits", "8 bits"}};
constexpr std::array kSurfaceBlends{FieldWord{"zeros", "as zeros"}, FieldWord{"bytes", "as in bytes"}};
constexpr std::array kRoundings{FieldWord{"once", "once"}, FieldWord{"each-blend", "each blend of two"}};
constexpr std::array kLineShapes{FieldWord{"diamonds", "diamonds"}, FieldWord{"rectangles", "rectangles"}};
constexpr std::array kPointShapes{FieldWord{"whole-pixels", "whole pixels"}, FieldWord{"squares", "squares"}};
constexpr std::array kPalettes{FieldWord{"rgb565", "5, 6, 5 bits"}, FieldWord{"rgb888", "8, 8, 8 bits"},
                               FieldWord{"dithered565", "5, 6, 5 bits, dithered"}};
constexpr std::array kStageBytes{FieldWord{"12-bits", "cut to 12 bits"}, FieldWord{"nearest", "to nearest"}};
constexpr std::array kNegativeNumbers{FieldWord{"zero", "0"}, FieldWord{"size", "without its sign"}};
constexpr std::array kCullZeros{FieldWord{"none", "neither 0 nor -0"}, FieldWord{"by-sign", "-0"}};
constexpr std::array kDotDivisors{FieldWord{"odd", "127, 255, 127"}, FieldWord{"even", "128, 256, 128"}};
constexpr std::array kAheadMappings{FieldWord{"own", "its own"}, FieldWord{"of-diffuse", "the diffuse stage's"}};

// The codes of a profile whose `one` is given.
constexpr FieldNumbers code_of_one(const HardwareProfile& p) {
  return {255 >> p.byte_shift.value, 255 >> p.byte_shift.value};
}
constexpr FieldNumbers lowest_codes(const HardwareProfile& p) {
  return {-p.one.value - 1, -p.one.value};
}
constexpr FieldNumbers lowest_outputs(const HardwareProfile& p) {
  return {std::max(p.lowest.value, -p.one.value - 1), -p.one.value};
}
constexpr FieldNumbers codes(const HardwareProfile& p) {
  return {0, p.one.value};
}
constexpr FieldNumbers halves(const HardwareProfile& p) {
  return {(p.one.value + 1) / 2, p.one.value / 2};
}
constexpr FieldNumbers expand_offsets(const HardwareProfile& p) {
  return {p.one.value, p.one.value + 1};
}

constexpr Numbers kBytes = numbers_of<0, 255>, kByteEnds = numbers_of<255, 0>;

using P = HardwareProfile;
constexpr std::array kFields{
    word<&P::arithmetic>("arithmetic", numbers, kArithmetics, "",
                         "The numbers that the combiners compute in: whole codes as the chip has them, exact "
                         "fractions, or 32-bit floats as shaders have them."),
    number<&P::one>("one", numbers, code_of_one, nullptr, "1", "The code that stands for 1.0."),
    number<&P::lowest>("lowest", integer_rules, lowest_codes, lowest_codes, "",
                       "The lowest code that a register can hold before the first general combiner."),
    number<&P::lowest_output>("lowest_output", integer_rules, lowest_outputs, lowest_codes, "",
                              "The lowest code that a general combiner writes; anything below is cut to it."),
    number<&P::half>("half", integer_rules, codes, halves, "4, 11",
                     "The code of one half: of the bias, of the half-bias mappings and of the mux."),
    number<&P::expand_offset>("expand_offset", integer_rules, expand_offsets, expand_offsets, "",
                              "What the expanding mappings take from twice the value."),
    number<&P::byte_shift>("byte_shift", numbers, numbers_of<0, 4>, nullptr, "1",
                           "How many low bits of a byte a register drops."),
    word<&P::general_narrowing>("general_narrowing", integer_rules, kNarrowings, "5, 8",
                                "How a general combiner drops the bits that a register cannot hold."),
    word<&P::narrowing_point>("narrowing_point", integer_rules, kNarrowingPoints, "7",
                              "Whether a general combiner drops bits after the scale or before it."),
    word<&P::final_narrowing>("final_narrowing", integer_rules, kNarrowings, "9, 10",
                              "How the final combiner drops the bits that a byte cannot hold."),
    number<&P::general_combiners>("general_combiners", features, numbers_of<1, 8>, nullptr, "",
                                  "How many general combiners the chip has."),
    number<&P::texture_units>("texture_units", features, numbers_of<1, 4>, nullptr, "",
                              "How many texture units the chip has."),
    flag<&P::per_stage_constants>(
        "per_stage_constants", features, "",
        "Whether each general combiner may have constants of its own (NV_register_combiners2)."),
    flag<&P::blue_to_alpha>("blue_to_alpha", features, "",
                            "Whether an RGB portion may copy its blue to the alpha of the register that it writes."),
    flag<&P::mux_by_lowest_bit>("mux_by_lowest_bit", features, "11",
                                "Whether the mux may look at the lowest bit of spare0's alpha instead of one half."),
    flag<&P::color_sum_inverts>("color_sum_inverts", features, "13",
                                "Whether spare0 and the secondary colour may go into the colour sum as 1 - x."),
    flag<&P::texture_shaders>("texture_shaders", features, "",
                              "Whether the chip has texture-shader stages (NV_texture_shader and NV_texture_shader2)."),
    flag<&P::point_sprites>("point_sprites", features, "46",
                            "Whether texture coordinates may run across each point (NV_point_sprite)."),
    flag<&P::multisampling>("multisampling", features, "48",
                            "Whether the chip has surfaces with two and four samples for each pixel."),
    number<&P::spare0_alpha_without_texture0>("spare0_alpha_without_texture0", start_registers, kBytes, kByteEnds, "",
                                              "The byte in spare0's alpha at the start while texture unit 0 is off."),
    number<&P::disabled_texture_alpha>("disabled_texture_alpha", start_registers, kBytes, kByteEnds, "16",
                                       "The alpha byte of a texture unit that is off; its colour is black."),
    word<&P::secondary_alpha>("secondary_alpha", start_registers, kSecondaryAlphas, "",
                              "Whether the secondary colour's alpha is 1.0 or as given."),
    number<&P::fog_alpha_without_fog>("fog_alpha_without_fog", start_registers, kBytes, kByteEnds, "",
                                      "The byte in the fog register's alpha while fog is off."),
    number<&P::subpixel_bits>("subpixel_bits", rasterizer, numbers_of<0, 4>, nullptr, "21",
                              "Window positions are cut to this many fraction bits of a pixel."),
    word<&P::line_shape>("line_shape", rasterizer, kLineShapes, "30", "Which pixels a line draws."),
    word<&P::point_shape>("point_shape", rasterizer, kPointShapes, "31", "Which pixels a point draws."),
    number<&P::vertex_color_mantissa_bits>("vertex_color_mantissa_bits", rasterizer, numbers_of<1, 23>, nullptr, "17",
                                           "How many fraction bits of a vertex colour count before it becomes a byte."),
    word<&P::polygon_offset_slope>("polygon_offset_slope", rasterizer, kSlopes, "20",
                                   "Which slope of a polygon the polygon offset multiplies."),
    word<&P::polygon_offset_fraction>("polygon_offset_fraction", rasterizer, kOffsetFractions, "20",
                                      "What becomes of the polygon offset's fraction before the offset is added."),
    word<&P::color_interpolation>("color_interpolation", rasterizer, kInterpolations, "27",
                                  "Whether smooth colours follow the perspective or run straight across the window."),
    word<&P::color_weights>("color_weights", rasterizer, kWeights, "27",
                            "How fine the weights of a polygon's corners are in its smooth colours."),
    word<&P::surface_blend>("surface_blend", rasterizer, kSurfaceBlends, "44",
                            "How blending reads the low bits that a surface of fewer bits does not store."),
    word<&P::coverage_narrowing>("coverage_narrowing", rasterizer, kNarrowings, "47",
                                 "How an alpha times the coverage of a smoothed primitive becomes a byte."),
    word<&P::depth_narrowing>("depth_narrowing", rasterizer, kNarrowings, "28",
                              "How a fragment's depth becomes a depth code."),
    word<&P::fog_byte>("fog_byte", rasterizer, kStageBytes, "25", "How a fragment's fog factor becomes a byte."),
    number<&P::texture_weight_bits>("texture_weight_bits", rasterizer, numbers_of<1, 8>, nullptr, "26",
                                    "How many fraction bits the weights of linear filters have."),
    word<&P::texture_weight_narrowing>("texture_weight_narrowing", rasterizer, kNarrowings, "26",
                                       "How a place between two texels becomes such a weight."),
    word<&P::texture_filter_rounding>("texture_filter_rounding", rasterizer, kRoundings, "26",
                                      "Whether linear filters round once, or at each blend of two texels."),
    word<&P::texture_bias_narrowing>("texture_bias_narrowing", rasterizer, kNarrowings, "26",
                                     "How a bias of the level of detail becomes a step of 1/256."),
    word<&P::dxt1_palette>("dxt1_palette", rasterizer, kPalettes, "24", "How the colours of a DXT1 texture are kept."),
    word<&P::stage_byte>("stage_byte", texture_shader, kStageBytes, "33",
                         "How a texture-shader stage's number from 0 to 1 becomes a byte."),
    word<&P::negative_stage_number>("negative_stage_number", texture_shader, kNegativeNumbers, "33",
                                    "What a texture-shader stage's number below 0 is, before it becomes a byte."),
    word<&P::cull_zero>("cull_zero", texture_shader, kCullZeros, "42",
                        "Which of CULL_FRAGMENT's coordinates at zero count as negative."),
    word<&P::dot_divisors>("dot_divisors", texture_shader, kDotDivisors, "36",
                           "What the signed mappings of dot products divide by: Direct3D's, OpenGL's, the plain one."),
    number<&P::dependent_divisor>("dependent_divisor", texture_shader, numbers_of<255, 256>, numbers_of<255, 256>, "37",
                                  "What a byte is divided by to be a coordinate of a dependent texture."),
    word<&P::ahead_mapping>("ahead_mapping", texture_shader, kAheadMappings, "38",
                            "Whose mapping the third dot product of a diffuse cube map has, which is read ahead."),
    word<&P::replaced_depth_narrowing>("replaced_depth_narrowing", texture_shader, kNarrowings, "39",
                                       "How a replaced depth becomes a depth code."),
};

// A field that is missing in the table makes the struct larger. Checked where all choices have one size.
static_assert(sizeof(Choice<bool>) != sizeof(Choice<int>) ||
              sizeof(HardwareProfile) == 2 * sizeof(std::string_view) + kFields.size() * sizeof(Choice<int>));

}  // namespace

std::optional<int> ProfileField::value_of(std::string_view word) const {
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i].word == word) return static_cast<int>(i);
  }
  return std::nullopt;
}

std::string ProfileField::word_of(int value) const {
  if (kind == FieldKind::word) return std::string(words[static_cast<std::size_t>(value)].word);
  if (kind == FieldKind::flag) return value != 0 ? "true" : "false";
  return std::to_string(value);
}

std::string ProfileField::text_of(int value) const {
  if (kind == FieldKind::word) return std::string(words[static_cast<std::size_t>(value)].text);
  if (kind == FieldKind::flag) return value != 0 ? "yes" : "no";
  return std::to_string(value);
}

std::span<const ProfileField> profile_fields() {
  return kFields;
}

const ProfileField* find_profile_field(std::string_view name) {
  for (const ProfileField& field : kFields) {
    if (field.name == name) return &field;
  }
  return nullptr;
}

void set_field(HardwareProfile& profile, const ProfileField& field, int value) {
  const Choice<int> choice = field.get(profile);
  field.set(profile, {value, choice.evidence, choice.source});
  if (field.name == "lowest") profile.lowest_output.value = std::max(profile.lowest_output.value, value);
  if (field.name == "lowest_output") profile.lowest.value = std::min(profile.lowest.value, value);
}

HardwareProfile with_exact_combiners(HardwareProfile profile) {
  for (const ProfileField& field : kFields) {
    const bool is_arithmetic = field.group == FieldGroup::numbers || field.group == FieldGroup::integer_rules;
    if (is_arithmetic) field.set(profile, field.get(profiles::ideal));
  }
  return profile;
}

}  // namespace ninebit
