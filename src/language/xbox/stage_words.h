// The Xbox's words of the texture-shader stages: PSTextureModes, PSInputTexture, PSDotMapping and PSCompareMode of a
// definition, which are those of the NV2A's methods, and of a log also bump matrices, eye vectors and CONTROL0.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "ninebit/language/register_words.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

// Exported because the JSON forms, in a shared library of their own, read all words with it.
namespace ninebit {
namespace NINEBIT_PUBLIC xbox {

// Stages that words describe.
struct StageWords {
  TextureShaderState state{};  // not enabled: PSTextureModes is missing or 0
  std::string why{};           // the words that the stages do not model, in one phrase; empty: none
  std::string missing{};       // numbers that the stages read and no word has, in one phrase; empty: none
  TextPlace place{};           // of PSTextureModes
};
// Reads words of these names; others are passed over. The rules are the NV2A's, and depths are codes.
[[nodiscard]] StageWords decode_stage_words(std::span<const RegisterWord> words);

// Whether a word of kOtherWordNames is one of the stages'.
[[nodiscard]] bool is_stage_word(std::string_view name);

// The same stages with 2D textures where a mode leaves the kind to the texture: for 1D textures and rectangles.
[[nodiscard]] TextureShaderState without_kinds(TextureShaderState state);

// The words of enabled stages that are not 0, in the order of kOtherWordNames, or a Diagnostic. What the application
// sets otherwise has no place in them: see not_in_stage_words().
[[nodiscard]] Result<std::vector<RegisterWord>> encode_stage_words(const TextureShaderState& state);

// All other words that decode_stage_words() reads: bump matrices, luminance scales and offsets of stages 1 to 3, the
// eye vector, which is that of stage 3, and CONTROL0. They are 0 where no operation reads them.
[[nodiscard]] std::vector<RegisterWord> encode_stage_numbers(const TextureShaderState& state);

// The settings that have an effect and no word: "the bump matrix of texture stage 1, …"; empty: none.
[[nodiscard]] std::string not_in_stage_words(const TextureShaderState& state);

}  // namespace xbox
}  // namespace ninebit
