// Renders scenes with a shadow technique; the returned arrays use the rendering's memory.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <initializer_list>
#include <memory>
#include <optional>
#include <variant>

#include "ninebit/scene/scene_io.h"
#include "ninebit/shadow/technique.h"
#include "src/python/module.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

glm::vec3 vector_of(const Point& p) {
  return {p[0], p[1], p[2]};
}

// A plane of the rendering as an array whose first row is the top one; the array keeps the rendering alive. The plane
// itself starts with the bottom row.
template <class T>
py::array upright(const PlaneSamples<T>& plane, int width, int height, const std::shared_ptr<Rendering>& owner) {
  if (plane.empty()) return py::array_t<T>(std::vector<py::ssize_t>{0, 0});
  const py::capsule keeps(new std::shared_ptr<Rendering>(owner),
                          [](void* kept) { delete static_cast<std::shared_ptr<Rendering>*>(kept); });
  const auto row = static_cast<py::ssize_t>(sizeof(T)) * width;
  return py::array_t<T>(std::vector<py::ssize_t>{height, width},
                        std::vector<py::ssize_t>{-row, static_cast<py::ssize_t>(sizeof(T))},
                        plane.data() + static_cast<std::size_t>(height - 1) * static_cast<std::size_t>(width), keeps);
}

// The value of that name. Throws Error for an unknown name.
template <class E>
E named(const std::string& name, std::initializer_list<E> all, const char* what) {
  std::string expected;
  for (const E one : all) {
    if (name_of(one) == name) return one;
    expected += ' ' + std::string(name_of(one));
  }
  throw Error{std::string("unknown ") + what + " '" + name + "'; expected one of" + expected};
}

py::dict order_of(const Rendering& rendering) {
  const IndexOrderReport& report = rendering.index_order;
  py::dict order;
  order["order"] = name_of(report.order);
  order["reason"] = report.reason;
  order["patches"] = report.patches;
  order["borders"] = report.borders;
  order["broken_borders"] = report.broken_borders;
  order["broken_share"] = report.broken_share;
  order["false_neighbours"] = report.false_neighbours;
  return order;
}

py::dict render(const std::string& scene_file, const std::string& technique_name, std::pair<int, int> size,
                int map_size, const std::string& profile, int index_step, const std::string& index_order,
                float patch_angle, const std::string& index_scales, const std::optional<Point>& camera,
                const std::optional<Point>& look_at, std::optional<float> fov, const std::optional<Point>& light,
                bool allow_outside) {
  const Technique& technique = technique_named(technique_name);
  RenderSettings settings;
  settings.width = size.first;
  settings.height = size.second;
  settings.map_size = map_size;
  settings.index.step = index_step;
  settings.index.order = named(index_order, {IndexOrder::file, IndexOrder::neighbour}, "index order");
  settings.index.patch_degrees = patch_angle;
  settings.index.scales = named(
      index_scales, {IndexScales::both, IndexScales::first, IndexScales::second, IndexScales::none}, "index scales");
  settings.profile = profile_named(profile);

  std::optional<Result<Rendering>> drawn;
  {
    const py::gil_scoped_release others_may_run;
    const Scene scene = scene_for(technique, scene_file, size, {camera, look_at, fov, light, allow_outside});
    drawn.emplace(technique.render(scene, settings, {}));
  }
  if (!*drawn) throw Error{drawn->error().text()};
  const auto rendering = std::make_shared<Rendering>(std::move(drawn->value()));
  const Surface& frame = rendering->frame;
  py::dict answer;
  constexpr std::array kColors{"red", "green", "blue", "alpha"};
  for (int c = 0; c < 4; ++c) {
    answer[kColors[static_cast<std::size_t>(c)]] = upright(frame.color(c), frame.width(), frame.height(), rendering);
  }
  answer["depth"] = upright(frame.depth(), frame.width(), frame.height(), rendering);
  answer["stencil"] = upright(frame.stencil(), frame.width(), frame.height(), rendering);
  answer["background"] = rendering->background;
  answer["lit"] = rendering->lit;
  answer["shadowed"] = rendering->shadowed;
  py::dict facts;
  for (const Fact& fact : rendering->facts) {
    facts[py::str(fact.name)] = std::visit([](const auto& value) { return py::cast(value); }, fact.value);
  }
  answer["facts"] = facts;
  answer["index_order"] = order_of(*rendering);
  return answer;
}

}  // namespace

const Technique& technique_named(const std::string& name) {
  const Technique* const technique = find_technique(name);
  if (technique != nullptr) return *technique;
  std::string message = "unknown technique '" + name + "'; expected one of";
  for (const Technique& one : techniques()) message += ' ' + std::string(one.name);
  throw Error{message};
}

Scene scene_for(const Technique& technique, const std::string& file, const std::pair<int, int>& size,
                const View& view) {
  if (size.first < 1 || size.second < 1) throw Error{"size must be width and height, each at least 1"};
  SceneSetup setup;
  setup.light_kinds = technique.lights;
  if (view.camera) setup.camera = vector_of(*view.camera);
  if (view.look_at) setup.look_at = vector_of(*view.look_at);
  if (view.light) setup.light = vector_of(*view.light);
  setup.fov_degrees = view.fov;
  auto scene = read_scene(file, {.allow_outside = view.allow_outside, .isolated = true});
  if (!scene) throw Error{scene.error().text()};
  const float aspect_ratio = static_cast<float>(size.first) / static_cast<float>(size.second);
  auto complete = complete_scene(std::move(*scene), setup, aspect_ratio);
  if (!complete) throw Error{complete.error().text()};
  return std::move(*complete);
}

void add_render(py::module_& module) {
  module.def(
      "techniques",
      [] {
        std::vector<std::string> names;
        for (const Technique& technique : techniques()) names.emplace_back(technique.name);
        return names;
      },
      "The names of the shadow techniques, the default first.");
  module.def(
      "render", &render, py::arg("scene"), py::kw_only(), py::arg("technique") = "index-cube",
      py::arg("size") = std::pair{1024, 768}, py::arg("map_size") = 512, py::arg("profile") = "geforce2",
      py::arg("index_step") = 2, py::arg("index_order") = "file", py::arg("patch_angle") = kPatchDegrees,
      py::arg("index_scales") = "both-x4", py::arg("camera") = py::none(), py::arg("look_at") = py::none(),
      py::arg("fov") = py::none(), py::arg("light") = py::none(), py::arg("allow_outside") = false,
      "Renders a scene with shadows. Returns 'red', 'green', 'blue', 'alpha', 'stencil' (uint8; 0 is lit) and 'depth' "
      "(uint32 codes) as upright arrays of the shape (height, width) in the rendering's memory; the numbers of pixels "
      "that are 'background', 'lit' and 'shadowed'; the technique's 'facts'; and 'index_order', the order of indices "
      "that was used, with its counts. Files that the scene names are read only below its folder unless allow_outside "
      "is true.");
}

}  // namespace ninebit::python
