// A hardware profile as the page's controls show it.
#pragma once

#include "ninebit/numerics/profile_fields.h"
#include "src/playground/reply.h"

namespace ninebit::playground {

// The field's value as a profile file has it.
[[nodiscard]] Json value_of_field(const ProfileField& field, const HardwareProfile& profile);

// The profile as `about` lists it.
[[nodiscard]] Json profile_object(const HardwareProfile& profile);

}  // namespace ninebit::playground
