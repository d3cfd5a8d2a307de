#include "src/tools/vectors/program_line.h"

#include "ninebit/language/json.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

// A value without the members that equal those of another value.
Json without_defaults(const Json& value, const Json& defaults) {
  if (!value.is_object() || !defaults.is_object()) return value;
  Json kept = Json::object();
  for (const auto& [key, member] : value.items()) {
    const auto other = defaults.find(key);
    if (other == defaults.end()) {
      kept[key] = member;
    } else if (member != *other) {
      kept[key] = without_defaults(member, *other);
    }
  }
  return kept;
}

}  // namespace

std::string program_line(const CombinerState& state) {
  static const Json defaults = Json::parse(print_json_program({}));
  const Json whole = Json::parse(print_json_program(state));
  Json line{{"ninebit", whole["ninebit"]}, {"version", whole["version"]}};
  const Json kept = without_defaults(whole, defaults);
  for (const auto& [key, member] : kept.items()) line[key] = member;
  if (line.contains("general_combiners")) {
    for (Json& stage : line["general_combiners"]) stage = without_defaults(stage, defaults["general_combiners"][0]);
  }
  return line.dump();
}

}  // namespace ninebit::tools
