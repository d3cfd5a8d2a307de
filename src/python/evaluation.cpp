#include "src/python/evaluation.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/language/trace_json.h"
#include "src/combiner/given_registers.h"
#include "src/python/waiting.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

constexpr std::size_t kFirstRegister = static_cast<std::size_t>(Register::constant0);

// More fragments than this are evaluated beside the interpreter, so that Ctrl-C stops them.
constexpr std::size_t kManyFragments = std::size_t{1} << 18;

struct Component {
  std::size_t reg = 0, component = 0;
};

Component component_of(const std::string& key) {
  const std::size_t dot = std::min(key.find('.'), key.size());
  for (std::size_t r = kFirstRegister; r < kRegisterCount; ++r) {
    if (short_name(static_cast<Register>(r)) != std::string_view(key).substr(0, dot)) continue;
    const std::size_t component = key.size() == dot + 2 ? std::string_view("rgba").find(key[dot + 1]) : 4;
    if (component < 4) return {r, component};
  }
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

// --- Planes of NumPy arrays, read in place.

struct InputPlane {
  const std::byte* from = nullptr;  // nullptr: the default
  std::ptrdiff_t stride = 0;        // bytes; 0: one code for all fragments
  bool bytes = false;               // uint8, not int16
  std::string key{};
};

// Holds the arrays, because other threads may change the dictionary meanwhile. Must be destroyed with the GIL held.
struct Planes {
  std::array<std::array<InputPlane, 4>, kRegisterCount> plane{};
  std::vector<py::array> arrays{};
  ComponentSet constants{};  // that are given
  bool any_constants = false;
  std::size_t count = 0;
};

Planes planes_of(const py::dict& inputs, std::size_t count) {
  Planes planes{.count = count};
  for (const auto& [key_object, value] : inputs) {
    const std::string key = key_of(key_object);
    const Component at = component_of(key);
    const bool bytes = py::isinstance<py::array_t<std::uint8_t>>(value);
    if (!bytes && !py::isinstance<py::array_t<s9>>(value))
      throw py::type_error(key + " must be an array of uint8 or int16");
    const py::array& array = planes.arrays.emplace_back(py::reinterpret_borrow<py::array>(value));
    const bool aligned = (array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) != 0;
    const auto size = static_cast<std::size_t>(array.size());
    if (!aligned || array.ndim() != 1 || (size != 1 && size != count)) {
      throw py::value_error(key + " must be an aligned array with one dimension, of one code or one per fragment");
    }
    planes.plane[at.reg][at.component] = {static_cast<const std::byte*>(array.data()),
                                          size == 1 ? 0 : static_cast<std::ptrdiff_t>(array.strides(0)), bytes, key};
    const auto reg = static_cast<Register>(at.reg);
    if (reg != Register::constant0 && reg != Register::constant1) continue;
    planes.constants.add(reg, static_cast<int>(at.component));
    planes.any_constants = true;
  }
  // As in `ninebit eval`, spare0's alpha starts as texture 0's.
  InputPlane& spare0_alpha = planes.plane[static_cast<std::size_t>(Register::spare0)][kAlpha];
  if (spare0_alpha.from == nullptr) spare0_alpha = planes.plane[static_cast<std::size_t>(Register::texture0)][kAlpha];
  return planes;
}

// Copies codes, and checks the copies: other threads may write into the arrays.
template <class Sample>
void take(const InputPlane& plane, std::size_t begin, std::size_t count, const Program& program, s9* to) {
  const std::byte* from = plane.from + static_cast<std::ptrdiff_t>(begin) * plane.stride;
  int least = program.datapath.one, most = program.datapath.lowest;
  for (std::size_t i = 0; i < count; ++i, from += plane.stride) {
    const int code = *reinterpret_cast<const Sample*>(from);
    least = std::min(least, code);
    most = std::max(most, code);
    to[i] = static_cast<s9>(code);
  }
  if (!is_code(program, least)) refuse_code(program, least, plane.key);
  if (!is_code(program, most)) refuse_code(program, most, plane.key);
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

// One fragment after the other: in real numbers, a batch cannot vary constants.
void run_in_rows(Program program, const Planes& planes, std::size_t count, RegisterBatch& registers, OutputBatch& out) {
  for (std::size_t i = 0; i < count; ++i) {
    RegisterFile file;
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        file.value[r][c] = registers.plane[r][c][i];
        const auto reg = static_cast<Register>(r);
        if (planes.constants.contains(reg, static_cast<int>(c))) {
          replace_constant(program, reg, static_cast<int>(c), file.value[r][c]);
        }
      }
    }
    const EvaluatedFragment result = evaluate_fragment(program, file);
    for (std::size_t c = 0; c < 4; ++c) out.plane[c][i] = result.color[c];
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) registers.plane[r][c][i] = result.registers.value[r][c];
    }
  }
}

struct Results {
  s9* color = nullptr;
  s9* after = nullptr;  // nullptr: not wanted
};

void run(const RunnableProgram& program, const BatchProgram& batch, const Planes& planes, const Results& to,
         const std::atomic<bool>& stopped) {
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  const RegisterFile defaults = default_codes(program);
  const bool in_rows = planes.any_constants && program.program.datapath.arithmetic != Arithmetic::integer;
  for (std::size_t begin = 0; begin < planes.count && !stopped; begin += kBatchSize) {
    const std::size_t count = std::min(kBatchSize, planes.count - begin);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const InputPlane& plane = planes.plane[r][c];
        s9* const codes = registers->plane[r][c].data();
        if (plane.from == nullptr) {
          std::fill_n(codes, count, defaults.value[r][c]);
        } else if (plane.bytes) {
          take<std::uint8_t>(plane, begin, count, program.program, codes);
        } else {
          take<s9>(plane, begin, count, program.program, codes);
        }
      }
    }
    if (in_rows) {
      run_in_rows(program.program, planes, count, *registers, *out);
    } else {
      batch.run(*registers, count, *out);
    }
    for (std::size_t c = 0; c < 4; ++c) std::copy_n(out->plane[c].data(), count, to.color + c * planes.count + begin);
    if (to.after == nullptr) continue;
    for (std::size_t r = kFirstRegister; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        std::copy_n(registers->plane[r][c].data(), count,
                    to.after + (4 * (r - kFirstRegister) + c) * planes.count + begin);
      }
    }
  }
}

s9* samples_of(const Codes& array, const std::vector<std::size_t>& shape, const char* name) {
  bool fits = array.ndim() == static_cast<py::ssize_t>(shape.size()) && array.writeable();
  for (std::size_t i = 0; fits && i < shape.size(); ++i)
    fits = static_cast<std::size_t>(array.shape(static_cast<int>(i))) == shape[i];
  if (!fits) throw py::value_error(std::string(name) + " does not have the shape of the results, or cannot be written");
  return const_cast<s9*>(array.data());
}

}  // namespace

std::vector<std::string> register_names() {
  std::vector<std::string> names;
  for (std::size_t r = kFirstRegister; r < kRegisterCount; ++r)
    names.emplace_back(short_name(static_cast<Register>(r)));
  return names;
}

void evaluate(const RunnableProgram& program, const py::dict& inputs, std::size_t count, const Codes& color,
              const std::optional<Codes>& after) {
  const Planes planes = planes_of(inputs, count);
  const Results to{.color = samples_of(color, {4, count}, "color"),
                   .after = after ? samples_of(*after, {kRegisterCount - kFirstRegister, 4, count}, "after") : nullptr};
  std::optional<BatchProgram> own;
  if (after || planes.any_constants)
    own.emplace(program.program, BatchOutputs{.registers = after.has_value()}, planes.constants);
  const BatchProgram& batch = own ? *own : program.batch;
  std::atomic<bool> stopped = false;
  const auto work = [&] { run(program, batch, planes, to, stopped); };
  if (count > kManyFragments) return work_beside(work, [&] { stopped = true; });
  const py::gil_scoped_release others_may_run;
  work();
}

py::object traced(const RunnableProgram& program, const py::dict& registers) {
  const HardwareProfile& profile = *program.state.profile.profile;
  RegisterFile file = default_codes(program);
  Program traced_program = program.program;
  bool has_spare0_alpha = false;
  for (const auto& [key_object, value] : registers) {
    const std::string key = key_of(key_object);
    const Component at = component_of(key);
    const auto reg = static_cast<Register>(at.reg);
    const int code = value.cast<int>();
    if (!is_code(program.program, code)) refuse_code(program.program, code, key);
    file.value[at.reg][at.component] = static_cast<s9>(code);
    has_spare0_alpha = has_spare0_alpha || (reg == Register::spare0 && at.component == kAlpha);
    if (reg == Register::constant0 || reg == Register::constant1) {
      replace_constant(traced_program, reg, static_cast<int>(at.component), static_cast<s9>(code));
    }
  }
  if (!has_spare0_alpha) file[Register::spare0][kAlpha] = file[Register::texture0][kAlpha];
  const std::string json = print_json_trace(traced_program, trace(traced_program, profile, file));
  return py::module_::import("json").attr("loads")(json);
}

}  // namespace ninebit::python
