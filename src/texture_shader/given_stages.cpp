#include "src/texture_shader/given_stages.h"

#include "ninebit/texture_shader/stage_state.h"

namespace ninebit {
namespace {

constexpr std::string_view kCoordinates = "strq", kBytes = "rgba", kAt = "at", kTexel = "texel";

}  // namespace

std::vector<GivenComponent> given_components(std::string_view name) {
  const bool is_texel = name.starts_with(kTexel);
  const std::string_view word = is_texel ? kTexel : kAt;
  if (!name.starts_with(word) || name.size() <= word.size()) return {};
  const int unit = name[word.size()] - '0';
  const std::string_view rest = name.substr(word.size() + 1);
  if (unit < 0 || unit >= kTextureStages) return {};
  std::vector<GivenComponent> all;
  for (int component = 0; component < 4; ++component) {
    const char letter = (is_texel ? kBytes : kCoordinates)[static_cast<std::size_t>(component)];
    const bool is_it = rest.size() == 2 && rest[0] == '.' && rest[1] == letter;
    if (rest.empty() || is_it) all.push_back({is_texel, unit, component});
  }
  return all;
}

void give(GivenFragment& fragment, const GivenComponent& component, float value) {
  const auto unit = static_cast<std::size_t>(component.unit), place = static_cast<std::size_t>(component.component);
  if (component.is_texel) {
    fragment.texel[unit][place] = static_cast<std::uint8_t>(value);
  } else {
    fragment.at[unit][place] = value;
  }
}

std::string name_of(const GivenComponent& component) {
  const char letter = (component.is_texel ? kBytes : kCoordinates)[static_cast<std::size_t>(component.component)];
  return std::string(component.is_texel ? kTexel : kAt) + std::to_string(component.unit) + '.' + letter;
}

bool runs_stages(const TextureShaderState& state, bool gives_components, bool gives_textures) {
  return state.enabled && (gives_components || (!gives_textures && !only_reads_textures(state)));
}

Result<TextureShaderProgram> compile_for_given(const TextureShaderState& state, const HardwareProfile& profile) {
  StageTextures textures;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const StageTarget target = info_of(state.stage[i].operation).target;
    if (target != StageTarget::none) textures[i] = StageTexture{.target = target};
  }
  for (const TextureStage& stage : state.stage) {
    const StageInput input = info_of(stage.operation).input;
    auto& read = textures[static_cast<std::size_t>(stage.previous)];
    if ((input == StageInput::offset || input == StageInput::luminance) && read) read->format = TextureFormat::dsdt_mag;
  }
  return compile(state, textures, profile);
}

TextureShaderResult evaluate_given(const TextureShaderProgram& program, const HardwareProfile& profile,
                                   const GivenFragment& fragment, bool gives_spare0_alpha, RegisterFile& registers) {
  const TextureShaderResult result =
      evaluate(program, profile, {fragment.at, fragment.at, fragment.at},
               [&](int unit, const TexturePlace&) { return fragment.texel[static_cast<std::size_t>(unit)]; });
  for (std::size_t unit = 0; unit < result.stage.size(); ++unit) {
    registers[static_cast<Register>(static_cast<std::size_t>(Register::texture0) + unit)] = result.stage[unit].codes;
  }
  if (!gives_spare0_alpha) registers[Register::spare0][kAlpha] = registers[Register::texture0][kAlpha];
  return result;
}

}  // namespace ninebit
