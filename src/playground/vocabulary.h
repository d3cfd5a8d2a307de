// The words of the forms, with what they compute.
#pragma once

#include <span>
#include <string_view>

#include "ninebit/numerics/profile_fields.h"
#include "src/playground/reply.h"

namespace ninebit::playground {

// A word and its help, one or two sentences.
struct HelpedWord {
  std::string_view word, help;
};

[[nodiscard]] std::span<const HelpedWord> gl_constant_help();
[[nodiscard]] std::span<const HelpedWord> gl_function_help();
[[nodiscard]] std::span<const HelpedWord> rc10_help();
[[nodiscard]] std::span<const HelpedWord> pixel_shader_help();
[[nodiscard]] std::span<const HelpedWord> json_help();

// A hardware profile as the page's controls show it.

// The field's value as a profile file has it.
[[nodiscard]] Json value_of_field(const ProfileField& field, const HardwareProfile& profile);

// The profile as `about` lists it.
[[nodiscard]] Json profile_object(const HardwareProfile& profile);

}  // namespace ninebit::playground
