#include "ninebit/texture_shader/stage_program.h"

#include <algorithm>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/texture_shader/validate_stages.h"

namespace ninebit {
namespace {

std::string stage_name(int place) {
  return "texture stage " + std::to_string(place);
}

std::string_view name_of(StageTarget target) {
  constexpr std::array<std::string_view, 6> names{"",          "1D texture", "2D texture",
                                                  "rectangle", "3D texture", "cube map"};
  return names[static_cast<std::size_t>(target)];
}

// The kinds of texels of an earlier stage that OpenGL distinguishes.
enum class TexelKind : std::uint8_t { unsigned_rgba, signed_rgba, hilo, signed_hilo, dsdt, dsdt_mag, depth };

TexelKind kind_of(const StageTexture& texture) {
  const bool is_signed = std::find(texture.is_signed.begin(), texture.is_signed.end(), true) != texture.is_signed.end();
  switch (texture.format) {
    case TextureFormat::hilo:
      return is_signed ? TexelKind::signed_hilo : TexelKind::hilo;
    case TextureFormat::dsdt:
      return TexelKind::dsdt;
    case TextureFormat::dsdt_mag:
    case TextureFormat::dsdt_mag_intensity:
      return TexelKind::dsdt_mag;
    case TextureFormat::depth:
    case TextureFormat::depth_comparison:
      return TexelKind::depth;
    default:
      return is_signed ? TexelKind::signed_rgba : TexelKind::unsigned_rgba;
  }
}

// Decides which stages are consistent, from the first on.
class Consistency {
 public:
  Consistency(const TextureShaderState& state, const StageTextures& textures) : state_(state), textures_(textures) {}

  std::array<std::string, kTextureStages> reasons() {
    for (int i = 0; i < kTextureStages; ++i) why_[at(i)] = reason(i);
    // A diffuse cube map reads the stage after it.
    if (operation(2) == TextureOperation::dot_product_diffuse_cube_map && why_[2].empty()) {
      why_[2] = ahead_reason();
      if (!why_[2].empty()) why_[3] = reason(3);
    }
    return why_;
  }

 private:
  static std::size_t at(int i) { return static_cast<std::size_t>(i); }
  [[nodiscard]] const TextureStage& stage(int i) const { return state_.stage[at(i)]; }
  [[nodiscard]] TextureOperation operation(int i) const { return stage(i).operation; }

  [[nodiscard]] bool gives_texel(int i) const {
    return info_of(operation(i)).target != StageTarget::none || operation(i) == TextureOperation::pass_through;
  }

  [[nodiscard]] std::string texture_reason(int i, const TextureOperationInfo& info) const {
    if (info.target == StageTarget::none) return "";
    const auto& texture = textures_[at(i)];
    const std::string wanted = std::string(info.name) + " reads a " + std::string(name_of(info.target));
    if (!texture) return wanted + ", and the unit has no complete texture";
    if (texture->target != info.target) return wanted + ", and the unit has a " + std::string(name_of(texture->target));
    const bool scales = info.input == StageInput::luminance;
    if (state_.rules == StageRules::open_gl && scales && kind_of(*texture) != TexelKind::unsigned_rgba) {
      return std::string(info.name) + " scales unsigned colours, and the unit's texture has another format";
    }
    return "";
  }

  [[nodiscard]] std::string input_reason(int i, const TextureOperationInfo& info) const {
    if (info.input == StageInput::none) return "";
    const int from = stage(i).previous;
    if (!why_[at(from)].empty()) return "it reads " + stage_name(from) + ", which is inconsistent";
    if (!gives_texel(from)) {
      return "it reads " + stage_name(from) + ", whose operation " + std::string(info_of(operation(from)).name) +
             " gives no texel";
    }
    return state_.rules == StageRules::open_gl ? format_reason(from, info) : "";
  }

  // OpenGL: whether the texel of a stage suits an input.
  [[nodiscard]] std::string format_reason(int from, const TextureOperationInfo& info) const {
    const bool passes = operation(from) == TextureOperation::pass_through;
    const TexelKind kind = passes ? TexelKind::unsigned_rgba : kind_of(*textures_[at(from)]);
    const auto refused = [&](const char* wanted) {
      return std::string(info.name) + " reads " + wanted + ", and " + stage_name(from) +
             " has a texture of another format";
    };
    switch (info.input) {
      case StageInput::offset:
        if (kind != TexelKind::dsdt && kind != TexelKind::dsdt_mag) return refused("DSDT or DSDT_MAG texels");
        break;
      case StageInput::luminance:
        if (kind != TexelKind::dsdt_mag) return refused("DSDT_MAG texels");
        break;
      case StageInput::alpha_red:
      case StageInput::green_blue:
        if (kind != TexelKind::unsigned_rgba) return refused("unsigned colours");
        break;
      case StageInput::normal:
        if (kind > TexelKind::signed_hilo) return refused("colours or HILO texels");
        break;
      case StageInput::none:
        break;
    }
    return "";
  }

  // The stages right before, which must be dot products.
  [[nodiscard]] std::string chain_reason(int i, const TextureOperationInfo& info) const {
    const bool reflects = operation(i) == TextureOperation::dot_product_reflect_cube_map ||
                          operation(i) == TextureOperation::dot_product_const_eye_reflect_cube_map;
    for (int before = 1; before <= info.dots_before; ++before) {
      const int place = i - before;
      const bool is_diffuse = operation(place) == TextureOperation::dot_product_diffuse_cube_map;
      if (operation(place) != TextureOperation::dot_product && !(reflects && before == 1 && is_diffuse)) {
        return std::string(info.name) + " continues " + std::to_string(info.dots_before) + " dot product" +
               (info.dots_before > 1 ? "s" : "") + ", and " + stage_name(place) + " has the operation " +
               std::string(info_of(operation(place)).name);
      }
      if (!why_[at(place)].empty()) return "it continues " + stage_name(place) + ", which is inconsistent";
    }
    return "";
  }

  [[nodiscard]] std::string reason(int i) const {
    const TextureOperationInfo& info = info_of(operation(i));
    for (const auto& why : {texture_reason(i, info), input_reason(i, info), chain_reason(i, info)}) {
      if (!why.empty()) return why;
    }
    return "";
  }

  [[nodiscard]] std::string ahead_reason() const {
    const TextureOperationInfo& next = info_of(operation(3));
    const std::string name(info_of(operation(2)).name);
    const bool reflects = operation(3) == TextureOperation::dot_product_reflect_cube_map ||
                          operation(3) == TextureOperation::dot_product_const_eye_reflect_cube_map;
    if (!reflects) {
      return name + " needs a reflect cube map after it, and texture stage 3 has the operation " +
             std::string(next.name);
    }
    if (stage(3).previous == 2) return name + " needs texture stage 3's dot product ahead, which reads this stage";
    const std::string why = input_reason(3, next);
    return why.empty() ? "" : "it needs texture stage 3's dot product ahead: " + why;
  }

  const TextureShaderState& state_;
  const StageTextures& textures_;
  std::array<std::string, kTextureStages> why_;
};

// OpenGL's formats decide how a dot product reads a texel; the setting is for unsigned colours alone.
DotMapping mapping_of(const TextureStage& stage, const std::optional<StageTexture>& previous) {
  if (!previous) return stage.mapping;
  switch (kind_of(*previous)) {
    case TexelKind::hilo:
      return DotMapping::hilo_1;
    case TexelKind::signed_hilo:
      return DotMapping::hilo_hemisphere;
    case TexelKind::signed_rgba:
      return DotMapping::minus1_to_1;
    default:
      return stage.mapping;
  }
}

// OpenGL: the components of a texture that the combiners see.
std::array<bool, 4> visible_components(TextureFormat format) {
  switch (format) {
    case TextureFormat::hilo:
    case TextureFormat::dsdt:
    case TextureFormat::dsdt_mag:
      return {};
    case TextureFormat::dsdt_mag_intensity:
      return {false, false, false, true};
    default:
      return {true, true, true, true};
  }
}

}  // namespace

bool has_dot_product(TextureOperation operation) {
  return info_of(operation).input == StageInput::normal;
}

std::vector<std::string> TextureShaderProgram::warnings() const {
  std::vector<std::string> all;
  for (int i = 0; i < kTextureStages; ++i) {
    const std::string& why = stage[static_cast<std::size_t>(i)].inconsistent;
    if (!why.empty()) all.push_back(stage_name(i) + ": " + why + "; it gives (0, 0, 0, 0)");
  }
  return all;
}

Result<TextureShaderProgram> compile(const TextureShaderState& state, const StageTextures& textures,
                                     const HardwareProfile& profile) {
  std::string message;
  for (const TextureShaderDiagnostic& fault : validate(state, profile)) {
    if (!message.empty()) message += '\n';
    message += fault.message;
  }
  if (!message.empty()) return Diagnostic{.message = message};
  TextureShaderProgram program;
  program.choices = stage_choices_of(profile);
  if (state.rules == StageRules::open_gl) program.choices.off_alpha = 0;  // GL_NONE gives (0, 0, 0, 0)
  program.depth_unit = state.depth_unit;
  program.converts_yuv = state.converts_yuv;
  const auto reasons = Consistency(state, textures).reasons();
  for (std::size_t i = 0; i < program.stage.size(); ++i) {
    ProgramTextureStage& made = program.stage[i];
    made.state = state.stage[i];
    made.inconsistent = reasons[i];
    const bool fetches = info_of(made.state.operation).target != StageTarget::none && reasons[i].empty();
    if (fetches) made.is_signed = textures[i]->is_signed;
    if (state.rules == StageRules::nv2a) continue;
    if (fetches) made.is_visible = visible_components(textures[i]->format);
    const auto from = static_cast<std::size_t>(made.state.previous);
    const bool reads_texture = info_of(state.stage[from].operation).target != StageTarget::none;
    if (has_dot_product(made.state.operation) && reads_texture) {
      made.state.mapping = mapping_of(made.state, textures[from]);
    }
  }
  return program;
}

}  // namespace ninebit
