#include "src/tools/input/register_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/system/number_list.h"

namespace ninebit::tools {
namespace {

struct Setting {
  std::vector<EvalColumn> columns;
  std::vector<s9> codes;
};

Result<Setting> parse_setting(const std::string& text, const HardwareProfile& profile) {
  const auto wrong = [&](const std::string& why) { return Diagnostic{.message = "--set: " + why}; };
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos) {
    return wrong(fmt::format("'{}' has no value; expected REGISTER=R,G,B,A or REGISTER.COMPONENT=VALUE", text));
  }
  const std::string name = text.substr(0, equals), value = text.substr(equals + 1);
  Setting setting{.columns = columns_named(name, profile), .codes = {}};
  if (setting.columns.empty()) {
    return wrong(
        fmt::format("unknown register '{}'; expected const0, const1, fog, primary, secondary, "
                    "spare0, spare1 or tex0 to tex{}, or one of these with .r, .g, .b or .a",
                    name, profile.texture_units - 1));
  }
  const auto codes = numbers<int>(value, ',');
  const int lowest = profile.lowest, one = profile.one;
  const bool fits = codes && codes->size() == setting.columns.size() &&
                    std::all_of(codes->begin(), codes->end(), [&](int n) { return n >= lowest && n <= one; });
  if (!fits) {
    return wrong(fmt::format("{} takes {} from {} to {}, not '{}'", name,
                             setting.columns.size() == 1 ? "a whole number" : "four whole numbers R,G,B,A, each",
                             lowest, one, value));
  }
  for (const int code : *codes) setting.codes.push_back(static_cast<s9>(code));
  return setting;
}

}  // namespace

Result<RegisterSettings> parse_register_settings(const std::vector<std::string>& texts,
                                                 const HardwareProfile& profile) {
  std::vector<EvalColumn> set;
  std::vector<s9> codes;
  for (const std::string& text : texts) {
    const auto setting = parse_setting(text, profile);
    if (!setting) return setting.error();
    for (std::size_t i = 0; i < setting->columns.size(); ++i) {
      const EvalColumn& column = setting->columns[i];
      if (std::find(set.begin(), set.end(), column) != set.end()) {
        return Diagnostic{.message = fmt::format("--set: {} is set twice", column.name())};
      }
      set.push_back(column);
      codes.push_back(setting->codes[i]);
    }
  }
  // One row of an eval table, so that both verbs have the same defaults.
  const EvalRows row(set, profile);
  const auto batch = std::make_unique<EvalBatch>();
  row.begin(*batch);
  for (std::size_t i = 0; i < set.size(); ++i) batch->registers(set[i].reg, set[i].component)[0] = codes[i];
  batch->count = 1;
  row.end(*batch);
  RegisterSettings inputs;
  for (std::size_t r = static_cast<std::size_t>(Register::fog); r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      inputs.registers.value[r][c] = batch->registers(static_cast<Register>(r), static_cast<int>(c))[0];
    }
  }
  for (std::size_t i = 0; i < set.size(); ++i) {
    const bool constant = set[i].reg == Register::constant0 || set[i].reg == Register::constant1;
    if (constant) inputs.constants.emplace_back(set[i], codes[i]);
  }
  inputs.set = std::move(set);
  return inputs;
}

Result<StageSettings> take_stage_settings(std::vector<std::string>& texts) {
  StageSettings all;
  const auto wrong = [](const std::string& why) { return Diagnostic{.message = "--set: " + why}; };
  for (const std::string& text : texts) {
    const std::size_t equals = std::min(text.find('='), text.size());
    const std::string name = text.substr(0, equals), value = text.substr(std::min(equals + 1, text.size()));
    const auto components = given_components(name);
    if (components.empty()) continue;
    const bool is_texel = components[0].is_texel;
    const auto values = numbers<float>(value, ',');
    // s and t are enough of coordinates.
    const std::size_t least = is_texel || components.size() == 1 ? components.size() : 2;
    const bool fits = values && values->size() >= least && values->size() <= components.size() &&
                      (!is_texel || std::all_of(values->begin(), values->end(),
                                                [](float v) { return v >= 0 && v <= 255 && v == std::floor(v); }));
    if (!fits) {
      const char* const expected = is_texel                 ? components.size() == 1 ? "a whole number from 0 to 255"
                                                                                     : "four whole numbers R,G,B,A, each from 0 to 255"
                                   : components.size() == 1 ? "a number"
                                                            : "two to four numbers S,T,R,Q";
      return wrong(fmt::format("{} takes {}, not '{}'", name, expected, value));
    }
    for (std::size_t i = 0; i < values->size(); ++i) {
      const GivenComponent& one = components[i];
      if (std::find(all.set.begin(), all.set.end(), one) != all.set.end()) {
        return wrong(fmt::format("{} is set twice", name_of(one)));
      }
      all.set.push_back(one);
      give(all.fragment, one, (*values)[i]);
    }
  }
  std::erase_if(texts, [](const std::string& text) {
    return !given_components(std::string_view(text).substr(0, text.find('='))).empty();
  });
  return all;
}

}  // namespace ninebit::tools
