#include "src/playground/vocabulary.h"

#include <array>
#include <string>
#include <utility>

#include "src/playground/texts.h"

namespace ninebit::playground {

namespace {

void add_helped(Json& words, std::string_view kind, std::span<const HelpedWord> helped) {
  for (const HelpedWord& one : helped) words.push_back({{"word", one.word}, {"kind", kind}, {"help", one.help}});
}

}  // namespace

Reply vocabulary(Request& request) {
  request.allow({});
  if (request.failed()) return request.refused();
  Json words = Json::array();
  add_helped(words, "gl-constant", gl_constant_help());
  add_helped(words, "gl-function", gl_function_help());
  add_helped(words, "rc10", rc10_help());
  add_helped(words, "ps", pixel_shader_help());
  add_helped(words, "json", json_help());
  for (const HardwareProfile& profile : hardware_profiles()) {
    words.push_back(
        {{"word", profile.name}, {"kind", "profile"}, {"help", "Profile: " + std::string(profile.chip) + "."}});
  }
  for (const ProfileField& field : profile_fields()) {
    words.push_back({{"word", field.name}, {"kind", "profile"}, {"help", field.help}});
  }
  return Json{{"words", std::move(words)}};
}

Json value_of_field(const ProfileField& field, const HardwareProfile& profile) {
  const int value = field.get(profile).value;
  if (field.kind == FieldKind::number) return value;
  if (field.kind == FieldKind::flag) return value != 0;
  return field.word_of(value);
}

Json profile_object(const HardwareProfile& profile) {
  Json fields = Json::array();
  for (const ProfileField& field : profile_fields()) {
    const Choice<int> choice = field.get(profile);
    Json object{{"name", field.name},
                {"value", value_of_field(field, profile)},
                {"evidence", name_of(choice.evidence)},
                {"source", choice.source},
                {"help", field.help},
                {"read", field.group != FieldGroup::integer_rules || profile.arithmetic == Arithmetic::integer}};
    if (field.kind == FieldKind::word) {
      for (const FieldWord& word : field.words) object["choices"].push_back(word.word);
    } else if (field.kind == FieldKind::number) {
      const FieldNumbers range = field.range(profile);
      object["range"] = {range.first, range.second};
    }
    fields.push_back(std::move(object));
  }
  return Json{{"name", profile.name}, {"summary", profile.chip}, {"fields", std::move(fields)}};
}

namespace {

constexpr std::array kGlConstantHelp{
    HelpedWord{"GL_FALSE", "The number 0: off."},
    HelpedWord{"GL_TRUE", "The number 1: on."},
    HelpedWord{"GL_NONE", "No scale or no bias: the outputs stay as they are."},
    HelpedWord{"GL_ZERO", "The register that always holds 0. Inverted it is 1, which passes the other factor on."},
    HelpedWord{"GL_ONE", "No register: GL refuses it. For 1.0 read GL_ZERO through GL_UNSIGNED_INVERT_NV."},
    HelpedWord{"GL_FOG", "The fog register: the fog colour, and in the final combiner's alpha the fog factor."},
    HelpedWord{"GL_RGB",
               "As a portion: red, green and blue. As component usage: each channel reads its own component."},
    HelpedWord{"GL_ALPHA", "As a portion: alpha. As component usage: all channels read the register's alpha."},
    HelpedWord{"GL_BLUE", "Component usage of alpha portions: alpha is computed from the register's blue."},
    HelpedWord{"GL_REGISTER_COMBINERS_NV", "Switches the register combiners on or off, by glEnable and glDisable."},
    HelpedWord{"GL_VARIABLE_A_NV", "Factor A of the product A·B; in the final combiner the weight that mixes B and C."},
    HelpedWord{"GL_VARIABLE_B_NV", "Factor B of the product A·B; in the final combiner the result where A is 1."},
    HelpedWord{"GL_VARIABLE_C_NV", "Factor C of the product C·D; in the final combiner the result where A is 0."},
    HelpedWord{"GL_VARIABLE_D_NV", "Factor D of the product C·D; in the final combiner it is added to the mix."},
    HelpedWord{"GL_VARIABLE_E_NV", "Final combiner: the first factor of the product E·F."},
    HelpedWord{"GL_VARIABLE_F_NV", "Final combiner: the second factor of the product E·F."},
    HelpedWord{"GL_VARIABLE_G_NV", "Final combiner: the alpha of the fragment."},
    HelpedWord{"GL_CONSTANT_COLOR0_NV", "Register of the first constant colour. Bytes, so 256 values a component."},
    HelpedWord{"GL_CONSTANT_COLOR1_NV", "Register of the second constant colour. Bytes, so 256 values a component."},
    HelpedWord{"GL_PRIMARY_COLOR_NV", "Register of the interpolated primary (diffuse) colour. A stage may write it."},
    HelpedWord{"GL_SECONDARY_COLOR_NV",
               "Register of the interpolated secondary (specular) colour. A stage may write it."},
    HelpedWord{"GL_SPARE0_NV", "A register for results. Its alpha starts as texture 0's alpha and decides the mux."},
    HelpedWord{"GL_SPARE1_NV", "A register for results. It starts as 0."},
    HelpedWord{"GL_DISCARD_NV", "As an output: the value is thrown away."},
    HelpedWord{"GL_E_TIMES_F_NV", "Final combiner, A to D: the product of the variables E and F."},
    HelpedWord{"GL_SPARE0_PLUS_SECONDARY_COLOR_NV", "Final combiner, B to D: spare0 plus the secondary colour."},
    HelpedWord{"GL_PER_STAGE_CONSTANTS_NV", "By glEnable: each general combiner reads constants of its own."},
    HelpedWord{"GL_UNSIGNED_IDENTITY_NV", "Mapping max(0, x): a negative value reads as 0."},
    HelpedWord{"GL_UNSIGNED_INVERT_NV", "Mapping 1 - min(max(0, x), 1): from 0 to 1, turned around."},
    HelpedWord{"GL_EXPAND_NORMAL_NV", "Mapping 2·max(0, x) - 1: a byte becomes a signed number, as for normals."},
    HelpedWord{"GL_EXPAND_NEGATE_NV", "Mapping 1 - 2·max(0, x): a byte becomes a signed number with the other sign."},
    HelpedWord{"GL_HALF_BIAS_NORMAL_NV", "Mapping max(0, x) - 1/2."},
    HelpedWord{"GL_HALF_BIAS_NEGATE_NV", "Mapping 1/2 - max(0, x)."},
    HelpedWord{"GL_SIGNED_IDENTITY_NV", "Mapping x: the value with its sign. Not in the final combiner."},
    HelpedWord{"GL_SIGNED_NEGATE_NV", "Mapping -x: the other sign. Not in the final combiner."},
    HelpedWord{"GL_SCALE_BY_TWO_NV",
               "Doubles a portion's outputs, after the bias and before they are cut to the range."},
    HelpedWord{"GL_SCALE_BY_FOUR_NV", "Multiplies a portion's outputs by four. Not together with a bias."},
    HelpedWord{"GL_SCALE_BY_ONE_HALF_NV", "Halves a portion's outputs. Not together with a bias."},
    HelpedWord{"GL_BIAS_BY_NEGATIVE_ONE_HALF_NV", "Takes one half from a portion's outputs, before the scale."},
    HelpedWord{"GL_COMBINER_INPUT_NV", "Asks for the register that a variable reads (glGetCombinerInputParameter)."},
    HelpedWord{"GL_COMBINER_MAPPING_NV", "Asks for the mapping of a variable."},
    HelpedWord{"GL_COMBINER_COMPONENT_USAGE_NV", "Asks which components a variable reads."},
    HelpedWord{"GL_COMBINER_AB_DOT_PRODUCT_NV", "Asks whether A·B is a dot product."},
    HelpedWord{"GL_COMBINER_CD_DOT_PRODUCT_NV", "Asks whether C·D is a dot product."},
    HelpedWord{"GL_COMBINER_MUX_SUM_NV", "Asks whether the third output is the mux instead of the sum."},
    HelpedWord{"GL_COMBINER_SCALE_NV", "Asks for the scale of a portion's outputs."},
    HelpedWord{"GL_COMBINER_BIAS_NV", "Asks for the bias of a portion's outputs."},
    HelpedWord{"GL_COMBINER_AB_OUTPUT_NV", "Asks for the register that A·B is written to."},
    HelpedWord{"GL_COMBINER_CD_OUTPUT_NV", "Asks for the register that C·D is written to."},
    HelpedWord{"GL_COMBINER_SUM_OUTPUT_NV", "Asks for the register that the sum or the mux is written to."},
    HelpedWord{"GL_MAX_GENERAL_COMBINERS_NV", "Asks how many general combiners the chip has."},
    HelpedWord{"GL_NUM_GENERAL_COMBINERS_NV", "How many general combiners run, from the first on."},
    HelpedWord{"GL_COLOR_SUM_CLAMP_NV", "Whether spare0 plus the secondary colour is cut to at most 1."},
    HelpedWord{"GL_COMBINER0_NV", "The first general combiner."},
    HelpedWord{"GL_COMBINER1_NV", "The second general combiner; a GeForce 2 has no more."},
    HelpedWord{"GL_COMBINER2_NV", "The third general combiner (NV20 and later)."},
    HelpedWord{"GL_COMBINER3_NV", "The fourth general combiner (NV20 and later)."},
    HelpedWord{"GL_COMBINER4_NV", "The fifth general combiner (NV20 and later)."},
    HelpedWord{"GL_COMBINER5_NV", "The sixth general combiner (NV20 and later)."},
    HelpedWord{"GL_COMBINER6_NV", "The seventh general combiner (NV20 and later)."},
    HelpedWord{"GL_COMBINER7_NV", "The eighth general combiner (NV20 and later)."},
    HelpedWord{"GL_TEXTURE0_ARB", "Register of texture unit 0's filtered texel. A stage may write it."},
    HelpedWord{"GL_TEXTURE1_ARB", "Register of texture unit 1's filtered texel. A stage may write it."},
    HelpedWord{"GL_TEXTURE2_ARB", "Register of texture unit 2's filtered texel (chips with four units)."},
    HelpedWord{"GL_TEXTURE3_ARB", "Register of texture unit 3's filtered texel (chips with four units)."}};

constexpr std::array kGlFunctionHelp{
    HelpedWord{"glCombinerParameteriNV",
               "(pname, value): sets how many general combiners run, or the colour sum's clamp."},
    HelpedWord{"glCombinerParameterfNV", "(pname, value): the same with a float."},
    HelpedWord{"glCombinerParameterivNV", "(pname, values): the same, or a constant colour in whole numbers."},
    HelpedWord{"glCombinerParameterfvNV", "(pname, values): sets a constant colour, four floats from 0 to 1."},
    HelpedWord{
        "glCombinerInputNV",
        "(stage, portion, variable, input, mapping, componentUsage): what one variable of a general combiner reads."},
    HelpedWord{
        "glCombinerOutputNV",
        "(stage, portion, abOutput, cdOutput, sumOutput, scale, bias, abDotProduct, cdDotProduct, muxSum): where a "
        "portion's results go."},
    HelpedWord{"glFinalCombinerInputNV", "(variable, input, mapping, componentUsage): what one variable A to G reads."},
    HelpedWord{"glCombinerStageParameterfvNV",
               "(stage, pname, values): sets a constant colour of one general combiner."},
    HelpedWord{"glCombinerParameterNV", "(pname, values): sets a constant colour, as Java's LWJGL spells it."},
    HelpedWord{"glCombinerStageParameterNV",
               "(stage, pname, values): a constant colour of one general combiner, as Java's LWJGL spells it."},
    HelpedWord{"glEnable", "(cap): switches on, such as GL_REGISTER_COMBINERS_NV or GL_PER_STAGE_CONSTANTS_NV."},
    HelpedWord{"glDisable", "(cap): switches off."}};

}  // namespace

std::span<const HelpedWord> gl_constant_help() {
  return kGlConstantHelp;
}

std::span<const HelpedWord> gl_function_help() {
  return kGlFunctionHelp;
}

namespace {

constexpr std::array kRc10Help{
    HelpedWord{"!!RC1.0", "The first line of a program for NVIDIA's nvparse."},
    HelpedWord{"fog", "The fog register: the fog colour, and in the final combiner's alpha the fog factor."},
    HelpedWord{"col0", "The primary (diffuse) colour."},
    HelpedWord{"col1", "The secondary (specular) colour."},
    HelpedWord{"spare0", "A register for results. Its alpha starts as tex0's alpha and decides mux()."},
    HelpedWord{"spare1", "A register for results. It starts as 0."},
    HelpedWord{"tex0", "The texel of texture unit 0."},
    HelpedWord{"tex1", "The texel of texture unit 1."},
    HelpedWord{"tex2", "The texel of texture unit 2 (chips with four units)."},
    HelpedWord{"tex3", "The texel of texture unit 3 (chips with four units)."},
    HelpedWord{"const0", "The first constant colour. (r, g, b, a) after an equals sign sets it."},
    HelpedWord{"const1", "The second constant colour. (r, g, b, a) after an equals sign sets it."},
    HelpedWord{"zero", "The number 0."},
    HelpedWord{"one", "The number 1: the register zero, read inverted."},
    HelpedWord{"discard", "Throws a result away: the product is only part of sum() or mux()."},
    HelpedWord{"color_sum", "Final combiner: spare0 plus the secondary colour."},
    HelpedWord{"final_product", "Final combiner: the product of two inputs, set before out.rgb reads it."},
    HelpedWord{"color", "The Xbox tools' name of the primary colour."},
    HelpedWord{"color0", "The Xbox tools' name of the primary colour."},
    HelpedWord{"color1", "The Xbox tools' name of the secondary colour."},
    HelpedWord{"texture0", "The Xbox tools' name of tex0."},
    HelpedWord{"texture1", "The Xbox tools' name of tex1."},
    HelpedWord{"texture2", "The Xbox tools' name of tex2."},
    HelpedWord{"texture3", "The Xbox tools' name of tex3."},
    HelpedWord{"rgb", "The RGB portion of a general combiner: red, green and blue."},
    HelpedWord{"alpha", "The alpha portion of a general combiner."},
    HelpedWord{"sum", "sum() writes A·B + C·D, the two products above it."},
    HelpedWord{"mux", "mux() writes A·B where spare0's alpha is below one half, else C·D."},
    HelpedWord{"expand", "expand(x) reads 2·max(0, x) - 1: a byte as a signed number."},
    HelpedWord{"half_bias", "half_bias(x) reads max(0, x) - 1/2."},
    HelpedWord{"unsigned", "unsigned(x) reads max(0, x): a negative value as 0."},
    HelpedWord{"unsigned_invert", "unsigned_invert(x) reads 1 - x, with x cut to 0 to 1 first."},
    HelpedWord{"scale_by_one_half", "scale_by_one_half() halves the portion's outputs."},
    HelpedWord{"scale_by_two", "scale_by_two() doubles the portion's outputs."},
    HelpedWord{"scale_by_four", "scale_by_four() multiplies the portion's outputs by four."},
    HelpedWord{"bias_by_negative_one_half", "bias_by_negative_one_half() takes one half from the portion's outputs."},
    HelpedWord{
        "bias_by_negative_one_half_scale_by_two",
        "bias_by_negative_one_half_scale_by_two() takes one half from the portion's outputs, then doubles them."},
    HelpedWord{"out.rgb", "The fragment's colour: the final combiner's A·B + (1 - A)·C + D."},
    HelpedWord{"out.a", "The fragment's alpha: the final combiner's G."},
    HelpedWord{"lerp", "lerp(a, b, c) is a·b + (1 - a)·c."},
    HelpedWord{"clamp_color_sum", "clamp_color_sum() cuts color_sum to at most 1."}};

constexpr std::array kPixelShaderHelp{
    HelpedWord{"ps.1.0", "A pixel shader of version 1.0."},
    HelpedWord{"ps.1.1", "A pixel shader of version 1.1: the GeForce 3's first, eight arithmetic instructions."},
    HelpedWord{"ps.1.2", "A pixel shader of version 1.2."},
    HelpedWord{"ps.1.3", "A pixel shader of version 1.3."},
    HelpedWord{"ps.1.4", "A pixel shader of version 1.4, made for another maker's chip."},
    HelpedWord{"xps.1.1", "A pixel shader in the dialect of the Xbox's assembler."},
    HelpedWord{"mov", "mov d, a: copies a."},
    HelpedWord{"add", "add d, a, b: a + b."},
    HelpedWord{"sub", "sub d, a, b: a - b."},
    HelpedWord{"mul", "mul d, a, b: a · b, component by component."},
    HelpedWord{"mad", "mad d, a, b, c: a · b + c."},
    HelpedWord{"lrp", "lrp d, a, b, c: a · b + (1 - a) · c."},
    HelpedWord{"dp3", "dp3 d, a, b: the dot product of red, green and blue, in every component."},
    HelpedWord{"dp4", "dp4 d, a, b: the dot product of all four components."},
    HelpedWord{"cnd", "cnd d, r0.a, b, c: b where r0's alpha is above one half, else c."},
    HelpedWord{"cmp", "cmp d, a, b, c: b where a is not negative, else c."},
    HelpedWord{"bem", "bem d, a, b: moves texture coordinates by a bump map (ps.1.4)."},
    HelpedWord{"nop", "Does nothing."},
    HelpedWord{"def", "def cN, r, g, b, a: sets a constant."},
    HelpedWord{"phase", "Divides the two halves of a ps.1.4 shader."},
    HelpedWord{"tex", "tex tN: the texel of unit N at its own coordinates."},
    HelpedWord{"texcoord", "texcoord tN: the texture coordinates as a colour."},
    HelpedWord{"texkill", "texkill tN: drops the pixel where a coordinate is negative."},
    HelpedWord{"texbem", "texbem tN, tM: reads unit N at coordinates that a bump map moves."},
    HelpedWord{"texbeml", "texbeml tN, tM: as texbem, times the bump map's luminance."},
    HelpedWord{"texbrdf", "texbrdf tN, tM: reads a table of reflection (Xbox)."},
    HelpedWord{"texreg2ar", "texreg2ar tN, tM: reads unit N at alpha and red of tM."},
    HelpedWord{"texreg2gb", "texreg2gb tN, tM: reads unit N at green and blue of tM."},
    HelpedWord{"texreg2rgb", "texreg2rgb tN, tM: reads unit N at red, green and blue of tM."},
    HelpedWord{"texm3x2pad", "The first row of a matrix of two rows."},
    HelpedWord{"texm3x2tex", "The second row of such a matrix, and a texel there."},
    HelpedWord{"texm3x2depth", "The second row of such a matrix; the quotient becomes the depth."},
    HelpedWord{"texm3x3pad", "A row of a matrix of three rows."},
    HelpedWord{"texm3x3tex", "The third row of such a matrix, and a texel in that direction."},
    HelpedWord{"texm3x3", "The third row of such a matrix; the result is the direction itself."},
    HelpedWord{"texm3x3diff", "The third row of such a matrix, and a texel of a diffuse cube map (Xbox)."},
    HelpedWord{"texm3x3spec", "The third row of such a matrix, and a texel where a fixed eye vector is mirrored."},
    HelpedWord{"texm3x3vspec", "The third row of such a matrix, and a texel where the eye vector is mirrored."},
    HelpedWord{"texdp3", "texdp3 tN, tM: the dot product of coordinates and a texel."},
    HelpedWord{"texdp3tex", "texdp3tex tN, tM: a texel at that dot product."},
    HelpedWord{"texld", "texld rN, tM: a texel (ps.1.4)."},
    HelpedWord{"texcrd", "texcrd rN, tM: coordinates as a colour (ps.1.4)."},
    HelpedWord{"texdepth", "texdepth r5: the quotient of red and green becomes the depth (ps.1.4)."},
    HelpedWord{"xmma", "Xbox: two products and their sum, a whole general combiner."},
    HelpedWord{"xmmc", "Xbox: two products, and the one that the mux takes."},
    HelpedWord{"xdm", "Xbox: a dot product and a product."},
    HelpedWord{"xdd", "Xbox: two dot products."},
    HelpedWord{"xfc", "Xbox: the final combiner, its inputs A to G."},
    HelpedWord{"v0", "The primary (diffuse) colour."},
    HelpedWord{"v1", "The secondary (specular) colour."},
    HelpedWord{"r0", "A register for results; what is in it at the end is the fragment's colour."},
    HelpedWord{"r1", "A register for results."},
    HelpedWord{"t0", "The texel of unit 0."},
    HelpedWord{"t1", "The texel of unit 1."},
    HelpedWord{"t2", "The texel of unit 2."},
    HelpedWord{"t3", "The texel of unit 3."},
    HelpedWord{"_x2", "Doubles the result."},
    HelpedWord{"_x4", "Multiplies the result by four."},
    HelpedWord{"_d2", "Halves the result."},
    HelpedWord{"_sat", "Cuts the result to 0 to 1."},
    HelpedWord{"_bias", "Takes one half from a source."},
    HelpedWord{"_bx2", "Reads a source as 2x - 1."}};

constexpr std::array kJsonHelp{
    HelpedWord{"num_general_combiners", "How many general combiners run."},
    HelpedWord{"color_sum_clamp", "Whether spare0 plus the secondary colour is cut to at most 1."},
    HelpedWord{"per_stage_constants", "Whether each general combiner reads constants of its own."},
    HelpedWord{"mux_by_lowest_bit", "Whether the mux looks at the lowest bit of spare0's alpha (NV2A)."},
    HelpedWord{"color_sum_invert_spare0", "Whether spare0 goes into the colour sum as 1 - x (NV2A)."},
    HelpedWord{"color_sum_invert_secondary", "Whether the secondary colour goes into the colour sum as 1 - x (NV2A)."},
    HelpedWord{"constant_color0", "The first constant colour, four numbers from 0 to 1."},
    HelpedWord{"constant_color1", "The second constant colour, four numbers from 0 to 1."},
    HelpedWord{"general_combiners",
               "The general combiners in their order, each with a portion rgb and a portion alpha."},
    HelpedWord{"final_combiner", "The inputs A to G of the final combiner."},
    HelpedWord{"input", "The register that a variable reads."},
    HelpedWord{"mapping", "What is done to the value before it is multiplied."},
    HelpedWord{"usage", "Which components of the register are read."},
    HelpedWord{"output", "Where a portion's results go, with scale and bias."}};

}  // namespace

std::span<const HelpedWord> rc10_help() {
  return kRc10Help;
}

std::span<const HelpedWord> pixel_shader_help() {
  return kPixelShaderHelp;
}

std::span<const HelpedWord> json_help() {
  return kJsonHelp;
}

}  // namespace ninebit::playground
