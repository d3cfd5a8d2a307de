// One field of a profile changed, and with it the fields that depend on it, so that the profile stays valid.
#include <utility>

#include "src/playground/texts.h"
#include "src/playground/vocabulary.h"

namespace ninebit::playground {
namespace {

// Every field's value by name.
Json values_of_profile(const HardwareProfile& profile) {
  Json values = Json::object();
  for (const ProfileField& field : profile_fields()) values[std::string(field.name)] = value_of_field(field, profile);
  return values;
}

// Makes the values fit each other after one of them was edited, by the ranges of parse_json_profile. The codes that
// depend on `one` are those of the base, moved or scaled.
void couple(Json& values, const Json& base, std::string_view edited) {
  const int one = 255 >> values["byte_shift"].get<int>(), base_one = base["one"].get<int>();
  if (values["one"] != one || edited == "arithmetic") {
    values["one"] = one;
    values["half"] = base["half"].get<int>() * (one + 1) / (base_one + 1);
    values["expand_offset"] = base["expand_offset"].get<int>() - base_one + one;
    for (const char* const lowest : {"lowest", "lowest_output"}) {
      values[lowest] = base[lowest].get<int>() + base_one - one;
    }
  }
}

// Moves the fields that an edited whole number moves along.
void move_along(Json& values, const HardwareProfile& before, const ProfileField& edited) {
  const std::string name(edited.name);
  if (edited.kind != FieldKind::number) return;
  HardwareProfile moved = before;
  set_field(moved, edited, values[name].get<int>());
  for (const ProfileField& field : profile_fields()) {
    if (field.get(moved).value == field.get(before).value || field.name == name) continue;
    values[std::string(field.name)] = value_of_field(field, moved);
  }
}

// The profile as a file that names only what differs from its base; the base's name alone if nothing does.
Json profile_file(const Json& values, const Json& base, const HardwareProfile& shipped, const std::string& name) {
  const bool integer = values["arithmetic"] == "integer";
  Json file{{"base", shipped.name}, {"name", name}};
  const std::size_t heading = file.size();
  for (const ProfileField& field : profile_fields()) {
    const std::string key(field.name);
    if (values[key] != base[key] && (integer || field.group != FieldGroup::integer_rules)) file[key] = values[key];
  }
  return file.size() == heading ? Json(shipped.name) : file;
}

std::optional<Json> edited_value(Request& request, const ProfileField& field, const Json& now) {
  const json::Value* const value = request.value("value");
  if (value == nullptr) return std::nullopt;
  if (now.is_boolean()) {
    bool flag = false;
    request.reader().boolean(*value, flag);
    return Json(flag);
  }
  if (now.is_number()) {
    int number = 0;
    request.reader().integer(*value, -256, 256, number);
    if (field.name == "byte_shift" && (number < 0 || number > 4)) {
      request.reader().fault(value->offset, "byte_shift must be from 0 to 4");
    }
    return Json(number);
  }
  return Json(request.word("value"));
}

}  // namespace

Reply edit_profile(Request& request) {
  request.allow({"profile", "field", "value"});
  const ChosenProfile chosen = request.profile("profile");
  const std::string edited = request.word("field");
  const ProfileField* const field = find_profile_field(edited);
  if (!request.failed() && field == nullptr) {
    request.reader().fault(request.find("field")->offset, json::in_quotes(edited) + " is not a field of a profile");
  }
  if (request.failed()) return request.refused();
  const HardwareProfile* shipped = chosen.shipped;
  std::string name = "mine";
  if (chosen.own) {
    const Json own = Json::parse(request.inner("profile"));
    shipped = find_profile(own["base"].get<std::string>());
    name = own["name"].get<std::string>();
  }
  const Json base = values_of_profile(*shipped), before = values_of_profile(chosen.profile());
  Json values = before;
  const auto value = edited_value(request, *field, before[edited]);
  if (request.failed()) return request.refused();
  values[edited] = *value;
  move_along(values, chosen.profile(), *field);
  couple(values, base, edited);
  Json out{{"profile", profile_file(values, base, *shipped, name)}};
  Json coupled = Json::array();
  for (const ProfileField& other : profile_fields()) {
    const std::string key(other.name);
    if (key != edited && values[key] != before[key]) coupled.push_back({{"name", key}, {"value", values[key]}});
  }
  out["coupled"] = std::move(coupled);
  if (out["profile"].is_string()) return out;
  const std::string file = out["profile"].dump();
  auto parsed = parse_json_profile({file, "profile"});
  if (!parsed) return refusals(parsed.faults(), file);
  return out;
}

Reply list_profile(Request& request) {
  request.allow({"profile"});
  const ChosenProfile chosen = request.profile("profile");
  if (request.failed()) return request.refused();
  return profile_object(chosen.profile());
}

}  // namespace ninebit::playground
