// JSON text as a tree of values that know their places.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/register_words/register_words_faults.h"

namespace ninebit::json {

enum class Type : unsigned char { null, boolean, number, string, array, object };

// "null", "a boolean", "a number", …
[[nodiscard]] std::string_view name_of(Type type);

struct Value {
  Type type = Type::null;
  bool boolean = false;
  std::string text{};             // of a string, decoded; of a number, as it was written
  std::string key{};              // in an object
  std::size_t key_offset = 0;     // of the key's opening quote
  std::size_t offset = 0;         // of the value's first byte
  std::vector<Value> children{};  // of an array or an object, in the order of the text
};

// Reads one value and nothing behind it. Empty: not JSON, deeper than kMaxDepth or of more than kMaxValues values, and
// `faults` has the one that ended the reading. Of repeated keys the first stays in the tree, the others are faults.
inline constexpr std::size_t kMaxDepth = 16;
inline constexpr std::size_t kMaxValues = 5'000;
[[nodiscard]] std::optional<Value> read_tree(std::string_view text, TextFaults& faults);

// Offsets of one text to places, at the cost of a search.
class Places {
 public:
  explicit Places(std::string_view text);
  [[nodiscard]] TextPlace operator()(std::size_t offset) const;

 private:
  std::vector<std::size_t> line_starts_;
};

// A name as it may stand in a message: quoted, cut to a bearable length, bytes that are no printable ASCII as escapes.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace ninebit::json
