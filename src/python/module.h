// Shared by the parts of the Python module. `import ninebit` loads the package in src/python/ninebit; this is its
// extension module, _ninebit.
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

// Raised as ninebit.Error, a ValueError, for invalid programs, states and files.
struct Error {
  std::string message;
};

// The shipped profile with that name; throws Error if there is none.
[[nodiscard]] const HardwareProfile& profile_named(const std::string& name);

// The technique with that name; throws Error if there is none.
[[nodiscard]] const Technique& technique_named(const std::string& name);

// The camera and light of a scene. A missing value is taken from the file, or chosen by complete_scene().
using Point = std::array<float, 3>;
struct View {
  std::optional<Point> camera, look_at;
  std::optional<float> fov;  // degrees
  std::optional<Point> light;
  bool allow_outside = false;  // the scene may name files outside its folder
};

// The scene of a file, completed for a picture of this width and height; throws Error if that fails.
[[nodiscard]] Scene scene_for(const Technique& technique, const std::string& file, const std::pair<int, int>& size,
                              const View& view);

void add_programs(pybind11::module_& module);
void add_render(pybind11::module_& module);
void add_draw(pybind11::module_& module);
void add_studies(pybind11::module_& module);

}  // namespace ninebit::python
