// Valid texture-shader stages with the textures that they read, made ready to run: immutable, with consistency decided.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/initial_registers.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// The texture of a unit, as far as stages depend on it.
struct StageTexture {
  StageTarget target = StageTarget::two_dimensional;  // its kind
  TextureFormat format = TextureFormat::rgba;         // its base internal format
  std::array<bool, 4> is_signed{};                    // which of red, green, blue and alpha are two's complement
  friend constexpr bool operator==(const StageTexture&, const StageTexture&) = default;
};
// By unit; empty: no texture, or one that is incomplete for its filter.
using StageTextures = std::array<std::optional<StageTexture>, kTextureStages>;

// A stage of a program.
struct ProgramTextureStage {
  TextureStage state;                                      // as it was set; mappings of OpenGL's formats are resolved
  std::string inconsistent;                                // why the stage gives (0, 0, 0, 0); empty: it is consistent
  std::array<bool, 4> is_signed{};                         // components of its texel that are two's complement
  std::array<bool, 4> is_visible{true, true, true, true};  // components that combiners see; the others read 0
  friend bool operator==(const ProgramTextureStage&, const ProgramTextureStage&) = default;
};

// Stages ready to be evaluated; compile() makes them.
struct TextureShaderProgram {
  StageChoices choices;                                   // of the profile
  DepthUnit depth_unit = DepthUnit::window;               // of replaced depths
  bool converts_yuv = false;                              // of every stage that reads a texture; of others assumed
  std::array<ProgramTextureStage, kTextureStages> stage;  // in the order of the units
  friend bool operator==(const TextureShaderProgram&, const TextureShaderProgram&) = default;

  // One sentence for each inconsistent stage, in their order: "texture stage 2: …; it gives (0, 0, 0, 0)".
  [[nodiscard]] std::vector<std::string> warnings() const;
};

// Whether an operation's stage computes a dot product.
[[nodiscard]] bool has_dot_product(TextureOperation operation);

// Compiles stages. Reports what validate() reports; the message has one line for each fault. Inconsistent stages are
// not faults: they give (0, 0, 0, 0), and so does what reads them. A stage is inconsistent if its texture is missing,
// incomplete or of another target, if the stage that it reads gives no texel or is inconsistent itself, if dot products
// before it are missing, and, by OpenGL's rules, if the formats do not suit (NV_texture_shader, 3.8.13.1).
[[nodiscard]] Result<TextureShaderProgram> compile(const TextureShaderState& state, const StageTextures& textures,
                                                   const HardwareProfile& profile);

}  // namespace ninebit
