// A program in the form of a name.
#pragma once

#include <array>
#include <string>
#include <string_view>

#include "ninebit/language/program_text.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The forms that programs are written in, as --to takes them.
inline constexpr std::array<std::string_view, 10> kPrintedForms{"gl",   "rc10", "ps11", "words",   "words-json",
                                                                "json", "xbox", "glsl", "glsl-es", "c"};

// A valid program in the form of this name, one of kPrintedForms. Reports what the form cannot express.
[[nodiscard]] Result<std::string> print_in_form(std::string_view form, const TextProgram& program, ChipClass chip,
                                                const HardwareProfile& profile);

}  // namespace ninebit
