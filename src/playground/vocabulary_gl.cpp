// Help for the enumerants and functions of NV_register_combiners and NV_register_combiners2.
#include <array>

#include "src/playground/vocabulary.h"

namespace ninebit::playground {
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

}  // namespace ninebit::playground
