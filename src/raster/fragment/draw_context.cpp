#include "src/raster/fragment/draw_context.h"

#include <algorithm>

#include "ninebit/combiner/initial_registers.h"

namespace ninebit {
namespace {

constexpr ColorBytes kWhite{255, 255, 255, 255};

// The registers with the values that all fragments share; texture registers differ per fragment.
RegisterFile initial_of(const DrawContext& context) {
  FragmentInputs inputs;
  inputs.secondary = {0, 0, 0, 255};
  inputs.fog_color = context.state.fog.color;
  if (context.state.fog.enabled) inputs.fog_factor = std::uint8_t{255};
  for (std::size_t unit = 0; unit < context.samplers.size(); ++unit) {
    if (context.samplers[unit]) inputs.texture[unit] = Texel{.format = context.samplers[unit]->format()};
  }
  return initial_registers(context.state.profile, inputs);
}

std::vector<RegisterComponent> overwritten(const Program& program) {
  std::array<bool, kRegisterCount> written{};
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    for (const Portion* portion : {&stage.rgb, &stage.alpha}) {
      for (const Register reg : {portion->out.ab, portion->out.cd, portion->out.sum}) {
        if (reg != Register::discard) written[static_cast<std::size_t>(reg)] = true;
      }
    }
  }
  std::vector<RegisterComponent> components;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (int k = 0; k < 4 && written[r]; ++k) components.push_back({static_cast<Register>(r), k});
  }
  return components;
}

}  // namespace

DrawContext::DrawContext(const PipelineState& pipeline, const VertexArrays& vertices,
                         std::span<const TextureUnit> units, const RenderTarget& target, bool for_probe)
    : state(pipeline),
      arrays(vertices),
      assembly(vertices),
      operations(pipeline, target, !for_probe),
      outputs(target),
      depth(target.format, state.profile.depth_narrowing) {
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    if (units[unit].texture == nullptr) continue;
    const Texture& texture = *units[unit].texture;
    samplers[unit] = TextureSampler::make(state.profile, texture, units[unit].sampler);
    if (!samplers[unit] || !samplers[unit]->needs_derivatives()) continue;
    needs_texture_changes = true;
    if (texture.target != TextureTarget::cube_map) {
      const bool counts_texels = texture.target == TextureTarget::rectangle;
      point_change[unit] = counts_texels ? 1.0F : 1.0F / static_cast<float>(texture.faces[0][0].width);
    }
  }
  has_flat_result = !for_probe && outputs.need_fragment_alone() &&
                    (!operations.needs_color() || (!state.program && shades_flat(arrays.vertex_colors)));
  fills_registers = for_probe || state.program.has_value() || outputs.needs_registers() || outputs.needs_output();
  initial = initial_of(*this);
  prepare_program(target, for_probe);
}

void DrawContext::prepare_program(const RenderTarget& target, bool for_probe) {
  const bool needs_registers = for_probe || outputs.needs_registers();
  if (state.program) {
    BatchOutputs wanted{.registers = needs_registers};
    if (!for_probe && !outputs.needs_output() && !outputs.needs_colors() && !state.blend.enabled) {
      for (std::size_t k = 0; k < 4; ++k) wanted.color[k] = state.color_mask[k] && target.color[k];
      wanted.color[kAlpha] = wanted.color[kAlpha] || state.alpha_test.enabled;
    }
    wanted_color = wanted.color;
    const auto is_signed = [](const auto& sampler) { return sampler && sampler->gives_signed_codes(); };
    const bool any_signed = std::any_of(samplers.begin(), samplers.end(), is_signed);
    program.emplace(*state.program, wanted, ComponentSet{},
                    any_signed ? BatchInputs::any_codes : BatchInputs::not_negative);
    const bool keeps_registers = state.program->datapath.arithmetic == Arithmetic::integer && !needs_registers;
    if (!keeps_registers) refilled = overwritten(*state.program);
  }
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    const auto reg = static_cast<Register>(r);
    reads[r] = needs_registers || (fills_registers && !program);
    for (int k = 0; k < 4 && program; ++k) reads[r] = reads[r] || program->reads().contains(reg, k);
  }
  for (std::size_t unit = 0; unit < reads_unit.size(); ++unit) {
    const auto reg = static_cast<std::size_t>(texture_register(static_cast<int>(unit)));
    // (Before the first general combiner, spare0's alpha is that of unit 0.)
    const bool as_spare0 = unit == 0 && reads[static_cast<std::size_t>(Register::spare0)];
    reads_unit[unit] = samplers[unit] && (reads[reg] || as_spare0);
  }
}

ColorBytes DrawContext::flat_primary_of_vertex(std::uint32_t primitive) const {
  if (!arrays.vertex_colors.empty()) return arrays.vertex_colors[assembly.provoking_vertex(primitive)];
  return kWhite;
}

}  // namespace ninebit
