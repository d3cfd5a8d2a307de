#include "src/gl_layer/draw/draw_state.h"

#include <algorithm>

#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"
#include "src/gl_layer/shader/program_cache.h"

namespace ninebit::gl_layer {
namespace {

// The target that the active unit samples, in OpenGL's order of precedence.
UnitSource enabled_target(const DriverFeatures& features) {
  if (driver_enables(GL_TEXTURE_CUBE_MAP)) return UnitSource::texture_cube_map;
  if (driver_enables(GL_TEXTURE_3D)) return UnitSource::texture_3d;
  if (features.rectangle && driver_enables(GL_TEXTURE_RECTANGLE)) return UnitSource::texture_rectangle;
  if (driver_enables(GL_TEXTURE_2D)) return UnitSource::texture_2d;
  if (driver_enables(GL_TEXTURE_1D)) return UnitSource::texture_1d;
  return UnitSource::disabled;
}

UnitSource source_of(ShaderOperation operation) {
  switch (operation) {
    case ShaderOperation::none:
      return UnitSource::zero;
    case ShaderOperation::texture_1d:
      return UnitSource::texture_1d;
    case ShaderOperation::texture_2d:
      return UnitSource::texture_2d;
    case ShaderOperation::texture_rectangle:
      return UnitSource::texture_rectangle;
    case ShaderOperation::texture_3d:
      return UnitSource::texture_3d;
    case ShaderOperation::texture_cube_map:
      return UnitSource::texture_cube_map;
    case ShaderOperation::pass_through:
      return UnitSource::pass_through;
    case ShaderOperation::cull_fragment:
      break;
  }
  return UnitSource::cull_fragment;
}

GLenum target_of(UnitSource source) {
  switch (source) {
    case UnitSource::texture_1d:
      return GL_TEXTURE_1D;
    case UnitSource::texture_2d:
      return GL_TEXTURE_2D;
    case UnitSource::texture_rectangle:
      return GL_TEXTURE_RECTANGLE;
    case UnitSource::texture_3d:
      return GL_TEXTURE_3D;
    case UnitSource::texture_cube_map:
      return GL_TEXTURE_CUBE_MAP;
    default:
      return GL_NONE;
  }
}

// A level parameter of the texture that the active unit has bound.
TexelKind texel_kind(UnitSource source) {
  const GLenum target = target_of(source);
  if (target == GL_NONE) return TexelKind::color;
  GLint base = 0, depth_bits = 0, compare = GL_NONE, mode = GL_LUMINANCE;
  found_driver.GetTexParameteriv(target, GL_TEXTURE_BASE_LEVEL, &base);
  if (base < 0 || base > 16) return TexelKind::color;
  const GLenum image = target == GL_TEXTURE_CUBE_MAP ? GLenum{GL_TEXTURE_CUBE_MAP_POSITIVE_X} : target;
  found_driver.GetTexLevelParameteriv(image, base, GL_TEXTURE_DEPTH_SIZE, &depth_bits);
  if (depth_bits == 0) return TexelKind::color;
  found_driver.GetTexParameteriv(target, GL_TEXTURE_COMPARE_MODE, &compare);
  found_driver.GetTexParameteriv(target, GL_DEPTH_TEXTURE_MODE, &mode);
  if (mode == GL_ALPHA) return compare == GL_NONE ? TexelKind::depth_in_alpha : TexelKind::comparison_in_alpha;
  return compare == GL_NONE ? TexelKind::depth : TexelKind::comparison;
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

ShaderInputs find_inputs(const Context& context) {
  ShaderInputs inputs;
  const auto active = static_cast<GLenum>(driver_integer(GL_ACTIVE_TEXTURE));
  const auto units = std::min(kLayerUnits, static_cast<std::size_t>(context.combiners.profile().texture_units.value));
  for (std::size_t i = 0; i < units; ++i) {
    found_driver.ActiveTexture(GL_TEXTURE0 + static_cast<GLenum>(i));
    UnitInput& unit = inputs.units[i];
    const UnitShader& shader = context.texture_shaders.units[i];
    unit.source = context.texture_shaders.enabled ? source_of(shader.operation) : enabled_target(context.features);
    unit.kind = texel_kind(unit.source);
    if (unit.source == UnitSource::cull_fragment) unit.cull_if_less = shader.cull_if_less;
  }
  found_driver.ActiveTexture(active);
  inputs.fog = fog_factor();
  // Lighting with a single colour has no secondary colour; without lighting it is the current one.
  const bool lit =
      driver_enables(GL_LIGHTING) && !(context.features.vertex_program && driver_enables(GL_VERTEX_PROGRAM_ARB));
  inputs.secondary = !lit || driver_integer(GL_LIGHT_MODEL_COLOR_CONTROL) != GL_SINGLE_COLOR;
  inputs.write_inputs = context.writes_inputs;
  return inputs;
}

bool reads(const Program& program, Register reg) {
  for (int i = 0; i < program.num_general_combiners; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    if (detail::reads(stage.rgb, reg) || detail::reads(stage.alpha, reg)) return true;
  }
  const FinalCombiner& f = program.final_combiner;
  return detail::reads_directly(f, reg) || f.e.reg == reg || f.f.reg == reg;
}

// Textures that the program does not read make no other shader. Unit 0 also gives spare0 its alpha.
ShaderInputs inputs_of(const Program& program, ShaderInputs inputs) {
  for (std::size_t i = 1; i < kLayerUnits; ++i) {
    UnitInput& unit = inputs.units[i];
    const bool read = reads(program, static_cast<Register>(static_cast<std::size_t>(Register::texture0) + i));
    if (!read && !inputs.write_inputs && unit.source != UnitSource::cull_fragment) unit = UnitInput{};
  }
  return inputs;
}

// Whether combiners compute the colour; finds the inputs again if they may have changed.
bool combiners_apply(Context& context) {
  if (!context.combiners.register_combiners_enabled()) return false;
  if (context.app_program != 0) {
    log_once("combiners are enabled while shaders of the program itself are current: its shaders draw");
    return false;
  }
  if (context.inputs_stale) {
    context.own_fragments = context.features.fragment_program && driver_enables(GL_FRAGMENT_PROGRAM_ARB);
    const ShaderInputs inputs = find_inputs(context);
    context.program_stale = context.program_stale || !(inputs == context.inputs);
    context.inputs = inputs;
    context.inputs_stale = false;
  }
  return !context.own_fragments;
}

void draw_without_combiners(Context& context) {
  if (context.bound) found_driver.UseProgram(context.app_program);
  context.bound = false;
  context.program = nullptr;
}

void use(Context& context, CachedProgram& cached) {
  if (!context.bound || context.program != &cached) found_driver.UseProgram(cached.driver_program);
  context.program = &cached;
  context.bound = true;
}

void upload_constants(CachedProgram& cached, const ConstantCodes& codes) {
  if (cached.constants < 0 || cached.uploaded == codes) return;
  found_driver.Uniform4iv(cached.constants, kGlslConstants, codes.front().data());
  cached.uploaded = codes;
}

}  // namespace

bool needs_preparation(const Context& context) {
  if (!context.touched) return false;
  if (!context.combiners.register_combiners_enabled()) return context.bound;
  return !context.bound || context.inputs_stale || context.program_stale || context.constants_stale;
}

void prepare_draw(Context& context) {
  if (!context.touched) return;
  if (!combiners_apply(context)) return draw_without_combiners(context);
  if (context.program == nullptr || context.program_stale || context.constants_stale) {
    const HardwareProfile& profile = context.combiners.profile();
    const Program program = normalize(context.combiners.state(), profile);
    CachedProgram* cached = context.program;
    if (cached == nullptr || context.program_stale) {
      const std::size_t known = context.programs->size();
      cached = &context.programs->find(without_constants(program), profile, inputs_of(program, context.inputs));
      if (context.programs->size() != known) context.bound = false;  // the driver has another program current
    }
    context.program_stale = context.constants_stale = false;
    if (cached->driver_program == 0) {
      context.bound = true;  // whichever is current, it is not the one that belongs there
      draw_without_combiners(context);
      context.program = cached;
      return;
    }
    use(context, *cached);
    upload_constants(*cached, constant_codes(program));
  } else if (context.program->driver_program != 0) {
    use(context, *context.program);
  }
}

void count_draw(const Context& context) {
  if (context.program != nullptr) ++*context.program->draws;
}

}  // namespace ninebit::gl_layer
