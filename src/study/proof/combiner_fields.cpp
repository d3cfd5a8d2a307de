#include "ninebit/study/combiner_fields.h"

#include <algorithm>
#include <utility>

namespace ninebit {
namespace {

using Words = std::vector<std::pair<std::string, int>>;

// A field whose values are the given ones, the profile's own first.
template <class T>
CombinerField make_field(std::string_view name, std::string_view rules, const HardwareProfile& profile,
                         Choice<T> HardwareProfile::*member, const Words& words) {
  const Choice<T>& choice = profile.*member;
  CombinerField field{name, rules, choice.evidence, {}};
  const auto add = [&](const std::string& word, int value) {
    field.values.push_back({word, [member, value](HardwareProfile& p) { (p.*member).value = static_cast<T>(value); }});
  };
  const int own = static_cast<int>(choice.value);
  for (const auto& [word, value] : words) {
    if (value == own) add(word, value);
  }
  if (field.values.empty()) add(std::to_string(own), own);  // a value of one's own that is neither of the rivals
  for (const auto& [word, value] : words) {
    if (value != own) add(word, value);
  }
  return field;
}

template <class T>
std::pair<std::string, int> named(const char* word, T value) {
  return {word, static_cast<int>(value)};
}

std::pair<std::string, int> number(int value) {
  return {std::to_string(value), value};
}

// No output is below what a register can hold: the rivals of one field move the other along.
CombinerField lowest_field(const HardwareProfile& profile) {
  const int one = profile.one;
  auto field = make_field("lowest", "", profile, &HardwareProfile::lowest, {number(-one), number(-one - 1)});
  for (FieldValue& value : field.values) {
    value.set = [set = value.set](HardwareProfile& p) {
      set(p);
      p.lowest_output.value = std::max(p.lowest_output.value, p.lowest.value);
    };
  }
  return field;
}
CombinerField lowest_output_field(const HardwareProfile& profile) {
  const int one = profile.one;
  auto field =
      make_field("lowest_output", "", profile, &HardwareProfile::lowest_output, {number(-one), number(-one - 1)});
  for (FieldValue& value : field.values) {
    value.set = [set = value.set](HardwareProfile& p) {
      set(p);
      p.lowest.value = std::min(p.lowest.value, p.lowest_output.value);
    };
  }
  return field;
}

}  // namespace

std::vector<CombinerField> arithmetic_fields(const HardwareProfile& profile) {
  if (profile.arithmetic != Arithmetic::integer) return {};
  using P = HardwareProfile;
  const int one = profile.one;
  const Words narrowings{named("toward-zero", Narrowing::toward_zero),
                         named("nearest-halves-up", Narrowing::nearest_halves_up)};
  return {lowest_field(profile),
          lowest_output_field(profile),
          make_field("half", "4, 11", profile, &P::half, {number((one + 1) / 2), number(one / 2)}),
          make_field("expand_offset", "", profile, &P::expand_offset, {number(one), number(one + 1)}),
          make_field("general_narrowing", "5, 8", profile, &P::general_narrowing, narrowings),
          make_field(
              "narrowing_point", "7", profile, &P::narrowing_point,
              {named("after-scale", NarrowingPoint::after_scale), named("before-scale", NarrowingPoint::before_scale)}),
          make_field("final_narrowing", "9, 10", profile, &P::final_narrowing, narrowings)};
}

std::vector<CombinerField> register_fields(const HardwareProfile& profile) {
  using P = HardwareProfile;
  const Words ends{number(255), number(0)};
  return {make_field("spare0_alpha_without_texture0", "", profile, &P::spare0_alpha_without_texture0, ends),
          make_field("disabled_texture_alpha", "16", profile, &P::disabled_texture_alpha, ends),
          make_field("secondary_alpha", "", profile, &P::secondary_alpha,
                     {named("one", SecondaryAlpha::one), named("as-given", SecondaryAlpha::as_given)}),
          make_field("fog_alpha_without_fog", "", profile, &P::fog_alpha_without_fog, ends)};
}

}  // namespace ninebit
