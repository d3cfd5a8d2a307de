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

}  // namespace ninebit
