// Register words as a JSON object.
#include <algorithm>
#include <charconv>

#include "ninebit/language/json.h"
#include "src/language/json/json_reader.h"
#include "src/language/register_words/register_words_layout.h"

namespace ninebit {

using json::Type;
using json::Value;

std::optional<std::uint32_t> json::word_of(const Value& value) {
  if (value.type != Type::string && value.type != Type::number) return std::nullopt;
  std::string_view digits = value.text;
  int base = 10;
  if (value.type == Type::string) {
    if (!digits.starts_with("0x") && !digits.starts_with("0X")) return std::nullopt;
    digits.remove_prefix(2);
    base = 16;
  }
  std::uint32_t word = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), word, base);
  if (digits.empty() || error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return word;
}

Parsed<CombinerState> parse_json_register_words(const SourceText& source, ChipClass chip,
                                                const HardwareProfile& profile,
                                                std::vector<RegisterWord>* other_words) {
  TextFaults faults(source.file);
  if (too_long(source.text, faults)) return faults.take();
  const std::optional<Value> root = json::read_tree(source.text, faults);
  if (!root) return faults.take();
  json::Reader reader(source.text, faults);
  std::vector<RegisterWord> found;
  if (root->type != Type::object) {
    reader.wrong_type(*root, "an object");
    return faults.take();
  }
  reader.heading(*root, "register_words", false);
  for (const Value& child : root->children) {
    if (child.key == "ninebit" || child.key == "version") continue;
    if (child.key == "chip") {
      if (child.type != Type::string || child.text != name_of(chip)) {
        reader.fault(child.offset, "\"chip\" must be " + json::in_quotes(name_of(chip)) + " here");
      }
      continue;
    }
    const bool name_is_text = json::in_quotes(child.key) == '"' + child.key + '"';
    const std::optional<std::uint32_t> word = json::word_of(child);
    if (!name_is_text) {
      reader.fault(child.key_offset, json::in_quotes(child.key) + " is not a register word");
    } else if (!word) {
      reader.fault(child.offset, child.key + " must be a string such as \"0x08040000\" or a whole number below 2^32");
    } else {
      found.push_back({child.key, *word, reader.place(child.key_offset)});
    }
  }
  Parsed<CombinerState> decoded = decode_register_words(found, source.file, chip, profile, other_words);
  if (faults.empty()) return decoded;
  faults.add(decoded.faults());
  return faults.take();
}

Result<std::string> print_json_register_words(const CombinerState& state, ChipClass chip,
                                              const HardwareProfile& profile,
                                              std::span<const RegisterWord> other_words) {
  const auto words = encode_register_words(state, chip, profile);
  if (!words) return words.error();
  std::string text = "{\n  \"ninebit\": \"register_words\",\n  \"version\": 1,\n  \"chip\": \"";
  text += std::string(name_of(chip)) + '"';
  const auto add = [&](const RegisterWord& word) {
    text += ",\n  \"" + word.name + "\": \"" + words::hex_text(word.value) + '"';
  };
  std::for_each(words->begin(), words->end(), add);
  if (chip == ChipClass::nv20) std::for_each(other_words.begin(), other_words.end(), add);
  return text + "\n}\n";
}

}  // namespace ninebit
