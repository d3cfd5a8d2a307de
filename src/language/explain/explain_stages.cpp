// Texture-shader stages as equations.

#include "ninebit/language/explain.h"
#include "src/system/digits.h"

namespace ninebit {
namespace stage_equations {
namespace {

// "(s1, t1, r1)", as many of s, t, r, q as `components`.
std::string coordinates(std::size_t place, std::size_t components) {
  std::string text = "(";
  for (std::size_t i = 0; i < components; ++i) {
    text += (i == 0 ? "" : ", ") + std::string(1, "strq"[i]) + std::to_string(place);
  }
  return text + ')';
}

// The factor of a dot product.
std::string mapped(const TextureStage& stage) {
  const std::string texel = "tex" + std::to_string(stage.previous);
  switch (stage.mapping) {
    case DotMapping::zero_to_one:
      return texel;
    case DotMapping::minus1_to_1_d3d:
      return "expand(" + texel + ")";
    case DotMapping::minus1_to_1_gl:
      return "signed_gl(" + texel + ")";
    case DotMapping::minus1_to_1:
      return "signed(" + texel + ")";
    case DotMapping::hilo_1:
      return "hilo(" + texel + ")";
    default:
      return "hemisphere(" + texel + ")";
  }
}

std::string dot_text(std::size_t place, const TextureStage& stage) {
  return "dot" + std::to_string(place) + " = dot(" + coordinates(place, 3) + ", " + mapped(stage) + ')';
}

// "dot1, dot2" of the stages that end here.
std::string dots(std::size_t place, std::size_t count) {
  std::string text;
  for (std::size_t i = place + 1 - count; i <= place; ++i) text += (text.empty() ? "dot" : ", dot") + std::to_string(i);
  return '(' + text + ')';
}

std::string moved(std::size_t place, const TextureStage& stage) {
  const std::string from = "tex" + std::to_string(stage.previous);
  const auto axis = [&](char name, float by_ds, float by_dt) {
    return std::string(1, name) + std::to_string(place) + " + " + digits_of(by_ds) + "·ds(" + from + ") + " +
           digits_of(by_dt) + "·dt(" + from + ')';
  };
  return '(' + axis('s', stage.matrix[0], stage.matrix[2]) + ", " + axis('t', stage.matrix[1], stage.matrix[3]) + ')';
}

std::string killed(std::size_t place, const TextureStage& stage) {
  std::string text;
  for (std::size_t i = 0; i < stage.cull.size(); ++i) {
    text += (i == 0 ? "" : " or ") + std::string(1, "strq"[i]) + std::to_string(place) +
            (stage.cull[i] == CullMode::kills_negative ? " < 0" : " ≥ 0");
  }
  return text;
}

void add_stage(std::size_t place, const TextureStage& stage, std::vector<std::string>& lines) {
  using enum TextureOperation;
  const std::string number = std::to_string(place), texel = "tex" + number + " = ";
  const auto read = [&](const std::string& at) { lines.push_back(texel + "texture " + number + " at " + at); };
  const TextureOperationInfo& info = info_of(stage.operation);
  if (info.input == StageInput::normal) lines.push_back(dot_text(place, stage));
  const std::string previous = "tex" + std::to_string(stage.previous);
  switch (stage.operation) {
    case texture_1d:
      return read("s" + number + " / q" + number);
    case texture_2d:
    case texture_rectangle:
      return read(coordinates(place, 2) + " / q" + number);
    case texture_3d:
      return read(coordinates(place, 3) + " / q" + number);
    case texture_cube_map:
      return read(coordinates(place, 3));
    case pass_through:
      lines.push_back(texel + coordinates(place, 4) + ", clamped to 0 to 1");
      return;
    case cull_fragment:
      lines.push_back("the fragment is killed if " + killed(place, stage));
      return;
    case offset_2d:
    case offset_rectangle:
      return read(moved(place, stage));
    case offset_2d_scale:
    case offset_rectangle_scale:
      read(moved(place, stage));
      lines.push_back("tex" + number + ".rgb × (" + digits_of(stage.scale) + "·" + previous + ".red + " +
                      digits_of(stage.bias) + ")");
      return;
    case dependent_ar:
      return read("(" + previous + ".a, " + previous + ".red)");
    case dependent_gb:
      return read("(" + previous + ".green, " + previous + ".blue)");
    case dot_product_2d:
    case dot_product_rectangle:
      return read(dots(place, 2));
    case dot_product_3d:
    case dot_product_cube_map:
      return read(dots(place, 3));
    case dot_product_diffuse_cube_map:
      return read("(dot1, dot2, dot3)");
    case dot_product_reflect_cube_map:
      return read("reflect(" + dots(place, 3) + ", (q1, q2, q3))");
    case dot_product_const_eye_reflect_cube_map:
      return read("reflect(" + dots(place, 3) + ", (" + digits_of(stage.eye[0]) + ", " + digits_of(stage.eye[1]) +
                  ", " + digits_of(stage.eye[2]) + "))");
    case dot_product_depth_replace:
      lines.push_back("depth = dot" + std::to_string(place - 1) + " / dot" + number);
      return;
    default:
      return;
  }
}

}  // namespace
}  // namespace stage_equations

std::vector<std::string> explain_stages(const TextureShaderState& state) {
  std::vector<std::string> lines;
  if (!state.enabled) return lines;
  for (std::size_t place = 0; place < state.stage.size(); ++place)
    stage_equations::add_stage(place, state.stage[place], lines);
  if (only_used(state).converts_yuv) lines.emplace_back("what textures give is converted from YUV");
  return lines;
}

std::string print_stages(const TextureShaderState& state) {
  std::string text;
  for (const std::string& line : explain_stages(state)) text += "  " + line + '\n';
  return text.empty() ? "" : "texture shader\n" + text;
}

}  // namespace ninebit
