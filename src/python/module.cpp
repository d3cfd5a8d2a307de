#include "src/python/module.h"

#include <pybind11/stl.h>

#include <utility>
#include <vector>

#include "ninebit/combiner/batch_program.h"
#include "src/system/nearest_name.h"
#include "src/system/stream.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

std::vector<std::string> profile_names() {
  std::vector<std::string> names;
  for (const HardwareProfile& profile : hardware_profiles()) names.emplace_back(profile.name);
  return names;
}

ProfileChoice profile_of_file(const std::string& path) {
  std::error_code error;
  const std::string text = posix::read_file(path, kMaxSourceBytes + 1, error);
  if (error) throw Error{path + ": cannot be read: " + error.message() + "; expected a profile as a .json file"};
  auto parsed = parse_json_profile({text, path});
  if (!parsed) throw Error{parsed.faults()[0].text()};
  auto own = std::make_shared<const OwnedProfile>(std::move(parsed).value());
  const HardwareProfile* const profile = &own->profile;
  return {path, std::move(own), profile};
}

}  // namespace

ProfileChoice profile_named(const std::string& name) {
  if (const HardwareProfile* const found = find_profile(name)) return {name, nullptr, found};
  if (name.ends_with(".json")) return profile_of_file(name);
  std::string message = "unknown profile '" + name + "'; expected ";
  for (const std::string& one : profile_names()) message += one + ", ";
  throw Error{message + "or the path of a .json file" + did_you_mean(name, profile_names())};
}

}  // namespace ninebit::python

PYBIND11_MODULE(_combiner, module) {
  using namespace ninebit;
  // Never freed: the interpreter may end before this module's statics are destroyed.
  static PyObject* const error = PyErr_NewExceptionWithDoc(
      "ninebit.Error", "An invalid program, state, file or option.", PyExc_ValueError, nullptr);
  module.attr("Error") = py::handle(error);
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the function's type is pybind11's
  py::register_exception_translator([](std::exception_ptr fault) {
    try {
      if (fault) std::rethrow_exception(fault);
    } catch (const python::Error& wrong) {
      PyErr_SetString(error, wrong.message.c_str());
    }
  });
  module.attr("__version__") = NINEBIT_VERSION;
  module.def("profiles", &python::profile_names, "The names of the hardware profiles, the default first.");
  module.def("simd_target", &simd_target, "The SIMD target that Program.evaluate runs on here, such as \"AVX2\".");
  module.def(
      "nearest_name",
      [](const std::string& wrong, const std::vector<std::string>& names) { return did_you_mean(wrong, names); },
      "The end of a sentence, \"; did you mean 'NAME'?\", or an empty text.");
  python::add_programs(module);
}
