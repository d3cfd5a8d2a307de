// Runs studies and returns their raw rows as NumPy structured arrays, one per table.
#include <pybind11/numpy.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

#include "ninebit/study/datapath_error.h"
#include "ninebit/study/depth_packing_error.h"
#include "ninebit/study/index_steps.h"
#include "ninebit/study/shadow_sweep.h"
#include "src/python/module.h"

namespace py = pybind11;

namespace ninebit::python {
namespace {

using Names = std::optional<std::vector<std::string>>;

// The elements of `all` with these names, in the order of the names; without names, all elements. Throws Error for an
// unknown name.
template <class T, class NameOf>
std::vector<T> chosen(const std::vector<T>& all, const Names& names, const char* what, const NameOf& name_of_one) {
  if (!names) return all;
  std::vector<T> found;
  for (const std::string& name : *names) {
    const auto one = std::find_if(all.begin(), all.end(), [&](const T& each) { return name_of_one(each) == name; });
    if (one == all.end()) {
      std::string message = std::string("unknown ") + what + " '" + name + "'; expected one of";
      for (const T& each : all) message += ' ' + std::string(name_of_one(each));
      throw Error{message};
    }
    found.push_back(*one);
  }
  return found;
}

std::vector<HardwareProfile> chosen_profiles(const Names& names) {
  if (!names) return {hardware_profiles().begin(), hardware_profiles().end()};
  std::vector<HardwareProfile> profiles;
  for (const std::string& name : *names) profiles.push_back(profile_named(name));
  return profiles;
}

// The dtype of a column. A column of numbers with missing values has doubles, with NaN for the missing ones.
std::string column_type(const std::vector<StudyRow>& rows, std::size_t field) {
  std::size_t longest = 1;
  bool texts = false, whole = true, positive = true;
  for (const StudyRow& row : rows) {
    const StudyValue& value = row.fields[field].second;
    if (const auto* const text = std::get_if<std::string>(&value)) {
      texts = true;
      longest = std::max(longest, text->size());  // in bytes, which is at least the number of characters
    }
    const bool unsigned_one = std::holds_alternative<std::uint64_t>(value);
    positive = positive && unsigned_one;
    whole = whole && (unsigned_one || std::holds_alternative<std::int64_t>(value));
  }
  return texts ? "U" + std::to_string(longest) : positive ? "u8" : whole ? "i8" : "f8";
}

py::object cell(const StudyValue& value, bool in_text) {
  if (!std::holds_alternative<std::monostate>(value)) {
    return std::visit([](const auto& v) -> py::object { return py::cast(v); }, value);
  }
  return in_text ? py::object(py::str("")) : py::object(py::float_(py::module_::import("math").attr("nan")));
}

py::object structured(const std::vector<StudyRow>& rows) {
  py::list types;
  std::vector<bool> in_text;
  for (std::size_t i = 0; i < rows.front().fields.size(); ++i) {
    const std::string type = column_type(rows, i);
    in_text.push_back(type[0] == 'U');
    types.append(py::make_tuple(rows.front().fields[i].first, type));
  }
  py::list tuples;
  for (const StudyRow& row : rows) {
    py::tuple cells(row.fields.size());
    for (std::size_t i = 0; i < row.fields.size(); ++i) cells[i] = cell(row.fields[i].second, in_text[i]);
    tuples.append(cells);
  }
  return py::module_::import("numpy").attr("array")(tuples, types);
}

// Runs all units in order; Ctrl-C stops between two units.
py::dict run(Result<std::unique_ptr<Study>> made) {
  if (!made) throw Error{made.error().text()};
  const Study& study = **made;
  std::map<std::string, std::vector<StudyRow>> tables;
  for (std::size_t unit = 0; unit < study.units(); ++unit) {
    std::optional<Result<std::vector<StudyRow>>> rows;
    {
      const py::gil_scoped_release others_may_run;
      rows.emplace(study.run(unit, {}));
    }
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
    if (!*rows) throw Error{rows->error().text()};
    for (StudyRow& row : rows->value()) tables[row.table].push_back(std::move(row));
  }
  py::dict answer;
  for (const auto& [name, rows] : tables) answer[py::str(name)] = structured(rows);
  return answer;
}

py::dict index_steps(const Names& profiles, const Names& formats, const Names& variants, std::pair<int, int> steps) {
  IndexStepsOptions options{.profiles = chosen_profiles(profiles)};
  options.formats = chosen(options.formats, formats, "format", [](StudyFormat format) { return name_of(format); });
  options.variants =
      chosen(options.variants, variants, "variant", [](const IndexVariant& variant) { return variant.name; });
  std::tie(options.first_step, options.last_step) = steps;
  return run(index_steps_study(std::move(options)));
}

py::dict datapath(const Names& profiles) {
  return run(datapath_study({.study = "datapath", .profile = "all"}, chosen_profiles(profiles)));
}

py::dict depth_packing(const Names& packings, const Names& storages, const Names& sets, std::uint32_t float_step) {
  DepthPackingOptions options = all_depth_packings();
  options.packings = chosen(options.packings, packings, "packing", [](const std::string& name) { return name; });
  options.storages = chosen(options.storages, storages, "storage", [](ChannelStorage one) { return name_of(one); });
  options.sets = chosen(options.sets, sets, "set", [](DepthSet one) { return name_of(one); });
  options.float_step = float_step;
  return run(make_depth_packing_study(options));
}

// The values of an axis by their names; empty if the axis is not swept.
template <class T>
std::vector<T> swept(const std::vector<std::pair<const char*, T>>& all, const Names& names, const char* what) {
  std::vector<T> values;
  if (!names) return values;
  for (const auto& [name, value] : chosen(all, names, what, [](const auto& one) { return std::string(one.first); })) {
    values.push_back(value);
  }
  return values;
}

py::dict shadows(const std::string& file, const std::string& technique_name, std::pair<int, int> size,
                 const std::string& profile, const std::vector<int>& map_sizes, const Names& formats,
                 const Names& scopes, const std::vector<int>& steps, const Names& orders, const Names& scales,
                 const Names& depth_bits, const std::vector<float>& biases, const Names& encodings,
                 const std::vector<std::pair<float, float>>& polygon_offsets, const std::optional<Point>& camera,
                 const std::optional<Point>& look_at, std::optional<float> fov, const std::optional<Point>& light,
                 bool allow_outside) {
  const Technique& technique = technique_named(technique_name);
  RenderSettings settings;
  settings.width = size.first;
  settings.height = size.second;
  settings.profile = profile_named(profile);
  ShadowGrid grid{.map_sizes = map_sizes, .index_steps = steps, .biases = biases};
  grid.index_formats = swept<IndexFormat>({{"rgb", IndexFormat::rgb},
                                           {"la", IndexFormat::luminance_alpha},
                                           {"l", IndexFormat::luminance},
                                           {"a", IndexFormat::alpha}},
                                          formats, "format");
  grid.index_scopes = swept<IndexScope>(
      {{"polygon", IndexScope::polygon}, {"object", IndexScope::object}, {"section", IndexScope::section}}, scopes,
      "scope");
  grid.index_orders =
      swept<IndexOrder>({{"file", IndexOrder::file}, {"neighbour", IndexOrder::neighbour}}, orders, "order");
  grid.index_scales = swept<IndexScales>({{"both-x4", IndexScales::both},
                                          {"first-x4", IndexScales::first},
                                          {"second-x4", IndexScales::second},
                                          {"no-scale", IndexScales::none}},
                                         scales, "scale");
  grid.depth_bits = swept<DepthCubeBits>(
      {{"8", DepthCubeBits::eight}, {"16", DepthCubeBits::sixteen}, {"float", DepthCubeBits::real}}, depth_bits,
      "number of depth bits");
  grid.encodings = swept<DepthEncoding>({{"d24", DepthEncoding::d24},
                                         {"d16", DepthEncoding::d16},
                                         {"rgba8-fract", DepthEncoding::rgba8_fract},
                                         {"rgba8-mod", DepthEncoding::rgba8_mod},
                                         {"rgba8-256over255", DepthEncoding::rgba8_256over255},
                                         {"rgba8-modf", DepthEncoding::rgba8_modf}},
                                        encodings, "encoding");
  for (const auto& [factor, units] : polygon_offsets) grid.polygon_offsets.push_back({factor, units});
  StudyQuestion question{.study = "shadows", .profile = profile};
  question.arguments = file;
  return run(make_shadow_sweep(std::move(question),
                               scene_for(technique, file, size, {camera, look_at, fov, light, allow_outside}),
                               technique, settings, grid));
}

}  // namespace

void add_studies(py::module_& module) {
  module.def(
      "index_steps_study", &index_steps, py::kw_only(), py::arg("profiles") = py::none(),
      py::arg("formats") = py::none(), py::arg("variants") = py::none(), py::arg("steps") = std::pair{1, 16},
      "Counts the pairs of different indices that compare equal, over all pairs: {'rows': array} with the fields "
      "profile, format, variant, step, codes, pairs, false_matches. Lists of names select; the default is all. "
      "`steps` are the first and the last. As `ninebit study index-steps`.");
  module.def(
      "datapath_study", &datapath, py::kw_only(), py::arg("profiles") = py::none(),
      "The error of each datapath operation against exact arithmetic, over all inputs: {'rows': array}, one row per "
      "operation and form, errors in real numbers; and 'differences' between each two profiles whose codes stand for "
      "the same numbers. Profiles whose arithmetic is not integer are skipped. As `ninebit study datapath`.");
  module.def(
      "depth_packing_study", &depth_packing, py::kw_only(), py::arg("packings") = py::none(),
      py::arg("storages") = py::none(), py::arg("sets") = py::none(), py::arg("float_step") = 64,
      "The error of depths after a round trip through bytes: {'rows': array, 'second_digit': array}. Storages are "
      "'round' and 'truncate'; sets are '16', '24' and 'floats', which takes every `float_step`th float. As "
      "`ninebit study depth-packing`.");
  module.def(
      "shadows_study", &shadows, py::arg("scene"), py::kw_only(), py::arg("technique") = "index-cube",
      py::arg("size") = std::pair{1024, 768}, py::arg("profile") = "geforce2",
      py::arg("map_sizes") = std::vector<int>{}, py::arg("formats") = py::none(), py::arg("scopes") = py::none(),
      py::arg("steps") = std::vector<int>{}, py::arg("orders") = py::none(), py::arg("scales") = py::none(),
      py::arg("depth_bits") = py::none(), py::arg("biases") = std::vector<float>{}, py::arg("encodings") = py::none(),
      py::arg("polygon_offsets") = std::vector<std::pair<float, float>>{}, py::arg("camera") = py::none(),
      py::arg("look_at") = py::none(), py::arg("fov") = py::none(), py::arg("light") = py::none(),
      py::arg("allow_outside") = false,
      "Counts a technique's wrong pixels by cause, against the ground truth, for each combination of the settings that "
      "are given as lists: {'rows': array}. As `ninebit study shadows`.");
}

}  // namespace ninebit::python
