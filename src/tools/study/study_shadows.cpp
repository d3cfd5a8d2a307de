// `ninebit study shadows`: counts the wrong pixels of a technique over a grid of its settings.
#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>

#include "ninebit/study/shadow_sweep.h"
#include "src/study/part/sweep_axes.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/common/scene_textures.h"
#include "src/tools/study/study.h"
#include "src/tools/trace/trace_page.h"

namespace ninebit::tools {
namespace {

constexpr const char* kDefaultMapSizes = "128,256,512,1024";

struct ShadowsFlags {
  StudyFlags study;
  SceneFlags scene;
  std::vector<CLI::Option*> scene_options;
  std::vector<std::string> lists = std::vector<std::string>(technique_settings().size());  // of the axes' flags
  bool find_offset = false;
};

std::string axis_flag(const TechniqueSetting& setting) {
  return fmt::format("--{}", setting.axis.flag);
}

// The settings that are axes, each with its list; an empty list is not swept.
template <class Flags, class Each>
void for_each_axis(Flags& flags, const Each& each) {
  const auto settings = technique_settings();
  for (std::size_t i = 0; i < settings.size(); ++i) {
    if (!settings[i].axis.flag.empty()) each(settings[i], flags.lists[i]);
  }
}

// The items of a setting's list; empty if one of them is not valid.
std::optional<std::vector<std::string>> items_in(const TechniqueSetting& setting, const std::string& list) {
  std::vector<std::string> items;
  if (setting.kind == SettingKind::whole) {
    const auto numbers = whole_numbers_in(list);
    if (!numbers) return std::nullopt;
    for (const int n : *numbers) items.push_back(std::to_string(n));
  } else {
    items = items_of(list, setting.numbers > 1 ? ';' : ',');
  }
  const auto is_valid = [&](const std::string& item) { return setting.value_of(item).has_value(); };
  if (!std::all_of(items.begin(), items.end(), is_valid)) return std::nullopt;
  return items;
}

ShadowGrid grid_of(const ShadowsFlags& flags) {
  ShadowGrid grid;
  for_each_axis(flags, [&](const TechniqueSetting& setting, const std::string& list) {
    if (!list.empty()) grid.push_back({setting.name, *items_in(setting, list)});
  });
  if (!flags.find_offset) return grid;
  grid.push_back({"polygon-offset"});
  for (const OffsetArguments& offset : offsets_to_search()) {
    grid.back().values.push_back(fmt::format("{},{}", offset.factor, offset.units));
  }
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

// Whether the flag gives the only value of an axis; the question then has the axis alone.
bool is_swept(const ShadowsFlags& flags, std::string_view flag) {
  bool swept = false;
  for_each_axis(flags, [&](const TechniqueSetting& setting, const std::string& list) {
    swept = swept || (!list.empty() && flag.substr(2) == setting.name);
  });
  return swept;
}

Result<StudyQuestion> question_of(const ShadowsFlags& flags) {
  auto question = question_of(flags.study, "shadows");
  if (!question) return question;
  if (question->profile == "all") question->profile = flags.study.common.profile;
  question->arguments = flags.scene.file;
  for (const CLI::Option* option : flags.scene_options) {
    const std::string name = option->get_name();
    if (!is_swept(flags, name)) add_option(*question, *option, name == "--technique" || name == "--size");
  }
  if (!flags.scene.up.empty()) question->options.emplace_back("--up", flags.scene.up);
  for_each_axis(flags, [&](const TechniqueSetting& setting, const std::string& list) {
    if (!list.empty()) question->options.emplace_back(axis_flag(setting), list);
  });
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

// The map sizes of a grid without lists: the one of --map-size, if it is given.
std::string default_map_sizes(const ShadowsFlags& flags, const TechniqueSetting& map_size) {
  const bool is_given =
      std::any_of(flags.scene_options.begin(), flags.scene_options.end(),
                  [](const CLI::Option* option) { return option->get_name() == "--map-size" && option->count() > 0; });
  return is_given ? map_size.text_of(map_size.get(flags.scene.settings)) : kDefaultMapSizes;
}

// Completes the grid; settings that the technique does not have are wrong usage.
void complete_grid(ShadowsFlags& flags) {
  const auto known = swept_settings(*find_technique(flags.scene.technique), flags.scene.settings);
  if (!known) throw CLI::ValidationError(known.error().message);
  if (grid_of(flags).empty() && known->has("map-size")) {
    for_each_axis(flags, [&flags](const TechniqueSetting& setting, std::string& list) {
      if (setting.name == "map-size") list = default_map_sizes(flags, setting);
    });
  }
  const auto found = axes_of(*known, grid_of(flags));
  if (!found) throw CLI::ValidationError(found.error().message);
  std::size_t points = 1;
  for (const SweepAxis& axis : *found) {
    points *= axis.values.size();
    if (points <= kMaxStudyUnits) continue;
    throw CLI::ValidationError(
        fmt::format("{}: the lists have more than {} combinations; give fewer values", axis.flag(), kMaxStudyUnits));
  }
}

// The flags' scene with its textures, which the study itself does not read, and its rays.
struct TracedScene {
  std::optional<Result<DrawnScene>> drawn{};  // empty: not loaded yet
  std::optional<GroundTruthScene> rays{};
};

// The texts of traces of the flags' scene, which is loaded for the first of them. Where its textures cannot be read,
// the texts are empty.
TraceTexts trace_texts_of(const ShadowsFlags& flags) {
  return [traced = std::make_shared<TracedScene>(), scene_flags = flags.scene, common = flags.study.common](
             const RenderSettings& settings, const Progress& progress) -> Result<std::vector<std::string>> {
    const bool is_first = !traced->drawn;
    if (is_first) traced->drawn.emplace(load_drawn_scene(scene_flags, settings));
    const Result<DrawnScene>& drawn = *traced->drawn;
    if (!drawn) {
      if (drawn.error().fault == Fault::cancelled) return drawn.error();
      if (is_first)
        say_warning(fmt::format("the report has no traces, and their commands fail, too: {}", drawn.error().text()));
      return std::vector<std::string>(settings.pixels.size());
    }
    if (!traced->rays) {
      auto rays = GroundTruthScene::make(drawn->scene);
      if (!rays) return rays.error();
      traced->rays.emplace(std::move(*rays));
    }
    return judged_pixel_texts(scene_flags, common, drawn->scene, settings, *traced->rays, progress);
  };
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
  auto scene = load_scene(flags.scene, settings);
  if (!scene) return scene.error();
  return make_shadow_sweep(std::move(question).value(), std::move(scene).value(), *find_technique(technique), settings,
                           grid_of(flags), trace_texts_of(flags), flags.scene.allow_outside);
}

// Removes the flag of a single value where its list has the same name; else the two exclude each other.
void add_axis(CLI::App& verb, ShadowsFlags& flags, const TechniqueSetting& setting, std::string& list) {
  CLI::Option* const single = verb.get_option(fmt::format("--{}", setting.name));
  const bool same_name = setting.axis.flag == setting.name;
  if (same_name) {
    flags.scene_options.erase(std::find(flags.scene_options.begin(), flags.scene_options.end(), single));
    verb.remove_option(single);
  }
  CLI::Option* const option = verb.add_option(axis_flag(setting), list, std::string(setting.axis.help));
  if (!same_name) option->excludes(single);
  option->type_name("LIST");
  if (setting.axis.expected.empty()) {
    std::vector<std::string> words;
    for (const SettingWord& word : setting.words) words.emplace_back(word.word);
    option->check(list_of(std::move(words)));
  } else {
    const auto parse = [&setting](const std::string& text) { return items_in(setting, text); };
    option->check(list_by(parse, std::string(setting.axis.expected)));
  }
}

void add_axes(CLI::App& verb, ShadowsFlags& flags) {
  for_each_axis(flags,
                [&](const TechniqueSetting& setting, std::string& list) { add_axis(verb, flags, setting, list); });
  verb.add_flag("--find-offset", flags.find_offset,
                "Search the polygon offset: factors from 0 to 4, units from 0 to 65536")
      ->excludes(verb.get_option("--polygon-offsets"))
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
  add_study_flags(*verb, flags->study, StudyProfiles::one);
  add_scene_file(*verb, "scene", flags->scene)->required();
  flags->scene_options = add_scene_flags(*verb, flags->scene);
  add_axes(*verb, *flags);
  verb->callback([flags, &request] {
    complete_grid(*flags);
    request.flags = &flags->study;
    request.make = [flags] { return make_study(*flags); };
  });
}

}  // namespace ninebit::tools
