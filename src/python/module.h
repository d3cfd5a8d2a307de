// Shared by the parts of the extension module _combiner, which needs nothing but the combiners, so that `import
// ninebit` is quick. The other module, _verbs, is loaded by the first call that draws, studies or proves.
#pragma once

#include <pybind11/pybind11.h>

#include <memory>
#include <string>

#include "ninebit/language/profile_json.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::python {

// Raised as ninebit.Error, a ValueError, for invalid programs, states and files.
struct Error {
  std::string message;
};

// A shipped profile, or one from a file.
struct ProfileChoice {
  std::string given;                        // the name or the path
  std::shared_ptr<const OwnedProfile> own;  // of a file
  const HardwareProfile* profile;
};

// The profile with that name, or of the .json file; throws Error if there is none.
[[nodiscard]] ProfileChoice profile_named(const std::string& name);

void add_programs(pybind11::module_& module);

}  // namespace ninebit::python
