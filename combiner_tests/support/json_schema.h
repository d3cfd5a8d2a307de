// Checks JSON values against a schema, for the part of JSON Schema 2020-12 that the project's schemas use.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

namespace ninebit::test {

using Json = nlohmann::json;

inline bool has_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "boolean") return value.is_boolean();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  if (type == "string") return value.is_string();
  if (type == "null") return value.is_null();
  ADD_FAILURE() << "the schema uses the type " << type << ", which this test does not know";
  return false;
}

// What is wrong with a value, by the part of JSON Schema 2020-12 that our schema uses; empty: nothing. A keyword beyond
// that part is a failure of the test.
inline std::string schema_complaint(const Json& root, const Json& rule, const Json& value, const std::string& at) {
  static const std::set<std::string> kAnnotations{"$schema", "title", "description", "$defs"};
  // First, because the other keywords assume it.
  if (rule.contains("type") && !has_type(value, rule.at("type"))) return at + " is no " + rule.at("type").dump();
  for (const auto& [keyword, argument] : rule.items()) {
    if (kAnnotations.count(keyword) != 0) continue;
    if (keyword == "$ref") {
      const std::string name = argument.get<std::string>().substr(std::string("#/$defs/").size());
      const std::string found = schema_complaint(root, root.at("$defs").at(name), value, at);
      if (!found.empty()) return found;
    } else if (keyword == "type") {
      continue;
    } else if (keyword == "const") {
      if (value != argument) return at + " is not " + argument.dump();
    } else if (keyword == "enum") {
      if (std::find(argument.begin(), argument.end(), value) == argument.end())
        return at + " is none of " + argument.dump();
    } else if (keyword == "required") {
      for (const Json& key : argument) {
        if (!value.contains(key)) return at + " lacks " + key.dump();
      }
    } else if (keyword == "properties") {
      for (const auto& [key, child] : value.items()) {
        if (!argument.contains(key)) continue;
        const std::string found = schema_complaint(root, argument.at(key), child, at + '/' + key);
        if (!found.empty()) return found;
      }
    } else if (keyword == "additionalProperties") {
      for (const auto& [key, child] : value.items()) {
        if (rule.contains("properties") && rule.at("properties").contains(key)) continue;
        if (argument == Json(false)) return at + " has the unknown key " + key;
        const std::string found = schema_complaint(root, argument, child, at + '/' + key);
        if (!found.empty()) return found;
      }
    } else if (keyword == "anyOf") {
      std::string last;
      bool fits = false;
      for (const Json& one : argument) {
        last = schema_complaint(root, one, value, at);
        fits = fits || last.empty();
      }
      if (!fits) return at + " fits none: " + last;
    } else if (keyword == "items") {
      for (std::size_t i = 0; i < value.size(); ++i) {
        const std::string found = schema_complaint(root, argument, value[i], at + '/' + std::to_string(i));
        if (!found.empty()) return found;
      }
    } else if (keyword == "minItems" || keyword == "maxItems") {
      const auto count = argument.get<std::size_t>();
      if (keyword == "minItems" ? value.size() < count : value.size() > count) return at + " has a wrong length";
    } else if (keyword == "pattern") {
      const std::regex pattern(argument.get<std::string>());
      if (!std::regex_search(value.get<std::string>(), pattern)) return at + " does not match " + argument.dump();
    } else if (keyword == "minimum" || keyword == "maximum") {
      const double limit = argument;
      if (keyword == "minimum" ? value.get<double>() < limit : value.get<double>() > limit)
        return at + " is out of range";
    } else {
      ADD_FAILURE() << "the schema uses " << keyword << ", which this test does not know";
    }
  }
  return {};
}

}  // namespace ninebit::test
