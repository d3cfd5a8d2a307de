// Programs as the register words of NV10 class (GeForce 256, GeForce 2) and NV20 class chips (GeForce3, NV2A).
// docs/languages.md documents the layouts and their sources.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The register layout: that of GeForce 256 and GeForce 2, or that of GeForce3 and NV2A.
enum class ChipClass : std::uint8_t { nv10, nv20 };

// "nv10" or "nv20".
[[nodiscard]] std::string_view name_of(ChipClass chip);

// One word by its name ("RC_IN_RGB[0]"; docs/languages.md lists the aliases), and its place in the text.
struct RegisterWord {
  std::string name{};       // such as "RC_IN_RGB[0]"
  std::uint32_t value = 0;  // all 32 bits
  TextPlace place{};        // 1:1 without a text
};

// The words of the Xbox's pixel shader definition that combiners do not read, in its order: texture modes and what
// belongs to them, and which of Direct3D's constants the combiners' constants come from. NV20's register words may have
// them, too. xbox_pixel_shader.h explains them.
inline constexpr std::array<std::string_view, 7> kOtherWordNames{
    "PSCompareMode", "PSTextureModes",          "PSDotMapping", "PSInputTexture", "PSC0Mapping",
    "PSC1Mapping",   "PSFinalCombinerConstants"};

// Decodes `NAME = 0x…` lines in any order (comments start with # or //; names are case-insensitive). A word with bits
// outside its valid mask, a reserved register code, an unknown or repeated name, a setting that the profile does not
// have and a state that OpenGL would refuse are faults. Missing words have the value that encodes GL's default state.
// If there is a state, `other_words` receives the words of kOtherWordNames that were given, in the order of the text.
// For the same words as a JSON object, see parse_json_register_words in json.h.
[[nodiscard]] Parsed<CombinerState> parse_register_words(const SourceText& source, ChipClass chip,
                                                         const HardwareProfile& profile,
                                                         std::vector<RegisterWord>* other_words = nullptr);

// Like parse_register_words, for words that are already split; `file` appears in messages.
[[nodiscard]] Parsed<CombinerState> decode_register_words(std::span<const RegisterWord> given, std::string_view file,
                                                          ChipClass chip, const HardwareProfile& profile,
                                                          std::vector<RegisterWord>* other_words = nullptr);

// The words of a state under their canonical names, or a Diagnostic that names what the chip cannot express. Constants
// are rounded to bytes, as in compile(). Stages past num_general_combiners are included if the chip has them and their
// portions differ from GL's defaults; the chip's words cannot express stage constants while per_stage_constants is off.
// Decoding returns a state that compiles to the same program.
[[nodiscard]] Result<std::vector<RegisterWord>> encode_register_words(const CombinerState& state, ChipClass chip,
                                                                      const HardwareProfile& profile);

// The result of encode_register_words as `NAME = 0x…` lines, and then `other_words`, if the chip is NV20.
[[nodiscard]] Result<std::string> print_register_words(const CombinerState& state, ChipClass chip,
                                                       const HardwareProfile& profile,
                                                       std::span<const RegisterWord> other_words = {});

}  // namespace ninebit
