// The settings of techniques as one table.
//
// A setting is a member of RenderSettings, a row of this table, and read by a technique. Everything that goes through
// the settings one by one walks the table: flags with their groups, help and checks, JSON, the axes of sweeps, Python,
// the requests of pages.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/frame/settings.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The type of a setting's value: whole or real numbers, a word, or files, which this table cannot read or write.
enum class SettingKind : std::uint8_t { whole, real, word, files };

// The numbers of a value; of a word, its enumerator. Empty: the technique chooses.
using SettingValue = std::vector<double>;

// SettingGroup::readers of settings that every technique reads.
inline constexpr unsigned kAllTechniques = ~0U;

// Settings that the same techniques read.
struct SettingGroup {
  std::string_view title;  // the heading in the help
  unsigned readers;        // the techniques that read them, a bit each; see is_read()
};

// A word that a setting may have as its value.
struct SettingWord {
  std::string_view word;  // as in flags and in JSON: "neighbour"
  int value;              // its enumerator
};

// A setting as an axis of a sweep.
struct SettingAxis {
  std::string_view flag{};                    // without dashes: "steps"; empty: it cannot be swept
  std::array<std::string_view, 2> columns{};  // fields of a row, one for each number of a value
  bool by_default = true;                     // rows have the columns even if the setting is neither swept nor changed
  std::string_view expected{};                // the list of the flag, in messages; empty: a list of the words
  std::string_view help{};                    // of the flag, one line
};

// A setting of techniques.
struct TechniqueSetting {
  std::string_view name{};                // as a flag, without dashes: "index-step"; elsewhere with underscores
  const SettingGroup* group = nullptr;    // in the help
  SettingKind kind = SettingKind::whole;  // of the value
  std::size_t numbers = 1;                // how many a value has
  std::span<const SettingWord> words{};   // of SettingKind::word
  double least = 0.0;                     // of each number
  double greatest = 0.0;                  // likewise
  bool power_of_two = false;              // only powers of two are valid
  std::string_view form{};                // the value in the help: "N"; empty: by its kind
  std::string_view noun{};                // the value in messages: "map size"; may be empty
  std::string_view expected{};            // a valid value in messages: "a power of two from 1 to 16384"
  std::string_view help{};                // one line
  SettingAxis axis{};                     // of sweeps
  // Reads the setting.
  SettingValue (*get)(const RenderSettings& settings) = nullptr;
  // Writes the setting; the value must be one that it allows().
  void (*set)(RenderSettings& settings, const SettingValue& value) = nullptr;

  // The name with underscores.
  [[nodiscard]] std::string key() const;
  // The value of a text such as "2", "neighbour" or "1.125,16"; empty if it is not valid.
  [[nodiscard]] std::optional<SettingValue> value_of(std::string_view text) const;
  // The word of an enumerator.
  [[nodiscard]] std::string_view word_of(int enumerator) const;
  // A value as such a text.
  [[nodiscard]] std::string text_of(const SettingValue& value) const;
  // Whether each number is in range and of the kind. An empty value is allowed where the default is one.
  [[nodiscard]] bool allows(const SettingValue& value) const;
};

// The double of a float's shortest decimal form: 0.1F becomes 0.1. Real settings are floats; JSON and rows show these.
[[nodiscard]] double shortest_decimal(double value);

// All settings of techniques, in the order of the help.
[[nodiscard]] std::span<const TechniqueSetting> technique_settings();

// The setting of that name, or nullptr.
[[nodiscard]] const TechniqueSetting* find_technique_setting(std::string_view name);

// Whether a rendering by the technique with these settings reads this setting.
[[nodiscard]] bool is_read(const TechniqueSetting& setting, std::string_view technique, const RenderSettings& settings);

}  // namespace ninebit
