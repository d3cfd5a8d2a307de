// `ninebit study shadows`: counts the wrong pixels of a technique over a grid of its settings.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "ninebit/study/shadow_sweep.h"
#include "src/study/part/sweep_axes.h"
#include "src/tools/common/cookie_file.h"
#include "src/tools/common/number_flag.h"
#include "src/tools/common/number_list.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/study/study.h"

namespace ninebit::tools {
namespace {

constexpr const char* kDefaultMapSizes = "128,256,512,1024";

struct ShadowsFlags {
  StudyFlags study;
  SceneFlags scene;
  std::vector<CLI::Option*> scene_options;
  std::string map_sizes, formats, scopes, steps, orders, scales, depth_bits, biases, encodings, polygon_offsets;
  bool find_offset = false;

  // The axes: flag and list; an empty list is not swept.
  [[nodiscard]] std::vector<std::pair<const char*, const std::string*>> axes() const {
    return {{"--map-sizes", &map_sizes},   {"--formats", &formats},
            {"--scopes", &scopes},         {"--steps", &steps},
            {"--orders", &orders},         {"--scales", &scales},
            {"--depth-bits", &depth_bits}, {"--biases", &biases},
            {"--encodings", &encodings},   {"--polygon-offsets", &polygon_offsets}};
  }
};

bool is_map_size(int n) {
  return n >= 1 && n <= kMaxSurfaceSize && (n & (n - 1)) == 0;
}
bool is_step(int n) {
  return n >= 1 && n <= kMaxIndexStep;
}
bool is_bias(float b) {
  return b >= 0.0F && b <= static_cast<float>(kMostDistance);  // false for NaN
}

// The whole numbers of a list; empty unless all of them pass the test.
std::optional<std::vector<int>> numbers_that(const std::string& list, bool (*will_do)(int)) {
  auto n = whole_numbers_in(list);
  if (!n || !std::all_of(n->begin(), n->end(), will_do)) return std::nullopt;
  return n;
}

std::optional<std::vector<float>> biases_in(const std::string& list) {
  auto n = numbers<float>(list, ',');
  if (!n || !std::all_of(n->begin(), n->end(), is_bias)) return std::nullopt;
  return n;
}

// Pairs of factor and units, such as "0,0;1,16".
std::optional<std::vector<OffsetArguments>> offsets_in(std::string_view list) {
  std::vector<OffsetArguments> offsets;
  for (const std::string& item : items_of(list, ';')) {
    const auto n = numbers<float>(item, ',');
    if (!n || n->size() != 2 || !std::isfinite(n->at(0)) || !std::isfinite(n->at(1))) return std::nullopt;
    offsets.push_back({n->at(0), n->at(1)});
  }
  return offsets;
}

template <class E>
std::vector<std::string> names_of(const Names<E>& names) {
  std::vector<std::string> all;
  for (const auto& [name, value] : names) all.push_back(name);
  return all;
}

// The values of a checked list; an empty text has none.
template <class E>
std::vector<E> values_in(const Names<E>& names, const std::string& list) {
  std::vector<E> values;
  if (list.empty()) return values;
  for (const std::string& item : items_of(list)) {
    for (const auto& [name, value] : names) {
      if (name == item) values.push_back(value);
    }
  }
  return values;
}

ShadowGrid grid_of(const ShadowsFlags& flags) {
  ShadowGrid grid;
  if (!flags.map_sizes.empty()) grid.map_sizes = *whole_numbers_in(flags.map_sizes);
  if (!flags.steps.empty()) grid.index_steps = *whole_numbers_in(flags.steps);
  if (!flags.biases.empty()) grid.biases = *numbers<float>(flags.biases, ',');
  if (!flags.polygon_offsets.empty()) grid.polygon_offsets = *offsets_in(flags.polygon_offsets);
  if (flags.find_offset) grid.polygon_offsets = {offsets_to_search().begin(), offsets_to_search().end()};
  grid.index_formats = values_in(kIndexFormats, flags.formats);
  grid.index_scopes = values_in(kIndexScopes, flags.scopes);
  grid.index_orders = values_in(kIndexOrders, flags.orders);
  grid.index_scales = values_in(kIndexScales, flags.scales);
  grid.depth_bits = values_in(kDepthBits, flags.depth_bits);
  grid.encodings = values_in(kDepthEncodings, flags.encodings);
  return grid;
}

// Adds a flag as it was given, unless its value is the default.
void add_option(StudyQuestion& question, const CLI::Option& option, bool always) {
  const std::string given = option.count() > 0 ? option.results().front() : option.get_default_str();
  if (option.get_items_expected_max() == 0) {
    if (option.count() > 0) question.options.emplace_back(option.get_name(), "");
  } else if (always || given != option.get_default_str()) {
    question.options.emplace_back(option.get_name(), given);
  }
}

Result<StudyQuestion> question_of(const ShadowsFlags& flags) {
  auto question = question_of(flags.study, "shadows");
  if (!question) return question;
  if (question->profile == "all") question->profile = flags.study.common.profile;
  question->arguments = flags.scene.file;
  for (const CLI::Option* option : flags.scene_options) {
    add_option(*question, *option, option->get_name() == "--technique" || option->get_name() == "--size");
  }
  for (const auto& [flag, list] : flags.axes()) {
    if (!list->empty()) question->options.emplace_back(flag, *list);
  }
  if (flags.find_offset) question->options.emplace_back("--find-offset", "");
  std::vector<std::string> files{flags.scene.file};
  if (!flags.scene.cookie.empty()) {
    for (std::string& file : items_of(flags.scene.cookie)) files.push_back(std::move(file));
  }
  for (const std::string& file : files) {
    if (Status added = add_content(*question, file); !added) return added.error();
  }
  return question;
}

// Completes the grid; settings that the technique does not have are wrong usage.
void complete_grid(ShadowsFlags& flags) {
  const auto known = swept_settings(*find_technique(flags.scene.technique), flags.scene.settings);
  if (!known) throw CLI::ValidationError(known.error().message);
  const auto axes = flags.axes();
  const bool none = std::all_of(axes.begin(), axes.end(), [](const auto& axis) { return axis.second->empty(); });
  if (none && !flags.find_offset && known->map_size) flags.map_sizes = kDefaultMapSizes;
  const ShadowGrid grid = grid_of(flags);
  const auto found = axes_of(*known, grid);
  if (!found) throw CLI::ValidationError(found.error().message);
  std::size_t points = 1;
  for (const SweepAxis& axis : *found) {
    points *= axis.size;
    if (points <= kMaxStudyUnits) continue;
    throw CLI::ValidationError(
        fmt::format("{}: the lists have more than {} combinations; give fewer values", axis.flag, kMaxStudyUnits));
  }
}

Result<std::unique_ptr<Study>> make_study(const ShadowsFlags& flags) {
  RenderSettings settings = settings_of(flags.scene, flags.study.common);
  const std::string& technique = flags.scene.technique;
  auto question = question_of(flags);
  if (!question) return question.error();
  if (!flags.scene.cookie.empty()) {
    auto cookie = read_cookie(settings.profile, flags.scene.cookie);
    if (!cookie) return cookie.error();
    settings.light_cookie.cookie = std::move(cookie).value();
  }
  auto scene = load_scene(flags.scene, settings, flags.study.common.quiet);
  if (!scene) return scene.error();
  return make_shadow_sweep(std::move(question).value(), std::move(scene).value(), *find_technique(technique), settings,
                           grid_of(flags));
}

void add_axes(CLI::App& verb, ShadowsFlags& flags) {
  const auto add = [&](const char* flag, const char* single, std::string& text, const char* help,
                       const CLI::Validator& check) {
    CLI::Option* option = verb.add_option(flag, text, help)->type_name("LIST")->check(check);
    if (single != nullptr) option->excludes(verb.get_option(single));
    return option;
  };
  add("--map-sizes", "--map-size", flags.map_sizes,
      "Sizes of the map, in texels per side (default without another list: 128 to 1024)",
      list_by([](const std::string& t) { return numbers_that(t, is_map_size); }, "powers of two such as 128,256"));
  add("--formats", "--index-format", flags.formats, "Formats of an index", list_of(names_of(kIndexFormats)));
  add("--scopes", "--index-scope", flags.scopes, "Units that get their own index", list_of(names_of(kIndexScopes)));
  add("--steps", "--index-step", flags.steps, "Steps between indices",
      list_by([](const std::string& t) { return numbers_that(t, is_step); },
              fmt::format("steps from 1 to {}, such as 1-4", kMaxIndexStep)));
  add("--orders", "--index-order", flags.orders, "Orders of indices", list_of(names_of(kIndexOrders)));
  add("--scales", "--index-scales", flags.scales, "Products that the comparison scales by four",
      list_of(names_of(kIndexScales)));
  add("--depth-bits", nullptr, flags.depth_bits, "Formats of the depth cube map: 8,16,float",
      list_of(names_of(kDepthBits)));
  add("--biases", "--bias", flags.biases, "Biases of the depth comparison, in world units",
      list_by(&biases_in, "distances from 0 to 1e12, such as 0.01,0.1"));
  add("--encodings", "--depth-encoding", flags.encodings, "Encodings of depth in the shadow map",
      list_of(names_of(kDepthEncodings)));
  CLI::Option* offsets = add("--polygon-offsets", "--polygon-offset", flags.polygon_offsets,
                             "Polygon offsets of the shadow map, such as '0,0;1,16'",
                             list_by(&offsets_in, "FACTOR,UNITS, such as '0,0;1,16'"));
  verb.add_flag("--find-offset", flags.find_offset,
                "Search the polygon offset: factors from 0 to 4, units from 0 to 65536")
      ->excludes(offsets)
      ->excludes(verb.get_option("--polygon-offset"));
}

}  // namespace

void add_study_shadows(CLI::App& verbs, StudyRequest& request) {
  CLI::App* verb = verbs.add_subcommand("shadows", "Count the wrong pixels of a technique over a grid of its settings");
  verb->footer(
      "Examples:\n"
      "  ninebit study shadows scenes/index_room.gltf\n"
      "  ninebit study shadows scenes/index_room.gltf --map-sizes 256,512 --scopes polygon,object --steps 1,2 -o out\n"
      "  ninebit study shadows scenes/index_room.gltf --technique shadow-map --find-offset -o out");
  auto flags = std::make_shared<ShadowsFlags>();
  add_study_flags(*verb, flags->study);
  add_scene_file(*verb, "scene", flags->scene)->required();
  flags->scene_options = add_scene_flags(*verb, flags->scene);
  // The list replaces the flag for a single value.
  CLI::Option* bits = verb->get_option("--depth-bits");
  flags->scene_options.erase(std::find(flags->scene_options.begin(), flags->scene_options.end(), bits));
  verb->remove_option(bits);
  add_axes(*verb, *flags);
  verb->callback([flags, &request] {
    complete_grid(*flags);
    request.flags = &flags->study;
    request.make = [flags] { return make_study(*flags); };
  });
}

}  // namespace ninebit::tools
