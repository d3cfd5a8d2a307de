// States and programs: parse, print, validate, compile.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/validate.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_words.h"
#include "src/python/evaluation.h"
#include "src/python/module.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

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
                      : form == "json"
                          ? parse_json_program(source, profile)
                          : throw Error{"unknown form; expected 'gl', 'rc10', 'words', 'words-json' or 'json'"};
  if (parsed) return {*parsed.value, &profile};
  std::string faults;
  for (const TextFault& fault : parsed.faults) faults += (faults.empty() ? "" : "\n") + fault.text();
  throw Error{faults};
}

std::string print(const State& state, const std::string& form) {
  const HardwareProfile& profile = *state.profile;
  if (form == "json") return print_json_program(state.state);
  const auto text = form == "gl"      ? print_gl_calls(state.state, profile)
                    : form == "rc10"  ? print_rc10(state.state, profile)
                    : form == "words" ? print_register_words(state.state, chip_of(profile), profile)
                    : form == "words-json"
                        ? print_json_register_words(state.state, chip_of(profile), profile)
                        : throw Error{"unknown form; expected 'gl', 'rc10', 'words', 'words-json' or 'json'"};
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

}  // namespace

void add_programs(py::module_& module) {
  py::class_<State>(module, "State", "The combiner state of OpenGL, and its hardware profile.")
      .def(py::init([](const std::string& profile) {
             return State{{}, &profile_named(profile)};
           }),
           py::arg("profile") = "geforce2", "OpenGL's default state.")
      .def_static("parse", &parse, py::arg("text"), py::arg("form"), py::arg("profile") = "geforce2",
                  "Parses a text in the form 'gl' (GL calls), 'rc10' (!!RC1.0), 'words' or 'words-json' (register "
                  "words), 'json'.")
      .def("print", &print, py::arg("form"), "The state as a text of that form; Error if the form cannot express it.")
      .def("validate", &diagnostics,
           "The faults that OpenGL would refuse, one dictionary each; an empty list if the state is valid.")
      .def_property_readonly(
          "profile", [](const State& state) { return std::string(state.profile->name); }, "The name of the profile.")
      .def(
          "__eq__", [](const State& a, const State& b) { return a.state == b.state && a.profile == b.profile; },
          py::is_operator());
  py::class_<RunnableProgram>(module, "Program",
                              "A compiled, valid state. It never changes, and any thread may use it.")
      .def(py::init(&compiled), py::arg("state"), "Compiles a state; Error if it is not valid.")
      .def_property_readonly(
          "profile", [](const RunnableProgram& p) { return std::string(p.profile->name); }, "The name of the profile.")
      .def_property_readonly(
          "one", [](const RunnableProgram& p) { return p.program.datapath.one; }, "The code of 1.0.")
      .def_property_readonly(
          "lowest", [](const RunnableProgram& p) { return p.program.datapath.lowest; },
          "The lowest code that a register can hold before the first stage.")
      .def("evaluate", &evaluate, py::arg("inputs"),
           "The colours of n fragments as int16 codes of the shape (4, n). `inputs` has arrays of int16 codes by "
           "register, 'tex0': (4, n), or by component, 'tex0.r': (n,); they are read in place. Missing components are "
           "0, except the alpha of textures and fog, which is 1.0, and spare0's alpha, which is tex0's.")
      .def("evaluate_registers", &evaluate_registers, py::arg("inputs"),
           "Like evaluate, as a dictionary: 'color', and every register after the last general combiner, (4, n) each.")
      .def("trace", &traced, py::arg("registers"),
           "Every step of one fragment, as printed by `ninebit trace --json`. `registers` has codes by name, "
           "'tex0.r': 100 or 'tex0': (100, 0, 0, 255).")
      .def(
          "explain", [](const RunnableProgram& p) { return print_explanation(explain(p.program, *p.profile)); },
          "The program as equations.")
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
