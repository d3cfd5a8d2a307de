// A JSON text as a tree, for the structure of glTF files.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/numerics/result.h"

namespace ninebit {

// Look-ups of what is not there give the null value, so that a path through a file needs one check at its end.
struct JsonValue {
  enum class Type { null, boolean, number, string, array, object };
  Type type = Type::null;
  double number = 0.0;
  std::string text;                // of a string
  std::vector<JsonValue> items;    // of an array or an object
  std::vector<std::string> names;  // of an object's items, in the text's order

  [[nodiscard]] const JsonValue& operator[](std::string_view name) const;
  [[nodiscard]] const JsonValue& operator[](std::size_t index) const;
  [[nodiscard]] bool exists() const { return type != Type::null; }
  [[nodiscard]] double number_or(double fallback) const { return type == Type::number ? number : fallback; }
  // A whole number >= 0 below 2^53; nothing for anything else.
  [[nodiscard]] std::optional<std::uint64_t> index() const;
};

// Arrays and objects nest at most 64 deep, far more than glTF needs. The Diagnostic names the line.
[[nodiscard]] Result<JsonValue> parse_json(std::string_view text);

}  // namespace ninebit
