// Evaluates texture-shader stages of one fragment, with every value on the way.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_program.h"

namespace NINEBIT_PUBLIC ninebit {

// The interpolated s, t, r, q of each unit, not divided by q.
using StageCoordinates = std::array<std::array<float, 4>, kTextureStages>;

// A fragment's coordinates, and those of its neighbours, which only levels of detail depend on.
struct StageInputs {
  StageCoordinates at{};     // of the fragment
  StageCoordinates right{};  // of the fragment on the right
  StageCoordinates above{};  // of the fragment above
};

// Where a texture is read: s, t, r after any division. The neighbours' places are those of the fragment's own texels at
// the neighbours' coordinates: how the chip finds the level of detail of a dependent texture is open.
struct TexturePlace {
  std::array<float, 3> at{};     // of the fragment
  std::array<float, 3> right{};  // of the fragment on the right
  std::array<float, 3> above{};  // of the fragment above
};

// Reads a unit's texture: its filtered bytes red, green, blue, alpha, signed ones in two's complement, HILO ones as
// H = 256 A + R and L = 256 G + B.
using FetchTexel = std::function<Bytes4(int unit, const TexturePlace& place)>;

// The values of one stage.
struct StageValues {
  TextureOperation operation = TextureOperation::none;  // the stage's
  int previous = 0;                                     // the stage whose texel it reads, if its operation reads one
  bool is_consistent = true;                            // if not, the stage gives (0, 0, 0, 0)
  std::array<float, 4> coordinates{};                   // s, t, r, q of the unit, as given
  Bytes4 input{};                                       // the texel of the previous stage, if one is read
  std::optional<std::array<float, 3>> normal;           // that texel as the factor of the dot product
  std::optional<float> dot;                             // the dot product
  std::optional<std::array<float, 3>> at;               // where the texture was read
  Bytes4 fetched{};                                     // what was read there
  Bytes4 texel{};                                       // the stage's texel, which later stages read
  Rgba9 codes{};                                        // what the combiners read
  friend bool operator==(const StageValues&, const StageValues&) = default;
};

// The results of all stages for one fragment.
struct TextureShaderResult {
  std::array<StageValues, kTextureStages> stage;  // in the order of the units
  bool is_culled = false;        // by CULL_FRAGMENT or a colour key; the stages are evaluated all the same
  std::optional<float> depth{};  // that replaces the fragment's, in the program's unit, not rounded or clamped
  friend bool operator==(const TextureShaderResult&, const TextureShaderResult&) = default;
};

// Evaluates a program that compile() made for this profile. Numbers are 32-bit floats in a fixed order of operations
// (docs/numerics.md, rules 33 to 40). A NaN that would become a byte is 0.
[[nodiscard]] TextureShaderResult evaluate(const TextureShaderProgram& program, const HardwareProfile& profile,
                                           const StageInputs& inputs, const FetchTexel& fetch);

// The code of a replaced depth in a buffer whose largest code is `largest` (rule 39): narrowed as the program says and
// clamped to [0, largest]; NaN gives 0.
[[nodiscard]] std::uint32_t replaced_depth_code(const TextureShaderProgram& program, float depth,
                                                std::uint32_t largest);

}  // namespace ninebit
