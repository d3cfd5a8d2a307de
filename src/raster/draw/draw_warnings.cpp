// Settings of a draw that GL accepts, and whose effect is easily overlooked.
#include <array>

#include "ninebit/combiner/program.h"
#include "ninebit/raster/rasterizer.h"
#include "ninebit/raster/texture_stages.h"
#include "src/raster/fragment/draw_context.h"
#include "src/raster/setup/arrays_check.h"
#include "src/raster/texture/texture_level.h"

namespace ninebit {
namespace {

constexpr std::array kTextureRegisters{Register::texture0, Register::texture1, Register::texture2, Register::texture3};
static_assert(kTextureRegisters.size() == kMaxTextureUnits);

bool writes(const ProgramStage& stage, Register reg) {
  for (const Portion* p : {&stage.rgb, &stage.alpha}) {
    if (p->out.ab == reg || p->out.cd == reg || p->out.sum == reg) return true;
  }
  return false;
}

// Whether the program reads a register before it writes any part of it.
bool reads_initial(const Program& program, Register reg) {
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    if (detail::stage_reads(stage, reg)) return true;
    if (writes(stage, reg)) return false;
  }
  return detail::final_reads(program.final_combiner, reg);
}

}  // namespace

Result<std::vector<std::string>> check_draw(const PipelineState& state, std::span<const TextureUnit> units) {
  auto of_stages = texture_shader_warnings(state, units);
  if (!of_stages) return of_stages;
  std::vector<std::string> all;
  for (std::size_t i = 0; i < kTextureRegisters.size(); ++i) {
    const TextureUnit unit = i < units.size() ? units[i] : TextureUnit{};
    const std::string number = std::to_string(i);
    if (unit.texture != nullptr) {
      const std::string why = why_incomplete(*unit.texture, uses_mipmaps(unit.sampler.min_filter));
      if (!why.empty()) all.push_back("texture unit " + number + " is off, because its texture is incomplete: " + why);
    } else if (!state.texture_shader.enabled && state.program && reads_initial(*state.program, kTextureRegisters[i])) {
      all.push_back("the program reads texture unit " + number +
                    ", which has no texture; the extension's default applies");
    }
  }
  all.insert(all.end(), of_stages->begin(), of_stages->end());
  return all;
}

Result<std::vector<std::string>> texture_shader_warnings(const PipelineState& state,
                                                         std::span<const TextureUnit> units) {
  if (!state.texture_shader.enabled) return std::vector<std::string>{};
  if (Status checked = check_arrays(state, {}, units); !checked) return checked.error();
  const auto stages = TextureStages::make(state.profile, state.texture_shader, stage_units(units));
  if (!stages) return stages.error();
  return stages->program().warnings();
}

}  // namespace ninebit
