#include "src/study/vectors/stage_mistakes.h"

#include <algorithm>
#include <cmath>

#include "ninebit/numerics/profile_fields.h"
#include "src/texture_shader/stage_fragment.h"

namespace ninebit::vectors {
namespace {

using Broken = BrokenStageRule;
using one_fragment::StageFactor;
using one_fragment::StageVector;

// The domain of a mistake: members that are not hidden keep the rules.
class MistakenFragment : public one_fragment::Fragment {
 public:
  MistakenFragment(Broken broken, const TextureShaderProgram& program, const StageInputs& inputs,
                   const FetchTexel& fetch, TextureShaderResult& result)
      : Fragment(program, inputs, fetch, result), broken_(broken) {}

  [[nodiscard]] At projected(int i) const {
    const TextureOperation operation = program_.stage[static_cast<std::size_t>(i)].state.operation;
    const bool keeps_q =
        broken_ == Broken::not_projected ||
        (broken_ == Broken::line_not_projected && operation == TextureOperation::texture_1d) ||
        (broken_ == Broken::rectangle_not_projected && operation == TextureOperation::texture_rectangle);
    At place = keeps_q ? Fragment::coordinates(i) : Fragment::projected(i);
    if (broken_ == Broken::third_is_zero) place.at[2] = 0.0F;
    return place;
  }
  [[nodiscard]] At coordinates(int i) const {
    return broken_ == Broken::cube_projected ? Fragment::projected(i) : Fragment::coordinates(i);
  }

  At offset(int i, const TextureStage& stage) {
    At place = Fragment::offset(i, stage);
    const auto number = [&](std::uint8_t byte) {
      const auto s = static_cast<float>(one_fragment::s8(byte));
      if (broken_ == Broken::offsets_unsigned) return static_cast<float>(byte) / 255.0F;
      return broken_ == Broken::offsets_by_127 ? s / 127.0F : (2.0F * s + 1.0F) / 255.0F;
    };
    const bool breaks =
        broken_ == Broken::offsets_unsigned || broken_ == Broken::offsets_by_127 || broken_ == Broken::offsets_odd;
    if (!breaks) return place;
    const float ds = number(values(i).input[kBlue]), dt = number(values(i).input[kGreen]);
    for (std::size_t k = 0; k < 2; ++k) {
      place.at[k] = given(0, i)[k] + stage.matrix[k] * ds + stage.matrix[k + 2] * dt;
    }
    return place;
  }

  At dependent(int i, const TextureStage& stage, int first, int second) {
    const bool exchanges = broken_ == Broken::dependent_exchanged;
    return Fragment::dependent(i, stage, exchanges ? second : first, exchanges ? first : second);
  }

  void dot(int i, const TextureStage& stage) {
    Fragment::dot(i, stage);
    float& dot = dots_[0][static_cast<std::size_t>(i)];
    const StageFactor n = factor(stage.mapping, values(i).input);
    const Four& c = given(0, i);
    dot = one_fragment::stage_dot({c[0], c[1], c[2]}, n.number) / n.over;
    if (broken_ == Broken::dots_with_q) dot += c[3];
    const bool is_ahead =
        i == 3 && program_.stage[2].state.operation == TextureOperation::dot_product_diffuse_cube_map && !values(2).at;
    if (broken_ == Broken::ahead_is_zero && is_ahead) dot = 0.0F;
    values(i).dot = dot;
  }

  [[nodiscard]] At dots(int first, int count) const {
    At place = Fragment::dots(first, count);
    if (broken_ == Broken::dots_exchanged && count == 2) std::swap(place.at[0], place.at[1]);
    return place;
  }

  [[nodiscard]] At reflected(int i, const TextureStage& stage, bool is_constant) const {
    if (broken_ == Broken::eye_ignored) return Fragment::dots(i - 2, 3);
    At place = Fragment::reflected(i, stage, is_constant);
    if (broken_ == Broken::eye_negated) {
      for (float& component : place.at) component = -component;
    }
    if (broken_ == Broken::unit_normals) {
      const Three d = Fragment::dots(i - 2, 3).at;
      const Three e = is_constant ? stage.eye : Three{given(0, i - 2)[3], given(0, i - 1)[3], given(0, i)[3]};
      const float along = 2.0F * (d[0] * e[0] + d[1] * e[1] + d[2] * e[2]);
      for (std::size_t k = 0; k < 3; ++k) place.at[k] = along * d[k] - e[k];
    }
    return place;
  }

  void scale(int i, const TextureStage& stage) {
    const Bytes4 before = values(i).texel;
    TextureStage broken = stage;
    const float factor = stage.scale * (static_cast<float>(values(i).input[kRed]) / 255.0F) + stage.bias;
    if (broken_ == Broken::luminance_clamped && factor > 1.0F) {
      broken.scale = 0.0F;
      broken.bias = 1.0F;
    }
    Fragment::scale(i, broken);
    if (broken_ == Broken::alpha_scaled) {
      values(i).texel[kAlpha] = static_cast<std::uint8_t>(
          one_fragment::stage_byte<StageByte::twelve_bits>(static_cast<float>(before[kAlpha]) / 255.0F * factor));
    }
  }

  void pass(int i) {
    Fragment::pass(i);
    if (broken_ != Broken::bytes_rounded_down) return;
    for (std::size_t k = 0; k < 4; ++k) {
      values(i).texel[k] = static_cast<std::uint8_t>(255.0F * std::clamp(given(0, i)[k], 0.0F, 1.0F));
    }
  }

  void cull(int i, const TextureStage& stage) {
    if (broken_ != Broken::three_culled && broken_ != Broken::all_culled) return Fragment::cull(i, stage);
    int killing = 0;
    const int compared = broken_ == Broken::three_culled ? 3 : 4;
    for (std::size_t k = 0; k < static_cast<std::size_t>(compared); ++k) {
      const float c = given(0, i)[k];
      if (stage.cull[k] == CullMode::kills_negative ? c < 0.0F : c >= 0.0F) ++killing;
    }
    const bool is_killed = broken_ == Broken::all_culled ? killing == 4 : killing > 0;
    result_.is_culled = result_.is_culled || is_killed;
  }

  void replace_depth(int i) {
    if (broken_ == Broken::depth_kept) return;
    Fragment::replace_depth(i);
    if (broken_ == Broken::depth_inverted) result_.depth = *values(i).dot / *values(i - 1).dot;
  }

  void off(int i) {
    Fragment::off(i);
    if (broken_ == Broken::off_is_clear) values(i).texel[kAlpha] = 0;
  }

  void finish(int i, const HardwareProfile& profile) {
    Fragment::finish(i, profile);
    StageValues& at = values(i);
    const auto& is_signed = program_.stage[static_cast<std::size_t>(i)].is_signed;
    if (broken_ == Broken::yuv_rounded && program_.converts_yuv && at.at) {
      const int c = 298 * (at.texel[0] - 16), d = at.texel[1] - 128, e = at.texel[2] - 128;
      const std::array rgb{c + 409 * e + 128, c - 100 * d - 208 * e + 128, c + 516 * d + 128};
      for (std::size_t k = 0; k < 3; ++k) {
        const auto byte = static_cast<std::uint8_t>(std::clamp(rgb[k] >> 8, 0, 255));
        at.codes[k] = texel_byte_code(profile, byte, is_signed[k]);
      }
    }
    for (std::size_t k = 0; k < 4; ++k) {
      if (!is_signed[k]) continue;
      if (broken_ == Broken::signs_ignored) at.codes[k] = texel_byte_code(profile, at.texel[k], false);
      if (broken_ == Broken::signs_not_doubled) at.codes[k] = static_cast<s9>(at.codes[k] / 2);
    }
  }

 private:
  // Rule 36, broken in one mapping.
  [[nodiscard]] StageFactor factor(DotMapping mapping, const Bytes4& texel) const {
    StageFactor right = one_fragment::factor_of(mapping, program_.choices.divisors, texel);
    const auto each = [&](auto number) { return StageVector{number(texel[0]), number(texel[1]), number(texel[2])}; };
    const auto odd = [](std::uint8_t v) { return 2.0F * static_cast<float>(one_fragment::s8(v)) + 1.0F; };
    const auto s = [](std::uint8_t v) { return static_cast<float>(one_fragment::s8(v)); };
    if (broken_ == Broken::words_of_8_bits) {
      const Bytes4 high{texel[kAlpha], texel[1], texel[1], texel[kAlpha]};
      if (mapping == DotMapping::hilo_1) return one_fragment::factor_of(mapping, program_.choices.divisors, high);
    }
    switch (mapping) {
      case DotMapping::minus1_to_1_d3d:
        if (broken_ == Broken::mapping_d3d_255) {
          return {each([](std::uint8_t v) { return 2.0F * static_cast<float>(v) - 255.0F; }), 255.0F};
        }
        [[fallthrough]];
      case DotMapping::minus1_to_1: {
        if (broken_ == Broken::mapping_odd && mapping == DotMapping::minus1_to_1) return {each(odd), 255.0F};
        StageVector& n = right.number;
        if (broken_ == Broken::mapping_clamped) {
          n = {std::max(n.x, -right.over), std::max(n.y, -right.over), std::max(n.z, -right.over)};
        }
        return right;
      }
      case DotMapping::minus1_to_1_gl:
        if (broken_ == Broken::mapping_gl_127) return {each(s), 127.0F};
        return right;
      case DotMapping::hilo_1:
        if (broken_ == Broken::hilo_third_zero) right.number.z = 0.0F;
        return right;
      case DotMapping::hilo_hemisphere:
        if (broken_ == Broken::hemisphere_third_one) right.number.z = 1.0F;
        if (broken_ == Broken::hemisphere_unsigned) {
          right.number.x = static_cast<float>(256 * texel[3] + texel[0]) / 65535.0F;
          right.number.y = static_cast<float>(256 * texel[1] + texel[2]) / 65535.0F;
        }
        return right;
      default:
        return right;
    }
  }

  Broken broken_;
};

void change_stage_operation(TextureShaderState& state, TextureOperation from, TextureOperation to) {
  for (TextureStage& stage : state.stage) {
    if (stage.operation == from) stage.operation = to;
  }
}

struct StageEdit {
  const char *name, *rules, *group;
  void (*edit)(TextureShaderState&);
};

using Op = TextureOperation;

const StageEdit kStageEdits[] = {
    {"the modes of CULL_FRAGMENT are exchanged", "42", "cull-fragment",
     [](TextureShaderState& s) {
       for (TextureStage& stage : s.stage) {
         for (CullMode& mode : stage.cull) {
           mode = mode == CullMode::kills_negative ? CullMode::kills_not_negative : CullMode::kills_negative;
         }
       }
     }},
    {"DEPENDENT_AR reads green and blue", "37", "dependent-ar",
     [](TextureShaderState& s) { change_stage_operation(s, Op::dependent_ar, Op::dependent_gb); }},
    {"DEPENDENT_GB reads alpha and red", "37", "dependent-gb",
     [](TextureShaderState& s) { change_stage_operation(s, Op::dependent_gb, Op::dependent_ar); }},
    {"every stage reads stage 0", "37", "other-stage-input",
     [](TextureShaderState& s) {
       for (TextureStage& stage : s.stage) stage.previous = 0;
     }},
    {"the offset matrix is transposed", "34", "offset-2d",
     [](TextureShaderState& s) {
       for (TextureStage& stage : s.stage) std::swap(stage.matrix[1], stage.matrix[2]);
     }},
    {"ds and dt are exchanged", "34", "offset-2d",
     [](TextureShaderState& s) {
       for (TextureStage& stage : s.stage) {
         std::swap(stage.matrix[0], stage.matrix[2]);
         std::swap(stage.matrix[1], stage.matrix[3]);
       }
     }},
    {"the texture is not moved", "34", "offset-2d",
     [](TextureShaderState& s) {
       for (TextureStage& stage : s.stage) stage.matrix = {};
     }},
    {"the luminance is ignored", "35", "offset-2d-scale",
     [](TextureShaderState& s) { change_stage_operation(s, Op::offset_2d_scale, Op::offset_2d); }},
    {"the luminance's scale is ignored", "35", "offset-2d-scale",
     [](TextureShaderState& s) {
       for (TextureStage& stage : s.stage) stage.scale = 1.0F;
     }},
    {"the luminance's offset is ignored", "35", "offset-2d-scale",
     [](TextureShaderState& s) {
       for (TextureStage& stage : s.stage) stage.bias = 0.0F;
     }},
    {"every dot mapping is from 0 to 1", "36", "dot-mapping-hilo-1",
     [](TextureShaderState& s) {
       for (TextureStage& stage : s.stage) stage.mapping = DotMapping::zero_to_one;
     }},
    {"every dot mapping of bytes is MINUS1_TO_1_D3D", "36", "dot-product-2d",
     [](TextureShaderState& s) {
       for (TextureStage& stage : s.stage) {
         if (stage.mapping < DotMapping::hilo_1) stage.mapping = DotMapping::minus1_to_1_d3d;
       }
     }},
    {"the constant eye instead of that of q", "38", "dot-product-reflect-cube-map",
     [](TextureShaderState& s) {
       change_stage_operation(s, Op::dot_product_reflect_cube_map, Op::dot_product_const_eye_reflect_cube_map);
     }},
    {"the eye of q instead of the constant one", "38", "dot-product-const-eye-reflect-cube-map",
     [](TextureShaderState& s) {
       change_stage_operation(s, Op::dot_product_const_eye_reflect_cube_map, Op::dot_product_reflect_cube_map);
     }},
    {"no conversion from YUV", "40", "yuv", [](TextureShaderState& s) { s.converts_yuv = false; }},
    {"rectangles are not moved", "34", "offset-rectangle",
     [](TextureShaderState& s) { change_stage_operation(s, Op::offset_rectangle, Op::texture_rectangle); }},
    {"the luminance is ignored on rectangles", "35", "offset-rectangle-scale",
     [](TextureShaderState& s) { change_stage_operation(s, Op::offset_rectangle_scale, Op::offset_rectangle); }},
};

struct NamedStageRule {
  const char *name, *rules, *group;
  Broken broken;
};

const NamedStageRule kBrokenStageRules[] = {
    {"a stage that is off gives alpha 0", "16", "texture-2d", Broken::off_is_clear},
    {"s, t and r are not divided by q", "", "texture-2d", Broken::not_projected},
    {"3D textures are read in their first layer", "", "texture-3d", Broken::third_is_zero},
    {"directions in a cube map are divided by q", "41", "texture-cube-map", Broken::cube_projected},
    {"signed texels are read as unsigned ones", "15", "signed-texels", Broken::signs_ignored},
    {"signed texels are not doubled", "15", "signed-texels", Broken::signs_not_doubled},
    {"PASS_THROUGH rounds 255 times the number down", "33", "pass-through", Broken::bytes_rounded_down},
    {"CULL_FRAGMENT does not compare q", "42", "cull-fragment", Broken::three_culled},
    {"CULL_FRAGMENT kills if all four components do", "42", "cull-fragment", Broken::all_culled},
    {"a dependent texture's coordinates are exchanged", "37", "dependent-ar", Broken::dependent_exchanged},
    {"ds and dt are not signed", "34", "offset-2d", Broken::offsets_unsigned},
    {"ds and dt are divided by 127", "34", "offset-2d", Broken::offsets_by_127},
    {"ds and dt are (2 s + 1) / 255", "34", "offset-2d", Broken::offsets_odd},
    {"the luminance scales alpha, too", "35", "offset-2d-scale", Broken::alpha_scaled},
    {"the luminance is clamped to 1 before the product", "35", "offset-2d-scale", Broken::luminance_clamped},
    {"the first of two dot products is t", "36", "dot-product-2d", Broken::dots_exchanged},
    {"dot products add q", "36", "dot-product-2d", Broken::dots_with_q},
    {"MINUS1_TO_1_D3D is 2 v / 255 - 1", "36", "dot-mapping-minus1-to-1-d3d", Broken::mapping_d3d_255},
    {"signed dot mappings are clamped at -1", "36", "dot-mapping-minus1-to-1-d3d", Broken::mapping_clamped},
    {"MINUS1_TO_1_GL is s / 127", "36", "dot-mapping-minus1-to-1-gl", Broken::mapping_gl_127},
    {"MINUS1_TO_1 is (2 s + 1) / 255", "36", "dot-mapping-minus1-to-1", Broken::mapping_odd},
    {"HILO words have 8 bits instead of 16", "36", "dot-mapping-hilo-1", Broken::words_of_8_bits},
    {"HILO_1's third number is 0", "36", "dot-mapping-hilo-1", Broken::hilo_third_zero},
    {"HILO_HEMISPHERE's third number is 1", "36", "dot-mapping-hilo-hemisphere", Broken::hemisphere_third_one},
    {"HILO_HEMISPHERE's words are not signed", "36", "dot-mapping-hilo-hemisphere", Broken::hemisphere_unsigned},
    {"the replaced depth is the inverse quotient", "39", "dot-product-depth-replace", Broken::depth_inverted},
    {"the depth is not replaced", "39", "dot-product-depth-replace", Broken::depth_kept},
    {"the reflection takes normals of length 1 for granted", "38", "dot-product-reflect-cube-map",
     Broken::unit_normals},
    {"the eye is not used: the normal is looked up", "38", "dot-product-reflect-cube-map", Broken::eye_ignored},
    {"the reflection has the other sign", "38", "dot-product-reflect-cube-map", Broken::eye_negated},
    {"the third dot product of a diffuse cube map is 0", "38", "dot-product-diffuse-cube-map", Broken::ahead_is_zero},
    {"YUV by (298 C + 409 E + 128) >> 8 and its like", "40", "yuv", Broken::yuv_rounded},
    {"a 1D texture's s is not divided by q", "", "texture-1d", Broken::line_not_projected},
    {"a rectangle's s and t are not divided by q", "", "texture-rectangle", Broken::rectangle_not_projected},
    {"coordinates of rectangles are from 0 to 1", "", "texture-rectangle", Broken::rectangles_of_unit_sides},
    {"dot products as coordinates of rectangles are from 0 to 1", "36", "dot-product-rectangle",
     Broken::dots_of_unit_sides},
};

// The group that shows a field of profiles; empty: no picture decides it, and no group of one operation depends on it.
const char* group_of(std::string_view field) {
  return field == "stage_byte"                 ? "pass-through"
         : field == "replaced_depth_narrowing" ? "dot-product-depth-replace"
                                               : "";
}

StageOutput output_of(const TextureShaderProgram& compiled, const TextureShaderResult& result) {
  constexpr std::uint32_t kLargestDepth = 0xFFFF;
  StageOutput output;
  output.is_culled = result.is_culled;
  if (output.is_culled) return output;
  for (std::size_t i = 0; i < output.texture.size(); ++i) output.texture[i] = result.stage[i].codes;
  if (result.depth) output.depth = replaced_depth_code(compiled, *result.depth, kLargestDepth);
  return output;
}

FetchTexel fetch_of(const std::vector<StagePicture>& pictures, const StageVectorProgram& program,
                    Broken broken = Broken::none) {
  return [&, broken](int unit, const TexturePlace& place) {
    const auto i = static_cast<std::size_t>(unit);
    if (!program.picture[i]) return Bytes4{};
    const StagePicture& picture = pictures[*program.picture[i]];
    const bool is_dot = program.state.stage[i].operation == TextureOperation::dot_product_rectangle;
    const bool has_unit_sides =
        picture.target == StageTarget::rectangle &&
        (broken == Broken::rectangles_of_unit_sides || (broken == Broken::dots_of_unit_sides && is_dot));
    if (!has_unit_sides) return picture.at(place.at);
    return picture.at({place.at[0] * static_cast<float>(picture.width),
                       place.at[1] * static_cast<float>(picture.height), place.at[2]});
  };
}

}  // namespace

std::vector<StageMistake> stage_mistakes_of(const HardwareProfile& profile) {
  std::vector<StageMistake> found;
  for (const ProfileField& field : profile_fields()) {
    if (field.group != FieldGroup::texture_shader) continue;
    const Choice<int> own = field.get(profile);
    const bool is_word = field.kind == FieldKind::word;
    const FieldNumbers numbers =
        is_word ? FieldNumbers{0, static_cast<int>(field.words.size()) - 1} : field.rivals(profile);
    for (const int value : {numbers.first, numbers.second}) {
      if (value == own.value) continue;
      StageMistake mistake{std::string(field.name) + " = " + field.word_of(value), std::string(field.rules),
                           group_of(field.name), profile};
      field.set(mistake.profile, {value, own.evidence, own.source});
      found.push_back(std::move(mistake));
    }
  }
  for (const NamedStageRule& one : kBrokenStageRules)
    found.push_back({one.name, one.rules, one.group, profile, one.broken});
  for (const StageEdit& one : kStageEdits)
    found.push_back({one.name, one.rules, one.group, profile, Broken::none, one.edit});
  return found;
}

TextureShaderProgram compiled_stages(const HardwareProfile& profile, const std::vector<StagePicture>& pictures,
                                     const StageVectorProgram& program, const TextureShaderState& state) {
  StageTextures textures;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    if (program.picture[i]) {
      textures[i] = StageTexture{.target = pictures[*program.picture[i]].target, .is_signed = program.is_signed[i]};
    }
  }
  return compile(state, textures, profile).value();
}

StageOutput stage_output(const HardwareProfile& profile, const std::vector<StagePicture>& pictures,
                         const StageVectorProgram& program, const TextureShaderProgram& compiled,
                         const StageCoordinates& at) {
  return output_of(compiled, evaluate(compiled, profile, {at, at, at}, fetch_of(pictures, program)));
}

std::vector<StageOutput> run_stage_mistake(const StageMistake& mistake, const StageVectorPack& pack,
                                           const StageVectorProgram& program) {
  TextureShaderState state = program.state;
  if (mistake.edit != nullptr) mistake.edit(state);
  const TextureShaderProgram compiled = compiled_stages(mistake.profile, pack.pictures, program, state);
  const FetchTexel fetch = fetch_of(pack.pictures, program, mistake.broken);
  std::vector<StageOutput> outputs;
  for (const StageCoordinates& at : program.at) {
    const StageInputs inputs{at, at, at};
    TextureShaderResult result;
    MistakenFragment fragment(mistake.broken, compiled, inputs, fetch, result);
    one_fragment::walk_stages(compiled, mistake.profile, fragment);
    outputs.push_back(output_of(compiled, result));
  }
  return outputs;
}

}  // namespace ninebit::vectors
