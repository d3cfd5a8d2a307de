#include "src/scene/json_value.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace ninebit {
namespace {

constexpr int kDeepest = 64;

class JsonParser {
 public:
  explicit JsonParser(std::string_view text) : text_(text) {}

  Result<JsonValue> parse() {
    JsonValue root;
    if (read_value(root, 0)) {
      skip_blanks();
      if (at_ == text_.size()) return root;
      fault_ = "the JSON text goes on after its end";
    }
    const auto line = 1 + std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n');
    return Diagnostic{fault_, "", static_cast<int>(line), Fault::invalid_input};
  }

 private:
  bool fail(const char* fault) {
    fault_ = fault;
    return false;
  }

  void skip_blanks() {
    while (at_ < text_.size() && (text_[at_] == ' ' || text_[at_] == '\t' || text_[at_] == '\n' || text_[at_] == '\r'))
      ++at_;
  }

  bool take(char c) {
    skip_blanks();
    if (at_ >= text_.size() || text_[at_] != c) return false;
    ++at_;
    return true;
  }

  bool take_word(std::string_view word) {
    if (!text_.substr(at_).starts_with(word)) return fail("a JSON value is malformed");
    at_ += word.size();
    return true;
  }

  bool read_value(JsonValue& value, int depth) {
    skip_blanks();
    if (depth > kDeepest) return fail("the JSON text nests too deep");
    if (at_ >= text_.size()) return fail("the JSON text ends early");
    switch (text_[at_]) {
      case '{':
        return read_object(value, depth);
      case '[':
        return read_array(value, depth);
      case '"':
        value.type = JsonValue::Type::string;
        return read_string(value.text);
      case 't':
      case 'f':
        value.type = JsonValue::Type::boolean;
        value.number = text_[at_] == 't' ? 1.0 : 0.0;
        return take_word(text_[at_] == 't' ? "true" : "false");
      case 'n':
        return take_word("null");
      default:
        return read_number(value);
    }
  }

  bool read_object(JsonValue& value, int depth) {
    value.type = JsonValue::Type::object;
    ++at_;
    if (take('}')) return true;
    do {
      skip_blanks();
      if (at_ >= text_.size() || text_[at_] != '"') return fail("a JSON object lacks a member name");
      if (!read_string(value.names.emplace_back())) return false;
      if (!take(':')) return fail("a JSON object lacks a ':'");
      if (!read_value(value.items.emplace_back(), depth + 1)) return false;
    } while (take(','));
    return take('}') || fail(at_ < text_.size() ? "a JSON object is malformed" : "the JSON text ends early");
  }

  bool read_array(JsonValue& value, int depth) {
    value.type = JsonValue::Type::array;
    ++at_;
    if (take(']')) return true;
    do {
      if (!read_value(value.items.emplace_back(), depth + 1)) return false;
    } while (take(','));
    return take(']') || fail(at_ < text_.size() ? "a JSON array is malformed" : "the JSON text ends early");
  }

  bool read_string(std::string& out) {
    ++at_;
    while (true) {
      const std::size_t stop = text_.find_first_of("\"\\", at_);
      if (stop == std::string_view::npos) {
        at_ = text_.size();
        return fail("the JSON text ends early, within a string");
      }
      out.append(text_.substr(at_, stop - at_));
      at_ = stop + 1;
      if (text_[stop] == '"') return true;
      if (at_ >= text_.size()) return fail("the JSON text ends early, within a string");
      read_escape(out);
    }
  }

  void read_escape(std::string& out) {
    const char c = text_[at_++];
    constexpr std::string_view kNames = "bfnrt";
    constexpr std::string_view kValues = "\b\f\n\r\t";
    const std::size_t known = kNames.find(c);
    if (known != std::string_view::npos) {
      out.push_back(kValues[known]);
    } else if (c == 'u') {
      read_code_point(out);
    } else {
      out.push_back(c);
    }
  }

  unsigned read_four_digits() {
    unsigned code = 0xFFFD;
    const std::string_view digits = text_.substr(at_, 4);
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), code, 16);
    if (error != std::errc() || end != digits.data() + 4) return 0xFFFD;
    at_ += 4;
    return code;
  }

  // What is no code point becomes the replacement character.
  void read_code_point(std::string& out) {
    unsigned code = read_four_digits();
    if (code >= 0xD800 && code < 0xDC00 && text_.substr(at_, 2) == "\\u") {
      at_ += 2;
      const unsigned low = read_four_digits();
      code = low >= 0xDC00 && low < 0xE000 ? 0x10000 + ((code - 0xD800) << 10U) + (low - 0xDC00) : 0xFFFD;
    }
    if (code >= 0xD800 && code < 0xE000) code = 0xFFFD;
    const auto put = [&out](unsigned byte) { out.push_back(static_cast<char>(byte)); };
    if (code < 0x80) {
      put(code);
      return;
    }
    if (code < 0x800) {
      put(0xC0 | (code >> 6U));
    } else {
      if (code < 0x10000) {
        put(0xE0 | (code >> 12U));
      } else {
        put(0xF0 | (code >> 18U));
        put(0x80 | ((code >> 12U) & 0x3FU));
      }
      put(0x80 | ((code >> 6U) & 0x3FU));
    }
    put(0x80 | (code & 0x3FU));
  }

  bool read_number(JsonValue& value) {
    value.type = JsonValue::Type::number;
    const char first = text_[at_];
    if (first != '-' && (first < '0' || first > '9')) return fail("a JSON value is malformed");
    const char* begin = text_.data() + at_;
    const auto [end, error] = std::from_chars(begin, text_.data() + text_.size(), value.number);
    if (error != std::errc() || !std::isfinite(value.number)) return fail("a JSON number is malformed or too large");
    at_ += static_cast<std::size_t>(end - begin);
    return true;
  }

  std::string_view text_;
  std::size_t at_ = 0;
  std::string fault_;
};

const JsonValue kNull;

}  // namespace

const JsonValue& JsonValue::operator[](std::string_view name) const {
  const auto found = std::find(names.begin(), names.end(), name);
  return found == names.end() ? kNull : items[static_cast<std::size_t>(found - names.begin())];
}

const JsonValue& JsonValue::operator[](std::size_t index) const {
  return index < items.size() ? items[index] : kNull;
}

std::optional<std::uint64_t> JsonValue::index() const {
  if (type != Type::number || number < 0.0 || number >= 9007199254740992.0 || number != std::floor(number))
    return std::nullopt;
  return static_cast<std::uint64_t>(number);
}

Result<JsonValue> parse_json(std::string_view text) {
  return JsonParser(text).parse();
}

}  // namespace ninebit
