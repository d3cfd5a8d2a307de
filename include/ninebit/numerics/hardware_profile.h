// Every hardware behaviour is a field of a named profile, tagged with its evidence.
//
// In this order: the words of the fields, the profile, the parts of it that programs keep, the shipped profiles. A new
// behaviour is a field here with its value in each profile (and in Datapath or StageChoices, if a program keeps it), a
// row of profile_fields.cpp, a rule that reads it, and its row in docs/numerics.md; everything else walks the table.
//
// A profile is a value: to try a "what if", copy one and change a field. The rules that read these fields are in
// combiner/arithmetic.inl; docs/numerics.md gives each rule's evidence in full.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string_view>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// How well a behaviour is known.
enum class Evidence : std::uint8_t {
  specified,  // the OpenGL extension says so
  seed,       // the article on index cube shadow mapping, tested by its author on a GeForce 2, implies it
  measured,   // read off real hardware (NV2A, the Xbox's GeForce3-class chip)
  inferred,   // follows from a measured rule or from a program that ran on the hardware
  assumed     // nothing decides it
};

// "specified", "seed", "measured", "inferred" or "assumed".
[[nodiscard]] std::string_view name_of(Evidence evidence);

// The numbers that the combiners compute in. With each of them registers start as codes and outputs end as codes.
enum class Arithmetic : std::uint8_t {
  integer,  // codes, as in hardware, by the fields of HardwareProfile
  exact,    // fractions without rounding; converted to a code only for the frame buffer
  float32   // 32-bit floats, as in emulators' shaders; converted to a code only for the frame buffer
};

// How a wide value is narrowed to the bits that a register can hold.
enum class Narrowing : std::uint8_t {
  toward_zero,       // the low bits of the magnitude are dropped
  nearest_halves_up  // to the nearest code, a half upward
};

// The point in a general combiner at which the low bits are dropped.
enum class NarrowingPoint : std::uint8_t {
  after_scale,  // products, sum, bias and scale are computed wide and narrowed once
  before_scale  // the biased sum is narrowed to a whole code, then scaled
};

// The alpha of the secondary colour.
enum class SecondaryAlpha : std::uint8_t { one, as_given };
// The slope of a polygon in its polygon offset (OpenGL 1.3, 3.5.5 allows both).
enum class OffsetSlope : std::uint8_t { larger, root };  // max(|dz/dx|, |dz/dy|), or the root of the sum of squares
// How the fraction of a polygon offset is treated, in steps of a 24-bit depth.
enum class OffsetFraction : std::uint8_t {
  kept,    // the sum of depth and offset is narrowed
  rounded  // the offset is rounded to nearest, halves up, before it is added
};
// How smooth colours are interpolated: perspective-correct like texture coordinates, or linearly in the window.
enum class ColorInterpolation : std::uint8_t { perspective, affine };
// The weights of a primitive's vertices in its smooth colours.
enum class ColorWeights : std::uint8_t {
  exact,      // shares, in floats
  eight_bits  // whole 256ths: the first and the third vertex's cut, the second has the rest
};
// The values that blending reads for the low bits that a surface of fewer bits does not store.
enum class SurfaceBlend : std::uint8_t {
  zeros,  // zeros, of the fragment's colour as well
  bytes   // those of the byte that stands for the stored number; the fragment's colour stays whole
};
// Where linear filters round.
enum class FilterRounding : std::uint8_t {
  once,       // the weighted sum of all texels
  each_blend  // each blend of two: along s, then along t, then between levels
};
// Which pixels a line draws.
enum class LineShape : std::uint8_t {
  diamonds,   // OpenGL 1.3, 3.4: those whose diamonds it leaves, side by side as often as its whole width says
  rectangles  // those whose centres a rectangle around it holds, which is up to 1.118 times too wide
};
// Which pixels a point draws.
enum class PointShape : std::uint8_t {
  whole_pixels,  // OpenGL 1.3, 3.3: a square of whole pixels, moved to whole pixels
  squares        // those whose centres a square around the point's own position holds, with a rule for its edges
};
// How a fog factor, or a texture-shader stage's number, from 0 to 1 becomes a byte.
enum class StageByte : std::uint8_t {
  twelve_bits,  // cut to 12 bits n, then 255 (n + 1) >> 12
  nearest       // times 255, to nearest, halves up
};
// The divisors of a dot product's signed bytes: for the mappings of Direct3D, of OpenGL, and the plain one.
enum class DotDivisors : std::uint8_t {
  odd,  // 127, 255, 127
  even  // 128, 256, 128
};
// Whose mapping the dot product has that DOT_PRODUCT_DIFFUSE_CUBE_MAP reads ahead of its stage.
enum class AheadMapping : std::uint8_t { own, of_diffuse };
// What a texture-shader stage's number below 0 is, before it becomes a byte.
enum class NegativeNumber : std::uint8_t {
  zero,  // 0
  size   // itself without its sign
};
// Which of CULL_FRAGMENT's coordinates count as negative at zero.
enum class CullZero : std::uint8_t {
  none,    // neither 0 nor -0
  by_sign  // -0
};
// How the colours of a DXT1 texture are kept.
enum class Dxt1Palette : std::uint8_t {
  rgb565,      // the palette in 5, 6 and 5 bits, then widened
  rgb888,      // the palette in bytes
  dithered565  // the palette in bytes, dithered to 5, 6 and 5 bits by the texel's place, then widened
};

// One hardware behaviour: its value, its evidence, and the source of that.
template <class T>
struct Choice {
  T value;            // what the hardware does or is assumed to do
  Evidence evidence;  // the kind of evidence for it
  std::string_view
      source;  // of the evidence, and the rival hypothesis if there is one; "rule N" refers to docs/numerics.md
  constexpr operator T() const { return value; }  // reads as its value
};

// One field for every behaviour that the extensions leave to the hardware. Nothing is checked here; parse_json_profile
// checks which values make sense.
struct HardwareProfile {
  std::string_view name;  // as --profile takes it
  std::string_view chip;  // for people

  Choice<Arithmetic> arithmetic;  // the numbers that the combiners compute in

  // Codes. A register component is an integer; `one` is the code of 1.0. If the arithmetic is not integer, `one` and
  // `byte_shift` define the numbers of codes, and the other four are not read.
  Choice<int> one;            // the code of 1.0
  Choice<int> lowest;         // the lowest code that a register can hold before the first stage
  Choice<int> lowest_output;  // the lowest code that a general combiner writes; at least `lowest`
  Choice<int> half;           // bias of one half, half-bias mapping, mux threshold
  Choice<int> expand_offset;  // the expanding mappings give 2v - this
  Choice<int> byte_shift;     // number of low bits of a byte (texel, colour, constant) that a register drops

  // Narrowing, for integer arithmetic only.
  Choice<Narrowing> general_narrowing;     // of a general combiner's outputs
  Choice<NarrowingPoint> narrowing_point;  // of a general combiner's outputs
  Choice<Narrowing> final_narrowing;       // of A·B + (1 - A)·C and of E·F

  // Features of the chip.
  Choice<int> general_combiners;     // 1 to 8
  Choice<int> texture_units;         // 1 to 4
  Choice<bool> per_stage_constants;  // NV_register_combiners2
  Choice<bool> blue_to_alpha;        // an RGB portion may write its blue to a register's alpha
  Choice<bool> mux_by_lowest_bit;    // the mux may test the lowest bit of spare0's alpha
  Choice<bool> color_sum_inverts;    // spare0 and the secondary colour may go into the colour sum as 1 - x
  Choice<bool> texture_shaders;      // NV_texture_shader and NV_texture_shader2
  Choice<bool> point_sprites;        // NV_point_sprite
  Choice<bool> multisampling;        // surfaces with two and four samples for each pixel

  // Registers before the first general combiner.
  Choice<int> spare0_alpha_without_texture0;  // byte, when texture unit 0 is off
  Choice<int> disabled_texture_alpha;         // byte, with RGB 0
  Choice<SecondaryAlpha> secondary_alpha;     // 1.0, or that of the colour
  Choice<int> fog_alpha_without_fog;          // byte

  // The rasterizer.
  Choice<int> subpixel_bits;                 // window positions are truncated toward zero to 1/2^this pixel
  Choice<LineShape> line_shape;              // of lines, and of the edges of polygons in that mode
  Choice<PointShape> point_shape;            // of points, and of the corners of polygons in that mode
  Choice<int> vertex_color_mantissa_bits;    // a float vertex colour keeps this many fraction bits, then x 255, half up
  Choice<OffsetSlope> polygon_offset_slope;  // m of the polygon offset factor × m + r × units
  Choice<OffsetFraction> polygon_offset_fraction;  // of that sum
  Choice<ColorInterpolation> color_interpolation;  // of smooth primary and secondary colours
  Choice<ColorWeights> color_weights;              // of smooth primary and secondary colours
  Choice<SurfaceBlend> surface_blend;              // of surfaces with fewer bits than bytes
  Choice<Narrowing> coverage_narrowing;            // of an alpha times a smoothed primitive's coverage, to a byte
  Choice<Narrowing> depth_narrowing;               // of a fragment's depth on its primitive, to a depth code
  Choice<StageByte> fog_byte;                      // of a fragment's fog factor
  Choice<int> texture_weight_bits;                 // fraction bits of the weights of linear filters
  Choice<Narrowing> texture_weight_narrowing;      // of a place between two texels, to these bits
  Choice<FilterRounding> texture_filter_rounding;  // of linear filters
  Choice<Narrowing> texture_bias_narrowing;        // of a level-of-detail bias, to 1/256
  Choice<Dxt1Palette> dxt1_palette;                // of DXT1 textures

  // Texture-shader stages, where the chip has them.
  Choice<StageByte> stage_byte;                  // of pass_through and of scaled offset textures
  Choice<NegativeNumber> negative_stage_number;  // of pass_through and of scaled offset textures
  Choice<CullZero> cull_zero;                    // of cull_fragment
  Choice<DotDivisors> dot_divisors;              // of signed mappings of dot products
  Choice<int> dependent_divisor;                 // a byte over this is a coordinate of a dependent texture
  Choice<AheadMapping> ahead_mapping;            // of the third dot product of a diffuse cube map
  Choice<Narrowing> replaced_depth_narrowing;    // of a replaced depth, to a depth code
};

// The fields of a HardwareProfile that the rules of combiner/arithmetic.inl read, under the same
// names, as plain values: programs that have them can be compared and stored.
struct Datapath {
  Arithmetic arithmetic = Arithmetic::integer;  // if not integer, of the rest only `one` is read
  int one = 255;                                // the code of 1.0
  int lowest = -255;                            // the lowest code that a register can hold before the first stage
  int lowest_output = -255;                     // the lowest code that a general combiner writes
  int half = 128;           // the code of one half: in the bias, the half-bias mappings and the mux's threshold
  int expand_offset = 255;  // subtracted by the expanding mappings: 2v - expand_offset
  Narrowing general_narrowing = Narrowing::toward_zero;          // of a general combiner's outputs
  NarrowingPoint narrowing_point = NarrowingPoint::after_scale;  // before or after the scale
  Narrowing final_narrowing = Narrowing::nearest_halves_up;      // of the final combiner's products

  friend constexpr bool operator==(const Datapath&, const Datapath&) = default;
};

// Returns the fields of a profile that the arithmetic reads.
[[nodiscard]] constexpr Datapath datapath_of(const HardwareProfile& profile) {
  return {profile.arithmetic,
          profile.one,
          profile.lowest,
          profile.lowest_output,
          profile.half,
          profile.expand_offset,
          profile.general_narrowing,
          profile.narrowing_point,
          profile.final_narrowing};
}

// The fields of a profile that the stage rules read.
struct StageChoices {
  StageByte byte = StageByte::twelve_bits;             // HardwareProfile::stage_byte
  NegativeNumber negative = NegativeNumber::zero;      // HardwareProfile::negative_stage_number
  CullZero cull_zero = CullZero::none;                 // HardwareProfile::cull_zero
  DotDivisors divisors = DotDivisors::odd;             // HardwareProfile::dot_divisors
  int dependent_divisor = 255;                         // HardwareProfile::dependent_divisor
  AheadMapping ahead_mapping = AheadMapping::own;      // HardwareProfile::ahead_mapping
  Narrowing depth_narrowing = Narrowing::toward_zero;  // HardwareProfile::replaced_depth_narrowing
  std::uint8_t off_alpha = 255;  // of `none`: HardwareProfile::disabled_texture_alpha, 0 by OpenGL's rules
  friend constexpr bool operator==(const StageChoices&, const StageChoices&) = default;
};

// Returns the fields of a profile that the stage rules read.
[[nodiscard]] constexpr StageChoices stage_choices_of(const HardwareProfile& profile) {
  return {profile.stage_byte,
          profile.negative_stage_number,
          profile.cull_zero,
          profile.dot_divisors,
          profile.dependent_divisor,
          profile.ahead_mapping,
          profile.replaced_depth_narrowing,
          static_cast<std::uint8_t>(profile.disabled_texture_alpha.value)};
}

// Returns all shipped profiles, the default (geforce2) first. Addresses and names stay valid for the whole run.
[[nodiscard]] std::span<const HardwareProfile> hardware_profiles();

// Returns the shipped profile of that name ("geforce2", "nv2a", …), or nullptr.
[[nodiscard]] const HardwareProfile* find_profile(std::string_view name);

namespace profiles {

namespace detail {
using enum Evidence;

// Rule numbers refer to docs/numerics.md.
consteval HardwareProfile card() {
  return {
      .name = "geforce2",
      .chip = "NV15, NV11 (GeForce 2)",
      .arithmetic = {Arithmetic::integer, specified, "NV_register_combiners, issues: 9-bit signed fixed point"},
      .one = {255, measured, "rule 1: 255 x 1.0 = 255 on NV2A, every texel value"},
      .lowest = {-255, inferred, "no input of this chip is negative; outputs are: see lowest_output"},
      .lowest_output = {-255, specified,
                        "NV_register_combiners clamps outputs to [-1, 1]; rival: -256, which NV_texture_shader allows "
                        "registers to hold"},
      .half = {128, inferred, "rules 4 and 22: 255 - half = 127, and the 16-bit depth compare of 2000"},
      .expand_offset = {255, inferred,
                        "rule 1 and NV_register_combiners: 2x - 1, so 0 gives -1.0; rival: 256, by which "
                        "NV_texture_expand_normal expands texels"},
      .byte_shift = {0, measured, "rule 1: bytes enter as 0..255"},
      .general_narrowing = {Narrowing::toward_zero, seed,
                            "rule 8: the square of a small difference is truncated to zero"},
      .narrowing_point = {NarrowingPoint::after_scale, seed, "rule 7: steps of 2 work on a GeForce 2"},
      .final_narrowing = {Narrowing::nearest_halves_up, inferred, "rule 9, measured on NV2A"},
      .general_combiners = {2, specified, "NV_register_combiners; two sets of stage registers on NV1x"},
      .texture_units = {2, specified, "ARB_multitexture on NV1x"},
      .per_stage_constants = {false, specified, "NV_register_combiners2 is absent"},
      .blue_to_alpha = {false, specified, "NV_register_combiners has no such output"},
      .mux_by_lowest_bit = {false, specified, "NV_register_combiners has the threshold of one half alone"},
      .color_sum_inverts = {false, specified, "NV_register_combiners has no such sum"},
      .texture_shaders = {false, specified, "NV_texture_shader is of the NV20 class"},
      .point_sprites = {false, specified, "NV_point_sprite is of the NV20 class"},
      .multisampling = {false, assumed, "the chip's driver drew larger pictures instead"},
      .spare0_alpha_without_texture0 = {255, assumed, "the extension leaves it unspecified"},
      .disabled_texture_alpha = {255, inferred, "rule 16, measured on NV2A"},
      .secondary_alpha = {SecondaryAlpha::one, inferred, "drivers up to 56.90 gave 1.0"},
      .fog_alpha_without_fog = {255, specified, "NV_register_combiners, initial register values"},
      .subpixel_bits = {4, inferred, "rule 21: modelled by envytools for NV10, measured on NV2A"},
      .line_shape = {LineShape::rectangles, inferred, "rule 30, measured on NV2A"},
      .point_shape = {PointShape::squares, inferred, "rule 31, measured on NV2A"},
      .vertex_color_mantissa_bits = {13, inferred, "rule 17: modelled by envytools for NV10, measured on NV2A"},
      .polygon_offset_slope = {OffsetSlope::larger, inferred, "rule 20: equal slopes in depth dumps of an NV2A"},
      .polygon_offset_fraction = {OffsetFraction::kept, inferred,
                                  "rule 20, measured on NV2A: the depth and the offset are added, then cut"},
      .color_interpolation = {ColorInterpolation::perspective, inferred,
                              "rule 27: in perspective on NV2A; OpenGL allows both; rival: affine"},
      .color_weights = {ColorWeights::eight_bits, inferred, "rule 27, measured on NV2A"},
      .surface_blend = {SurfaceBlend::zeros, inferred, "rule 44, measured on NV2A"},
      .coverage_narrowing = {Narrowing::nearest_halves_up, assumed, "rule 47: no picture has another alpha than 255"},
      .depth_narrowing = {Narrowing::toward_zero, inferred, "rule 28, measured on NV2A"},
      .fog_byte = {StageByte::twelve_bits, inferred, "rule 25, measured on NV2A"},
      .texture_weight_bits = {8, inferred, "rule 26, measured on NV2A"},
      .texture_weight_narrowing = {Narrowing::toward_zero, inferred, "rule 26, measured on NV2A"},
      .texture_filter_rounding = {FilterRounding::each_blend, inferred, "rule 26, measured on NV2A"},
      .texture_bias_narrowing = {Narrowing::toward_zero, inferred, "rule 26, measured on NV2A"},
      .dxt1_palette = {Dxt1Palette::rgb565, inferred,
                       "banding of DXT1 skies in reviews of 2001; how the chip rounds is assumed"},
      .stage_byte = {StageByte::twelve_bits, assumed, "the chip has no such stage; as nv2a"},
      .negative_stage_number = {NegativeNumber::zero, assumed, "the chip has no such stage; as nv2a"},
      .cull_zero = {CullZero::none, assumed, "the chip has no such stage; as nv2a"},
      .dot_divisors = {DotDivisors::odd, assumed, "the chip has no such stage; as nv2a"},
      .dependent_divisor = {255, assumed, "the chip has no such stage; as nv2a"},
      .ahead_mapping = {AheadMapping::own, assumed, "the chip has no such stage; as nv2a"},
      .replaced_depth_narrowing = {Narrowing::toward_zero, assumed, "the chip has no such stage; as nv2a"},
  };
}

consteval HardwareProfile early_truncation() {
  HardwareProfile p = card();
  p.name = "geforce2-early-truncation";
  p.chip = "none: the rival of rule 7";
  p.narrowing_point = {NarrowingPoint::before_scale, assumed, "the hypothesis that rule 7 rejects"};
  return p;
}

consteval HardwareProfile eight_bit() {
  HardwareProfile p = card();
  p.name = "geforce256-8bit";
  p.chip = "none: an 8-bit card, as the article fears";
  constexpr std::string_view why = "the article: an older card may be less precise";
  p.one = {127, assumed, why};
  p.lowest = {-127, assumed, why};
  p.lowest_output = {-127, assumed, why};
  p.half = {64, assumed, why};
  p.expand_offset = {127, assumed, why};
  p.byte_shift = {1, assumed, why};
  return p;
}

consteval HardwareProfile xbox() {
  HardwareProfile p = card();
  p.name = "nv2a";
  p.chip = "NV2A (Xbox), GeForce3 class";
  p.lowest = {-256, specified, "NV_texture_shader, number formats: -256 is -1.00392; pictures show no negative texel"};
  p.half = {128, measured, "rule 4: 255 - half = 127, and with x2 254"};
  p.general_narrowing = {Narrowing::nearest_halves_up, inferred,
                         "rule 5: measured for a half of 25, 63, 255; products and negative values were never read"};
  p.narrowing_point = {NarrowingPoint::after_scale, inferred, "rule 22"};
  p.final_narrowing = {Narrowing::nearest_halves_up, measured, "rule 9: 4,600 colours"};
  p.general_combiners = {8, specified, "NV_register_combiners2"};
  p.texture_units = {4, specified, "NV20 class"};
  p.per_stage_constants = {true, specified, "NV_register_combiners2"};
  p.blue_to_alpha = {true, measured, "NV2A output flag"};
  p.mux_by_lowest_bit = {true, measured, "rule 11: 129 takes CD, 130 and 0 take AB"};
  p.color_sum_inverts = {true, measured, "rule 13: 1 - 191/255 is 64/255, by either"};
  p.texture_shaders = {true, specified, "NV20 class"};
  p.point_sprites = {true, measured, "rule 46: 7,938 pixels, none wrong"};
  p.multisampling = {true, measured, "rule 48: 460,800 samples, none wrong"};
  p.disabled_texture_alpha = {255, measured, "rule 16"};
  p.secondary_alpha = {SecondaryAlpha::as_given, specified, "NV_register_combiners2"};
  p.subpixel_bits = {4, measured, "rule 21"};
  p.line_shape = {LineShape::rectangles, measured, "rule 30: 68,224 pixels of lines"};
  p.point_shape = {PointShape::squares, measured, "rule 31: 354 of 355 points"};
  p.vertex_color_mantissa_bits = {13, measured, "rule 17: 273 of 273"};
  p.polygon_offset_slope = {OffsetSlope::larger, inferred, "rule 20: equal slopes in depth dumps"};
  p.polygon_offset_fraction = {OffsetFraction::kept, measured, "rule 20: 312,960 pixels"};
  p.color_interpolation = {ColorInterpolation::perspective, measured,
                           "rule 27: 359,729 pixels; affine where a bit of NV097_SET_CONTROL0 is off"};
  p.color_weights = {ColorWeights::eight_bits, measured, "rule 27: 1.2 million pixels"};
  p.surface_blend = {SurfaceBlend::zeros, measured, "rule 44: 1,823,808 pixels, none wrong"};
  p.depth_narrowing = {Narrowing::toward_zero, measured, "rule 28: 216,525 of 216,529 pixels"};
  p.fog_byte = {StageByte::twelve_bits, measured, "rule 25: 5,796 of 5,800 pixels"};
  p.texture_weight_bits = {8, measured, "rule 26: a ramp of 84 pixels"};
  p.texture_weight_narrowing = {Narrowing::toward_zero, measured, "rule 26: a ramp of 84 pixels, 167 of 168 rows"};
  p.texture_filter_rounding = {FilterRounding::each_blend, measured, "rule 26: 159,744 values"};
  p.texture_bias_narrowing = {Narrowing::toward_zero, measured, "rule 26: the bias is s4.8"};
  p.dxt1_palette = {Dxt1Palette::dithered565, measured, "rule 24: 788,736 values of textures in pictures"};
  p.stage_byte = {StageByte::twelve_bits, measured, "rule 33: 557,056 values"};
  p.negative_stage_number = {NegativeNumber::zero, assumed, "rule 33: no picture has one; rival: without its sign"};
  p.cull_zero = {CullZero::none, assumed, "rule 42: pixels within 1e-6 of 0 are left out; rival: -0 is negative"};
  p.dot_divisors = {DotDivisors::odd, assumed, "rule 36: cube maps show directions alone; rival: 128, 256, 128"};
  p.dependent_divisor = {255, assumed, "rule 37: 131,072 pixels show no difference; rival: 256"};
  p.ahead_mapping = {AheadMapping::own, assumed,
                     "rule 38: all stages of the pictures have one mapping; rival: that of the diffuse stage"};
  p.replaced_depth_narrowing = {Narrowing::toward_zero, measured,
                                "rule 39: 65,410 of 65,536 depths of 16 bits; of 24 bits assumed"};
  return p;
}

// A profile without a chip, for an arithmetic of real numbers: all features of the extensions, and the NV2A's
// behaviour.
consteval HardwareProfile real_numbers(std::string_view name, std::string_view chip,
                                       const Choice<Arithmetic>& arithmetic) {
  constexpr std::string_view not_read = "not read by this arithmetic";
  constexpr std::string_view as_nv2a = "no chip decides; as nv2a";
  using P = HardwareProfile;
  P p = xbox();
  for (const auto flag : {&P::blue_to_alpha, &P::mux_by_lowest_bit, &P::color_sum_inverts, &P::texture_shaders,
                          &P::point_sprites, &P::multisampling}) {
    p.*flag = {(p.*flag).value, assumed, as_nv2a};
  }
  for (const auto number :
       {&P::texture_units, &P::disabled_texture_alpha, &P::subpixel_bits, &P::texture_weight_bits}) {
    p.*number = {(p.*number).value, assumed, as_nv2a};
  }
  p.name = name;
  p.chip = chip;
  p.arithmetic = arithmetic;
  p.one = {255, specified, "OpenGL: a byte n stands for n / 255"};
  p.lowest = {-255, specified, "NV_register_combiners: registers hold [-1, 1]"};
  p.lowest_output = {-255, specified, "NV_register_combiners: outputs are clamped to [-1, 1]"};
  p.half = {128, assumed, not_read};
  p.expand_offset = {255, assumed, not_read};
  p.byte_shift = {0, specified, "OpenGL: a byte n stands for n / 255"};
  p.general_narrowing = {Narrowing::nearest_halves_up, assumed, not_read};
  p.narrowing_point = {NarrowingPoint::after_scale, assumed, not_read};
  p.final_narrowing = {Narrowing::nearest_halves_up, assumed, not_read};
  p.line_shape = {LineShape::diamonds, specified, "OpenGL 1.3, 3.4.1 and 3.4.2"};
  p.point_shape = {PointShape::whole_pixels, specified, "OpenGL 1.3, 3.3"};
  p.vertex_color_mantissa_bits = {23, assumed, "no bit of a float is cut before it is rounded to a byte"};
  p.polygon_offset_slope = {OffsetSlope::larger, assumed, as_nv2a};
  p.polygon_offset_fraction = {OffsetFraction::kept, specified, "OpenGL 1.3, 3.5.5: the offset is added to the depth"};
  p.color_interpolation = {ColorInterpolation::perspective, assumed, as_nv2a};
  p.color_weights = {ColorWeights::exact, specified, "OpenGL 1.3, 3.5.1"};
  p.coverage_narrowing = {Narrowing::nearest_halves_up, specified, "OpenGL: colours are rounded to nearest"};
  p.surface_blend = {SurfaceBlend::bytes, specified, "OpenGL 1.3, 4.1.6: the numbers that the bits stand for"};
  p.depth_narrowing = {Narrowing::nearest_halves_up, specified, "OpenGL: depths are rounded to nearest"};
  p.fog_byte = {StageByte::nearest, specified, "OpenGL: colours are rounded to nearest"};
  p.texture_weight_narrowing = {Narrowing::nearest_halves_up, assumed, "the nearest weights of these bits"};
  p.texture_filter_rounding = {FilterRounding::once, specified, "OpenGL 1.3, 3.8.8: one weighted sum"};
  p.texture_bias_narrowing = {Narrowing::nearest_halves_up, specified,
                              "OpenGL 1.4, 3.8.8 adds it as it is: to the nearest step of the level of detail"};
  p.dxt1_palette = {Dxt1Palette::rgb888, specified, "EXT_texture_compression_s3tc: real numbers between the colours"};
  p.stage_byte = {StageByte::nearest, specified, "OpenGL: colours are rounded to nearest"};
  p.negative_stage_number = {NegativeNumber::zero, specified, "OpenGL: colours are clamped to 0 to 1"};
  p.cull_zero = {CullZero::none, specified, "NV_texture_shader: comparisons with 0.0, which -0.0 equals"};
  p.dot_divisors = {DotDivisors::odd, assumed, as_nv2a};
  p.dependent_divisor = {255, specified, "OpenGL: a byte n stands for n / 255"};
  p.ahead_mapping = {AheadMapping::own, assumed, as_nv2a};
  p.replaced_depth_narrowing = {Narrowing::nearest_halves_up, specified, "OpenGL: depths are rounded to nearest"};
  return p;
}
}  // namespace detail

// "geforce2": NV15 and NV11, the article's card.
inline constexpr HardwareProfile geforce2 = detail::card();
// "geforce2-early-truncation": geforce2 that drops low bits before the scale, the hypothesis that rule 7 rejects.
inline constexpr HardwareProfile geforce2_early_truncation = detail::early_truncation();
// "geforce256-8bit": the less precise card that the article fears; registers keep seven bits and a sign.
inline constexpr HardwareProfile geforce256_8bit = detail::eight_bit();
// "nv2a": the Xbox's chip of the GeForce3 class, which was measured.
inline constexpr HardwareProfile nv2a = detail::xbox();
// "ideal": the extension's equations in exact fractions. The errors of other profiles are measured against it.
inline constexpr HardwareProfile ideal =
    detail::real_numbers("ideal", "none: what the algebra says",
                         {Arithmetic::exact, Evidence::specified, "NV_register_combiners writes real numbers"});
// "float-shader": the equations in 32-bit floats, as emulators' shaders compute them.
inline constexpr HardwareProfile float_shader =
    detail::real_numbers("float-shader", "none: emulators that run combiners as float shaders",
                         {Arithmetic::float32, Evidence::assumed, "xemu, MAME, Cxbx-Reloaded compute so"});

}  // namespace profiles
}  // namespace ninebit
