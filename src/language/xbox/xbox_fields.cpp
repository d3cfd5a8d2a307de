#include "src/language/xbox/xbox_fields.h"

#include <algorithm>

namespace ninebit::xbox {
namespace {

char lower_of(char c) {
  return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
}

bool same_but_case(std::string_view a, std::string_view b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](char x, char y) { return lower_of(x) == lower_of(y); });
}

}  // namespace

const Field* find_field(std::string_view name) {
  if (same_but_case(name, "PSAphaInputs")) return kFields.data();
  const auto found =
      std::find_if(kFields.begin(), kFields.end(), [&](const Field& field) { return same_but_case(field.name, name); });
  return found == kFields.end() ? nullptr : &*found;
}

std::vector<std::string_view> field_names() {
  std::vector<std::string_view> names;
  for (const Field& field : kFields) names.push_back(field.name);
  return names;
}

const Field& field_of(std::size_t word) {
  std::size_t i = 0;
  while (i + 1 < kFields.size() && kFields[i + 1].first <= word) ++i;
  return kFields[i];
}

std::string word_name(std::size_t word) {
  const Field& field = field_of(word);
  std::string name(field.name);
  if (field.count > 1) name += '[' + std::to_string(word - field.first) + ']';
  return name;
}

}  // namespace ninebit::xbox
