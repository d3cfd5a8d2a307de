#include "src/gl_layer/shader/program_cache.h"

#include <atomic>
#include <string>

#include "src/gl_layer/driver/driver.h"
#include "src/gl_layer/driver/log.h"
#include "src/gl_layer/shader/fragment_shader.h"

namespace ninebit::gl_layer {
namespace {

std::string info_log(GLuint object, decltype(Driver::GetShaderiv) get, decltype(Driver::GetShaderInfoLog) get_log) {
  GLint length = 0;
  get(object, GL_INFO_LOG_LENGTH, &length);
  std::string text(static_cast<std::size_t>(length > 0 ? length : 0), '\0');
  if (!text.empty()) get_log(object, length, nullptr, text.data());
  return text;
}

// 0 if the driver refuses the text: then the log has it whole.
GLuint link(const std::string& text) {
  const Driver& driver = found_driver;
  const GLuint shader = driver.CreateShader(GL_FRAGMENT_SHADER);
  const GLchar* const source = text.c_str();
  driver.ShaderSource(shader, 1, &source, nullptr);
  driver.CompileShader(shader);
  GLint compiled = GL_FALSE, linked = GL_FALSE;
  driver.GetShaderiv(shader, GL_COMPILE_STATUS, &compiled);
  if (compiled == GL_FALSE) {
    log_line("the driver refuses this shader, so fixed functions draw instead:\n" + text +
             info_log(shader, driver.GetShaderiv, driver.GetShaderInfoLog));
    driver.DeleteShader(shader);
    return 0;
  }
  const GLuint program = driver.CreateProgram();
  driver.AttachShader(program, shader);
  driver.LinkProgram(program);
  driver.DetachShader(program, shader);
  driver.DeleteShader(shader);
  driver.GetProgramiv(program, GL_LINK_STATUS, &linked);
  if (linked != GL_FALSE) return program;
  log_line("the driver does not link this shader, so fixed functions draw instead:\n" + text +
           info_log(program, driver.GetProgramiv, driver.GetProgramInfoLog));
  driver.DeleteProgram(program);
  return 0;
}

void set_samplers(GLuint program) {
  found_driver.UseProgram(program);
  for (std::size_t i = 0; i < kLayerUnits; ++i) {
    const std::string name = "ninebit_texture" + std::to_string(i);
    const GLint location = found_driver.GetUniformLocation(program, name.c_str());
    if (location >= 0) found_driver.Uniform1i(location, static_cast<GLint>(i));
  }
}

class Hash {
 public:
  template <class... Values>
  void add(Values... values) {
    ((value_ = (value_ ^ static_cast<std::uint64_t>(values)) * 0x100000001B3U), ...);
  }
  // Small numbers as one: a hash is computed at every change of a program, and multiplications wait for each other.
  template <class... Values>
  void add_bytes(Values... values) {
    std::uint64_t all = 0;
    ((all = all << 8U | static_cast<std::uint64_t>(values)), ...);
    add(all ^ all >> 29U);
  }
  void add_input(const CombinerInput& in) { add_bytes(in.reg, in.mapping, in.usage); }
  void add_portion(const Portion& p) {
    add_bytes(p.a.reg, p.a.mapping, p.a.usage, p.b.reg, p.b.mapping, p.b.usage);
    add_bytes(p.c.reg, p.c.mapping, p.c.usage, p.d.reg, p.d.mapping, p.d.usage);
    add_bytes(p.out.ab, p.out.cd, p.out.sum, p.out.scale, p.out.bias, p.out.ab_dot_product, p.out.cd_dot_product,
              p.out.mux_sum);
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  std::uint64_t value_ = 0xCBF29CE484222325U;
};

std::size_t next_number() {
  static std::atomic<std::size_t> number{0};
  return ++number;
}

}  // namespace

Program without_constants(Program program) {
  for (ProgramStage& stage : program.general) stage.constant0 = stage.constant1 = {};
  program.constant0 = program.constant1 = {};
  return program;
}

ConstantCodes constant_codes(const Program& program) {
  ConstantCodes codes{};
  const auto set = [&](std::size_t stage, const Rgba9& constant0, const Rgba9& constant1) {
    for (std::size_t c = 0; c < 4; ++c) {
      codes[2 * stage][c] = constant0[c];
      codes[2 * stage + 1][c] = constant1[c];
    }
  };
  for (std::size_t i = 0; i < program.general.size(); ++i) {
    set(i, program.general[i].constant0, program.general[i].constant1);
  }
  set(program.general.size(), program.constant0, program.constant1);
  return codes;
}

std::uint64_t hash_of(const Program& program, const ShaderInputs& inputs) {
  Hash hash;
  hash.add(program.num_general_combiners, program.color_sum_clamp, inputs.fog, inputs.secondary, inputs.write_inputs);
  for (const UnitInput& unit : inputs.units) hash.add(unit.target, unit.kind);
  if (inputs.stages) {
    for (const ProgramTextureStage& stage : inputs.stages->stage) hash.add(stage.state.operation, stage.state.previous);
  }
  if (inputs.environments) {
    for (const Environment& one : *inputs.environments) hash.add(one.mode, one.format, one.rgb.function);
  }
  for (std::size_t i = 0; i < static_cast<std::size_t>(program.num_general_combiners); ++i) {
    hash.add_portion(program.general[i].rgb);
    hash.add_portion(program.general[i].alpha);
  }
  const FinalCombiner& f = program.final_combiner;
  for (const CombinerInput* in : {&f.a, &f.b, &f.c, &f.d, &f.e, &f.f, &f.g}) hash.add_input(*in);
  return hash.value();
}

ProgramCache::~ProgramCache() {
  for (const auto& [hash, candidates] : programs_) {
    for (const auto& cached : candidates) {
      if (cached->driver_program != 0) own_.abandon(cached->driver_program);
    }
  }
}

CachedProgram& ProgramCache::find(const Program& program, const HardwareProfile& profile, const ShaderInputs& inputs) {
  auto& candidates = programs_[hash_of(program, inputs)];
  for (const auto& cached : candidates) {
    if (cached->inputs == inputs && cached->program == program) return *cached;
  }
  auto added = std::make_unique<CachedProgram>(CachedProgram{.program = program, .inputs = inputs});
  added->number = next_number();
  const auto text = fragment_shader(program, profile, inputs);
  if (!text) {
    log_line("no shader for a program: " + text.error().message);
  } else if ((added->driver_program = link(*text)) != 0) {
    own_.add(added->driver_program);
    added->shader = *text;
    set_samplers(added->driver_program);
    const auto location = [&](const char* name) {
      return found_driver.GetUniformLocation(added->driver_program, name);
    };
    added->constants = location("ninebit_combine_constants");
    added->stage_numbers = {location("ninebit_stages_matrix"), location("ninebit_stages_scale"),
                            location("ninebit_stages_eye")};
  }
  ++size_;
  candidates.push_back(std::move(added));
  return *candidates.back();
}

}  // namespace ninebit::gl_layer
