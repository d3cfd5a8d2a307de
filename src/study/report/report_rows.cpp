// Rows, and their machine-readable forms: JSON and CSV.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "ninebit/study/report_files.h"
#include "src/study/part/part_text.h"

namespace ninebit {
namespace {

using Json = nlohmann::ordered_json;

template <class... Cases>
struct Overloaded : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Overloaded(Cases...) -> Overloaded<Cases...>;

// RFC 4180: a field with a comma, a quotation mark or a line break is quoted, and its quotation marks are doubled.
std::string csv_field(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) {
    if (c == '"') quoted += '"';
    quoted += c;
  }
  return quoted + '"';
}

constexpr std::string_view kEndOfLine = "\r\n";  // required by RFC 4180

std::string csv_header(const StudyRow& row) {
  std::string line;
  for (const auto& [name, value] : row.fields) {
    if (!line.empty()) line += ',';
    line += csv_field(name);
  }
  return line += kEndOfLine;
}

void append_csv_line(std::string& out, const StudyRow& row) {
  bool first = true;
  for (const auto& [name, value] : row.fields) {
    if (!first) out += ',';
    out += csv_field(text_of(value));
    first = false;
  }
  out += kEndOfLine;
}

}  // namespace

std::string text_of(const StudyValue& value) {
  return std::visit(
      Overloaded{[](std::monostate) { return std::string(); }, [](const std::string& text) { return text; },
                 [](const auto& number) { return fmt::format("{}", number); }},
      value);
}

const StudyValue& StudyRow::operator[](std::string_view name) const {
  static const StudyValue nothing;
  const auto found = std::find_if(fields.begin(), fields.end(), [&](const auto& field) { return field.first == name; });
  return found == fields.end() ? nothing : found->second;
}

double StudyRow::number(std::string_view name) const {
  return std::visit(Overloaded{[](std::monostate) { return 0.0; }, [](const std::string&) { return 0.0; },
                               [](const auto& number) { return static_cast<double>(number); }},
                    (*this)[name]);
}

std::uint64_t StudyRow::count(std::string_view name) const {
  const StudyValue& value = (*this)[name];
  if (const auto* whole = std::get_if<std::uint64_t>(&value)) return *whole;
  if (const auto* whole = std::get_if<std::int64_t>(&value)) return *whole > 0 ? static_cast<std::uint64_t>(*whole) : 0;
  const double real = number(name);
  if (!(real > 0.0)) return 0;
  constexpr double kBeyond = 18446744073709551616.0;  // 2^64
  return real < kBeyond ? static_cast<std::uint64_t>(real) : std::numeric_limits<std::uint64_t>::max();
}

std::string StudyRow::text(std::string_view name) const {
  return text_of((*this)[name]);
}

std::string report_json(const StudyQuestion& question, std::string_view version, std::span<const StudyRow> rows) {
  Json out{{"command", "study " + question.study},
           {"version", version},
           {"profile", question.profile},
           {"question", question.command()},
           {"rows", Json::array()}};
  for (const StudyRow& row : rows) {
    Json object = Json::object();
    for (const auto& [name, value] : row.fields) object[name] = json_value(value);
    out[row.table].push_back(std::move(object));
  }
  // A file name may not be UTF-8; invalid bytes become the replacement character.
  return out.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<std::pair<std::string, std::string>> report_csv(std::span<const StudyRow> rows) {
  std::vector<std::pair<std::string, std::string>> tables;
  for (const StudyRow& row : rows) {
    auto table = std::find_if(tables.begin(), tables.end(), [&](const auto& t) { return t.first == row.table; });
    if (table == tables.end()) table = tables.insert(tables.end(), {row.table, csv_header(row)});
    append_csv_line(table->second, row);
  }
  return tables;
}

}  // namespace ninebit
