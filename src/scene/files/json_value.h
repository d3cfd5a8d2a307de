// Reads JSON text and looks up values in it without failing, for the structure of glTF files.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/numerics/result.h"

namespace ninebit {

using JsonValue = nlohmann::json;

// The most values and member names, together, in a JSON text: in memory each takes up to fifty times its bytes.
inline constexpr std::uint64_t kMostJsonValues = std::uint64_t{1} << 22;

// Parses a JSON text. Arrays and objects nest at most 64 deep, far more than glTF needs. The Diagnostic has the line.
[[nodiscard]] Result<JsonValue> parse_json(std::string_view text);

// An object's member or an array's item. A missing one is null, so a path through a file needs only one check at its
// end.
[[nodiscard]] const JsonValue& item(const JsonValue& value, const char* name);
[[nodiscard]] const JsonValue& item(const JsonValue& value, std::uint64_t index);

template <class First, class Second, class... Rest>
[[nodiscard]] const JsonValue& item(const JsonValue& value, First first, Second second, Rest... rest) {
  return item(item(value, first), second, rest...);
}

// The value itself if it is an array, otherwise an empty array.
[[nodiscard]] const JsonValue& list_of(const JsonValue& value);

// The text if the value is a string, otherwise an empty text.
[[nodiscard]] const std::string& text_of(const JsonValue& value);

[[nodiscard]] double number_or(const JsonValue& value, double fallback);

// A whole number >= 0 below 2^53, in any notation ("3", "3.0", "0.3e1"); nothing for any other value.
[[nodiscard]] std::optional<std::uint64_t> index_of(const JsonValue& value);

// The item of a list at the index in `reference`; null if there is none.
[[nodiscard]] const JsonValue& target_of(const JsonValue& list, const JsonValue& reference);

}  // namespace ninebit
