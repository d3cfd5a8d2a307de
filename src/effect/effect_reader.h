// Reads the parts of an effect from a JSON tree.
#pragma once

#include <algorithm>
#include <array>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/effect/effect.h"
#include "ninebit/effect/effect_json.h"
#include "ninebit/language/source_text.h"
#include "src/effect/effect_words.h"
#include "src/language/json/json_reader.h"

namespace ninebit::effect_detail {

// The fault of a file name; nothing if the file may be read.
using NameCheck = std::function<std::optional<std::string>(const std::string& name)>;

// Whether a number may be an expression of the moment, as moving_number() reads it.
enum class Numbers : std::uint8_t { fixed, moving };

// Typed readers for values of a tree; anything else than what is expected is a fault with its place.
class EffectReader {
 public:
  // With `check`, for the names of files.
  explicit EffectReader(json::Reader& reader, NameCheck check, const EffectMoment& moment)
      : read_(reader), check_(std::move(check)), moment_(moment) {}

  [[nodiscard]] json::Reader& reader() { return read_; }

  // Calls `then` with a member that is there and is not null.
  template <class Then>
  void with(const json::Value& object, std::string_view key, const Then& then) {
    const json::Value* const value = json::Reader::find(object, key);
    if (value != nullptr && value->type != json::Type::null) then(*value);
  }

  void text(const json::Value& value, std::string& into);
  // Reports a file of this name, which `value` holds, if it may not be read.
  void check_file(const json::Value& value, const std::string& name);
  // A finite number in [lowest, highest].
  void real(const json::Value& value, double lowest, double highest, float& into, Numbers numbers = Numbers::fixed);
  // An array of so many numbers, or from `fewest` on; returns how many there are, 0 after a fault.
  std::size_t reals(const json::Value& value, std::size_t fewest, double lowest, double highest, std::span<float> into,
                    Numbers numbers = Numbers::fixed);
  // Whether a number depends on the moment.
  [[nodiscard]] bool moves() const { return moves_; }
  // Three coordinates, which may move.
  void point(const json::Value& value, std::optional<glm::vec3>& into);
  // Colours in [0, 1] as bytes, rounded to nearest, halves up.
  void bytes(const json::Value& value, std::span<std::uint8_t> into);
  void byte(const json::Value& value, std::uint8_t& into);

  // A word of a table.
  template <class T, std::size_t N>
  void word(const json::Value& value, const Words<T, N>& words, std::string_view what, T& into) {
    if (value.type != json::Type::string) return read_.wrong_type(value, "a string");
    if (const auto found = value_of(words, value.text)) {
      into = *found;
    } else {
      read_.fault(value.offset,
                  json::in_quotes(value.text) + " is not a " + std::string(what) + "; expected " + list_of(words));
    }
  }

  // The value that `parse` returns for a string.
  template <class T>
  void parsed(const json::Value& value, Result<T> (*parse)(std::string_view), T& into) {
    if (value.type != json::Type::string) return read_.wrong_type(value, "a string");
    if (auto result = parse(value.text)) {
      into = std::move(result).value();
    } else {
      read_.fault(value.offset, result.error().message);
    }
  }

 private:
  json::Reader& read_;
  NameCheck check_;
  EffectMoment moment_;
  bool moves_ = false;
};

// Reads one element of "passes" of an effect whose scene and profile have been read.
[[nodiscard]] EffectPass read_pass(EffectReader& read, const json::Value& value, const Effect& effect);

// parse_effect() that also checks the names of programs, textures and meshes.
[[nodiscard]] Parsed<Effect> parse_effect(const SourceText& source, const NameCheck& check, const EffectMoment& moment);

}  // namespace ninebit::effect_detail
