// The answers about texts, which need no picture.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/language/program_text.h"
#include "src/playground/request.h"

namespace ninebit::playground {

// {"do": "about"}: what there is to choose from.
[[nodiscard]] Reply about(Request& request);
// {"do": "vocabulary"}: every word of the forms, with help.
[[nodiscard]] Reply vocabulary(Request& request);
// {"do": "read", "text", "profile"}: what is wrong with a program, and what it computes.
[[nodiscard]] Reply read_text(Request& request);
// {"do": "convert", "text", "profile", "to"}.
[[nodiscard]] Reply convert_text(Request& request);
// {"do": "trace", "text", "profile", "registers", "name"}.
[[nodiscard]] Reply trace_text(Request& request);

// {"do": "evaluate", "text", "profile", "pictures", "registers"}: the colours of the pictures in the buffer, as bytes.
[[nodiscard]] Reply evaluate_pictures(Request& request, std::span<const std::uint8_t> buffer,
                                      std::vector<std::uint8_t>& bytes);

// {"do": "profile", "profile"}: its fields, as `about` lists them for shipped profiles.
[[nodiscard]] Reply list_profile(Request& request);
// {"do": "edit_profile", "profile", "field", "value"}: the profile with that field changed and the fields that depend
// on it, which "coupled" names.
[[nodiscard]] Reply edit_profile(Request& request);

// A program that the profile accepts, or every fault of its text. `name` is for messages.
[[nodiscard]] Parsed<TextProgram> valid_program(std::string_view text, std::string_view name,
                                                const HardwareProfile& profile);

// Whether a portion or the final combiner reads the register.
[[nodiscard]] bool reads_register(const Program& program, Register reg);

// scenes/index_room.gltf, embedded at build time.

extern const std::string_view kRoomText;

}  // namespace ninebit::playground
