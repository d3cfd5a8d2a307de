// Programs: compile, evaluate for one fragment or many, trace, emit GLSL.
#include <algorithm>
#include <cstddef>
#include <memory>

#include "ninebit/combiner/evaluate_arrays.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/trace_json.h"
#include "ninebit/texture_shader/validate_stages.h"
#include "src/capi/handles.h"
#include "src/texture_shader/given_stages.h"

static_assert(NINEBIT_REGISTERS == ninebit::kRegisterCount);
static_assert(NINEBIT_TEXTURE3 == static_cast<int>(ninebit::Register::texture3));
static_assert(NINEBIT_FOG == static_cast<int>(ninebit::Register::fog));
static_assert(NINEBIT_SPARE0 == static_cast<int>(ninebit::Register::spare0));

namespace ninebit::capi {
namespace {

constexpr bool is_read(std::size_t reg) {
  return reg >= NINEBIT_FOG;  // all but zero and the constants
}

bool in_range(const Program& program, int code) {
  return code >= program.datapath.lowest && code <= program.datapath.one;
}

ninebit_result out_of_range(const Program& program, int code, char** error) {
  return wrong_argument("code " + std::to_string(code) + " is out of range; expected " +
                            std::to_string(program.datapath.lowest) + " to " + std::to_string(program.datapath.one),
                        error);
}

void write_registers(const RegisterFile& from, ninebit_registers& to) {
  for (std::size_t r = 0; r < kRegisterCount; ++r) std::copy(from.value[r].begin(), from.value[r].end(), to.code[r]);
}

FragmentArrays arrays_of(const ninebit_planes& planes) {
  FragmentArrays samples{.count = planes.count};
  constexpr std::ptrdiff_t kStride = sizeof(int16_t);
  for (std::size_t r = NINEBIT_FOG; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) samples.input[r][c] = {planes.input[r][c], kStride};
  }
  for (std::size_t c = 0; c < 4; ++c) samples.color[c] = {planes.color[c], kStride};
  return samples;
}

}  // namespace

ninebit_result read_registers(const ninebit_program& program, const ninebit_registers* from, RegisterFile& to,
                              char** error) {
  if (from == nullptr || from->struct_size < kRegistersSize) {
    return wrong_argument("registers is NULL, or its struct_size is not set", error);
  }
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    if (!is_read(r)) continue;
    for (std::size_t c = 0; c < 4; ++c) {
      const int16_t code = from->code[r][c];
      if (!in_range(program.program, code)) return out_of_range(program.program, code, error);
      to.value[r][c] = code;
    }
  }
  return NINEBIT_OK;
}

}  // namespace ninebit::capi

using namespace ninebit::capi;

ninebit_result ninebit_compile(const ninebit_state* state, ninebit_program** program, char** error) {
  return guarded(error, [&] {
    if (program == nullptr) return wrong_argument("program is NULL", error);
    *program = nullptr;
    if (state == nullptr) return wrong_argument("state is NULL", error);
    const auto* const profile = ninebit::find_profile(state->context.profile().name);
    if (const auto wrong = ninebit::validate(state->context.texture_shader(), *profile); !wrong.empty()) {
      return invalid_input(wrong.front().message, error);
    }
    const auto compiled = ninebit::compile(state->context.state(), *profile);
    if (!compiled) return invalid_input(compiled.error().text(), error);
    std::unique_ptr<ninebit_program> made(
        new ninebit_program{.profile = profile, .program = *compiled, .batch = ninebit::BatchProgram(*compiled)});
    if (state->context.texture_shader().enabled) {
      made->stages = ninebit::compile_for_given(state->context.texture_shader(), *profile).value();
    }
    *program = made.release();
    return NINEBIT_OK;
  });
}

void ninebit_program_free(ninebit_program* program) {
  delete program;
}

int ninebit_one(const ninebit_program* program) {
  return program == nullptr ? 0 : program->program.datapath.one;
}

int ninebit_lowest(const ninebit_program* program) {
  return program == nullptr ? 0 : program->program.datapath.lowest;
}

ninebit_result ninebit_initial_registers(const ninebit_program* program, const ninebit_inputs* inputs,
                                         ninebit_registers* registers, char** error) {
  return guarded(error, [&] {
    if (program == nullptr) return wrong_argument("program is NULL", error);
    if (inputs == nullptr || inputs->struct_size < kInputsSize) {
      return wrong_argument("inputs is NULL, or its struct_size is not set", error);
    }
    if (registers == nullptr || registers->struct_size < kRegistersSize) {
      return wrong_argument("registers is NULL, or its struct_size is not set", error);
    }
    ninebit::FragmentInputs in;
    std::copy_n(inputs->primary, 4, in.primary.begin());
    std::copy_n(inputs->secondary, 4, in.secondary.begin());
    std::copy_n(inputs->fog_color, 3, in.fog_color.begin());
    if (inputs->fog_enabled != 0) in.fog_factor = inputs->fog_factor;
    for (std::size_t unit = 0; unit < 4; ++unit) {
      if (inputs->texture_enabled[unit] == 0) continue;
      ninebit::Texel& texel = in.texture[unit].emplace();
      std::copy_n(inputs->texture[unit], 4, texel.value.begin());
    }
    write_registers(ninebit::initial_registers(*program->profile, in), *registers);
    return NINEBIT_OK;
  });
}

ninebit_result ninebit_evaluate(const ninebit_program* program, const ninebit_registers* registers, int16_t color[4],
                                ninebit_registers* after, char** error) {
  return guarded(error, [&] {
    if (program == nullptr) return wrong_argument("program is NULL", error);
    if (color == nullptr) return wrong_argument("color is NULL", error);
    if (after != nullptr && after->struct_size < kRegistersSize) {
      return wrong_argument("the struct_size of after is not set", error);
    }
    ninebit::RegisterFile file;
    if (const ninebit_result read = read_registers(*program, registers, file, error); read != NINEBIT_OK) return read;
    const ninebit::EvaluatedFragment done = ninebit::evaluate_fragment(program->program, file);
    std::copy(done.color.begin(), done.color.end(), color);
    if (after != nullptr) write_registers(done.registers, *after);
    return NINEBIT_OK;
  });
}

ninebit_result ninebit_run_stages(const ninebit_program* program, const float at[16], ninebit_read_texel read_texel,
                                  void* data, ninebit_registers* registers, ninebit_fate* fate, char** error) {
  return guarded(error, [&] {
    if (program == nullptr) return wrong_argument("program is NULL", error);
    if (at == nullptr || read_texel == nullptr) return wrong_argument("at or read_texel is NULL", error);
    if (registers == nullptr || registers->struct_size < kRegistersSize) {
      return wrong_argument("registers is NULL, or its struct_size is not set", error);
    }
    if (fate != nullptr && fate->struct_size < kFateSize) {
      return wrong_argument("the struct_size of fate is not set", error);
    }
    if (!program->stages) return invalid_input("the program has no texture-shader stages", error);
    ninebit::StageInputs inputs;
    for (std::size_t unit = 0; unit < inputs.at.size(); ++unit) std::copy_n(at + 4 * unit, 4, inputs.at[unit].begin());
    inputs.right = inputs.above = inputs.at;
    const auto result = ninebit::evaluate(*program->stages, *program->profile, inputs,
                                          [&](int unit, const ninebit::TexturePlace& place) {
                                            ninebit::Bytes4 texel{};
                                            read_texel(data, unit, place.at.data(), texel.data());
                                            return texel;
                                          });
    for (std::size_t unit = 0; unit < result.stage.size(); ++unit) {
      const ninebit::Rgba9& codes = result.stage[unit].codes;
      std::copy(codes.begin(), codes.end(), registers->code[NINEBIT_TEXTURE0 + unit]);
    }
    registers->code[NINEBIT_SPARE0][3] = registers->code[NINEBIT_TEXTURE0][3];
    if (fate == nullptr) return NINEBIT_OK;
    fate->culled = result.is_culled ? 1 : 0;
    fate->depth_is_set = result.depth ? 1 : 0;
    fate->depth = result.depth.value_or(0.0F);
    return NINEBIT_OK;
  });
}

ninebit_result ninebit_evaluate_planes(const ninebit_program* program, const ninebit_planes* planes, char** error) {
  return guarded(error, [&] {
    if (program == nullptr) return wrong_argument("program is NULL", error);
    if (planes == nullptr || planes->struct_size < kPlanesSize) {
      return wrong_argument("planes is NULL, or its struct_size is not set", error);
    }
    const ninebit::FragmentArrays samples = arrays_of(*planes);
    if (const auto wrong = ninebit::find_code_out_of_range(program->program, samples)) {
      return out_of_range(program->program, wrong->code, error);
    }
    ninebit::evaluate(program->batch, samples, 0, samples.count);
    return NINEBIT_OK;
  });
}

ninebit_result ninebit_trace_json(const ninebit_program* program, const ninebit_registers* registers, char** json,
                                  char** error) {
  return guarded(error, [&] {
    if (json == nullptr) return wrong_argument("json is NULL", error);
    *json = nullptr;
    if (program == nullptr) return wrong_argument("program is NULL", error);
    ninebit::RegisterFile file;
    if (const ninebit_result read = read_registers(*program, registers, file, error); read != NINEBIT_OK) return read;
    const ninebit::Trace traced = ninebit::trace(program->program, *program->profile, file);
    return give(ninebit::print_json_trace(program->program, traced), json, error);
  });
}

ninebit_result ninebit_emit_glsl(const ninebit_program* program, int version, const char* function, char** glsl,
                                 char** error) {
  return guarded(error, [&] {
    if (glsl == nullptr) return wrong_argument("glsl is NULL", error);
    *glsl = nullptr;
    if (program == nullptr) return wrong_argument("program is NULL", error);
    if (version != 330 && version != 300) return wrong_argument("version is neither 330 nor 300", error);
    const auto target = version == 330 ? ninebit::GlslVersion::glsl_330 : ninebit::GlslVersion::es_300;
    const auto text = ninebit::emit_glsl(program->program, target, function == nullptr ? "ninebit_combine" : function);
    if (!text) return invalid_input(text.error().text(), error);
    return give(*text, glsl, error);
  });
}
