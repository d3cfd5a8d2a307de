#include "src/python/evaluation.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <functional>
#include <future>
#include <limits>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "ninebit/combiner/evaluate_arrays.h"
#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/language/trace_json.h"
#include "src/combiner/given_registers.h"
#include "src/python/waiting.h"
#include "src/texture_shader/given_stages.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

constexpr std::size_t kFirstRegister = static_cast<std::size_t>(Register::constant0);

// More fragments than this are evaluated beside the interpreter, so that Ctrl-C stops them.
constexpr std::size_t kManyFragments = std::size_t{1} << 18;
// As many are evaluated between two looks at whether to go on.
constexpr std::size_t kPart = std::size_t{1} << 15;

struct Component {
  std::size_t reg = 0, component = 0;
};

Component component_of(const std::string& key) {
  const std::size_t dot = std::min(key.find('.'), key.size());
  const std::optional<Register> reg = register_named(std::string_view(key).substr(0, dot));
  const std::size_t component = key.size() == dot + 2 ? std::string_view("rgba").find(key[dot + 1]) : 4;
  if (reg && component < 4) return {static_cast<std::size_t>(*reg), component};
  throw Error{"'" + key + "' is not a component of a register; expected a name such as tex0.r"};
}

std::string key_of(py::handle key) {
  if (py::isinstance<py::str>(key)) return key.cast<std::string>();
  throw py::type_error("a component's name must be str, such as 'tex0.r'");
}

[[noreturn]] void refuse_code(const Program& program, int code, const std::string& key) {
  throw Error{key + " has the code " + std::to_string(code) + "; expected " + std::to_string(program.datapath.lowest) +
              " to " + std::to_string(program.datapath.one)};
}

bool is_code(const Program& program, int code) {
  return code >= program.datapath.lowest && code <= program.datapath.one;
}

// NumPy arrays, which are read in place. Holds them, as other threads may change the dictionary
// meanwhile. Must be destroyed with the GIL held.
struct Inputs {
  FragmentArrays samples{};
  std::vector<py::array> arrays{};
  ComponentSet constants{};  // that are given
  bool any_constants = false;
  bool not_negative = true;  // as far as types and single codes say
};

Inputs arrays_of(const py::dict& planes, std::size_t count) {
  Inputs inputs{.samples = {.count = count}};
  for (const auto& [key_object, value] : planes) {
    const std::string key = key_of(key_object);
    const Component at = component_of(key);
    const bool bytes = py::isinstance<py::array_t<std::uint8_t>>(value);
    if (!bytes && !py::isinstance<py::array_t<s9>>(value))
      throw py::type_error(key + " must be an array of uint8 or int16");
    const py::array& array = inputs.arrays.emplace_back(py::reinterpret_borrow<py::array>(value));
    const bool aligned = (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
    const auto size = static_cast<std::size_t>(array.size());
    if (!aligned || array.ndim() != 1 || (size != 1 && size != count)) {
      throw py::value_error(key + " must be an aligned array with one dimension, of one code or one per fragment");
    }
    inputs.samples.input[at.reg][at.component] = {array.data(),
                                                  size == 1 ? 0 : static_cast<std::ptrdiff_t>(array.strides(0)),
                                                  bytes ? ElementType::byte : ElementType::code};
    inputs.not_negative = inputs.not_negative && (bytes || (size == 1 && *static_cast<const s9*>(array.data()) >= 0));
    const auto reg = static_cast<Register>(at.reg);
    if (reg != Register::constant0 && reg != Register::constant1) continue;
    inputs.constants.add(reg, static_cast<int>(at.component));
    inputs.any_constants = true;
  }
  return inputs;
}

// The codes of the components that are not given.
RegisterFile default_codes(const RunnableProgram& program) {
  const HardwareProfile& profile = *program.state.profile.profile;
  RegisterFile file = default_registers(profile);
  file[Register::constant0] = detail::constant_codes(profile, program.state.state.constant0);
  file[Register::constant1] = detail::constant_codes(profile, program.state.state.constant1);
  file[Register::spare0][kAlpha] = file[Register::texture0][kAlpha];
  return file;
}

// All inputs of the fragments. Throws for a code out of range.
Inputs inputs_of(const RunnableProgram& program, const py::dict& planes, std::size_t count) {
  Inputs inputs = arrays_of(planes, count);
  FragmentArrays& samples = inputs.samples;
  if (const auto wrong = find_code_out_of_range(program.program, samples)) {
    const char letter = "rgba"[wrong->component];
    refuse_code(program.program, wrong->code, std::string(short_name(wrong->reg)) + '.' + letter);
  }
  samples.otherwise = default_codes(program);
  // As in `ninebit eval`, spare0's alpha starts as texture 0's.
  InputArray& spare0_alpha = samples.input[static_cast<std::size_t>(Register::spare0)][kAlpha];
  if (spare0_alpha.first == nullptr) spare0_alpha = samples.input[static_cast<std::size_t>(Register::texture0)][kAlpha];
  return inputs;
}

int code_at(const InputArray& array, std::size_t i) {
  const auto* const at = static_cast<const std::byte*>(array.first) + static_cast<std::ptrdiff_t>(i) * array.stride;
  return array.type == ElementType::byte ? static_cast<int>(*at) : *reinterpret_cast<const s9*>(at);
}

// The program with the constants that are given for a fragment.
Program with_constants(const Program& program, const Inputs& inputs, std::size_t i) {
  Program own = program;
  for (const Register reg : {Register::constant0, Register::constant1}) {
    for (int c = kRed; c <= kAlpha; ++c) {
      if (!inputs.constants.contains(reg, c)) continue;
      const InputArray& from = inputs.samples.input[static_cast<std::size_t>(reg)][static_cast<std::size_t>(c)];
      replace_constant(own, reg, c, static_cast<s9>(code_at(from, i)));
    }
  }
  return own;
}

// One fragment after the other: in real numbers, a batch cannot vary constants.
void run_in_rows(const Program& program, const Inputs& inputs, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    evaluate(BatchProgram(with_constants(program, inputs, i)), inputs.samples, i, i + 1);
  }
}

// Calls body(begin, end) for parts of all fragments, on all processors where there are many, until it is stopped.
template <class Body>
void in_parts(std::size_t count, const std::atomic<bool>& stopped, const Body& body) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    while (!stopped) {
      const std::size_t begin = next.fetch_add(kPart);
      if (begin >= count) return;
      body(begin, std::min(begin + kPart, count));
    }
  };
  const std::size_t processors = std::max(1U, std::thread::hardware_concurrency());
  const std::size_t helpers = std::min(processors, std::max<std::size_t>(1, count / kManyFragments)) - 1;
  std::vector<std::future<void>> others;
  for (std::size_t i = 0; i < helpers; ++i) others.push_back(std::async(std::launch::async, work));
  work();
  for (std::future<void>& other : others) other.get();
}

// Works beside the interpreter where there is much to do, else without its lock.
void run_on(std::size_t count, const std::function<void(std::size_t, std::size_t)>& body) {
  std::atomic<bool> stopped = false;
  const auto work = [&] { in_parts(count, stopped, body); };
  if (count > kManyFragments) return work_beside(work, [&] { stopped = true; });
  const py::gil_scoped_release others_may_run;
  work();
}

// The four components of an array of results, of the shape (4, count), with any strides.
std::array<OutputArray, 4> outputs_of(const py::array& array, std::size_t count, const char* name) {
  const bool bytes = py::isinstance<py::array_t<std::uint8_t>>(array);
  const bool is_right = (bytes || py::isinstance<py::array_t<s9>>(array)) && array.writeable() && array.ndim() == 2 &&
                        array.shape(0) == 4 && static_cast<std::size_t>(array.shape(1)) == count;
  if (!is_right) {
    throw py::value_error(std::string(name) +
                          " must be an array of uint8 or int16 with the shape of the results, which can be written");
  }
  std::array<OutputArray, 4> outputs;
  for (py::ssize_t c = 0; c < 4; ++c) {
    auto* const first = static_cast<std::byte*>(const_cast<void*>(array.data())) + c * array.strides(0);
    outputs[static_cast<std::size_t>(c)] = {first, static_cast<std::ptrdiff_t>(array.strides(1)),
                                            bytes ? ElementType::byte : ElementType::code};
  }
  return outputs;
}

}  // namespace

std::vector<std::string> register_names() {
  std::vector<std::string> names;
  for (std::size_t r = kFirstRegister; r < kRegisterCount; ++r)
    names.emplace_back(short_name(static_cast<Register>(r)));
  return names;
}

void evaluate(const RunnableProgram& program, const py::dict& planes, std::size_t count, const py::array& color,
              const std::vector<py::array>& after) {
  Inputs inputs = inputs_of(program, planes, count);
  FragmentArrays& samples = inputs.samples;
  samples.color = outputs_of(color, count, "color");
  for (std::size_t i = 0; i < after.size() && i < kRegisterCount - kFirstRegister; ++i) {
    samples.after[kFirstRegister + i] = outputs_of(after[i], count, "after");
  }

  const bool in_rows = inputs.any_constants && program.program.datapath.arithmetic != Arithmetic::integer;
  std::optional<BatchProgram> own;
  if (!after.empty() || inputs.any_constants) {
    own.emplace(program.program, BatchOutputs{.registers = !after.empty()}, inputs.constants);
  }
  const BatchProgram& batch = own ? *own : inputs.not_negative ? program.of_bytes : program.batch;
  run_on(count, [&](std::size_t begin, std::size_t end) {
    if (in_rows) return run_in_rows(program.program, inputs, begin, end);
    evaluate(batch, samples, begin, end);
  });
}

void evaluate_real(const RunnableProgram& program, const py::dict& planes, std::size_t count,
                   py::array_t<double>& color, std::vector<py::array_t<double>>& after) {
  const Inputs inputs = inputs_of(program, planes, count);
  const FragmentArrays& samples = inputs.samples;
  const Arithmetic computed = program.program.datapath.arithmetic;
  const Arithmetic arithmetic = computed == Arithmetic::integer ? Arithmetic::exact : computed;
  auto colors = color.mutable_unchecked<2>();
  std::vector<py::detail::unchecked_mutable_reference<double, 2>> registers;
  for (py::array_t<double>& array : after) registers.push_back(array.mutable_unchecked<2>());
  run_on(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      RegisterFile file = samples.otherwise;
      for (std::size_t r = 0; r < kRegisterCount; ++r) {
        for (std::size_t c = 0; c < 4; ++c) {
          if (samples.input[r][c].first != nullptr) file.value[r][c] = static_cast<s9>(code_at(samples.input[r][c], i));
        }
      }
      std::optional<Program> own;
      if (inputs.any_constants) own = with_constants(program.program, inputs, i);
      const RealEvaluation found = ninebit::evaluate_real(own ? *own : program.program, file, arithmetic);
      const auto column = static_cast<py::ssize_t>(i);
      for (std::size_t c = 0; c < 4; ++c) {
        const auto row = static_cast<py::ssize_t>(c);
        colors(row, column) = found.color[c];
        for (std::size_t r = 0; r < registers.size(); ++r) {
          registers[r](row, column) = found.registers().value[kFirstRegister + r][c];
        }
      }
    }
  });
}

namespace {

GivenComponent given_component(const std::string& key) {
  const auto components = given_components(key);
  if (components.size() == 1) return components[0];
  throw Error{"'" + key + "' is not a coordinate or a byte of a texel; expected a name such as at0.s or texel0.r"};
}

TextureShaderProgram stages_of(const RunnableProgram& program) {
  auto stages = compile_for_given(program.state.texture_shader, *program.state.profile.profile);
  if (!stages) throw Error{stages.error().text()};
  return *std::move(stages);
}

// An array of one component, which is read in place.
struct GivenPlane {
  GivenComponent to{};
  const std::byte* first = nullptr;
  std::ptrdiff_t stride = 0;
  [[nodiscard]] float at(std::size_t i) const {
    const std::byte* const here = first + static_cast<std::ptrdiff_t>(i) * stride;
    return to.is_texel ? static_cast<float>(*here) : *reinterpret_cast<const float*>(here);
  }
};

}  // namespace

py::tuple run_stages(const RunnableProgram& program, const py::dict& planes, std::size_t count) {
  const TextureShaderProgram stages = stages_of(program);
  std::vector<GivenPlane> given;
  std::vector<py::array> arrays;  // as other threads may change the dictionary
  for (const auto& [key_object, value] : planes) {
    const std::string key = key_of(key_object);
    const GivenComponent to = given_component(key);
    const bool fits =
        to.is_texel ? py::isinstance<py::array_t<std::uint8_t>>(value) : py::isinstance<py::array_t<float>>(value);
    if (!fits) throw py::type_error(key + " must be an array of " + (to.is_texel ? "uint8" : "float32"));
    const py::array& array = arrays.emplace_back(py::reinterpret_borrow<py::array>(value));
    const bool aligned = (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
    const auto size = static_cast<std::size_t>(array.size());
    if (!aligned || array.ndim() != 1 || (size != 1 && size != count)) {
      throw py::value_error(key + " must be an aligned array with one dimension, of one number or one per fragment");
    }
    given.push_back({to, static_cast<const std::byte*>(array.data()),
                     size == 1 ? 0 : static_cast<std::ptrdiff_t>(array.strides(0))});
  }
  constexpr std::size_t kCodes = 4 * kTextureStages;
  const auto length = static_cast<py::ssize_t>(count);
  py::array_t<s9> codes({static_cast<py::ssize_t>(kCodes), length});
  py::array_t<bool> culled(length);
  py::array_t<float> depth(length);
  s9* const to_codes = codes.mutable_data();
  bool* const to_culled = culled.mutable_data();
  float* const to_depth = depth.mutable_data();
  run_on(count, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) {
      GivenFragment fragment;
      for (const GivenPlane& one : given) give(fragment, one.to, one.at(i));
      RegisterFile registers;
      const TextureShaderResult result =
          evaluate_given(stages, *program.state.profile.profile, fragment, true, registers);
      for (std::size_t k = 0; k < kCodes; ++k) to_codes[k * count + i] = result.stage[k / 4].codes[k % 4];
      to_culled[i] = result.is_culled;
      to_depth[i] = result.depth.value_or(std::numeric_limits<float>::quiet_NaN());
    }
  });
  return py::make_tuple(codes, culled, depth, stages.warnings());
}

py::object traced(const RunnableProgram& program, const py::dict& registers, const py::dict& given) {
  const HardwareProfile& profile = *program.state.profile.profile;
  RegisterFile file = default_codes(program);
  Program traced_program = program.program;
  bool has_spare0_alpha = false, has_textures = false;
  for (const auto& [key_object, value] : registers) {
    const std::string key = key_of(key_object);
    const Component at = component_of(key);
    const auto reg = static_cast<Register>(at.reg);
    const int code = value.cast<int>();
    if (!is_code(program.program, code)) refuse_code(program.program, code, key);
    file.value[at.reg][at.component] = static_cast<s9>(code);
    has_spare0_alpha = has_spare0_alpha || (reg == Register::spare0 && at.component == kAlpha);
    has_textures = has_textures || is_texture(reg);
    if (reg == Register::constant0 || reg == Register::constant1) {
      replace_constant(traced_program, reg, static_cast<int>(at.component), static_cast<s9>(code));
    }
  }
  if (!has_spare0_alpha) file[Register::spare0][kAlpha] = file[Register::texture0][kAlpha];
  const auto loaded = [](const std::string& json) -> py::dict {
    return py::module_::import("json").attr("loads")(json);
  };
  py::dict out;
  if (runs_stages(program.state.texture_shader, !given.empty(), has_textures)) {
    GivenFragment fragment;
    for (const auto& [key_object, value] : given) {
      const std::string key = key_of(key_object);
      const GivenComponent to = given_component(key);
      const auto number = value.cast<float>();
      if (to.is_texel && !(number >= 0.0F && number <= 255.0F)) throw Error{key + " is not a byte; expected 0 to 255"};
      give(fragment, to, number);
    }
    out["texture_shader"] =
        loaded(print_json_stages(evaluate_given(stages_of(program), profile, fragment, has_spare0_alpha, file)));
  }
  out.attr("update")(loaded(print_json_trace(traced_program, trace(traced_program, profile, file))));
  return out;
}

}  // namespace ninebit::python
