// States and programs: parse, print, validate, compile.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/validate.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/program_text.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "src/python/evaluation.h"
#include "src/python/module.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

// The forms that parse() reads, by name.
constexpr std::array kForms{std::pair{"gl", ProgramForm::gl},       std::pair{"source", ProgramForm::source},
                            std::pair{"rc10", ProgramForm::rc10},   std::pair{"ps", ProgramForm::ps},
                            std::pair{"words", ProgramForm::words}, std::pair{"words-json", ProgramForm::words_json},
                            std::pair{"json", ProgramForm::json},   std::pair{"xbox", ProgramForm::xbox},
                            std::pair{"log", ProgramForm::log}};

State parse(const std::string& text, const std::optional<std::string>& form, const std::string& profile_name) {
  const HardwareProfile& profile = profile_named(profile_name);
  const auto named = std::find_if(kForms.begin(), kForms.end(), [&](const auto& one) { return form == one.first; });
  if (form && named == kForms.end()) {
    std::string names;
    for (const auto& one : kForms) names += std::string(names.empty() ? "" : ", ") + one.first;
    throw Error{"unknown form '" + *form + "'; expected one of " + names};
  }
  const auto parsed = parse_program({text, {}}, form ? named->second : form_of(text), profile);
  if (parsed) return {parsed->state, &profile};
  throw Error{parsed.error().text()};
}

std::string print(const State& state, const std::string& form) {
  const HardwareProfile& profile = *state.profile;
  if (form == "json") return print_json_program(state.state);
  const auto text =
      form == "gl"           ? print_gl_calls(state.state, profile)
      : form == "rc10"       ? print_rc10(state.state, profile)
      : form == "ps11"       ? print_pixel_shader(state.state, profile)
      : form == "words"      ? print_register_words(state.state, chip_of(profile), profile)
      : form == "words-json" ? print_json_register_words(state.state, chip_of(profile), profile)
      : form == "xbox"
          ? print_xbox_pixel_shader(state.state, profile)
          : throw Error{"unknown form '" + form + "'; expected one of gl, rc10, ps11, words, words-json, json, xbox"};
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
      .def_static(
          "parse", &parse, py::arg("text"), py::arg("form") = py::none(), py::arg("profile") = "geforce2",
          "Parses a text in the form 'gl' (GL calls), 'source' (a source file with them), 'rc10' (!!RC1.0), 'ps' "
          "(a ps.1.x pixel shader), 'words' or 'words-json' (register words), 'json', 'xbox' (a "
          "D3DPIXELSHADERDEF) or 'log' (register writes with one set-up); None: as the text looks.")
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
