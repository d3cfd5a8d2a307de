// The words of the forms, with what they compute.
#pragma once

#include <span>
#include <string_view>

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

}  // namespace ninebit::playground
