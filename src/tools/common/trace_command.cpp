#include "src/tools/common/trace_command.h"

#include <fmt/format.h>

#include <utility>

#include "src/study/part/part_text.h"
#include "src/system/quoting.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {

std::vector<std::string> given_arguments(const CommonFlags& common, std::span<CLI::Option* const> options,
                                         const std::function<bool(const std::string&)>& reads) {
  std::vector<std::string> arguments;
  for (const CLI::Option* option : options) {
    const std::string name = option->get_name();
    if (option->count() == 0 || name == "--technique" || !reads(name)) continue;
    if (name == "--profile") {  // its text became the profile's name
      arguments.push_back(name + '=' + (common.profile_file.empty() ? common.profile : common.profile_file));
    } else if (option->get_items_expected_max() == 0) {
      arguments.push_back(name);
    } else {
      arguments.push_back(name + '=' + option->results().back());
    }
  }
  return arguments;
}

std::vector<WrongPixelTrace> worst_traces(const SceneFlags& scene, const RenderSettings& settings,
                                          std::span<const std::string> arguments, const GroundTruth& truth) {
  std::string start = fmt::format("ninebit trace --scene {}", shell_word(scene.file));
  if (scene.allow_outside) start += " --allow-outside";
  if (!scene.up.empty()) start += " --up " + shell_word(scene.up);
  start += fmt::format(" --size {}x{}", settings.width, settings.height);
  for (const std::string& argument : arguments) start += ' ' + shell_word(argument);
  return ninebit::worst_traces(truth, settings.width, settings.height, start);
}

Json worst_json(const std::vector<WrongPixelTrace>& worst) {
  Json out = Json::array();
  for (const WrongPixelTrace& one : worst) {
    Json object = Json::object();
    for (const auto& [name, value] : fields_of(one)) object[name] = json_value(value);
    out.push_back(std::move(object));
  }
  return out;
}

std::string worst_text(const std::vector<WrongPixelTrace>& worst) {
  std::string text;
  for (const WrongPixelTrace& one : first_of_causes(worst)) {
    text += fmt::format("  {}: {}\n", name_of(one.pixel.cause), printable(one.command));
  }
  return text;
}

}  // namespace ninebit::tools
