#include "src/tools/common/flag_values.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <limits>
#include <set>
#include <utility>

#include "ninebit/frame/settings.h"
#include "ninebit/raster/surface.h"
#include "src/system/nearest_name.h"
#include "src/system/number_list.h"

namespace ninebit::tools {

std::vector<std::string> items_of(std::string_view list, char separator) {
  std::vector<std::string> items;
  while (true) {
    const std::size_t end = list.find(separator);
    items.emplace_back(list.substr(0, end));
    if (end == std::string_view::npos) return items;
    list.remove_prefix(end + 1);
  }
}

std::optional<std::vector<int>> whole_numbers_in(std::string_view list) {
  constexpr int kMost = 4'096;
  std::vector<int> all;
  for (const std::string& item : items_of(list)) {
    // A number that is negative begins with the dash.
    const std::size_t dash = item.find('-', 1);
    const auto first = numbers<int>(std::string_view(item).substr(0, dash), ',');
    const auto last = dash == std::string::npos ? first : numbers<int>(std::string_view(item).substr(dash + 1), ',');
    if (!first || !last || first->front() > last->front()) return std::nullopt;
    if (static_cast<long long>(last->front()) - first->front() >= kMost) return std::nullopt;
    for (int n = first->front(); n < last->front(); ++n) all.push_back(n);
    all.push_back(last->front());
    if (all.size() > kMost) return std::nullopt;
  }
  return all;
}

CLI::Validator checked_by(std::string (*check)(const std::string&)) {
  return CLI::Validator([check](std::string& text) { return check(text); }, "");
}

CLI::Validator list_of(std::vector<std::string> known) {
  const auto check = [known = std::move(known)](const std::string& text) -> std::string {
    std::set<std::string> given;
    for (const std::string& item : items_of(text)) {
      if (std::find(known.begin(), known.end(), item) == known.end()) {
        return fmt::format("unknown name '{}'; expected a list of {}{}", item, fmt::join(known, ", "),
                           did_you_mean(item, known));
      }
      if (!given.insert(item).second) return fmt::format("'{}' is given twice; expected each name once", item);
    }
    return {};
  };
  return CLI::Validator(check, "");
}

CLI::Validator real_in_range(double least, double greatest) {
  const auto check = [=](const std::string& text) -> std::string {
    if (are_numbers_in<double>(text, ',', 1, least, greatest)) return {};
    return fmt::format("'{}' is out of range; expected a number from {:g} to {:g}", text, least, greatest);
  };
  return CLI::Validator(check, "");
}

namespace {

std::string check_pixel(const std::string& text) {
  const auto n = numbers<int>(text, ',');
  if (n && n->size() == 2 && n->at(0) >= 0 && n->at(1) >= 0) return {};
  return fmt::format("invalid pixel '{}'; expected X,Y, each a whole number, counted from the top left", text);
}

}  // namespace

CLI::Option* add_pixel_flag(CLI::App& verb, const std::string& flag, std::string& text, const std::string& help) {
  return verb.add_option(flag, text, help)
      ->type_name("X,Y")
      ->check(CLI::Validator([](std::string& value) { return check_pixel(value); }, ""));
}

Result<glm::ivec2> window_pixel(const std::string& flag, const std::string& text, const RenderSettings& settings) {
  const auto at = *numbers<int>(text, ',');
  if (at[0] < settings.width && at[1] < settings.height) return glm::ivec2(at[0], settings.height - 1 - at[1]);
  return Diagnostic{.message =
                        fmt::format("{}: {} is outside of the picture; expected X from 0 to {} and Y from 0 to {}",
                                    flag, text, settings.width - 1, settings.height - 1)};
}

std::string check_size(const std::string& text) {
  const auto n = numbers<int>(text, 'x');
  if (n && n->size() == 2 && n->at(0) >= 1 && n->at(1) >= 1 && std::max(n->at(0), n->at(1)) <= kMaxSurfaceSize)
    return {};
  return fmt::format("invalid picture size '{}'; expected WIDTHxHEIGHT, each a whole number from 1 to {}", text,
                     kMaxSurfaceSize);
}

std::string check_point(const std::string& text) {
  if (are_numbers_in<float>(text, ',', 3, -kMostDistance, kMostDistance)) return {};
  return fmt::format("invalid point '{}'; expected X,Y,Z, each from -1e12 to 1e12", text);
}

std::optional<glm::vec3> point_of(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const auto n = numbers<float>(text, ',');
  return glm::vec3(n->at(0), n->at(1), n->at(2));
}

std::string check_floor(const std::string& text) {
  if (text == "auto" || text == "none") return {};
  if (are_numbers_in<float>(text, ',', 1, -kMostDistance, kMostDistance)) return {};
  return fmt::format("invalid floor '{}'; expected auto, none or a height from -1e12 to 1e12", text);
}

std::string check_fov(const std::string& text) {
  if (are_numbers_in<float>(text, ',', 1, 0.01F, 170.0)) return {};
  return fmt::format("invalid angle '{}'; expected degrees from 0.01 to 170", text);
}

std::string check_seconds(const std::string& text) {
  if (are_numbers_in<double>(text, ',', 1, -1e6, 1e6)) return {};
  return fmt::format("invalid time '{}'; expected seconds from -1e6 to 1e6", text);
}

std::string check_frame(const std::string& text) {
  if (are_numbers_in<int>(text, ',', 1, 0, 1'000'000'000)) return {};
  return fmt::format("invalid frame '{}'; expected a whole number from 0 to 1000000000", text);
}

std::string check_spot_angle(const std::string& text) {
  if (are_numbers_in<float>(text, ',', 1, 1.0, 170.0)) return {};
  return fmt::format("invalid angle '{}'; expected degrees from 1 to 170", text);
}

std::string check_file_name(const std::string& text) {
  return text.empty() ? "the file name is empty" : "";
}

}  // namespace ninebit::tools
