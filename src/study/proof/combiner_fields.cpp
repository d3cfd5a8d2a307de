#include "ninebit/study/combiner_fields.h"

#include <algorithm>

#include "ninebit/numerics/profile_fields.h"

namespace ninebit {
namespace {

// The values that the evidence lets compete.
std::vector<int> rivals_of(const ProfileField& field, const HardwareProfile& profile) {
  if (field.rivals != nullptr) return {field.rivals(profile).first, field.rivals(profile).second};
  std::vector<int> values(field.words.size());
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<int>(i);
  return values;
}

std::vector<CombinerField> fields_of(FieldGroup group, const HardwareProfile& profile) {
  std::vector<CombinerField> fields;
  for (const ProfileField& field : profile_fields()) {
    if (field.group != group) continue;
    std::vector<int> values = rivals_of(field, profile);
    if (values.empty()) continue;
    // The profile's own value first, which may be one of its own.
    const Choice<int> own = field.get(profile);
    std::erase(values, own.value);
    values.insert(values.begin(), own.value);
    CombinerField& out = fields.emplace_back(CombinerField{field.name, field.rules, own.evidence, {}});
    for (const int value : values) {
      out.values.push_back({field.word_of(value), [&field, value](HardwareProfile& p) { set_field(p, field, value); }});
    }
  }
  return fields;
}

}  // namespace

std::vector<CombinerField> arithmetic_fields(const HardwareProfile& profile) {
  if (profile.arithmetic != Arithmetic::integer) return {};
  return fields_of(FieldGroup::integer_rules, profile);
}

std::vector<CombinerField> register_fields(const HardwareProfile& profile) {
  return fields_of(FieldGroup::start_registers, profile);
}

}  // namespace ninebit
