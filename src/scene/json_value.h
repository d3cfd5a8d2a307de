// Reading a JSON text, and look-ups in it that never fail, for the structure of glTF files.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/numerics/result.h"

namespace ninebit {

using Json = nlohmann::json;

// What a JSON text may hold of values and of members' names, all told: in memory each takes up to fifty times its
// bytes.
inline constexpr std::uint64_t kMostJsonValues = std::uint64_t{1} << 22;

// Arrays and objects nest at most 64 deep, far more than glTF needs. The Diagnostic names the line.
[[nodiscard]] Result<Json> parse_json(std::string_view text);

// An object's member or an array's item. What is not there is null, so that a path through a file needs one check at
// its end.
[[nodiscard]] const Json& item(const Json& value, const char* name);
[[nodiscard]] const Json& item(const Json& value, std::uint64_t index);

template <class First, class Second, class... Rest>
[[nodiscard]] const Json& item(const Json& value, First first, Second second, Rest... rest) {
  return item(item(value, first), second, rest...);
}

// The value itself where it is an array, and an empty array for anything else.
[[nodiscard]] const Json& list_of(const Json& value);

// The text of a string, and an empty one for anything else.
[[nodiscard]] const std::string& text_of(const Json& value);

[[nodiscard]] double number_or(const Json& value, double fallback);

// A whole number >= 0 below 2^53, written in any way ("3", "3.0", "0.3e1"); nothing for anything else.
[[nodiscard]] std::optional<std::uint64_t> index_of(const Json& value);

// The item of a list that a reference to it by its index names.
[[nodiscard]] const Json& target_of(const Json& list, const Json& reference);

}  // namespace ninebit
