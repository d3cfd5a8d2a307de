// Help for the words of !!RC1.0, of pixel shaders and of JSON programs.
#include <array>

#include "src/playground/vocabulary.h"

namespace ninebit::playground {
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
