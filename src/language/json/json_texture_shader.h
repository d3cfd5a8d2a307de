// Texture-shader stages as a JSON object, the value of the key "texture_shader" of programs and of effects' passes.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/stage_state.h"
#include "src/language/json/json_reader.h"

// Exported because effects, in a shared library of their own, are read with it.
namespace ninebit {
namespace NINEBIT_PUBLIC json {

// Stages, and where the text has them.
struct PlacedTextureShader {
  TextureShaderState state{};
  std::size_t offset = 0;                              // of the object
  std::array<std::size_t, kTextureStages> stage_at{};  // of each stage
};

// Reads {"stages": [{"operation": "offset_2d", "previous": 0, …}], "rules": …}, which enables the stages. Unknown keys
// and names, wrong types and numbers that a float cannot hold are faults.
[[nodiscard]] PlacedTextureShader read_texture_shader(const Value& value, Reader& read);

// Reports what validate() finds in stages that were read.
void check_texture_shader(const PlacedTextureShader& stages, const HardwareProfile& profile, Reader& read);

// The object, without keys that have their defaults; each line but the first begins with `indent`. Equal states give
// equal texts, and reading returns the same state, enabled. Numbers must be finite.
[[nodiscard]] std::string texture_shader_text(const TextureShaderState& state, std::string_view indent);

}  // namespace json
}  // namespace ninebit
