#include "src/language/json/json_reader.h"

#include <algorithm>
#include <charconv>
#include <nlohmann/json.hpp>

#include "src/system/find_row.h"
#include "src/system/lines.h"
#include "src/system/quoting.h"

namespace ninebit::json {
namespace {

// Finds the places that nlohmann's parser does not report. Each of its events is one token, and only blanks, commas and
// colons separate tokens, so a cursor that skips one token per event is at the place of the event. The parser accepts
// each token before it reports it, so the cursor need not validate it.
class Cursor {
 public:
  explicit Cursor(std::string_view text) : text_(text) { at_ = mark_size(text_); }

  // Returns the offset of the next token and moves past it.
  std::size_t next() {
    at_ = std::min(text_.find_first_not_of(" \t\r\n,:", at_), text_.size());
    const std::size_t start = at_;
    if (at_ >= text_.size()) return start;
    if (text_[at_] == '"') {
      for (++at_; at_ < text_.size() && text_[at_] != '"'; ++at_) {
        if (text_[at_] == '\\') ++at_;
      }
      at_ = std::min(at_ + 1, text_.size());
    } else if (std::string_view("{}[]").find(text_[at_]) != std::string_view::npos) {
      ++at_;
    } else {
      at_ = std::min(text_.find_first_of(" \t\r\n,:{}[]\"", at_), text_.size());
    }
    return start;
  }

  // The text from an offset that next() returned to the cursor.
  [[nodiscard]] std::string_view token(std::size_t start) const { return text_.substr(start, at_ - start); }

 private:
  std::string_view text_;
  std::size_t at_ = 0;
};

// The parser's message without its prefix and without the bytes that it read last.
std::string sentence_of(std::string_view what) {
  const std::size_t place = what.find("column ");
  if (place != std::string_view::npos) {
    const std::size_t colon = what.find(": ", place);
    if (colon != std::string_view::npos) what.remove_prefix(colon + 2);
  }
  std::string text(what);
  const std::size_t last = text.find("; last read: ");
  if (last != std::string::npos) {
    const std::size_t expected = text.rfind("; expected ");
    text.erase(last, expected != std::string::npos && expected > last ? expected - last : std::string::npos);
  }
  for (char& c : text) {
    if (c < ' ' || c > '~') c = '?';
  }
  return text.substr(0, 300);
}

// Builds the tree with a stack of unfinished values: a value is moved into its parent when it ends.
class Builder {
 public:
  using number_integer_t = nlohmann::json::number_integer_t;
  using number_unsigned_t = nlohmann::json::number_unsigned_t;
  using number_float_t = nlohmann::json::number_float_t;
  using string_t = nlohmann::json::string_t;
  using binary_t = nlohmann::json::binary_t;

  Builder(std::string_view text, TextFaults& faults) : text_(text), cursor_(text), faults_(faults) {}

  bool null() { return leaf(Type::null); }
  bool boolean(bool value) {
    next_.boolean = value;
    return leaf(Type::boolean);
  }
  bool number_integer(number_integer_t) { return leaf(Type::number); }
  bool number_unsigned(number_unsigned_t) { return leaf(Type::number); }
  bool number_float(number_float_t, const string_t&) { return leaf(Type::number); }
  bool string(string_t& value) {
    next_.text = std::move(value);
    return leaf(Type::string);
  }
  bool binary(binary_t&) { return false; }  // never occurs in JSON text

  bool start_object(std::size_t) { return start(Type::object); }
  bool start_array(std::size_t) { return start(Type::array); }
  bool end_object() { return end(); }
  bool end_array() { return end(); }

  bool key(string_t& value) {
    next_.key_offset = cursor_.next();
    next_.key = std::move(value);
    return true;
  }

  bool parse_error(std::size_t position, const std::string&, const nlohmann::json::exception& error) {
    const std::size_t offset = std::min(position == 0 ? 0 : position - 1, text_.size());
    faults_.add(place_of(text_, offset), "not valid JSON: " + sentence_of(error.what()));
    return false;
  }

  [[nodiscard]] Value take() { return std::move(root_); }

 private:
  bool counted() {
    if (++values_ <= kMaxValues) return true;
    faults_.add(place_of(text_, next_.offset), "more than " + std::to_string(kMaxValues) + " values");
    return false;
  }

  bool leaf(Type type) {
    next_.type = type;
    next_.offset = cursor_.next();
    if (!counted()) return false;
    if (type == Type::number) next_.text = cursor_.token(next_.offset);
    attach(std::exchange(next_, {}));
    return true;
  }

  bool start(Type type) {
    next_.type = type;
    next_.offset = cursor_.next();
    if (!counted()) return false;
    if (open_.size() >= kMaxDepth) {
      faults_.add(place_of(text_, next_.offset),
                  "brackets are nested more than " + std::to_string(kMaxDepth) + " deep");
      return false;
    }
    open_.push_back(std::exchange(next_, {}));
    return true;
  }

  bool end() {
    static_cast<void>(cursor_.next());
    Value done = std::move(open_.back());
    open_.pop_back();
    attach(std::move(done));
    return true;
  }

  void attach(Value value) {
    if (open_.empty()) {
      root_ = std::move(value);
      return;
    }
    std::vector<Value>& siblings = open_.back().children;
    if (open_.back().type == Type::object) {
      if (const Value* const same = find_row(siblings, &Value::key, value.key)) {
        faults_.add(place_of(text_, value.key_offset), "the key " + in_quotes(value.key) +
                                                           " was given before, in line " +
                                                           std::to_string(place_of(text_, same->key_offset).line));
        return;
      }
    }
    siblings.push_back(std::move(value));
  }

  std::string_view text_;
  Cursor cursor_;
  TextFaults& faults_;
  std::vector<Value> open_;
  Value next_{};
  Value root_{};
  std::size_t values_ = 0;
};

}  // namespace

std::string_view name_of(Type type) {
  switch (type) {
    case Type::null:
      return "null";
    case Type::boolean:
      return "a boolean";
    case Type::number:
      return "a number";
    case Type::string:
      return "a string";
    case Type::array:
      return "an array";
    case Type::object:
      return "an object";
  }
  return "something else";
}

std::optional<Value> read_tree(std::string_view text, TextFaults& faults) {
  Builder builder(text, faults);
  if (!nlohmann::json::sax_parse(text.begin(), text.end(), &builder)) return std::nullopt;
  return builder.take();
}

Places::Places(std::string_view text) : line_starts_{0} {
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\n') line_starts_.push_back(i + 1);
  }
}

TextPlace Places::operator()(std::size_t offset) const {
  const auto after = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset);
  const auto line = static_cast<std::size_t>(after - line_starts_.begin());
  return {static_cast<int>(line), 1 + static_cast<int>(offset - line_starts_[line - 1])};
}

std::string in_quotes(std::string_view text) {
  return quoted_briefly(text, '"', 60);
}

namespace {

// Whether a number that a float cannot hold is between 0 and 1. The JSON parser has already refused numbers that are
// too large for a double.
bool underflows(std::string_view text) {
  double number = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  return text.front() != '-' && (error != std::errc{} || number < 1.0);
}

}  // namespace

std::optional<std::size_t> Reader::choice(const Value& value, std::span<const std::string_view> names,
                                          std::string_view what, GlError error) {
  if (value.type != Type::string) {
    wrong_type(value, "a string");
    return std::nullopt;
  }
  std::string all;
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (names[i] == value.text) return i;
    all += (all.empty() ? "" : ", ") + std::string(names[i]);
  }
  fault(value.offset, in_quotes(value.text) + " is not a valid " + std::string(what) + "; expected one of " + all,
        error);
  return std::nullopt;
}

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
