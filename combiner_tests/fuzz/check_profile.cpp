// A profile of somebody's own. It has no printer in the library, so one stands here.
#include <algorithm>
#include <memory>
#include <string>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/language/profile_json.h"

namespace ninebit::fuzz {
namespace {

std::string member(const std::string& key, int value) {
  return ", \"" + key + "\": " + std::to_string(value);
}

std::string member(const std::string& key, bool value) {
  return ", \"" + key + "\": " + (value ? "true" : "false");
}

std::string member(const std::string& key, const char* value) {
  return ", \"" + key + "\": \"" + value + '"';
}

const char* name(Narrowing narrowing) {
  return narrowing == Narrowing::toward_zero ? "toward-zero" : "nearest-halves-up";
}

const char* name(Arithmetic arithmetic) {
  return arithmetic == Arithmetic::integer ? "integer" : arithmetic == Arithmetic::exact ? "exact" : "float32";
}

// Every field that the arithmetic reads, whatever the base has.
std::string print(const HardwareProfile& p) {
  std::string text = R"({"base": "geforce2", "name": ")" + std::string(p.name) + '"';
  text += member("arithmetic", name(p.arithmetic)) + member("one", p.one.value);
  text += member("byte_shift", p.byte_shift.value);
  if (p.arithmetic == Arithmetic::integer) {
    const bool early = p.narrowing_point == NarrowingPoint::before_scale;
    text += member("lowest", p.lowest.value) + member("lowest_output", p.lowest_output.value);
    text += member("half", p.half.value);
    text += member("expand_offset", p.expand_offset.value) + member("general_narrowing", name(p.general_narrowing));
    text += member("narrowing_point", early ? "before-scale" : "after-scale");
    text += member("final_narrowing", name(p.final_narrowing));
  }
  text += member("general_combiners", p.general_combiners.value) + member("texture_units", p.texture_units.value);
  text += member("per_stage_constants", p.per_stage_constants.value) + member("blue_to_alpha", p.blue_to_alpha.value);
  text +=
      member("mux_by_lowest_bit", p.mux_by_lowest_bit.value) + member("color_sum_inverts", p.color_sum_inverts.value);
  text += member("spare0_alpha_without_texture0", p.spare0_alpha_without_texture0.value);
  text += member("disabled_texture_alpha", p.disabled_texture_alpha.value);
  text += member("secondary_alpha", p.secondary_alpha == SecondaryAlpha::one ? "one" : "as-given");
  text += member("fog_alpha_without_fog", p.fog_alpha_without_fog.value);
  text += member("subpixel_bits", p.subpixel_bits.value);
  return text + member("vertex_color_mantissa_bits", p.vertex_color_mantissa_bits.value) + "}";
}

// The limits that profile_json.h states.
std::string wrong_with_limits(const HardwareProfile& p) {
  const auto within = [](int value, int low, int high) { return value >= low && value <= high; };
  const bool integer = p.arithmetic == Arithmetic::integer;
  if (p.name.empty() || find_profile(p.name) != nullptr) return "the name '" + std::string(p.name) + "'";
  if (!within(p.byte_shift, 0, 4) || p.one != 255 >> p.byte_shift.value) return "one and byte_shift";
  if (integer && !within(p.lowest, -p.one - 1, -p.one)) return "lowest";
  if (integer && !within(p.lowest_output, p.lowest, -p.one)) return "lowest_output";
  if (integer && !within(p.half, 0, p.one)) return "half";
  if (integer && !within(p.expand_offset, p.one, p.one + 1)) return "expand_offset";
  if (!within(p.general_combiners, 1, 8) || !within(p.texture_units, 1, 4)) return "combiners and texture units";
  for (const int byte :
       {p.spare0_alpha_without_texture0.value, p.disabled_texture_alpha.value, p.fog_alpha_without_fog.value}) {
    if (!within(byte, 0, 255)) return "a byte";
  }
  return within(p.subpixel_bits, 0, 4) && within(p.vertex_color_mantissa_bits, 1, 23) ? "" : "bits";
}

// A state that takes every mapping and the narrowing in all its places.
CombinerState busy_state() {
  constexpr auto kRgb = ComponentUsage::rgb;
  constexpr auto kAlpha = ComponentUsage::alpha;
  CombinerState state;
  Portion& rgb = state.general[0].rgb;
  rgb.a = {Register::primary, InputMapping::expand_normal, kRgb};
  rgb.b = {Register::texture0, InputMapping::half_bias_negate, kRgb};
  rgb.c = {Register::secondary, InputMapping::signed_negate, kRgb};
  rgb.d = {Register::texture0, InputMapping::expand_negate, kAlpha};
  rgb.out = {.ab = Register::secondary,
             .cd = Register::spare1,
             .sum = Register::spare0,
             .scale = Scale::by_two,
             .bias = Bias::by_negative_one_half,
             .cd_dot_product = true};
  Portion& alpha = state.general[0].alpha;
  alpha.a = {Register::primary, InputMapping::signed_identity, kAlpha};
  alpha.b = {Register::texture0, InputMapping::half_bias_normal, kAlpha};
  alpha.c = {Register::primary, InputMapping::unsigned_invert, ComponentUsage::blue};
  alpha.d = {Register::texture0, InputMapping::unsigned_identity, kAlpha};
  alpha.out = {.sum = Register::spare0, .scale = Scale::by_one_half, .mux_sum = true};
  FinalCombiner& f = state.final_combiner;
  f.a = {Register::primary, InputMapping::unsigned_identity, kAlpha};
  f.b = {Register::spare0_plus_secondary, InputMapping::unsigned_identity, kRgb};
  f.c = {Register::spare1, InputMapping::unsigned_invert, kRgb};
  f.d = {Register::e_times_f, InputMapping::unsigned_identity, kRgb};
  f.e = {Register::secondary, InputMapping::unsigned_identity, kRgb};
  f.f = {Register::texture0, InputMapping::unsigned_invert, kRgb};
  return state;
}

// The batch evaluator against the reference, over codes from the lowest to 1.0.
std::string wrong_with_arithmetic(const HardwareProfile& profile) {
  const auto program = compile(busy_state(), profile);
  if (!program) return "a program of one stage does not compile: " + program.error().message;
  const std::size_t count = profile.arithmetic == Arithmetic::integer ? kBatchSize : 8;
  const auto batch = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  std::vector<RegisterFile> fragments(count);
  const int codes = profile.one - profile.lowest + 1;
  for (std::size_t i = 0; i < count; ++i) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const int code = profile.lowest + static_cast<int>(i * (2 * r + 1) * (c + 37) + r + c) % codes;
        batch->plane[r][c][i] = fragments[i].value[r][c] = static_cast<s9>(code);
      }
    }
  }
  BatchProgram(*program, {.registers = true}).run(*batch, count, *out);
  for (std::size_t i = 0; i < count; ++i) {
    const Rgba9 color = evaluate(*program, fragments[i]);
    for (std::size_t c = 0; c < 4; ++c) {
      if (out->plane[c][i] != color[c]) return "the evaluators differ in fragment " + std::to_string(i);
      if (color[c] < 0 || color[c] > profile.one) return "a colour is " + std::to_string(color[c]);
    }
  }
  return {};
}

}  // namespace

std::string check_profile(std::string_view bytes) {
  const auto parsed = parse_json_profile({bytes, kFile});
  std::string wrong = wrong_with_answer(parsed, bytes);
  if (!wrong.empty() || !parsed) return wrong;
  const HardwareProfile& profile = parsed->profile;
  wrong = wrong_with_limits(profile);
  if (!wrong.empty()) return "out of its limits: " + wrong;
  const std::string printed = print(profile);
  const auto back = parse_json_profile({printed, kFile});
  if (!back) return "the same profile in full is refused: " + back.faults().front().text() + "\n" + printed;
  if (print(back->profile) != printed) return "another profile comes back:\n" + printed;
  return wrong_with_arithmetic(profile);
}

}  // namespace ninebit::fuzz
