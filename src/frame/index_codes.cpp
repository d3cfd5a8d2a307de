#include "ninebit/frame/index_codes.h"

#include <fmt/format.h>

#include <array>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/frame/technique_settings.h"

namespace ninebit {
namespace {

constexpr std::array kFormats{IndexFormat::rgb, IndexFormat::luminance_alpha, IndexFormat::luminance,
                              IndexFormat::alpha};
constexpr std::array kScopes{IndexScope::polygon, IndexScope::section, IndexScope::object};

bool fits(IndexFormat format, int step, std::uint64_t count) {
  return count < IndexCodes(step, format).capacity();
}

struct SettingChange {
  std::string change;
  std::string why;
};

// The single changes that provide enough codes.
std::vector<SettingChange> sufficient_changes(IndexFormat format, int step, IndexScope scope,
                                              const IndexCounts& counts) {
  std::vector<SettingChange> found;
  for (int smaller = step - 1; smaller >= 1; --smaller) {
    if (!fits(format, smaller, counts.of(scope))) continue;
    found.push_back(
        {fmt::format("index step {}", smaller), fmt::format("{} codes", IndexCodes(smaller, format).capacity())});
    break;
  }
  // The smallest format with enough codes.
  for (auto other = kFormats.rbegin(); other != kFormats.rend(); ++other) {
    if (!fits(*other, step, counts.of(scope))) continue;
    found.push_back({fmt::format("index format {}", name_of(*other)),
                     fmt::format("{} codes", IndexCodes(step, *other).capacity())});
    break;
  }
  // Coarser scopes.
  bool coarser = false;
  for (const IndexScope other : kScopes) {
    if (coarser && counts.of(other) > 0 && fits(format, step, counts.of(other))) {
      found.push_back(
          {fmt::format("index scope {}", name_of(other)),
           fmt::format("{}{} {}s", other == IndexScope::section ? "at most " : "", counts.of(other), name_of(other))});
    }
    coarser = coarser || other == scope;
  }
  return found;
}

}  // namespace

std::string_view name_of(IndexFormat format) {
  return find_technique_setting("index-format")->word_of(static_cast<int>(format));
}

std::string_view name_of(IndexScope scope) {
  return find_technique_setting("index-scope")->word_of(static_cast<int>(scope));
}

std::string_view name_of(IndexOrder order) {
  return find_technique_setting("index-order")->word_of(static_cast<int>(order));
}

std::string_view name_of(IndexScales scales) {
  return find_technique_setting("index-scales")->word_of(static_cast<int>(scales));
}

InternalFormat map_format(IndexFormat format) {
  switch (format) {
    case IndexFormat::rgb:
      return InternalFormat::rgb8;
    case IndexFormat::luminance_alpha:
      return InternalFormat::luminance8_alpha8;
    case IndexFormat::luminance:
      return InternalFormat::luminance8;
    case IndexFormat::alpha:
      break;
  }
  return InternalFormat::alpha8;
}

Status check_index_codes(IndexFormat format, int step, IndexScope scope, const IndexCounts& counts) {
  if (step < 1 || step > kMaxIndexStep) {
    return Diagnostic{.message = fmt::format("index step {} is out of range; expected 1 to {}", step, kMaxIndexStep)};
  }
  const std::uint64_t used = counts.of(scope);
  if (fits(format, step, used)) return {};
  std::string would_do;
  for (const SettingChange& setting : sufficient_changes(format, step, scope, counts)) {
    would_do += would_do.empty() ? fmt::format("{} would do ({})", setting.change, setting.why)
                                 : fmt::format(", or {} ({})", setting.change, setting.why);
  }
  return Diagnostic{.message = fmt::format(
                        "too many {0}s: {1} of them and the cleared map need {2} codes, index format {3} with step "
                        "{4} has {5}; {6}",
                        name_of(scope), used, used + 1, name_of(format), step, IndexCodes(step, format).capacity(),
                        would_do.empty() ? "no other step, format or scope alone would do" : would_do)};
}

}  // namespace ninebit
