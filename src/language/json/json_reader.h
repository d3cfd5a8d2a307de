// Reads values of the expected types from a tree; anything else is a fault with its place.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "src/language/source/source_faults.h"
#include "src/system/find_row.h"

// JSON text as a tree of values with their places.

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

// A name quoted for a message: truncated to a readable length, with bytes that are not printable UTF-8 as escapes.
[[nodiscard]] std::string in_quotes(std::string_view text);

}  // namespace json
}  // namespace ninebit

namespace ninebit::json {

// The 32 bits of a string "0x…" or of a whole number; empty if the value is neither or does not fit.
[[nodiscard]] std::optional<std::uint32_t> word_of(const Value& value);

}  // namespace ninebit::json

// Exported because effects, in a shared library of their own, are read with it.
namespace ninebit {
namespace NINEBIT_PUBLIC json {

class Reader {
 public:
  Reader(std::string_view text, TextFaults& faults) : places_(text), faults_(faults) {}

  // `gl_error`: the error that OpenGL would raise for the same value.
  void fault(std::size_t offset, const std::string& message, GlError gl_error = GlError::no_error) {
    faults_.add(places_(offset), message, gl_error);
  }

  [[nodiscard]] TextPlace place(std::size_t offset) const { return places_(offset); }

  // "mapping must be a string, not a number".
  void wrong_type(const Value& value, std::string_view expected) {
    fault(value.offset,
          called(value) + " must be " + std::string(expected) + ", not " + std::string(name_of(value.type)));
  }

  // Whether the value is an object; keys other than the given ones are faults.
  bool object(const Value& value, std::initializer_list<std::string_view> keys) {
    return object(value, std::span(keys.begin(), keys.size()));
  }
  bool object(const Value& value, std::span<const std::string_view> keys) {
    if (value.type != Type::object) {
      wrong_type(value, "an object");
      return false;
    }
    for (const Value& child : value.children) {
      if (std::find(keys.begin(), keys.end(), child.key) != keys.end()) continue;
      std::string message = "unknown key " + in_quotes(child.key) + "; the keys here are ";
      for (const std::string_view key : keys)
        message += std::string(key == *keys.begin() ? "" : ", ") + std::string(key);
      fault(child.key_offset, message);
    }
    return true;
  }

  // Calls function(value) if the object has the key.
  template <class Function>
  static void with(const Value& object, std::string_view key, const Function& function) {
    if (const Value* const value = find(object, key)) function(*value);
  }

  [[nodiscard]] static const Value* find(const Value& object, std::string_view key) {
    return find_row(object.children, &Value::key, key);
  }

  void boolean(const Value& value, bool& into) {
    if (value.type != Type::boolean) return wrong_type(value, "true or false");
    into = value.boolean;
  }

  // A whole number in [lowest, highest], written without fraction and exponent.
  void integer(const Value& value, int lowest, int highest, int& into, GlError beyond = GlError::no_error);

  // A real number in [0, 1].
  void fraction(const Value& value, float& into);

  // The number of the name that a string is; empty after a fault, whose error is `error` where it is none of them.
  [[nodiscard]] std::optional<std::size_t> choice(const Value& value, std::span<const std::string_view> names,
                                                  std::string_view what, GlError error = GlError::no_error);

  // The enumerator with this name, by the combiner's `name_of`. One of `refused` is a word of the language that OpenGL
  // rejects here.
  template <class Enum>
  void name(const Value& value, std::span<const Enum> allowed, std::string_view what, Enum& into,
            std::span<const Enum> refused = {}) {
    std::vector<std::string_view> names;
    for (const Enum one : allowed) names.push_back(ninebit::name_of(one));
    const bool known =
        std::any_of(refused.begin(), refused.end(), [&](Enum one) { return ninebit::name_of(one) == value.text; });
    const auto chosen = choice(value, names, what, known ? GlError::invalid_enum : GlError::no_error);
    if (chosen) into = allowed[*chosen];
  }

  // Checks "ninebit" and "version", which identify the text; `required`: they must be present.
  void heading(const Value& root, std::string_view kind, bool required);

 private:
  static std::string called(const Value& value) { return value.key.empty() ? "the value" : value.key; }

  Places places_;
  TextFaults& faults_;
};

}  // namespace json
}  // namespace ninebit
