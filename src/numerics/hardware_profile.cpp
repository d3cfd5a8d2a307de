#include "ninebit/numerics/hardware_profile.h"

#include <array>

#include "src/numerics/exact_combiners.h"

namespace ninebit {
namespace {

constexpr std::array<HardwareProfile, 6> kProfiles{profiles::geforce2,        profiles::geforce2_early_truncation,
                                                   profiles::geforce256_8bit, profiles::nv2a,
                                                   profiles::ideal,           profiles::float_shader};

}  // namespace

std::string_view name_of(Evidence evidence) {
  switch (evidence) {
    case Evidence::specified:
      return "specified";
    case Evidence::seed:
      return "seed";
    case Evidence::measured:
      return "measured";
    case Evidence::inferred:
      return "inferred";
    case Evidence::assumed:
      break;
  }
  return "assumed";
}

std::span<const HardwareProfile> hardware_profiles() {
  return kProfiles;
}

const HardwareProfile* find_profile(std::string_view name) {
  for (const HardwareProfile& profile : kProfiles) {
    if (profile.name == name) return &profile;
  }
  return nullptr;
}

HardwareProfile with_exact_combiners(HardwareProfile profile) {
  constexpr const HardwareProfile& exact = profiles::ideal;
  profile.arithmetic = exact.arithmetic;
  profile.one = exact.one;
  profile.lowest = exact.lowest;
  profile.lowest_output = exact.lowest_output;
  profile.half = exact.half;
  profile.expand_offset = exact.expand_offset;
  profile.byte_shift = exact.byte_shift;
  profile.general_narrowing = exact.general_narrowing;
  profile.narrowing_point = exact.narrowing_point;
  profile.final_narrowing = exact.final_narrowing;
  return profile;
}

}  // namespace ninebit
