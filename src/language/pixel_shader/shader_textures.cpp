// Texture instructions as texture-shader stages: register n is stage n. Rules: microsoft.com, the pages of the
// instructions, ps_1_1 to ps_1_4.
#include <algorithm>
#include <array>
#include <optional>
#include <string>

#include "ninebit/texture_shader/validate_stages.h"
#include "src/language/pixel_shader/shader_parser.h"
#include "src/language/source/beyond_opengl.h"
#include "src/system/find_row.h"

namespace ninebit::detail {
namespace {

using enum TextureOperation;

struct TextureName {
  std::string_view name;
  TextureOperation operation;
};
// Where Direct3D leaves the kind of the texture to the application, and names of ps.1.4.
constexpr std::array kNames{TextureName{"tex", texture_2d},
                            TextureName{"texld", texture_2d},
                            TextureName{"texcrd", pass_through},
                            TextureName{"texbem", offset_2d},
                            TextureName{"texbeml", offset_2d_scale},
                            TextureName{"texm3x2pad", dot_product},
                            TextureName{"texm3x2tex", dot_product_2d},
                            TextureName{"texm3x3tex", dot_product_cube_map}};

// Empty: the stages have no such operation.
std::optional<TextureOperation> operation_named(std::string_view name) {
  if (const TextureName* const found = find_row(kNames, &TextureName::name, name)) return found->operation;
  const auto* const info = find_row(texture_operations(), &TextureOperationInfo::direct3d, name);
  return info == nullptr ? std::nullopt : std::optional(info->operation);
}

// The instruction that Direct3D has for an operation of a 2D texture, or of the only kind that there is.
std::string_view name_of_operation(TextureOperation operation) {
  const TextureName* const found = find_row(kNames, &TextureName::operation, operation);
  const bool is_named = found != nullptr && operation != pass_through && operation != dot_product;
  return is_named ? found->name : info_of(operation).direct3d;
}

class ShaderTextures {
 public:
  ShaderTextures(const ShaderText& text, const HardwareProfile& profile, SourceFaults& faults, SourceFaults& notes)
      : text_(text), profile_(profile), faults_(faults), notes_(notes) {}

  TextureShaderState translate() {
    const std::size_t before = faults_.count();
    is_plain_ = std::all_of(text_.instructions.begin(), text_.instructions.end(), [](const ShaderInstruction& one) {
      return one.op() != ShaderOp::texture || one.row->name == "tex" || one.row->name == "texld";
    });
    for (const ShaderInstruction& one : text_.instructions) {
      if (one.op() == ShaderOp::texture) stage(one);
    }
    // A row of a matrix that was refused says nothing about the others.
    const bool all_taken = faults_.count() == before;
    for (std::size_t place = 0; place < at_.size() && all_taken; ++place) {
      if (at_[place] != nullptr) check_rows(place);
    }
    // A full list drops faults, and its count tells nothing.
    if (faults_.full() || faults_.count() > before || is_plain_) return {};
    state_.enabled = true;
    if (text_.version.is_xbox) {
      state_.rules = StageRules::nv2a;
      state_.depth_unit = DepthUnit::codes;
    }
    for (const TextureShaderDiagnostic& found : validate(state_, profile_)) {
      const auto place = static_cast<std::size_t>(found.stage.value_or(0));
      faults_.add(found.stage && at_[place] != nullptr ? at_[place]->offset : first_, found.message, found.gl_error);
    }
    note();
    return state_;
  }

 private:
  [[nodiscard]] static std::string name_at(const ShaderInstruction* one) {
    return one == nullptr ? "" : std::string(one->row->name);
  }

  void stage(const ShaderInstruction& one) {
    if (first_ == 0) first_ = one.offset;
    const ShaderTarget& to = one.targets[0];
    const bool is_old = text_.version.minor < 4 || text_.version.is_xbox;
    if (to.index >= kTextureStages) {
      return faults_.add(to.offset, quoted(to.text) + " has no texture-shader stage; there are four");
    }
    const auto place = static_cast<std::size_t>(to.index);
    const auto operation = operation_named(one.row->name);
    if (!operation) {
      return faults_.add(
          one.offset,
          quoted(one.row->name) + " is beyond the texture shaders of the GeForce3, which have no such operation");
    }
    if (one.row->name == "texkill" && to.file == ShaderFile::temporary) {
      return faults_.add(to.offset, "'texkill' of " + quoted(to.text) +
                                        " tests a register's value; the texture shaders of "
                                        "the GeForce3 test coordinates alone");
    }
    if (at_[place] != nullptr && state_.stage[place].operation == cull_fragment) {
      return faults_.add(one.offset, quoted(to.text) + " needs texture stage " + std::to_string(place) +
                                         ", which 'texkill' has; a stage has one instruction");
    }
    if (at_[place] != nullptr) {
      return faults_.add(one.offset, quoted(to.text) + " is loaded already, by " + name_at(at_[place]));
    }
    at_[place] = &one;
    TextureStage& stage = state_.stage[place];
    stage.operation = *operation;
    if (!is_old) return coordinates(one, place);
    if (info_of(*operation).input == StageInput::none) return;
    if (one.operands.empty()) {
      return faults_.add(one.offset, quoted(one.row->name) + " needs the register that it reads, such as t0");
    }
    source(one, place);
    if (*operation == dot_product_const_eye_reflect_cube_map) eye(one, stage);
  }

  // ps.1.4's texld r0, t0 and texcrd r0, t0: the coordinates of unit n are those of stage n.
  void coordinates(const ShaderInstruction& one, std::size_t place) {
    if (one.operands.empty()) return;
    const ShaderOperand& from = one.operands[0];
    if (from.file == ShaderFile::temporary) {
      return faults_.add(from.offset, quoted(one.row->name) +
                                          " reads a texture at a register's value; the texture "
                                          "shaders of the GeForce3 have no such operation");
    }
    if (from.modifier != ShaderModifier::none && !is_plain_) {
      return faults_.add(from.offset, quoted(from.text) +
                                          " has a modifier; the texture shaders of the GeForce3 have none for "
                                          "coordinates");
    }
    if (from.index != static_cast<int>(place)) {
      notes_.add(from.offset, "unit " + std::to_string(place) + " gets the coordinates of " + std::string(from.text));
    }
  }

  void source(const ShaderInstruction& one, std::size_t place) {
    const ShaderOperand& from = one.operands[0];
    TextureStage& stage = state_.stage[place];
    const bool is_dot = info_of(stage.operation).input == StageInput::normal;
    const std::string reads = quoted(one.row->name) + " of " + std::string(one.targets[0].text) + " reads ";
    if (from.file != ShaderFile::texture || from.index >= static_cast<int>(place)) {
      return faults_.add(from.offset, reads + quoted(from.text) + "; expected a t register of a lower number",
                         GlError::invalid_operation);
    }
    const ShaderInstruction* const loaded = at_[static_cast<std::size_t>(from.index)];
    const TextureOperation previous = state_.stage[static_cast<std::size_t>(from.index)].operation;
    if (loaded == nullptr) {
      return faults_.add(from.offset, reads + quoted(from.text) + ", which no instruction before loads");
    }
    if (info_of(previous).target == StageTarget::none && previous != pass_through) {
      return faults_.add(from.offset,
                         reads + quoted(from.text) + ", which has no texel: it is loaded by " + name_at(loaded));
    }
    if (from.modifier != ShaderModifier::none && (from.modifier != ShaderModifier::expand || !is_dot)) {
      return faults_.add(from.offset, quoted(from.text) + " has a modifier that " + quoted(one.row->name) +
                                          " does not have" + (is_dot ? "; expected _bx2 or none" : ""));
    }
    stage.previous = from.index;
    if (from.modifier == ShaderModifier::expand) stage.mapping = DotMapping::minus1_to_1_d3d;
  }

  void eye(const ShaderInstruction& one, TextureStage& stage) {
    if (one.operands.size() < 2 || one.operands[1].file != ShaderFile::constant) {
      return faults_.add(one.offset, quoted(one.row->name) + " needs a constant with the eye vector, such as c0");
    }
    if (one.operands[1].modifier != ShaderModifier::none) {
      return faults_.add(one.operands[1].offset,
                         quoted(one.operands[1].text) + " has a modifier; expected a constant without one");
    }
    const ShaderConstant& constant = text_.constants.at(static_cast<std::size_t>(one.operands[1].index));
    if (constant.defined) std::copy_n(constant.color.begin(), 3, stage.eye.begin());
  }

  // Whether the rows of a matrix stand in consecutive registers.
  void check_rows(std::size_t place) {
    const std::string name = name_at(at_[place]);
    const std::string before = place > 0 ? name_at(at_[place - 1]) : "",
                      first = place > 1 ? name_at(at_[place - 2]) : "";
    const std::string after = place + 1 < at_.size() ? name_at(at_[place + 1]) : "";
    const auto complain = [&](const std::string& what) {
      faults_.add(at_[place]->offset, quoted(name) + " of t" + std::to_string(place) + " needs " + what);
    };
    const bool is_last3 = name == "texm3x3tex" || name == "texm3x3spec" || name == "texm3x3vspec";
    if (name == "texm3x2pad") {
      if (after != "texm3x2tex" && after != "texm3x2depth") complain("texm3x2tex or texm3x2depth in the next register");
    } else if (name == "texm3x2tex" || name == "texm3x2depth") {
      if (before != "texm3x2pad") complain("texm3x2pad in the register before");
    } else if (name == "texm3x3pad") {
      if (!after.starts_with("texm3x3")) complain("texm3x3pad or the matrix's last row in the next register");
    } else if (name == "texm3x3diff") {
      if (before != "texm3x3pad") complain("texm3x3pad in the register before");
      if (after != "texm3x3spec" && after != "texm3x3vspec") complain("texm3x3vspec in the next register");
    } else if (is_last3 && ((before != "texm3x3pad" && before != "texm3x3diff") || first != "texm3x3pad")) {
      complain("texm3x3pad in the two registers before");
    }
  }

  // Notes the settings that the text leaves to the application.
  void note() {
    for (std::size_t i = 0; i < at_.size(); ++i) {
      const ShaderInstruction* const one = at_[i];
      const std::string name = name_at(one), stage = "texture stage " + std::to_string(i);
      if (name == "texcrd") {
        notes_.add(one->offset, "the coordinates of " + stage + " are clamped to 0 to 1, which ps.1.4 does not do");
      } else if (name == "tex" || name == "texld") {
        notes_.add(one->offset, stage + " reads a texture of the kind that the application sets; a 2D one is assumed");
        if (text_.version.minor == 4) {
          notes_.add(one->offset, "the coordinates of " + stage + " are divided by q, which ps.1.4 does not do");
        }
      } else if (name.starts_with("texbem")) {
        notes_.add(one->offset, "the application sets the bump matrix of " + stage +
                                    (name == "texbeml" ? ", its luminance scale and its offset" : "") +
                                    "; the identity" + (name == "texbeml" ? ", 1 and 0 are" : " is") + " assumed");
      } else if (name == "texm3x3tex") {
        notes_.add(one->offset,
                   stage + " reads a texture of the kind that the application sets; a cube map is assumed");
      } else if (name == "texm3x3spec" && one->operands.size() > 1 &&
                 !text_.constants.at(static_cast<std::size_t>(one->operands[1].index)).defined) {
        notes_.add(one->operands[1].offset, "the application sets " + std::string(one->operands[1].text) +
                                                ", the eye vector of " + stage + "; (0, 0, -1) is assumed");
      }
    }
  }

  const ShaderText& text_;
  const HardwareProfile& profile_;
  SourceFaults &faults_, &notes_;
  TextureShaderState state_;
  bool is_plain_ = false;  // the stages only read textures, as without texture shaders
  std::array<const ShaderInstruction*, kTextureStages> at_{};  // by stage
  std::size_t first_ = 0;                                      // the offset of the first of them
};

}  // namespace

TextureShaderState translate_textures(const ShaderText& text, const HardwareProfile& profile, SourceFaults& faults,
                                      SourceFaults& notes) {
  return ShaderTextures(text, profile, faults, notes).translate();
}

Result<std::string> print_textures(const TextureShaderState& state, const std::string& eye) {
  const TextureShaderState used = only_used(state);
  const auto why = [](std::size_t place, const std::string& what) {
    return Diagnostic{.message = "ps.1.1 cannot express this: texture stage " + std::to_string(place) + ": " + what};
  };
  if (const std::string beyond = beyond_opengl(used); !beyond.empty()) {
    return Diagnostic{.message = "ps.1.1 cannot express this: " + beyond};
  }
  std::string text;
  for (std::size_t i = 0; i < used.stage.size(); ++i) {
    const TextureStage& stage = used.stage[i];
    if (stage.operation == none) continue;
    std::string name(name_of_operation(stage.operation));
    if (operation_named(name) != stage.operation) {
      return why(i, std::string(info_of(stage.operation).name) + "; " + name + " reads a texture of another kind");
    }
    if (stage.operation == dot_product_diffuse_cube_map || stage.operation == brdf) {
      return why(i, name + "; only xps.1.1 has it");
    }
    if (stage.operation == dot_product_depth_replace) return why(i, "texm3x2depth; it begins with ps.1.3");
    const TextureStage fresh;
    if (stage.matrix != fresh.matrix || stage.scale != fresh.scale || stage.bias != fresh.bias) {
      return why(i, "a bump matrix, scale or bias, which the application sets");
    }
    if (stage.cull != fresh.cull) return why(i, "a cull mode but that of negative coordinates");
    if (stage.operation == dot_product) {
      const bool is_two = i + 1 < used.stage.size() && (used.stage[i + 1].operation == dot_product_2d ||
                                                        used.stage[i + 1].operation == dot_product_depth_replace);
      name = is_two ? "texm3x2pad" : "texm3x3pad";
    }
    text += name + " t" + std::to_string(i);
    if (info_of(stage.operation).input != StageInput::none) text += ", t" + std::to_string(stage.previous);
    if (stage.mapping == DotMapping::minus1_to_1_d3d) text += "_bx2";
    if (stage.operation == dot_product_const_eye_reflect_cube_map) text += ", " + eye;
    text += '\n';
  }
  return text;
}

}  // namespace ninebit::detail
