// Programs as the Xbox's pixel shader definition, D3DPIXELSHADERDEF: the 60 words that a title gives to Direct3D.
// docs/languages.md documents the shapes of text and the sources.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The size of a definition in words of 32 bits, and in bytes.
inline constexpr std::size_t kXboxDefinitionWords = 60, kXboxDefinitionBytes = 240;

// Whether a text or a binary file seems to be a definition in one of the shapes that parse_xbox_pixel_shader reads.
[[nodiscard]] bool is_xbox_pixel_shader(std::string_view text);

// Reads a definition, whichever of these the text is:
// - a C initializer of the struct, or assignments to its members (`psd.PSRGBInputs[0] = 0x…;`); values are constant
//   expressions of numbers and of the macros of the Xbox's headers
// - 60 numbers in hexadecimal, or the bytes of them as a hex dump of xxd, hexdump, od or WinDbg
// - a C array of the 60 words or of the 240 bytes
// - the 240 bytes themselves, little endian
// Missing words are 0. The words are those of NV20 and mean what decode_register_words says, with the same faults; the
// profile decides which of NV20's features there are. Unknown members and macros, values out of range and wrong counts
// are faults with their place. `other_words` receives all words of kOtherWordNames, if there is a state.
[[nodiscard]] Parsed<CombinerState> parse_xbox_pixel_shader(const SourceText& source, const HardwareProfile& profile,
                                                            std::vector<RegisterWord>* other_words = nullptr);

// A C initializer of the struct in the macros' words, which parse_xbox_pixel_shader reads back to the same program; or
// a Diagnostic as from encode_register_words. Words of `other_words` that are missing are 0.
[[nodiscard]] Result<std::string> print_xbox_pixel_shader(const CombinerState& state, const HardwareProfile& profile,
                                                          std::span<const RegisterWord> other_words = {});

// The meaning of a word of kOtherWordNames, one phrase a part: "texture 0: PROJECT2D (2D, projective)". Empty for other
// names.
[[nodiscard]] std::vector<std::string> explain_other_word(const RegisterWord& word);

}  // namespace ninebit
