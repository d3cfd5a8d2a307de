// States and programs: read, printed, judged; evaluated on NumPy arrays, traced.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/combiner/trace.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/trace_json.h"
#include "src/python/module.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

struct State {
  CombinerState state{};
  const HardwareProfile* profile = &profiles::geforce2;
};

struct RunnableProgram {
  Program program;
  BatchProgram batch;
  const HardwareProfile* profile;
};

ChipClass chip_of(const HardwareProfile& profile) {
  return profile.per_stage_constants ? ChipClass::nv20 : ChipClass::nv10;
}

State parse(const std::string& text, const std::string& form, const std::string& profile_name) {
  const HardwareProfile& profile = profile_named(profile_name);
  const SourceText source{text, {}};
  const auto parsed = form == "gl"           ? parse_gl_calls(source, profile)
                      : form == "rc10"       ? parse_rc10(source, profile)
                      : form == "words"      ? parse_register_words(source, chip_of(profile), profile)
                      : form == "words-json" ? parse_json_register_words(source, chip_of(profile), profile)
                      : form == "json"       ? parse_json_program(source, profile)
                                             : throw Error{"form is 'gl', 'rc10', 'words', 'words-json' or 'json'"};
  if (parsed) return {*parsed.value, &profile};
  std::string faults;
  for (const TextFault& fault : parsed.faults) faults += (faults.empty() ? "" : "\n") + fault.text();
  throw Error{faults};
}

std::string print(const State& state, const std::string& form) {
  const HardwareProfile& profile = *state.profile;
  if (form == "json") return print_json_program(state.state);
  const auto text = form == "gl"           ? print_gl_calls(state.state, profile)
                    : form == "rc10"       ? print_rc10(state.state, profile)
                    : form == "words"      ? print_register_words(state.state, chip_of(profile), profile)
                    : form == "words-json" ? print_json_register_words(state.state, chip_of(profile), profile)
                                           : throw Error{"form is 'gl', 'rc10', 'words', 'words-json' or 'json'"};
  if (!text) throw Error{text.error().text()};
  return *text;
}

std::vector<py::dict> diagnostics(const State& state) {
  std::vector<py::dict> rows;
  for (const StateDiagnostic& found : validate(state.state, *state.profile)) {
    py::dict row;
    row["gl_error"] = std::string(name_of(found.gl_error));
    row["stage"] = found.stage;
    row["portion"] =
        found.portion ? py::object(py::str(*found.portion == PortionName::rgb ? "rgb" : "alpha")) : py::none();
    row["variable"] =
        found.variable ? py::object(py::str(std::string(1, "ABCDEFG"[static_cast<int>(*found.variable)]))) : py::none();
    row["message"] = found.message;
    rows.push_back(row);
  }
  return rows;
}

RunnableProgram compiled(const State& state) {
  const auto program = compile(state.state, *state.profile);
  if (!program) throw Error{program.error().text()};
  return {*program, BatchProgram(*program), state.profile};
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
              "' is no register; expected fog, primary, secondary, spare0, spare1, tex0 to tex3, alone or with " +
              ".r, .g, .b, .a"};
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

// --- Planes of NumPy arrays: read where they lie.

using Array = py::array_t<s9, py::array::c_style>;

struct Planes {
  std::array<std::array<const s9*, 4>, kRegisterCount> from{};  // nullptr: the default
  std::size_t count = 0;
};

Planes planes_of(const py::dict& inputs, const Program& program) {
  Planes planes;
  bool first = true;
  for (const auto& [key_object, value] : inputs) {
    const auto key = key_object.cast<std::string>();
    const Name name = name_of_key(key);
    if (!Array::check_(value))
      throw py::type_error(key + " must be a C-contiguous array of int16, so that it need not be copied");
    const auto array = py::reinterpret_borrow<Array>(value);
    const bool whole = !name.component.has_value();
    if (array.ndim() != (whole ? 2 : 1) || (whole && array.shape(0) != 4)) {
      throw py::value_error(key + (whole ? " must have the shape (4, n)" : " must have one dimension"));
    }
    const auto count = static_cast<std::size_t>(array.shape(whole ? 1 : 0));
    if (!first && count != planes.count) throw py::value_error("all inputs must have the same number of fragments");
    first = false;
    planes.count = count;
    const auto [least, most] = std::minmax_element(array.data(), array.data() + array.size());
    if (array.size() > 0) {
      check_code(program, *least, key);
      check_code(program, *most, key);
    }
    for (std::size_t c = 0; c < 4; ++c) {
      if (whole) planes.from[name.reg][c] = array.data() + c * count;
    }
    if (!whole) planes.from[name.reg][*name.component] = array.data();
  }
  if (first) throw py::value_error("there are no inputs, and so no number of fragments");
  // As `ninebit eval` has it: spare0's alpha starts as texture 0's.
  auto& spare0_alpha = planes.from[static_cast<std::size_t>(Register::spare0)][kAlpha];
  if (spare0_alpha == nullptr) spare0_alpha = planes.from[static_cast<std::size_t>(Register::texture0)][kAlpha];
  return planes;
}

// The color planes, and those of all registers where they are wanted.
void run(const RunnableProgram& program, const BatchProgram& batch, const Planes& planes, s9* color, s9* after) {
  const auto registers = std::make_unique<RegisterBatch>();
  const auto out = std::make_unique<OutputBatch>();
  const auto one = static_cast<s9>(program.program.datapath.one);
  const bool texture0_has_alpha = planes.from[static_cast<std::size_t>(Register::texture0)][kAlpha] != nullptr;
  for (std::size_t begin = 0; begin < planes.count; begin += kBatchSize) {
    const std::size_t count = std::min(kBatchSize, planes.count - begin);
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        const s9* const from = planes.from[r][c];
        const bool spare0_alpha = r == static_cast<std::size_t>(Register::spare0) && c == kAlpha;
        const bool full = starts_at_one(r, c) || (spare0_alpha && !texture0_has_alpha);
        if (from != nullptr) std::copy_n(from + begin, count, registers->plane[r][c].data());
        if (from == nullptr) std::fill_n(registers->plane[r][c].data(), count, full ? one : s9{0});
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

py::array_t<s9> evaluate(const RunnableProgram& program, const py::dict& inputs) {
  const Planes planes = planes_of(inputs, program.program);
  py::array_t<s9> color({std::size_t{4}, planes.count});
  s9* const to = color.mutable_data();
  const py::gil_scoped_release others_may_run;
  run(program, program.batch, planes, to, nullptr);
  return color;
}

py::dict evaluate_registers(const RunnableProgram& program, const py::dict& inputs) {
  const Planes planes = planes_of(inputs, program.program);
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
    const auto key = key_object.cast<std::string>();
    const Name name = name_of_key(key);
    const auto codes = name.component ? std::vector{value.cast<int>()} : value.cast<std::vector<int>>();
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

}  // namespace

void add_programs(py::module_& module) {
  py::class_<State>(module, "State", "The combiners as OpenGL holds them, and the profile they are of.")
      .def(py::init([](const std::string& profile) {
             return State{{}, &profile_named(profile)};
           }),
           py::arg("profile") = "geforce2", "OpenGL's default state.")
      .def_static("parse", &parse, py::arg("text"), py::arg("form"), py::arg("profile") = "geforce2",
                  "The state of a text: GL calls 'gl', !!RC1.0 'rc10', register words 'words' or 'words-json', 'json'.")
      .def("print", &print, py::arg("form"), "The state as a text of that form; Error where the form cannot say it.")
      .def("validate", &diagnostics, "What OpenGL would refuse, a dictionary for each fault; an empty list: nothing.")
      .def_property_readonly(
          "profile", [](const State& state) { return std::string(state.profile->name); }, "The name of the profile.")
      .def("__eq__", [](const State& a, const State& b) { return a.state == b.state && a.profile == b.profile; });
  py::class_<RunnableProgram>(module, "Program",
                              "A valid state made ready to run. It never changes, and may run in any thread.")
      .def(py::init(&compiled), py::arg("state"), "Compiles; Error where the state is not valid.")
      .def_property_readonly(
          "profile", [](const RunnableProgram& p) { return std::string(p.profile->name); }, "The name of the profile.")
      .def_property_readonly(
          "one", [](const RunnableProgram& p) { return p.program.datapath.one; }, "The code of 1.0.")
      .def_property_readonly(
          "lowest", [](const RunnableProgram& p) { return p.program.datapath.lowest; },
          "The lowest code of a register.")
      .def("evaluate", &evaluate, py::arg("inputs"),
           "The colours of n fragments as int16 codes of the shape (4, n). `inputs` has arrays of int16 codes by "
           "register, "
           "'tex0': (4, n), or by component, 'tex0.r': (n,); they are read in place. What is missing is 0, but 1.0 for "
           "alpha of textures and fog, and tex0's alpha for spare0's.")
      .def("evaluate_registers", &evaluate_registers, py::arg("inputs"),
           "The same as a dictionary: 'color', and every register after the last general combiner, (4, n) each.")
      .def("trace", &traced, py::arg("registers"),
           "Every step of one fragment, as `ninebit trace --json` tells it. `registers` has codes by name, 'tex0.r': "
           "100 or "
           "'tex0': (100, 0, 0, 255).")
      .def(
          "explain", [](const RunnableProgram& p) { return print_explanation(explain(p.program, *p.profile)); },
          "What the program computes, as equations.")
      .def(
          "glsl",
          [](const RunnableProgram& p, const std::string& function, bool es) {
            const auto text = emit_glsl(p.program, es ? GlslVersion::es_300 : GlslVersion::glsl_330, function);
            if (!text) throw Error{text.error().text()};
            return *text;
          },
          py::arg("function") = "ninebit_combine", py::arg("es") = false,
          "The program as a GLSL function of integers, for OpenGL 3.3 or OpenGL ES 3.0.");
}

}  // namespace ninebit::python
