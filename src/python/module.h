// What the parts of the Python module share. `import ninebit` is the package in src/python/ninebit; this is its module
// _ninebit.
#pragma once

#include <pybind11/pybind11.h>

#include <array>
#include <optional>
#include <string>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/technique.h"

namespace ninebit::python {

// What the package raises for wrong programs, states and files: ninebit.Error, a ValueError.
struct Error {
  std::string message;
};

// The shipped profile of a name, or Error.
[[nodiscard]] const HardwareProfile& profile_named(const std::string& name);

// The technique of a name, or Error.
[[nodiscard]] const Technique& technique_named(const std::string& name);

// Where a scene is seen and lit from; without a value as the file says, or as complete_scene() chooses.
using Point = std::array<float, 3>;
struct View {
  std::optional<Point> camera, look_at;
  std::optional<float> fov;  // degrees
  std::optional<Point> light;
  bool allow_outside = false;  // files that the scene names may stand anywhere
};

// A file's scene, complete for a picture of this width and height, or Error.
[[nodiscard]] Scene scene_for(const Technique& technique, const std::string& file, const std::pair<int, int>& size,
                              const View& view);

void add_programs(pybind11::module_& module);
void add_render(pybind11::module_& module);
void add_studies(pybind11::module_& module);

}  // namespace ninebit::python
