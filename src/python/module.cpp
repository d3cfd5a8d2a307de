#include "src/python/module.h"

#include <pybind11/stl.h>

#include <vector>

#include "ninebit/combiner/batch_program.h"

namespace py = pybind11;

namespace ninebit::python {

const HardwareProfile& profile_named(const std::string& name) {
  const HardwareProfile* const found = find_profile(name);
  if (found != nullptr) return *found;
  std::string message = "unknown profile '" + name + "'; expected one of";
  for (const HardwareProfile& profile : hardware_profiles()) message += ' ' + std::string(profile.name);
  throw Error{message};
}

}  // namespace ninebit::python

PYBIND11_MODULE(_ninebit, module) {
  using namespace ninebit;
  module.doc() = "GeForce 2 register combiners to the bit, and the shadow techniques built on them.";
  // Never freed: the interpreter may end before this module's statics are destroyed.
  static PyObject* const error =
      PyErr_NewExceptionWithDoc("ninebit.Error", "An invalid program, state or file.", PyExc_ValueError, nullptr);
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
  module.def(
      "profiles",
      [] {
        std::vector<std::string> names;
        for (const HardwareProfile& profile : hardware_profiles()) names.emplace_back(profile.name);
        return names;
      },
      "The names of the hardware profiles, the default first.");
  module.def("simd_target", &simd_target, "The SIMD target that Program.evaluate runs on here, such as \"AVX2\".");
  python::add_programs(module);
  python::add_render(module);
  python::add_draw(module);
  python::add_studies(module);
}
