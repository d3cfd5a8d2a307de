#include "src/language/source/beyond_opengl.h"

namespace ninebit {

std::string beyond_opengl(const Program& program) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  for (std::size_t i = 0; i < program.general.size(); ++i) {
    const ProgramStage& stage = program.general[i];
    const std::string where = " (general combiner " + std::to_string(i) + ")";
    if (stage.mux_by_lowest_bit) add("mux by the lowest bit of spare0's alpha" + where);
    if (stage.rgb.out.ab_blue_to_alpha || stage.rgb.out.cd_blue_to_alpha) add("blue-to-alpha output" + where);
  }
  if (program.color_sum_invert_spare0) add("1 - spare0 in the colour sum");
  if (program.color_sum_invert_secondary) add("1 - secondary in the colour sum");
  return text;
}

std::string beyond_opengl(const TextureShaderState& state) {
  std::string text;
  const auto add = [&](const std::string& what) { text += (text.empty() ? "" : "; ") + what; };
  const TextureShaderState used = only_used(state);
  for (std::size_t i = 0; i < used.stage.size(); ++i) {
    const DotMapping mapping = used.stage[i].mapping;
    if (mapping != DotMapping::zero_to_one && mapping != DotMapping::minus1_to_1_d3d) {
      add("dot-product mapping but that of 0 to 1 and (x - 128) / 127 (texture stage " + std::to_string(i) + ")");
    }
  }
  if (used.depth_unit == DepthUnit::codes) add("replaced depth in codes of the buffer");
  if (used.converts_yuv) add("conversion from YUV");
  return text;
}

}  // namespace ninebit
