// The fields of a hardware profile by name, with what they decide.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "src/playground/reply.h"

namespace ninebit::playground {

// One field under one profile.
struct FieldRow {
  Json value{};  // as a profile file has it
  Evidence evidence = Evidence::assumed;
  std::string_view source{};
  std::vector<std::string_view> choices{};  // the words that a profile file may have; empty: not a word
  int lowest = 0, highest = 0;              // of a number
};

// A field of HardwareProfile.
struct ProfileField {
  std::string_view name;
  bool integer_only;  // only integer arithmetic reads it
  std::string_view help;
  FieldRow (*row)(const HardwareProfile& profile);
};

// In the order of HardwareProfile.
[[nodiscard]] std::span<const ProfileField> profile_fields();

// The profile as `about` lists it.
[[nodiscard]] Json profile_object(const HardwareProfile& profile);

}  // namespace ninebit::playground
