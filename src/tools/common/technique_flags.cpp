#include "src/tools/common/technique_flags.h"

#include <fmt/format.h>

#include <array>
#include <vector>

#include "src/tools/common/scene_textures.h"

namespace ninebit::tools {
namespace {

// The flag of a setting, as CLI11 knows it.
std::string flag_of(const TechniqueSetting& setting) {
  return "--" + std::string(setting.name);
}

std::string check_setting(const TechniqueSetting& setting, const std::string& text) {
  if (setting.value_of(text)) return {};
  if (setting.noun.empty()) return fmt::format("'{}' is out of range; expected {}", text, setting.expected);
  return fmt::format("invalid {} '{}'; expected {}", setting.noun, text, setting.expected);
}

// Adds the flag of a setting that is not files.
CLI::Option* add_value_flag(CLI::App& verb, const TechniqueSetting& setting, RenderSettings& settings) {
  const auto set = [&](const std::string& text) { setting.set(settings, *setting.value_of(text)); };
  const std::string flag = flag_of(setting), help(setting.help);
  if (setting.kind == SettingKind::word) {
    std::vector<std::string> words;
    for (const SettingWord& word : setting.words) words.emplace_back(word.word);
    return verb.add_option_function<std::string>(flag, set, help)->check(CLI::IsMember(words));
  }
  if (setting.kind == SettingKind::whole && setting.expected.empty()) {
    const auto set_whole = [&](int number) { setting.set(settings, {static_cast<double>(number)}); };
    const int least = static_cast<int>(setting.least), greatest = static_cast<int>(setting.greatest);
    return verb.add_option_function<int>(flag, set_whole, help)->check(whole_in_range(least, greatest));
  }
  const auto check = [&setting](const std::string& text) { return check_setting(setting, text); };
  return verb.add_option_function<std::string>(flag, set, help)->check(CLI::Validator(check, ""));
}

// Flags that are not in the table, and the groups that they belong to.
struct FlagGroup {
  std::string_view title;
  std::vector<std::string_view> flags;
};

const std::array<FlagGroup, 4>& flag_groups() {
  static const std::array<FlagGroup, 4> groups{
      FlagGroup{"Picture",
                {"--technique", "--size", "--light-facing", "--supersample", "--turntable", "--only", "--layers"}},
      FlagGroup{"Scene, camera and light",
                {"--up", "--allow-outside", "--floor", "--camera", "--look-at", "--fov", "--light", "--light-type",
                 "--light-target", "--spot-angle"}},
      FlagGroup{find_technique_setting("index-order")->group->title, {"--check-order", "--pick"}},
      FlagGroup{"Checks", {"--ground-truth"}}};
  return groups;
}

void put_into_group(CLI::App& verb, std::string_view flag, std::string_view title) {
  CLI::Option* const option = verb.get_option_no_throw(std::string(flag));
  if (option != nullptr) option->group(std::string(title));
}

}  // namespace

void add_technique_flags(CLI::App& verb, SceneFlags& flags) {
  for (const TechniqueSetting& setting : technique_settings()) {
    CLI::Option* option = nullptr;
    if (setting.kind == SettingKind::files) {
      option = verb.add_option(flag_of(setting), flags.cookie, std::string(setting.help));
      option->check(CLI::Validator([](const std::string& text) { return check_cookie(text); }, ""));
    } else {
      option = add_value_flag(verb, setting, flags.settings);
      // The help of settings with several numbers names their default.
      const SettingValue value = setting.get(flags.settings);
      if (value.size() == 1) option->default_str(setting.text_of(value));
    }
    if (!setting.form.empty()) option->type_name(std::string(setting.form));
  }
}

std::string unread_flag(const CLI::App& verb, const SceneFlags& flags) {
  std::string own;
  for (const TechniqueSetting& setting : technique_settings()) {
    const bool is_own = setting.group->readers != kAllTechniques && is_read(setting, flags.technique, flags.settings);
    if (is_own && verb.get_option_no_throw(flag_of(setting)) != nullptr) {
      own += (own.empty() ? "" : ", ") + flag_of(setting);
    }
  }
  RenderSettings with_shadows = flags.settings;
  with_shadows.light_cookie.shadows = true;
  for (const TechniqueSetting& setting : technique_settings()) {
    const CLI::Option* const given = verb.get_option_no_throw(flag_of(setting));
    if (given == nullptr || given->count() == 0 || is_read(setting, flags.technique, flags.settings)) continue;
    const bool reads_with_shadows = is_read(setting, flags.technique, with_shadows);
    return fmt::format("{}: technique {}{} does not read it; expected {}", flag_of(setting), flags.technique,
                       reads_with_shadows ? " with --cookie-shadows none" : "", own);
  }
  return {};
}

bool reads_flag(const SceneFlags& flags, std::string_view flag) {
  const TechniqueSetting* const setting = find_technique_setting(flag.substr(2));
  return setting == nullptr || is_read(*setting, flags.technique, flags.settings);
}

Json settings_json(std::string_view technique, const RenderSettings& settings) {
  Json out = Json::object();
  for (const TechniqueSetting& setting : technique_settings()) {
    if (setting.get == nullptr || !is_read(setting, technique, settings)) continue;
    const SettingValue value = setting.get(settings);
    Json numbers = Json::array();
    for (const double n : value)
      numbers.push_back(setting.kind == SettingKind::whole ? Json(static_cast<int>(n)) : Json(shortest_decimal(n)));
    out[setting.key()] = value.empty()                       ? Json()
                         : setting.kind == SettingKind::word ? Json(setting.text_of(value))
                         : setting.numbers == 1              ? numbers[0]
                                                             : numbers;
  }
  return out;
}

void group_scene_flags(CLI::App& verb) {
  for (const FlagGroup& group : flag_groups()) {
    for (const std::string_view flag : group.flags) put_into_group(verb, flag, group.title);
  }
  for (const TechniqueSetting& setting : technique_settings()) {
    put_into_group(verb, flag_of(setting), setting.group->title);
  }
}

void warn_of_unused_order(const RenderSettings& settings, const IndexOrderReport& report) {
  if (settings.index.order == report.order) return;
  say_warning(fmt::format("--index-order neighbour has no effect, the order of the file is used: {}", report.reason));
}

std::string order_text(const IndexOrderReport& report) {
  if (report.order == IndexOrder::file) return {};
  return fmt::format("index order: {} patches, {} borders, {} broken ({:.1f} % of their length), {} false neighbours\n",
                     report.patches, report.borders, report.broken_borders, 100.0 * report.broken_share,
                     report.false_neighbours);
}

void add_order(Json& index, const IndexOrderReport& report) {
  index["order"] = name_of(report.order);
  if (!report.reason.empty()) index["reason"] = report.reason;
  if (report.order == IndexOrder::file) return;
  index["patches"] = report.patches;
  index["borders"] = report.borders;
  index["broken_borders"] = report.broken_borders;
  index["broken_share"] = report.broken_share;
  index["false_neighbours"] = report.false_neighbours;
}

}  // namespace ninebit::tools
