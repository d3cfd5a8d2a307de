// JSON text as a tree of values with their places.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/register_words/register_words_faults.h"

// Exported because effects, in a shared library of their own, are read with it.
namespace ninebit {
namespace NINEBIT_PUBLIC json {

enum class Type : unsigned char { null, boolean, number, string, array, object };

// "null", "a boolean", "a number", …
[[nodiscard]] std::string_view name_of(Type type);

struct Value {
  Type type = Type::null;
  bool boolean = false;
  std::string text{};             // strings: decoded; numbers: as written
  std::string key{};              // the key of a member of an object
  std::size_t key_offset = 0;     // of the key's opening quote
  std::size_t offset = 0;         // of the value's first byte
  std::vector<Value> children{};  // of an array or an object, in text order
};

// Reads a text that is one value. Empty if it is not JSON, is deeper than kMaxDepth or has more than kMaxValues values;
// `faults` then has the fault that ended the reading. The first of several equal keys stays in the tree, the others are
// faults.
inline constexpr std::size_t kMaxDepth = 16;
inline constexpr std::size_t kMaxValues = 5'000;
[[nodiscard]] std::optional<Value> read_tree(std::string_view text, TextFaults& faults);

// Converts offsets of a text to places, by binary search.
class Places {
 public:
  explicit Places(std::string_view text);
  [[nodiscard]] TextPlace operator()(std::size_t offset) const;

 private:
  std::vector<std::size_t> line_starts_;
};

// A name quoted for a message: truncated to a readable length, with bytes that are not printable ASCII as escapes.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace json
}  // namespace ninebit
