#include "src/study/part/sweep_axes.h"

#include <fmt/format.h>

#include <algorithm>

namespace ninebit {
namespace {

// A rendering's fact as a row's value; no value if there is none.
StudyValue fact(const Rendering* rendering, std::string_view name) {
  if (rendering == nullptr) return {};
  for (const Fact& f : rendering->facts) {
    if (f.name == name) return std::visit([](const auto& value) { return StudyValue(value); }, f.value);
  }
  return {};
}

// The number of a value as a row's value.
StudyValue field_of(const TechniqueSetting& setting, const SettingValue& value, std::size_t number) {
  if (setting.kind == SettingKind::word) return setting.text_of(value);
  if (setting.kind == SettingKind::whole) return static_cast<std::int64_t>(value[number]);
  return shortest_decimal(value[number]);
}

bool is_among(const std::vector<const TechniqueSetting*>& settings, std::string_view name) {
  return std::any_of(settings.begin(), settings.end(), [&](const auto* setting) { return setting->name == name; });
}

bool draws_shadows(const Technique& technique, const RenderSettings& settings) {
  return technique.name != "reflective" && (technique.name != "light-cookie" || settings.light_cookie.shadows);
}

}  // namespace

bool SweptSettings::has(std::string_view axis) const {
  return is_among(settings, axis);
}

bool SweptSettings::has_column(std::string_view name) const {
  return is_among(columns, name);
}

std::string SweepAxis::flag() const {
  return fmt::format("--{}", setting->axis.flag);
}

Result<SweptSettings> swept_settings(const Technique& technique, const RenderSettings& settings,
                                     const ShadowGrid& grid) {
  if (!draws_shadows(technique, settings)) {
    return Diagnostic{.message = fmt::format("technique {} draws no shadows to compare", technique.name)};
  }
  SweptSettings swept{.technique = technique.name};
  for (const TechniqueSetting& setting : technique_settings()) {
    if (setting.axis.flag.empty() || !is_read(setting, technique.name, settings)) continue;
    swept.settings.push_back(&setting);
    // Rows without the columns of settings that were added later are those of older parts.
    const bool is_swept =
        std::any_of(grid.begin(), grid.end(), [&](const ShadowAxis& axis) { return axis.setting == setting.name; });
    const bool is_changed = setting.get(settings) != setting.get(RenderSettings{});
    if (setting.axis.by_default || is_swept || is_changed) swept.columns.push_back(&setting);
  }
  return swept;
}

Result<std::vector<SweepAxis>> axes_of(const SweptSettings& known, const ShadowGrid& grid) {
  std::vector<SweepAxis> axes;
  std::string unsupported;
  for (const auto& [name, values] : grid) {
    if (values.empty()) return Diagnostic{.message = fmt::format("{}: expected at least one value", name)};
    const TechniqueSetting* const setting = find_technique_setting(name);
    if (setting == nullptr || setting->axis.flag.empty()) {
      return Diagnostic{.message = fmt::format("'{}' is not a setting that can be swept", name)};
    }
    if (std::any_of(axes.begin(), axes.end(), [&](const SweepAxis& axis) { return axis.setting == setting; })) {
      return Diagnostic{.message = fmt::format("{} is swept twice; expected one list of its values", name)};
    }
    SweepAxis axis{.setting = setting};
    if (!known.has(name)) unsupported += fmt::format("{}{}", unsupported.empty() ? "" : ", ", axis.flag());
    for (const std::string& text : values) {
      const auto value = setting->value_of(text);
      if (!value) return Diagnostic{.message = fmt::format("'{}' is not a valid value of {}", text, name)};
      axis.values.push_back(*value);
    }
    axes.push_back(std::move(axis));
  }
  if (unsupported.empty()) return axes;
  return Diagnostic{.message = fmt::format("technique {} does not support {}", known.technique, unsupported)};
}

RowFields settings_fields(const SweptSettings& known, const RenderSettings& settings, const Rendering* rendering) {
  RowFields fields;
  for (const TechniqueSetting* setting : known.columns) {
    const SettingValue value = setting->get(settings);
    for (std::size_t i = 0; i < setting->numbers; ++i) {
      const std::string column(setting->axis.columns[i]);
      fields.emplace_back(column, value.empty() ? fact(rendering, column) : field_of(*setting, value, i));
    }
  }
  return fields;
}

std::span<const ErrorCause> causes_of(const SweptSettings& known) {
  ShadowEvidence evidence;
  if (known.has("map-size")) evidence.fetched.resize(1);
  if (known.has("index-step")) evidence.index_of_triangle.resize(1);
  return causes_of(evidence);
}

}  // namespace ninebit
