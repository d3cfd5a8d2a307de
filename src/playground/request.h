// A request to the playground's engine.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/effect/effect_json.h"
#include "ninebit/language/profile_json.h"
#include "ninebit/language/source_code.h"
#include "src/language/json/json_reader.h"
#include "src/playground/reply.h"

namespace ninebit::playground {

// A profile, which stays valid as long as this.
struct ChosenProfile {
  const HardwareProfile* shipped = &profiles::geforce2;  // if it is not one's own
  std::optional<OwnedProfile> own{};                     // if it is
  std::string text{};                                    // of one's own
  [[nodiscard]] const HardwareProfile& profile() const { return own ? own->profile : *shipped; }
  [[nodiscard]] bool is_same(const ChosenProfile& other) const {
    return own.has_value() == other.own.has_value() && (own ? text == other.text : shipped == other.shipped);
  }
};

// The file texts of a request by name.
using FileTexts = std::map<std::string, std::string, std::less<>>;
// What is chosen of programs whose texts leave a choice, by the names of their files.
using ProgramChoices = std::map<std::string, SourceSelection, std::less<>>;

// A request, an object with the key "do". Where a value is missing, of another type or out of range, its reader adds a
// fault and returns a value without meaning: take the faults before the values are used.
class Request {
 public:
  // The views must outlive the request.
  Request(std::string_view text, const json::Value& root, TextFaults& faults)
      : text_(text), root_(root), faults_(faults), reader_(text, faults) {}

  // Reports keys other than these and "do".
  void allow(const std::vector<std::string_view>& keys);
  [[nodiscard]] bool failed() const { return !faults_.empty(); }
  [[nodiscard]] Reply refused() { return refusals(faults_.take(), text_); }

  [[nodiscard]] bool has(std::string_view key) const { return json::Reader::find(root_, key) != nullptr; }
  [[nodiscard]] std::string word(std::string_view key);
  [[nodiscard]] std::string word_or(std::string_view key, std::string_view otherwise);
  [[nodiscard]] int number(std::string_view key, int lowest, int highest);
  [[nodiscard]] bool flag_or(std::string_view key, bool otherwise);
  // The number that a value is, if it is one of this range.
  [[nodiscard]] static std::optional<double> real_of(const json::Value& value, double lowest, double highest);
  // The members of an object of strings; none without the key.
  [[nodiscard]] FileTexts texts(std::string_view key);
  // "choice", {"function", "defines", "program"}, each of which may be missing: what is chosen of one text.
  [[nodiscard]] SourceSelection choice();
  // "choices", an object of such objects by the names of files.
  [[nodiscard]] ProgramChoices choices();
  // The value of a key, which must be there.
  [[nodiscard]] const json::Value* value(std::string_view key);
  [[nodiscard]] const json::Value* find(std::string_view key) const { return json::Reader::find(root_, key); }
  // A string, or an object as its text.
  [[nodiscard]] std::string inner(std::string_view key);
  [[nodiscard]] std::string inner(const json::Value& value);
  // Reads "size", an array of a picture's width and height; without it both stay.
  void picture_size(int& width, int& height);
  // "time" in seconds and "frame"; 0 without them.
  [[nodiscard]] EffectMoment moment();
  // The profile under a key: the name of a shipped one, or a profile file's object or text. Without the key geforce2.
  [[nodiscard]] ChosenProfile profile(std::string_view key);
  [[nodiscard]] ChosenProfile profile_in(const json::Value& value);
  [[nodiscard]] json::Reader& reader() { return reader_; }

 private:
  // Whether a value is one; else that is a fault.
  bool is_object(const json::Value& value);
  SourceSelection choice_in(const json::Value& value);

  std::string_view text_;
  const json::Value& root_;
  TextFaults& faults_;
  json::Reader reader_;
};

}  // namespace ninebit::playground
