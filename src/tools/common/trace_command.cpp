#include "src/tools/common/trace_command.h"

#include <fmt/format.h>

#include "src/system/shell_word.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

constexpr int kMostOfCause = 3;

}  // namespace

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
  std::vector<WrongPixelTrace> traces;
  for (const WorstPixel& pixel : worst_pixels(truth, settings.width, settings.height, kMostOfCause)) {
    const int y = settings.height - 1 - pixel.y;
    traces.push_back({pixel, pixel.x, y, fmt::format("{} --pixel {},{} --ground-truth", start, pixel.x, y)});
  }
  return traces;
}

Json json_of(std::span<const WrongPixelTrace> worst) {
  Json out = Json::array();
  for (const WrongPixelTrace& one : worst) {
    out.push_back({{"cause", name_of(one.pixel.cause)},
                   {"x", one.x},
                   {"y", one.y},
                   {"radius", one.pixel.radius},
                   {"command", one.command}});
  }
  return out;
}

std::string text_of(std::span<const WrongPixelTrace> worst) {
  std::string text;
  for (std::size_t i = 0; i < worst.size(); ++i) {
    if (i > 0 && worst[i].pixel.cause == worst[i - 1].pixel.cause) continue;
    text += fmt::format("  {}: {}\n", name_of(worst[i].pixel.cause), printable(worst[i].command));
  }
  return text;
}

}  // namespace ninebit::tools
