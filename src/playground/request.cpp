#include "src/playground/request.h"

#include <algorithm>
#include <cstdlib>

#include "src/playground/engine.h"

namespace ninebit::playground {
namespace {

constexpr double kMostSeconds = 1e6;
constexpr int kMostFrames = 1'000'000'000;
constexpr int kMostPrograms = 1'000'000;  // of one function, or set-ups of a log

// The end of a bracketed value that starts at `at` of a text that is JSON.
std::size_t end_of_brackets(std::string_view text, std::size_t at) {
  int open = 0;
  for (; at < text.size(); ++at) {
    const char c = text[at];
    if (c == '"') {
      for (++at; at < text.size() && text[at] != '"'; ++at) {
        if (text[at] == '\\') ++at;
      }
    } else if (c == '{' || c == '[') {
      ++open;
    } else if ((c == '}' || c == ']') && --open == 0) {
      return at + 1;
    }
  }
  return text.size();
}

std::string shipped_names() {
  std::string names;
  for (const HardwareProfile& profile : hardware_profiles()) {
    names += (names.empty() ? "" : ", ") + std::string(profile.name);
  }
  return names;
}

}  // namespace

void Request::allow(const std::vector<std::string_view>& keys) {
  for (const json::Value& child : root_.children) {
    if (child.key == "do" || std::find(keys.begin(), keys.end(), child.key) != keys.end()) continue;
    std::string message = "unknown key " + json::in_quotes(child.key) + "; the keys here are do";
    for (const std::string_view key : keys) message += ", " + std::string(key);
    reader_.fault(child.key_offset, message);
  }
}

const json::Value* Request::value(std::string_view key) {
  const json::Value* const found = find(key);
  if (found == nullptr) reader_.fault(root_.offset, "the key " + json::in_quotes(key) + " is missing");
  return found;
}

std::string Request::word(std::string_view key) {
  const json::Value* const found = value(key);
  if (found == nullptr) return {};
  if (found->type == json::Type::string) return found->text;
  reader_.wrong_type(*found, "a string");
  return {};
}

std::string Request::word_or(std::string_view key, std::string_view otherwise) {
  return has(key) ? word(key) : std::string(otherwise);
}

int Request::number(std::string_view key, int lowest, int highest) {
  int number = lowest;
  if (const json::Value* const found = value(key)) reader_.integer(*found, lowest, highest, number);
  return number;
}

bool Request::flag_or(std::string_view key, bool otherwise) {
  if (const json::Value* const found = find(key)) reader_.boolean(*found, otherwise);
  return otherwise;
}

std::optional<double> Request::real_of(const json::Value& value, double lowest, double highest) {
  if (value.type != json::Type::number) return std::nullopt;
  const double number = std::strtod(value.text.c_str(), nullptr);
  return number >= lowest && number <= highest ? std::optional(number) : std::nullopt;
}

bool Request::is_object(const json::Value& value) {
  if (value.type == json::Type::object) return true;
  reader_.wrong_type(value, "an object");
  return false;
}

FileTexts Request::texts(std::string_view key) {
  FileTexts all;
  const json::Value* const found = find(key);
  if (found == nullptr || !is_object(*found)) return all;
  for (const json::Value& child : found->children) {
    if (child.type != json::Type::string) {
      reader_.fault(child.offset, json::in_quotes(child.key) + " must be a string, the text of a file");
      continue;
    }
    all.insert_or_assign(child.key, child.text);
  }
  return all;
}

SourceSelection Request::choice_in(const json::Value& value) {
  SourceSelection out;
  if (!reader_.object(value, {"function", "defines", "program"})) return out;
  if (const json::Value* const function = json::Reader::find(value, "function")) {
    if (function->type == json::Type::string && !function->text.empty()) {
      out.functions.push_back(function->text);
    } else {
      reader_.wrong_type(*function, "the name of a function");
    }
  }
  if (const json::Value* const program = json::Reader::find(value, "program")) {
    int number = 1;
    reader_.integer(*program, 1, kMostPrograms, number);
    out.program = static_cast<std::size_t>(number);
  }
  const json::Value* const defines = json::Reader::find(value, "defines");
  if (defines == nullptr || !is_object(*defines)) return out;
  for (const json::Value& define : defines->children) {
    if (define.type == json::Type::string && !define.key.empty() && !define.text.empty()) {
      out.definitions.push_back({define.key, define.text});
    } else {
      reader_.fault(define.offset, "defines: " + json::in_quotes(define.key) + " must have a value, as a string");
    }
  }
  return out;
}

SourceSelection Request::choice() {
  const json::Value* const found = find("choice");
  return found == nullptr ? SourceSelection{} : choice_in(*found);
}

ProgramChoices Request::choices() {
  ProgramChoices all;
  const json::Value* const found = find("choices");
  if (found == nullptr || !is_object(*found)) return all;
  for (const json::Value& child : found->children) all.insert_or_assign(child.key, choice_in(child));
  return all;
}

std::string Request::inner(std::string_view key) {
  const json::Value* const found = value(key);
  return found == nullptr ? "" : inner(*found);
}

std::string Request::inner(const json::Value& value) {
  if (value.type == json::Type::string) return value.text;
  if (value.type == json::Type::object) {
    const std::size_t end = end_of_brackets(text_, value.offset);
    return std::string(text_.substr(value.offset, end - value.offset));
  }
  reader_.wrong_type(value, "an object, or a string with its text");
  return {};
}

void Request::picture_size(int& width, int& height) {
  const json::Value* const size = find("size");
  if (size == nullptr) return;
  if (size->type != json::Type::array || size->children.size() != 2) {
    reader_.fault(size->offset, "size must be an array of width and height");
    return;
  }
  reader_.integer(size->children[0], 1, kMaxDrawnSide, width);
  reader_.integer(size->children[1], 1, kMaxDrawnSide, height);
}

ChosenProfile Request::profile(std::string_view key) {
  const json::Value* const found = find(key);
  return found == nullptr ? ChosenProfile{} : profile_in(*found);
}

EffectMoment Request::moment() {
  EffectMoment moment;
  if (has("frame")) moment.frame = number("frame", 0, kMostFrames);
  const json::Value* const time = find("time");
  if (time == nullptr) return moment;
  if (const auto seconds = real_of(*time, -kMostSeconds, kMostSeconds)) {
    moment.time = *seconds;
  } else {
    reader_.fault(time->offset, "time must be a number of seconds from -1e6 to 1e6");
  }
  return moment;
}

ChosenProfile Request::profile_in(const json::Value& value) {
  ChosenProfile chosen;
  if (value.type == json::Type::string && !value.text.starts_with('{')) {
    if (const HardwareProfile* const shipped = find_profile(value.text)) {
      chosen.shipped = shipped;
    } else {
      reader_.fault(value.offset, "unknown profile " + json::in_quotes(value.text) + "; expected one of " +
                                      shipped_names() + ", or a profile as an object");
    }
    return chosen;
  }
  const std::string text = inner(value);
  if (failed()) return chosen;
  auto parsed = parse_json_profile({text, "profile"});
  if (parsed) {
    chosen.own = std::move(*parsed);
    chosen.text = text;
    return chosen;
  }
  // They are of another text than the request's own.
  for (const TextFault& fault : parsed.faults()) {
    const std::string place = std::to_string(fault.line) + ":" + std::to_string(fault.column);
    reader_.fault(value.offset, "profile:" + place + ": " + fault.message);
  }
  return chosen;
}

}  // namespace ninebit::playground
