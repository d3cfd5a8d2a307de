#include "src/tools/common/list_flag.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <utility>

#include "src/language/source/nearest_name.h"
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

}  // namespace ninebit::tools
