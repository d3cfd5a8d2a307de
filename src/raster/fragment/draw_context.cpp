#include "src/raster/fragment/draw_context.h"

#include <algorithm>

#include "ninebit/combiner/initial_registers.h"

namespace ninebit {
namespace {

constexpr ColorBytes kWhite{255, 255, 255, 255};

// Whether a stage may replace depths, which then are not known when fragments are made.
bool replaces_depth(const PipelineState& state) {
  if (!state.texture_shader.enabled) return false;
  const auto& stage = state.texture_shader.stage;
  return std::any_of(stage.begin(), stage.end(),
                     [](const TextureStage& s) { return s.operation == TextureOperation::dot_product_depth_replace; });
}

// Whether primitives of a type may be drawn as lines or as points.
bool draws(const PipelineState& state, PrimitiveType type, PolygonMode mode) {
  using enum PrimitiveType;
  if (type == points) return mode == PolygonMode::point;
  if (type == lines || type == line_strip || type == line_loop) return mode == PolygonMode::line;
  return state.front_mode == mode || state.back_mode == mode;
}

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

// The change of s/q from texel to texel; 0 for a cube map, whose direction has no such change.
float texel_width(const Texture& texture) {
  if (texture.target == TextureTarget::cube_map) return 0.0F;
  const bool counts_texels = texture.target == TextureTarget::rectangle;
  return counts_texels ? 1.0F : 1.0F / static_cast<float>(texture.faces[0][0].width);
}

}  // namespace

StageUnits stage_units(std::span<const TextureUnit> units) {
  StageUnits taken;
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    taken.texture[unit] = units[unit].texture;
    taken.sampler[unit] = units[unit].sampler;
  }
  return taken;
}

DrawContext::DrawContext(const PipelineState& pipeline, const VertexArrays& vertices,
                         std::span<const TextureUnit> units, const RenderTarget& target, bool for_probe)
    : state(pipeline),
      arrays(vertices),
      assembly(vertices),
      operations(pipeline, target, !for_probe && !replaces_depth(pipeline)),
      outputs(target),
      depth(target.format, state.profile.depth_narrowing, state.float_depth_one),
      largest_depth(max_depth(target.format)),
      draws_lines(draws(pipeline, assembly.type(), PolygonMode::line)),
      draws_points(draws(pipeline, assembly.type(), PolygonMode::point)) {
  state.texture_shader.enabled ? prepare_stages(units) : prepare_units(units);
  has_flat_result = !for_probe && !stages_decide && !kills_by_key && !state.polygon_smooth &&
                    !(state.line_smooth && draws_lines) && outputs.need_fragment_alone() &&
                    (!operations.needs_color() || (!state.program && shades_flat(arrays.vertex_colors)));
  fills_registers =
      for_probe || kills_by_key || state.program.has_value() || outputs.needs_registers() || outputs.needs_output();
  initial = initial_of(*this);
  prepare_program(target, for_probe);
}

void DrawContext::prepare_units(std::span<const TextureUnit> units) {
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    if (units[unit].texture == nullptr) continue;
    samplers[unit] = TextureSampler::make(state.profile, *units[unit].texture, units[unit].sampler);
    if (!samplers[unit]) continue;
    kills_by_key = kills_by_key || samplers[unit]->kills();
    cylinder[unit] = cylinder_of(units[unit].sampler);
    if (!samplers[unit]->needs_derivatives()) continue;
    needs_texture_changes = true;
    point_change[unit] = texel_width(*units[unit].texture);
  }
}

void DrawContext::prepare_stages(std::span<const TextureUnit> units) {
  auto made = TextureStages::make(state.profile, state.texture_shader, stage_units(units));
  stages = *std::move(made);  // the state has been checked
  stages_decide = stages->culls() || stages->replaces_depth();
  needs_texture_changes = stages->needs_derivatives();
  for (std::size_t unit = 0; unit < units.size(); ++unit) {
    const ProgramTextureStage& stage = stages->program().stage[unit];
    const TextureOperationInfo& info = info_of(stage.state.operation);
    const bool is_plain = info.target != StageTarget::none && info.input == StageInput::none;
    cylinder[unit] = cylinder_of(units[unit].sampler);
    if (is_plain && stage.inconsistent.empty()) point_change[unit] = texel_width(*units[unit].texture);
  }
}

bool DrawContext::gives_signed_codes() const {
  const auto is_signed = [](const auto& sampler) { return sampler && sampler->gives_signed_codes(); };
  if (!stages) return std::any_of(samplers.begin(), samplers.end(), is_signed);
  const auto& stage = stages->program().stage;
  return std::any_of(stage.begin(), stage.end(), [](const ProgramTextureStage& s) {
    return std::find(s.is_signed.begin(), s.is_signed.end(), true) != s.is_signed.end();
  });
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
    program.emplace(*state.program, wanted, ComponentSet{},
                    gives_signed_codes() ? BatchInputs::any_codes : BatchInputs::not_negative);
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
    const bool kills = samplers[unit] && samplers[unit]->kills();
    reads_unit[unit] = (stages || samplers[unit]) && (reads[reg] || as_spare0 || kills);
  }
}

ColorBytes DrawContext::flat_primary_of_vertex(std::uint32_t primitive) const {
  if (!arrays.vertex_colors.empty()) return arrays.vertex_colors[assembly.provoking_vertex(primitive)];
  return kWhite;
}

}  // namespace ninebit
