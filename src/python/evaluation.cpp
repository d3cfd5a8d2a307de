#include "src/python/evaluation.h"

#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/trace.h"
#include "ninebit/language/trace_json.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

std::string type_of(py::handle object) {
  return Py_TYPE(object.ptr())->tp_name;
}

// --- Registers by their names: "tex0" or "tex0.r".

struct Name {
  std::size_t reg = 0;
  std::optional<std::size_t> component{};  // empty: all four
};

Name name_of_key(const std::string& key) {
  const std::size_t dot = key.find('.');
  for (std::size_t r = static_cast<std::size_t>(Register::fog); r < kRegisterCount; ++r) {
    if (short_name(static_cast<Register>(r)) != std::string_view(key).substr(0, dot)) continue;
    if (dot == std::string::npos) return {r, {}};
    const std::size_t component = std::string_view("rgba").find(key.substr(dot + 1));
    if (key.size() == dot + 2 && component != std::string_view::npos) return {r, component};
  }
  throw Error{"'" + key +
              "' is not a register; expected fog, primary, secondary, spare0, spare1, tex0 to tex3, alone or with " +
              ".r, .g, .b or .a"};
}

bool starts_at_one(std::size_t reg, std::size_t component) {
  const auto name = static_cast<Register>(reg);
  return component == kAlpha && (name == Register::fog || is_texture(name));
}

void check_code(const Program& program, int code, const std::string& key) {
  if (code >= program.datapath.lowest && code <= program.datapath.one) return;
  throw Error{key + " has the code " + std::to_string(code) + "; expected " + std::to_string(program.datapath.lowest) +
              " to " + std::to_string(program.datapath.one)};
}

// --- Dictionary contents as C++ values.

std::string key_of(py::handle key) {
  if (!py::isinstance<py::str>(key)) {
    throw py::type_error("a register's name must be str, such as 'tex0' or 'tex0.r', not " + type_of(key));
  }
  return key.cast<std::string>();
}

// A number, or a sequence of them.
template <class Codes>
Codes codes_of(py::handle value, const std::string& key, const char* expected) try {
  return value.cast<Codes>();
} catch (const py::cast_error&) {
  throw py::type_error(key + " must be " + expected + ", not " + type_of(value));
}

// --- Planes of NumPy arrays, read in place.

using Array = py::array_t<s9, py::array::c_style>;

struct InputPlane {
  const s9* from = nullptr;  // nullptr: the default
  std::string key{};         // the caller's key
};

// Holds the arrays, because other threads may change the dictionary meanwhile. Must be destroyed with the GIL held.
struct Planes {
  std::array<std::array<InputPlane, 4>, kRegisterCount> plane{};
  std::vector<Array> arrays{};
  std::size_t count = 0;
};

Planes planes_of(const py::dict& inputs) {
  Planes planes;
  bool first = true;
  for (const auto& [key_object, value] : inputs) {
    const std::string key = key_of(key_object);
    const Name name = name_of_key(key);
    if (!Array::check_(value)) {
      throw py::type_error(key + " must be a C-contiguous array of int16, so that it need not be copied; it is " +
                           type_of(value));
    }
    const Array& array = planes.arrays.emplace_back(py::reinterpret_borrow<Array>(value));
    if ((array.flags() & py::detail::npy_api::NPY_ARRAY_ALIGNED_) == 0) {
      throw py::type_error(key + " must be an aligned array, so that it need not be copied");
    }
    const bool whole = !name.component.has_value();
    if (array.ndim() != (whole ? 2 : 1) || (whole && array.shape(0) != 4)) {
      throw py::value_error(key + (whole ? " must have the shape (4, n)" : " must have one dimension"));
    }
    const auto count = static_cast<std::size_t>(array.shape(whole ? 1 : 0));
    if (!first && count != planes.count) throw py::value_error("all inputs must have the same number of fragments");
    first = false;
    planes.count = count;
    for (std::size_t c = 0; c < 4; ++c) {
      if (whole) planes.plane[name.reg][c] = {array.data() + c * count, key};
    }
    if (!whole) planes.plane[name.reg][*name.component] = {array.data(), key};
  }
  if (first)
    throw py::value_error("there are no inputs; expected at least one array, which gives the number of fragments");
  // As in `ninebit eval`, spare0's alpha starts as texture 0's.
  InputPlane& spare0_alpha = planes.plane[static_cast<std::size_t>(Register::spare0)][kAlpha];
  if (spare0_alpha.from == nullptr) spare0_alpha = planes.plane[static_cast<std::size_t>(Register::texture0)][kAlpha];
  return planes;
}

// Copies codes, and checks the copies: other threads may write into the arrays.
void take(const InputPlane& plane, std::size_t begin, std::size_t count, const Program& program, s9* to) {
  std::copy_n(plane.from + begin, count, to);
  s9 least = to[0], most = to[0];
  for (std::size_t i = 1; i < count; ++i) {
    least = std::min(least, to[i]);
    most = std::max(most, to[i]);
  }
  check_code(program, least, plane.key);
  check_code(program, most, plane.key);
}

// Computes the color planes, and those of all registers if `after` is not null.
void run(const RunnableProgram& program, const BatchProgram& batch, const Planes& planes, s9* color, s9* after) {
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  const auto one = static_cast<s9>(program.program.datapath.one);
  const bool texture0_has_alpha = planes.plane[static_cast<std::size_t>(Register::texture0)][kAlpha].from != nullptr;
  for (std::size_t begin = 0; begin < planes.count; begin += kBatchSize) {
    const std::size_t count = std::min(kBatchSize, planes.count - begin);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const InputPlane& plane = planes.plane[r][c];
        const bool spare0_alpha = r == static_cast<std::size_t>(Register::spare0) && c == kAlpha;
        const bool full = starts_at_one(r, c) || (spare0_alpha && !texture0_has_alpha);
        s9* const to = registers->plane[r][c].data();
        if (plane.from != nullptr) {
          take(plane, begin, count, program.program, to);
        } else {
          std::fill_n(to, count, full ? one : s9{0});
        }
      }
    }
    batch.run(*registers, count, *out);
    for (std::size_t c = 0; c < 4; ++c) std::copy_n(out->plane[c].data(), count, color + c * planes.count + begin);
    if (after == nullptr) continue;
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        std::copy_n(registers->plane[r][c].data(), count, after + (4 * r + c) * planes.count + begin);
      }
    }
  }
}

}  // namespace

py::array_t<s9> evaluate(const RunnableProgram& program, const py::dict& inputs) {
  const Planes planes = planes_of(inputs);
  py::array_t<s9> color({std::size_t{4}, planes.count});
  s9* const to = color.mutable_data();
  const py::gil_scoped_release others_may_run;
  run(program, program.batch, planes, to, nullptr);
  return color;
}

py::dict evaluate_registers(const RunnableProgram& program, const py::dict& inputs) {
  const Planes planes = planes_of(inputs);
  py::array_t<s9> color({std::size_t{4}, planes.count});
  py::array_t<s9> after({kRegisterCount, std::size_t{4}, planes.count});
  s9 *const to = color.mutable_data(), *const registers_to = after.mutable_data();
  {
    const py::gil_scoped_release others_may_run;
    run(program, BatchProgram(program.program, {.registers = true}), planes, to, registers_to);
  }
  py::dict answer;
  answer["color"] = color;
  for (std::size_t r = static_cast<std::size_t>(Register::fog); r < kRegisterCount; ++r) {
    answer[py::str(std::string(short_name(static_cast<Register>(r))))] = after[py::int_(r)];
  }
  return answer;
}

py::object traced(const RunnableProgram& program, const py::dict& registers) {
  RegisterFile file;
  bool has_spare0_alpha = false;
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    if (starts_at_one(r, kAlpha)) file.value[r][kAlpha] = static_cast<s9>(program.program.datapath.one);
  }
  for (const auto& [key_object, value] : registers) {
    const std::string key = key_of(key_object);
    const Name name = name_of_key(key);
    const auto codes = name.component ? std::vector{codes_of<int>(value, key, "a whole number")}
                                      : codes_of<std::vector<int>>(value, key, "a sequence of four whole numbers");
    if (!name.component && codes.size() != 4) throw py::value_error(key + " must have four codes");
    for (std::size_t i = 0; i < codes.size(); ++i) {
      check_code(program.program, codes[i], key);
      const std::size_t component = name.component.value_or(i);
      file.value[name.reg][component] = static_cast<s9>(codes[i]);
      has_spare0_alpha =
          has_spare0_alpha || (static_cast<Register>(name.reg) == Register::spare0 && component == kAlpha);
    }
  }
  if (!has_spare0_alpha) file[Register::spare0][kAlpha] = file[Register::texture0][kAlpha];
  const std::string json = print_json_trace(program.program, trace(program.program, *program.profile, file));
  return py::module_::import("json").attr("loads")(json);
}

}  // namespace ninebit::python
