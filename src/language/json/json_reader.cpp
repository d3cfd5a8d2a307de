#include "src/language/json/json_reader.h"

#include <charconv>

namespace ninebit::json {
namespace {

// Whether a number that a float cannot hold is between 0 and 1. The JSON parser has already refused numbers that are
// too large for a double.
bool underflows(std::string_view text) {
  double number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return text.front() != '-' && (error != std::errc{} || number < 1.0);
}

}  // namespace

void Reader::integer(const Value& value, int lowest, int highest, int& into, GlError beyond) {
  if (value.type != Type::number) return wrong_type(value, "a whole number");
  int number = 0;
  const char* const end = value.text.data() + value.text.size();
  const auto [stop, error] = std::from_chars(value.text.data(), end, number);
  const bool is_whole = stop == end && error != std::errc::invalid_argument;
  if (!is_whole || error != std::errc{} || number < lowest || number > highest) {
    return fault(
        value.offset,
        called(value) + " must be a whole number from " + std::to_string(lowest) + " to " + std::to_string(highest),
        is_whole ? beyond : GlError::no_error);
  }
  into = number;
}

void Reader::fraction(const Value& value, float& into) {
  if (value.type != Type::number) return wrong_type(value, "a number");
  float number = 0;
  const char* const end = value.text.data() + value.text.size();
  const auto [stop, error] = std::from_chars(value.text.data(), end, number);
  if (error == std::errc::result_out_of_range && underflows(value.text)) {
    number = 0;
  } else if (error != std::errc{} || stop != end || !(number >= 0.0F && number <= 1.0F)) {
    return fault(value.offset, "a component of a constant is a number from 0 to 1");
  }
  into = number == 0.0F ? 0.0F : number;  // not -0
}

void Reader::heading(const Value& root, std::string_view kind, bool required) {
  const Value* const what = find(root, "ninebit");
  if (what != nullptr && what->type != Type::string) {
    wrong_type(*what, "a string");
  } else if (what != nullptr && what->text != kind) {
    fault(what->offset, "\"ninebit\" must be " + in_quotes(kind) + " here, not " + in_quotes(what->text));
  } else if (what == nullptr && required) {
    return fault(root.offset, "the key \"ninebit\": " + in_quotes(kind) + " is missing");
  }
  const Value* const version = find(root, "version");
  if (version == nullptr) {
    if (required) fault(root.offset, "the key \"version\": 1 is missing");
  } else if (version->type != Type::number) {
    wrong_type(*version, "a whole number");
  } else if (version->text != "1") {
    fault(version->offset, "version " + in_quotes(version->text) + " is not supported; expected version 1");
  }
}

}  // namespace ninebit::json
