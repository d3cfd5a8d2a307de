// States and programs: parse, print, validate, compile.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/validate.h"
#include "ninebit/language/explain.h"
#include "ninebit/language/glsl.h"
#include "ninebit/language/json.h"
#include "ninebit/language/program_text.h"
#include "src/python/evaluation.h"
#include "src/python/module.h"
#include "src/system/nearest_name.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

template <class Names>
[[noreturn]] void refuse_name(const char* what, const std::string& name, const Names& names) {
  std::string list;
  for (const auto& one : names) list += (list.empty() ? "" : ", ") + std::string(one);
  throw Error{std::string("unknown ") + what + " '" + name + "'; expected one of " + list + did_you_mean(name, names)};
}

ProgramForm form_named(const std::string& name) {
  const Form* const form = find_form(name);
  if (form == nullptr || form->parse == nullptr) refuse_name("form", name, read_form_names());
  return form_id(*form);
}

ChipClass chip_named(const std::string& name) {
  if (name == "nv10") return ChipClass::nv10;
  if (name == "nv20") return ChipClass::nv20;
  refuse_name("chip", name, std::vector<std::string>{"nv10", "nv20"});
}

using Words = std::optional<std::string>;

ReadOptions options_of(const Words& chip, const std::vector<std::string>& functions,
                       const std::map<std::string, std::string>& definitions, std::size_t setup) {
  ReadOptions options{.setup = setup, .source = {.functions = functions}};
  if (chip) options.chip = chip_named(*chip);
  for (const auto& [name, value] : definitions) options.source.definitions.push_back({name, value});
  return options;
}

State parse(const std::string& text, const Words& form, const std::string& profile_name, const Words& chip,
            const std::vector<std::string>& functions, const std::map<std::string, std::string>& definitions,
            std::size_t setup) {
  const ProfileChoice profile = profile_named(profile_name);
  const auto parsed = parse_program({text, {}}, form ? form_named(*form) : form_of(text), *profile.profile,
                                    options_of(chip, functions, definitions, setup));
  if (!parsed) throw Error{parsed.error().text()};
  State state{parsed->state, profile, {}, parsed->texture_shader};
  for (const TextFault& note : parsed.notes) state.notes.push_back(note.text());
  return state;
}

std::string print(const State& state, const std::string& form, const Words& chip) {
  const Form* const named = find_form(form);
  if (named == nullptr || named->print == nullptr) refuse_name("form", form, written_form_names());
  const HardwareProfile& profile = *state.profile.profile;
  if (form == "c" || form.starts_with("glsl")) {
    if (const auto program = compile(state.state, profile); !program) throw Error{program.error().text()};
  }
  const auto text =
      named->print({state.state, {}, state.texture_shader}, chip ? chip_named(*chip) : chip_of(profile), profile);
  if (!text) throw Error{"cannot be written as " + form + ": " + text.error().text()};
  return *text;
}

std::vector<py::dict> diagnostics(const State& state) {
  std::vector<py::dict> rows;
  for (const StateDiagnostic& found :
       validate(TextProgram{state.state, {}, state.texture_shader}, *state.profile.profile)) {
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
  const TextProgram both{state.state, {}, state.texture_shader};
  if (const auto wrong = validate(both, *state.profile.profile); !wrong.empty()) throw Error{wrong.front().message};
  const auto program = compile(state.state, *state.profile.profile);
  if (!program) throw Error{program.error().text()};
  return {state, *program, BatchProgram(*program), BatchProgram(*program, {}, {}, BatchInputs::not_negative)};
}

std::string explained(const RunnableProgram& p) {
  const std::string stages = print_stages(p.state.texture_shader);
  return stages + (stages.empty() ? "" : "\n") + print_explanation(explain(p.program, *p.state.profile.profile));
}

std::string glsl(const RunnableProgram& p, const std::string& function, bool es) {
  const auto text = emit_glsl(p.program, es ? GlslVersion::es_300 : GlslVersion::glsl_330, function);
  if (!text) throw Error{text.error().text()};
  return *text;
}

void add_state(py::module_& module) {
  py::class_<State>(module, "State")
      .def(py::init([](const std::string& profile) {
             return State{{}, profile_named(profile)};
           }),
           py::arg("profile"))
      .def(py::init(&parse), py::arg("text"), py::arg("form"), py::arg("profile"), py::arg("chip"), py::arg("function"),
           py::arg("define"), py::arg("setup"))
      .def("print", &print, py::arg("form"), py::arg("chip") = py::none(),
           "The state as a text of that form; Error if the form cannot express it. `chip` is that of register words.")
      .def("validate", &diagnostics,
           "The faults that OpenGL would refuse, one dictionary each; an empty list if the state is valid.")
      .def_property_readonly(
          "profile", [](const State& state) { return std::string(state.profile.profile->name); },
          "The name of the profile.")
      .def_property_readonly("_notes", [](const State& state) { return state.notes; })
      .def_property_readonly("_profile", [](const State& state) { return state.profile.given; })
      .def_property_readonly(
          "stages", [](const State& state) { return state.state.num_general_combiners; },
          "The number of general combiners.")
      .def(
          "__eq__",
          [](const State& a, const State& b) {
            return a.state == b.state && a.texture_shader == b.texture_shader &&
                   a.profile.profile->name == b.profile.profile->name;
          },
          py::is_operator());
  module.def(
      "form_of", [](const std::string& text) { return std::string(form_row(form_of(text)).name); }, py::arg("text"),
      "The form that State.parse() finds in a text.");
}

}  // namespace

void add_programs(py::module_& module) {
  add_state(module);
  module.attr("REGISTERS") = py::tuple(py::cast(register_names()));
  module.def("register_named", [](const std::string& name) -> std::optional<std::string> {
    const std::optional<Register> reg = register_named(name);
    return reg ? std::optional<std::string>(short_name(*reg)) : std::nullopt;
  });
  py::class_<RunnableProgram>(module, "Program")
      .def(py::init(&compiled), py::arg("state"))
      .def_property_readonly(
          "profile", [](const RunnableProgram& p) { return std::string(p.state.profile.profile->name); },
          "The name of the profile.")
      .def_property_readonly(
          "one", [](const RunnableProgram& p) { return p.program.datapath.one; }, "The code of 1.0.")
      .def_property_readonly(
          "lowest", [](const RunnableProgram& p) { return p.program.datapath.lowest; },
          "The lowest code that a register can hold before the first stage.")
      .def_property_readonly(
          "stages", [](const RunnableProgram& p) { return p.program.num_general_combiners; },
          "The number of general combiners.")
      .def("_evaluate", &evaluate, py::arg("planes"), py::arg("count"), py::arg("color").noconvert(),
           py::arg("after").noconvert().none(true))
      .def("_evaluate_real", &evaluate_real, py::arg("planes"), py::arg("count"), py::arg("color").noconvert(),
           py::arg("after").noconvert())
      .def("_run_stages", &run_stages, py::arg("planes"), py::arg("count"))
      .def_property_readonly("_has_stages", [](const RunnableProgram& p) { return p.state.texture_shader.enabled; })
      .def("_trace", &traced, py::arg("registers"), py::arg("given"))
      .def("explain", &explained, "The program as equations.")
      .def("glsl", &glsl, py::arg("function") = "ninebit_combine", py::arg("es") = false,
           "The program as a GLSL function of integers, for OpenGL 3.3 or OpenGL ES 3.0.");
}

}  // namespace ninebit::python
