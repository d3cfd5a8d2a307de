#include "src/study/part/part_text.h"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <optional>
#include <utility>

#include "src/system/hashing/openssl.h"

namespace ninebit {
namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view kKind = "ninebit study part 1";
constexpr std::string_view kEndBegin = R"({"end":)";
constexpr std::string_view kHashBegin = R"(,"sha256":")";
constexpr std::size_t kHashSize = 64;
constexpr std::size_t kTail = kHashBegin.size() + kHashSize + 2;  // the hash, its quote and the brace

// {"a":1} becomes {"a":1,"sha256":"…"} with the hash of {"a":1}.
std::string with_hash(const Json& json) {
  // A file name may not be UTF-8.
  std::string text = json.dump(-1, ' ', false, Json::error_handler_t::replace);
  const std::string hash = sha256(text);
  text.pop_back();
  return fmt::format("{}{}{}\"}}\n", text, kHashBegin, hash);
}

// The inverse of with_hash; empty if the line is not a result of with_hash.
std::optional<std::string> without_hash(std::string_view line) {
  if (line.size() <= kTail || !line.ends_with("\"}")) return std::nullopt;
  const std::string_view tail = line.substr(line.size() - kTail);
  if (!tail.starts_with(kHashBegin)) return std::nullopt;
  std::string text(line.substr(0, line.size() - kTail));
  text += '}';
  if (sha256(text) != tail.substr(kHashBegin.size(), kHashSize)) return std::nullopt;
  return text;
}

Diagnostic damaged() {
  return {.message = "the line does not match its SHA-256; expected an unchanged line"};
}

StudyValue value_of(const Json& json) {
  if (json.is_number_unsigned()) return json.get<std::uint64_t>();
  if (json.is_number_integer()) return json.get<std::int64_t>();
  if (json.is_number_float()) return json.get<double>();
  if (json.is_string()) return json.get<std::string>();
  return std::monostate{};
}

// Checks the type: the JSON library would convert numbers of any type and size.
std::size_t count_of(const Json& json) {
  if (!json.is_number_unsigned())
    throw nlohmann::json::other_error::create(0, "expected a whole number from 0", nullptr);
  return json.get<std::size_t>();
}

// Changed contents with a matching hash give an error, not a crash: the JSON library throws on missing values and on
// values of another type.
template <class Read>
auto read_json(std::string_view line, const Read& read) -> Result<decltype(read(Json()))> {
  const auto text = without_hash(line);
  if (!text) return damaged();
  try {
    return read(Json::parse(*text));
  } catch (const nlohmann::json::exception& error) {
    return Diagnostic{.message = fmt::format("is not a line of a study's part: {}", quotable(error.what()))};
  }
}

}  // namespace

std::string quotable(std::string text) {
  constexpr std::size_t kLongest = 400;
  if (text.size() > kLongest) text.replace(kLongest, std::string::npos, "...");
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < 32 || c == 127) c = '?';
  }
  return text;
}

std::string header_line(const PartHeader& header) {
  Json options = Json::array();
  for (const auto& [flag, value] : header.question.options) options.push_back({flag, value});
  return with_hash({{"file", kKind},
                    {"study", header.question.study},
                    {"profile", header.question.profile},
                    {"arguments", header.question.arguments},
                    {"options", std::move(options)},
                    {"build", header.build},
                    {"units", header.units},
                    {"shard", {header.shard.index, header.shard.count}}});
}

std::string unit_line(const FinishedUnit& unit) {
  Json rows = Json::array();
  for (const StudyRow& row : unit.rows) {
    Json fields = Json::object();
    for (const auto& [name, value] : row.fields) fields[name] = json_value(value);
    rows.push_back({row.table, std::move(fields)});
  }
  return with_hash({{"unit", unit.unit}, {"rows", std::move(rows)}});
}

std::string end_line(std::size_t units, std::string_view hash_of_all_before) {
  return fmt::format("{}{},\"sha256\":\"{}\"}}\n", kEndBegin, units, hash_of_all_before);
}

Result<PartHeader> parse_header_line(std::string_view line) {
  return read_json(line, [](const Json& json) {
    if (json.at("file") != kKind) throw nlohmann::json::other_error::create(0, "the file is of another kind", nullptr);
    PartHeader header;
    header.question.study = json.at("study").get<std::string>();
    header.question.profile = json.at("profile").get<std::string>();
    header.question.arguments = json.at("arguments").get<std::string>();
    for (const Json& option : json.at("options")) {
      header.question.options.emplace_back(option.at(0).get<std::string>(), option.at(1).get<std::string>());
    }
    header.build = json.at("build").get<std::string>();
    header.units = count_of(json.at("units"));
    header.shard = {count_of(json.at("shard").at(0)), count_of(json.at("shard").at(1))};
    return header;
  });
}

Result<FinishedUnit> parse_unit_line(std::string_view line) {
  return read_json(line, [](const Json& json) {
    FinishedUnit unit{count_of(json.at("unit")), {}};
    for (const Json& row : json.at("rows")) {
      StudyRow& out = unit.rows.emplace_back();
      out.table = row.at(0).get<std::string>();
      for (const auto& [name, value] : row.at(1).items()) out.fields.emplace_back(name, value_of(value));
    }
    return unit;
  });
}

bool is_end_line(std::string_view line) {
  return line.starts_with(kEndBegin);
}

Status check_end_line(std::string_view line, std::size_t units, std::string_view hash_of_all_before) {
  std::string expected = end_line(units, hash_of_all_before);
  expected.pop_back();
  if (line == expected) return {};
  return Diagnostic{.message = fmt::format("does not match the {} units before it; expected {}", units, expected)};
}

}  // namespace ninebit
