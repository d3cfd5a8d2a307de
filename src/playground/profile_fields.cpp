#include "src/playground/profile_fields.h"

namespace ninebit::playground {

Json value_of_field(const ProfileField& field, const HardwareProfile& profile) {
  const int value = field.get(profile).value;
  if (field.kind == FieldKind::number) return value;
  if (field.kind == FieldKind::flag) return value != 0;
  return field.word_of(value);
}

Json profile_object(const HardwareProfile& profile) {
  Json fields = Json::array();
  for (const ProfileField& field : profile_fields()) {
    const Choice<int> choice = field.get(profile);
    Json object{{"name", field.name},
                {"value", value_of_field(field, profile)},
                {"evidence", name_of(choice.evidence)},
                {"source", choice.source},
                {"help", field.help},
                {"read", field.group != FieldGroup::integer_rules || profile.arithmetic == Arithmetic::integer}};
    if (field.kind == FieldKind::word) {
      for (const FieldWord& word : field.words) object["choices"].push_back(word.word);
    } else if (field.kind == FieldKind::number) {
      const FieldNumbers range = field.range(profile);
      object["range"] = {range.first, range.second};
    }
    fields.push_back(std::move(object));
  }
  return Json{{"name", profile.name}, {"summary", profile.chip}, {"fields", std::move(fields)}};
}

}  // namespace ninebit::playground
