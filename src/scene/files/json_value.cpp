#include "src/scene/files/json_value.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

namespace ninebit {
namespace {

constexpr int kDeepestValue = 64;
constexpr int kNumberOverflow = 406;  // nlohmann's id of this error

Diagnostic fault_at(std::string message, std::string_view text, std::size_t at) {
  const std::string_view before = text.substr(0, at);
  return {std::move(message), "", static_cast<int>(1 + std::count(before.begin(), before.end(), '\n')),
          Fault::invalid_input};
}

// The description in a parse error, without the position and the last token, which can be long.
std::string reason(std::string_view what) {
  const std::size_t start = what.find(" - ");
  if (start == std::string_view::npos) return "";
  what.remove_prefix(start + 3);
  return fmt::format(": {}", what.substr(0, what.find("; last read")));
}

// Finds the first fault of a JSON text without storing its values.
class FaultFinder : public nlohmann::json_sax<JsonValue> {
 public:
  [[nodiscard]] std::optional<Diagnostic> find(std::string_view text) {
    std::istringstream in{std::string(text)};
    if (JsonValue::sax_parse(in, this)) {
      // The parser treats a byte 0 as the end.
      const std::size_t zero = text.find('\0');
      if (zero == std::string_view::npos) return std::nullopt;
      return fault_at("the JSON text is malformed: it holds a byte 0", text, zero);
    }
    // Events have no position, but the stream is just behind the value that exceeds a limit.
    if (position_ == 0)
      return fault_at(depth_ > kDeepestValue
                          ? "the JSON text nests too deep"
                          : fmt::format("the JSON text holds more than {} values and names", kMostJsonValues),
                      text, static_cast<std::size_t>(std::max<std::streamoff>(in.tellg(), 0)));
    // A position counts the bytes that were read, including the one at fault; the end counts as one more.
    if (position_ > text.size()) return fault_at("the JSON text ends early", text, text.size());
    return fault_at(message_, text, position_ - 1);
  }

  bool null() override { return one_more(); }
  bool boolean(bool) override { return one_more(); }
  bool number_integer(JsonValue::number_integer_t) override { return one_more(); }
  bool number_unsigned(JsonValue::number_unsigned_t) override { return one_more(); }
  bool number_float(JsonValue::number_float_t, const std::string&) override { return one_more(); }
  bool string(std::string&) override { return one_more(); }
  bool binary(JsonValue::binary_t&) override { return one_more(); }
  bool key(std::string&) override { return one_more(); }
  bool start_object(std::size_t) override { return ++depth_ <= kDeepestValue && one_more(); }
  bool start_array(std::size_t) override { return ++depth_ <= kDeepestValue && one_more(); }
  bool end_object() override { return --depth_ >= 0; }
  bool end_array() override { return --depth_ >= 0; }

  bool parse_error(std::size_t position, const std::string&, const JsonValue::exception& error) override {
    position_ = std::max<std::size_t>(position, 1);
    message_ = error.id == kNumberOverflow ? "a JSON number is too large"
                                           : fmt::format("the JSON text is malformed{}", reason(error.what()));
    return false;
  }

 private:
  bool one_more() { return ++values_ <= kMostJsonValues; }

  int depth_ = 0;
  std::uint64_t values_ = 0;
  std::size_t position_ = 0;  // of the malformed byte; 0: none
  std::string message_;
};

const JsonValue kNull;
const JsonValue kNoItems = JsonValue::array();
const std::string kNoText;

}  // namespace

Result<JsonValue> parse_json(std::string_view text) {
  if (auto fault = FaultFinder().find(text)) return *std::move(fault);
  return Result<JsonValue>(JsonValue::parse(text, nullptr, false));
}

const JsonValue& item(const JsonValue& value, const char* name) {
  const auto found = value.find(name);
  return found == value.end() ? kNull : *found;
}

const JsonValue& item(const JsonValue& value, std::uint64_t index) {
  return value.is_array() && index < value.size() ? value[static_cast<std::size_t>(index)] : kNull;
}

const JsonValue& list_of(const JsonValue& value) {
  return value.is_array() ? value : kNoItems;
}

const std::string& text_of(const JsonValue& value) {
  const auto* text = value.get_ptr<const std::string*>();
  return text == nullptr ? kNoText : *text;
}

double number_or(const JsonValue& value, double fallback) {
  return value.is_number() ? value.get<double>() : fallback;
}

std::optional<std::uint64_t> index_of(const JsonValue& value) {
  const double number = number_or(value, -1.0);
  if (number < 0.0 || number >= 9007199254740992.0 || number != std::floor(number)) return std::nullopt;
  return static_cast<std::uint64_t>(number);
}

const JsonValue& target_of(const JsonValue& list, const JsonValue& reference) {
  const std::optional<std::uint64_t> index = index_of(reference);
  return index ? item(list, *index) : kNull;
}

}  // namespace ninebit
