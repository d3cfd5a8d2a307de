#include "src/gl_layer/draw/draw_state.h"

#include <algorithm>

#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"
#include "src/gl_layer/driver/lookups.h"
#include "src/gl_layer/shader/environment.h"
#include "src/gl_layer/shader/program_cache.h"
#include "src/gl_layer/shader/texture_formats.h"

namespace ninebit::gl_layer {
namespace {

// The target that the active unit samples, in OpenGL's order of precedence.
StageTarget enabled_target(const DriverFeatures& features) {
  if (driver_enables(GL_TEXTURE_CUBE_MAP)) return StageTarget::cube_map;
  if (driver_enables(GL_TEXTURE_3D)) return StageTarget::three_dimensional;
  if (features.rectangle && driver_enables(GL_TEXTURE_RECTANGLE)) return StageTarget::rectangle;
  if (driver_enables(GL_TEXTURE_2D)) return StageTarget::two_dimensional;
  if (driver_enables(GL_TEXTURE_1D)) return StageTarget::one_dimensional;
  return StageTarget::none;
}

TexelKind depth_kind(GLenum target) {
  GLint compare = GL_NONE, mode = GL_LUMINANCE;
  found_driver.GetTexParameteriv(target, GL_TEXTURE_COMPARE_MODE, &compare);
  found_driver.GetTexParameteriv(target, GL_DEPTH_TEXTURE_MODE, &mode);
  if (mode == GL_ALPHA) return compare == GL_NONE ? TexelKind::depth_in_alpha : TexelKind::comparison_in_alpha;
  return compare == GL_NONE ? TexelKind::depth : TexelKind::comparison;
}

// The texture that the active unit has bound to a target.
UnitInput unit_input(StageTarget of) {
  UnitInput unit{.target = of};
  const GLenum target = gl_target(of);
  if (target == GL_NONE) return unit;
  unit.depth_bits = base_level_value(target, GL_TEXTURE_DEPTH_SIZE);
  unit.kind = unit.depth_bits != 0
                  ? depth_kind(target)
                  : kind_of_stored_format(static_cast<GLenum>(base_level_value(target, GL_TEXTURE_INTERNAL_FORMAT)));
  return unit;
}

GLenum binding_of(GLenum target) {
  switch (target) {
    case GL_TEXTURE_1D:
      return GL_TEXTURE_BINDING_1D;
    case GL_TEXTURE_3D:
      return GL_TEXTURE_BINDING_3D;
    case GL_TEXTURE_CUBE_MAP:
      return GL_TEXTURE_BINDING_CUBE_MAP;
    case GL_TEXTURE_RECTANGLE:
      return GL_TEXTURE_BINDING_RECTANGLE;
    default:
      return GL_TEXTURE_BINDING_2D;
  }
}

// Asking for all levels takes the driver some microseconds, so the answer is kept until an image may have changed.
bool is_complete(Context& context, GLenum target) {
  const BaseImage base = base_image(target, context.features);
  if (unseen_image_calls_looked_up()) return has_all_levels(target, base);
  // Where the driver makes the levels, any change of texels makes them.
  GLint makes_levels = GL_FALSE;
  found_driver.GetTexParameteriv(target, GL_GENERATE_MIPMAP, &makes_levels);
  if (makes_levels != GL_FALSE) return has_all_levels(target, base);
  StageCache& cache = context.stage_cache;
  const std::uint64_t now = context.group->images_changed;
  if (cache.images_changed != now) cache.levels.clear();
  cache.images_changed = now;
  const auto name = static_cast<unsigned>(driver_integer(binding_of(target)));
  const auto [known, is_new] = cache.levels.try_emplace({target, name});
  if (is_new || known->second.seen != base.values()) {
    known->second = {.seen = base.values(), .complete = has_all_levels(target, base)};
  }
  return known->second.complete;
}

// A texture as the rules of consistency see it.
std::optional<StageTexture> stage_texture(Context& context, const UnitInput& unit) {
  const GLenum target = gl_target(unit.target);
  if (target == GL_NONE || !is_complete(context, target)) return std::nullopt;
  StageTexture texture{.target = unit.target};
  switch (unit.kind) {
    case TexelKind::color:
      break;
    case TexelKind::depth:
    case TexelKind::depth_in_alpha:
      texture.format = TextureFormat::depth;
      break;
    case TexelKind::comparison:
    case TexelKind::comparison_in_alpha:
      texture.format = TextureFormat::depth_comparison;
      break;
    case TexelKind::signed_color:
      texture.is_signed = {true, true, true, true};
      break;
    case TexelKind::signed_rgb_unsigned_alpha:
      texture.is_signed = {true, true, true, false};
      break;
    case TexelKind::hilo:
    case TexelKind::signed_hilo:
      texture.format = TextureFormat::hilo;
      if (unit.kind == TexelKind::signed_hilo) texture.is_signed = {true, true, true, true};
      break;
    case TexelKind::dsdt:
      texture.format = TextureFormat::dsdt;
      break;
    case TexelKind::dsdt_mag:
      texture.format = TextureFormat::dsdt_mag;
      break;
    case TexelKind::dsdt_mag_intensity:
      texture.format = TextureFormat::dsdt_mag_intensity;
      break;
  }
  return texture;
}

// Calls a function with each unit's number while the unit is active.
template <class Visit>
void visit_units(const Context& context, const Visit& visit) {
  const auto active = static_cast<GLenum>(driver_integer(GL_ACTIVE_TEXTURE));
  const auto units = std::min(kLayerUnits, static_cast<std::size_t>(context.combiners.profile().texture_units.value));
  for (std::size_t i = 0; i < units; ++i) {
    found_driver.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    visit(i);
  }
  found_driver.ActiveTexture(active);
}

// The stages with the textures that are bound. Numbers that are uniforms are the defaults, so that equal stages make
// one shader.
StageTextures stage_textures(Context& context, std::array<UnitInput, kLayerUnits>& units) {
  StageTextures textures;
  visit_units(context, [&](std::size_t i) {
    units[i] = unit_input(info_of(context.combiners.texture_shader().stage[i].operation).target);
    textures[i] = stage_texture(context, units[i]);
  });
  return textures;
}

TextureShaderProgram compile_stages(const Context& context, const StageTextures& textures) {
  TextureShaderState state = context.combiners.texture_shader();
  for (TextureStage& stage : state.stage) {
    stage.matrix = TextureStage{}.matrix;
    stage.scale = TextureStage{}.scale;
    stage.bias = TextureStage{}.bias;
    stage.eye = TextureStage{}.eye;
  }
  auto program = compile(state, textures, context.combiners.profile());
  if (!program) {  // gl_nv refuses what compile() would
    log_once("texture shaders: " + program.error().message);
    return {};
  }
  return *program;
}

// Finds the stages and the textures that they read. Those of the last draw stay if nothing of them has changed.
void find_stages(Context& context, ShaderInputs& inputs) {
  const StageTextures textures = stage_textures(context, inputs.units);
  const bool same = !context.program_stale && textures == context.stage_cache.textures && context.inputs.stages;
  if (same) {
    inputs.stages = context.inputs.stages;
  } else {
    inputs.stages = compile_stages(context, textures);
    context.stage_cache.textures = textures;
    for (const std::string& warning : inputs.stages->warnings()) log_once(warning);
  }
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    if (!inputs.stages->stage[i].inconsistent.empty()) inputs.units[i] = {};
  }
}

FogFactor fog_factor() {
  if (!driver_enables(GL_FOG)) return FogFactor::off;
  switch (driver_integer(GL_FOG_MODE)) {
    case GL_LINEAR:
      return FogFactor::linear;
    case GL_EXP:
      return FogFactor::exp;
    default:
      return FogFactor::exp2;
  }
}

// Whether a stage gives a colour that a texture environment uses. That HILO and DSDT texels leave the colour as it is
// is inferred from programs that use them so.
bool has_color(const TextureShaderProgram& stages, std::size_t i) {
  const ProgramTextureStage& stage = stages.stage[i];
  const TextureOperation operation = stage.state.operation;
  const bool has_texel = info_of(operation).target != StageTarget::none || operation == TextureOperation::pass_through;
  return has_texel && stage.is_visible[kRed];
}

ShaderInputs find_inputs(Context& context) {
  ShaderInputs inputs;
  if (context.combiners.texture_shader().enabled) {
    find_stages(context, inputs);
  } else {
    visit_units(context, [&](std::size_t i) { inputs.units[i] = unit_input(enabled_target(context.features)); });
  }
  if (!context.combiners.register_combiners_enabled()) {
    inputs.environments.emplace();
    visit_units(context, [&](std::size_t i) {
      if (context.no_environment[i]) return;
      if (has_color(*inputs.stages, i)) (*inputs.environments)[i] = read_environment(inputs.units[i].target);
    });
  }
  inputs.fog = fog_factor();
  // Lighting with a single colour has no secondary colour; without lighting it is the current one.
  const bool lit =
      driver_enables(GL_LIGHTING) && !(context.features.vertex_program && driver_enables(GL_VERTEX_PROGRAM_ARB));
  inputs.secondary = !lit || driver_integer(GL_LIGHT_MODEL_COLOR_CONTROL) != GL_SINGLE_COLOR;
  if (inputs.environments) inputs.color_sum = lit ? inputs.secondary : driver_enables(GL_COLOR_SUM);
  inputs.write_inputs = context.writes_inputs && !inputs.environments;
  return inputs;
}

// Textures that the program does not read make no other shader. Unit 0 also gives spare0 its alpha. Stages read each
// other, cull fragments and replace depths.
ShaderInputs inputs_of(const Program& program, ShaderInputs inputs) {
  if (inputs.stages) return inputs;
  for (std::size_t i = 1; i < kLayerUnits; ++i) {
    UnitInput& unit = inputs.units[i];
    const bool read =
        detail::program_reads(program, static_cast<Register>(static_cast<std::size_t>(Register::texture0) + i));
    if (!read && !inputs.write_inputs) unit = UnitInput{};
  }
  return inputs;
}

// Whether a shader of the layer computes the colour; finds the inputs again if they may have changed.
bool combiners_apply(Context& context) {
  if (!computes_colors(context)) return false;
  if (context.app_program != 0) {
    log_once(
        "combiners or texture shaders are enabled while shaders of the program itself are current: its shaders draw");
    return false;
  }
  if (!context.inputs_stale && context.fog_stale) {
    const FogFactor fog = fog_factor();
    context.inputs_changed = context.inputs_changed || fog != context.inputs.fog;
    context.inputs.fog = fog;
  }
  if (context.inputs_stale) {
    context.own_fragments = context.features.fragment_program && driver_enables(GL_FRAGMENT_PROGRAM_ARB);
    ShaderInputs inputs = find_inputs(context);
    if (!(inputs == context.inputs)) {
      context.inputs = std::move(inputs);
      context.inputs_changed = true;
      context.of_fog = {};
    }
    context.inputs_stale = false;
  }
  context.fog_stale = false;
  return !context.own_fragments;
}

void draw_without_combiners(Context& context) {
  if (context.bound) found_driver.UseProgram(context.app_program);
  context.bound = false;
  context.program = nullptr;
}

void use(Context& context, CachedProgram& cached) {
  note_use(Asked::combiners);
  if (!context.bound || context.program != &cached) found_driver.UseProgram(cached.driver_program);
  context.program = &cached;
  context.bound = true;
}

void upload_constants(CachedProgram& cached, const ConstantCodes& codes) {
  if (cached.constants < 0 || cached.uploaded == codes) return;
  found_driver.Uniform4iv(cached.constants, kGlslConstants, codes.front().data());
  cached.uploaded = codes;
}

void upload_stage_numbers(CachedProgram& cached, const TextureShaderState& state) {
  if (!cached.inputs.stages) return;
  StageUniforms numbers;
  auto& [matrices, scales, eyes] = numbers;
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const TextureStage& stage = state.stage[i];
    std::copy(stage.matrix.begin(), stage.matrix.end(), &matrices[4 * i]);
    scales[2 * i] = stage.scale;
    scales[2 * i + 1] = stage.bias;
    std::copy(stage.eye.begin(), stage.eye.end(), &eyes[3 * i]);
  }
  if (cached.uploaded_stages == numbers) return;
  cached.uploaded_stages = numbers;
  constexpr auto kUnits = static_cast<GLsizei>(kLayerUnits);
  found_driver.Uniform4fv(cached.stage_numbers[0], kUnits, matrices.data());  // a location of -1 is ignored
  found_driver.Uniform2fv(cached.stage_numbers[1], kUnits, scales.data());
  found_driver.Uniform3fv(cached.stage_numbers[2], kUnits, eyes.data());
}

}  // namespace

bool computes_colors(const Context& context) {
  return context.combiners.register_combiners_enabled() || context.combiners.texture_shader().enabled;
}

bool needs_preparation(const Context& context) {
  if (!context.touched) return false;
  if (!computes_colors(context)) return context.bound;
  return !context.bound || context.inputs_stale || context.fog_stale || context.inputs_changed ||
         context.program_stale || context.constants_stale;
}

void prepare_draw(Context& context) {
  if (!context.touched) return;
  if (!combiners_apply(context)) return draw_without_combiners(context);
  if (context.program == nullptr || context.inputs_changed || context.program_stale || context.constants_stale) {
    const HardwareProfile& profile = context.combiners.profile();
    if (context.program_stale || context.constants_stale) {
      // Environments need no combiners; one program stands for all.
      context.shown = normalize(context.inputs.environments ? CombinerState{} : context.combiners.state(), profile);
    }
    const Program& program = context.shown;
    CachedProgram* cached = context.program;
    if (cached == nullptr || context.inputs_changed || context.program_stale) {
      if (context.program_stale) context.of_fog = {};
      CachedProgram*& of_fog = context.of_fog[static_cast<std::size_t>(context.inputs.fog)];
      const std::size_t known = context.programs->size();
      if (of_fog == nullptr) {
        of_fog = &context.programs->find(without_constants(program), profile, inputs_of(program, context.inputs));
      }
      cached = of_fog;
      if (context.programs->size() != known) context.bound = false;  // the driver has another program current
    }
    context.inputs_changed = context.program_stale = context.constants_stale = false;
    if (cached->driver_program == 0) {
      context.bound = true;  // whichever is current, it is not the one that belongs there
      draw_without_combiners(context);
      context.program = cached;
      return;
    }
    use(context, *cached);
    upload_constants(*cached, constant_codes(program));
    upload_stage_numbers(*cached, context.combiners.texture_shader());
  } else if (context.program->driver_program != 0) {
    use(context, *context.program);
  }
}

bool is_consistent(Context& context, int unit) {
  std::array<UnitInput, kLayerUnits> units{};
  return compile_stages(context, stage_textures(context, units))
      .stage[static_cast<std::size_t>(unit)]
      .inconsistent.empty();
}

void count_draw(const Context& context) {
  if (context.program != nullptr) ++*context.program->draws;
}

}  // namespace ninebit::gl_layer
