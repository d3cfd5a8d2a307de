#include "ninebit/numerics/hardware_profile.h"

#include <array>

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

}  // namespace ninebit
