// A profile of somebody's own. It has no printer in the library, so one stands here.
#include <memory>
#include <string>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "ninebit/combiner/batch_program.h"
#include "ninebit/language/profile_json.h"
#include "ninebit/numerics/profile_fields.h"

namespace ninebit::fuzz {
namespace {

bool is_read(const ProfileField& field, const HardwareProfile& p) {
  return field.group != FieldGroup::integer_rules || p.arithmetic == Arithmetic::integer;
}

// Every field that the arithmetic reads, whatever the base has.
std::string print(const HardwareProfile& p) {
  std::string text = R"({"base": "geforce2", "name": ")" + std::string(p.name) + '"';
  for (const ProfileField& field : profile_fields()) {
    if (!is_read(field, p)) continue;
    const std::string quote = field.kind == FieldKind::word ? "\"" : "";
    text += ", \"" + std::string(field.name) + "\": " + quote + field.word_of(field.get(p).value) + quote;
  }
  return text + "}";
}

std::string wrong_with_limits(const HardwareProfile& p) {
  if (p.name.empty() || find_profile(p.name) != nullptr) return "the name '" + std::string(p.name) + "'";
  for (const ProfileField& field : profile_fields()) {
    if (field.kind != FieldKind::number || !is_read(field, p)) continue;
    const FieldNumbers range = field.range(p);
    const int value = field.get(p).value;
    if (value < range.first || value > range.second) return std::string(field.name);
  }
  return {};
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
