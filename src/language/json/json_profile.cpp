#include <algorithm>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/language/profile_json.h"
#include "ninebit/numerics/profile_fields.h"
#include "src/language/json/json_reader.h"

namespace ninebit {
namespace {

using json::Reader;
using json::Type;
using json::Value;

// The storage of an OwnedProfile's string views.
struct ProfileText {
  std::string name, chip, source;
};

bool is_name(std::string_view text) {
  const auto plain = [](char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '_' ||
           c == '.';
  };
  return !text.empty() && text.size() <= 64 && std::all_of(text.begin(), text.end(), plain);
}

class ProfileReader {
 public:
  ProfileReader(const SourceText& source, TextFaults& faults) : read_(source.text, faults), faults_(faults) {
    text_->source = source.file.empty() ? "a custom profile" : std::string(source.file);
  }

  OwnedProfile read(const Value& root) {
    std::vector<std::string_view> keys{"ninebit", "version", "base", "name", "chip"};
    for (const ProfileField& field : profile_fields()) keys.push_back(field.name);
    if (!read_.object(root, keys)) return {profile_, text_};
    root_ = &root;
    read_.heading(root, "profile", false);
    read_base();
    read_names();
    read_fields();
    return {profile_, text_};
  }

 private:
  const Value* find(std::string_view key) const { return Reader::find(*root_, key); }

  void read_base() {
    std::string names;
    for (const HardwareProfile& shipped : hardware_profiles()) {
      names += (names.empty() ? "" : ", ") + std::string(shipped.name);
    }
    const Value* const base = find("base");
    if (base == nullptr) return read_.fault(root_->offset, "the key \"base\" is missing; expected one of " + names);
    if (base->type != Type::string) return read_.wrong_type(*base, "a string");
    const HardwareProfile* const shipped = find_profile(base->text);
    if (shipped == nullptr) {
      return read_.fault(base->offset,
                         json::in_quotes(base->text) + " is not a shipped profile; expected one of " + names);
    }
    profile_ = *shipped;
    base_arithmetic_ = profile_.arithmetic;
  }

  void read_names() {
    text_->chip = "none: a variation of " + std::string(profile_.name);
    const Value* const name = find("name");
    if (name == nullptr) {
      read_.fault(root_->offset, "the key \"name\" is missing");
    } else if (name->type != Type::string) {
      read_.wrong_type(*name, "a string");
    } else if (!is_name(name->text)) {
      read_.fault(name->offset, "a name must be 1 to 64 letters, digits and characters - _ .");
    } else if (find_profile(name->text) != nullptr) {
      read_.fault(name->offset, json::in_quotes(name->text) + " is the name of a shipped profile");
    } else {
      text_->name = name->text;
    }
    if (const Value* const chip = find("chip")) {
      const auto control = [](char c) { return (c >= 0 && c < ' ') || c == '\x7F'; };
      if (chip->type != Type::string) {
        read_.wrong_type(*chip, "a string");
      } else if (chip->text.size() > 200 || std::any_of(chip->text.begin(), chip->text.end(), control)) {
        read_.fault(chip->offset, "chip must be one line of at most 200 bytes");
      } else {
        text_->chip = chip->text;
      }
    }
    profile_.name = text_->name;
    profile_.chip = text_->chip;
  }

  // First the fields that the others' ranges depend on.
  void read_fields() {
    for (const char* const first : {"arithmetic", "byte_shift", "one"}) read_field(*find_profile_field(first));
    if (!one_fits()) return;
    const bool integer = profile_.arithmetic == Arithmetic::integer;
    if (!integer) {
      mark_integer_rules("not read by this arithmetic");
      set_codes_of_one();
    } else if (base_arithmetic_ != Arithmetic::integer) {  // the base marks them as not read
      mark_integer_rules(text_->source);
    }
    for (const ProfileField& field : profile_fields()) {
      if (field.group == FieldGroup::numbers) continue;
      const Value* const value = find(field.name);
      if (integer || field.group != FieldGroup::integer_rules) {
        read_field(field);
      } else if (value != nullptr) {
        read_.fault(value->key_offset, std::string(field.name) + " is not read by this arithmetic; remove it");
      }
    }
  }

  // Reports a code of 1.0 that does not fit the bytes; only once, as one of the keys may already have a fault. Without
  // either key there is nothing to report.
  bool one_fits() {
    const int one = 255 >> profile_.byte_shift.value;
    if (profile_.one == one) return true;
    const Value* const at = find("one") != nullptr ? find("one") : find("byte_shift");
    if (at != nullptr && faults_.empty()) {
      read_.fault(at->offset, "one is " + std::to_string(profile_.one.value) + "; with byte_shift " +
                                  std::to_string(profile_.byte_shift.value) + " it must be " + std::to_string(one) +
                                  ", so that a byte of 255 is 1.0");
    }
    return false;
  }

  // Keeps the values and changes their evidence.
  void mark_integer_rules(std::string_view source) {
    for (const ProfileField& field : profile_fields()) {
      if (field.group != FieldGroup::integer_rules) continue;
      field.set(profile_, {field.get(profile_).value, Evidence::assumed, source});
    }
  }

  // The codes of an arithmetic that does not read them.
  void set_codes_of_one() {
    const int one = profile_.one;
    profile_.lowest.value = profile_.lowest_output.value = -one;
    profile_.half.value = (one + 1) / 2;
    profile_.expand_offset.value = one;
  }

  void read_field(const ProfileField& field) {
    const Value* const value = find(field.name);
    if (value == nullptr) {
      if (field.kind == FieldKind::number && field.group == FieldGroup::integer_rules) check_base(field);
      return;
    }
    std::optional<int> chosen;
    if (field.kind == FieldKind::number) {
      chosen = number_of(field, *value);
    } else if (field.kind == FieldKind::flag) {
      bool flag = field.get(profile_).value != 0;
      read_.boolean(*value, flag);
      chosen = flag ? 1 : 0;
    } else {
      chosen = word_of(field, *value);
    }
    if (chosen) field.set(profile_, {*chosen, Evidence::assumed, text_->source});
  }

  int number_of(const ProfileField& field, const Value& value) {
    // `one` is compared with byte_shift afterwards: that fault names both.
    const FieldNumbers range = field.name == "one" ? FieldNumbers{1, 255} : field.range(profile_);
    int number = field.get(profile_).value;
    read_.integer(value, range.first, range.second, number);
    return number;
  }

  std::optional<int> word_of(const ProfileField& field, const Value& value) {
    std::vector<std::string_view> names;
    for (const FieldWord& word : field.words) names.push_back(word.word);
    return read_.choice(value, names, field.name) ? field.value_of(value.text) : std::nullopt;
  }

  // Reports a value of the base that other fields of this file have put out of its range.
  void check_base(const ProfileField& field) {
    const int value = field.get(profile_).value;
    const FieldNumbers range = field.range(profile_);
    if (value >= range.first && value <= range.second) return;
    const Value* const one = find("one");
    read_.fault(one != nullptr ? one->offset : root_->offset,
                std::string(field.name) + " of the base is " + std::to_string(value) +
                    ", but with this value it must be " + std::to_string(range.first) + " to " +
                    std::to_string(range.second) + "; set it as well");
  }

  Reader read_;
  TextFaults& faults_;
  const Value* root_ = nullptr;
  std::shared_ptr<ProfileText> text_ = std::make_shared<ProfileText>();
  HardwareProfile profile_ = profiles::geforce2;
  Arithmetic base_arithmetic_ = Arithmetic::integer;
};

}  // namespace

Parsed<OwnedProfile> parse_json_profile(const SourceText& source) {
  TextFaults faults(source.file);
  if (too_long(source.text, faults)) return faults.take();
  const auto root = json::read_tree(source.text, faults);
  if (!root) return faults.take();
  const OwnedProfile profile = ProfileReader(source, faults).read(*root);
  if (!faults.empty()) return faults.take();
  return profile;
}

}  // namespace ninebit
