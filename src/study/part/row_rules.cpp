#include "ninebit/study/row_rules.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

#include "src/study/part/part_text.h"

namespace ninebit {
namespace {

using Kind = FieldRule::Kind;

// A signed or unsigned whole number as a comparable pair: true if negative, and the bits.
std::optional<std::pair<bool, std::uint64_t>> whole(const StudyValue& value) {
  if (const auto* const n = std::get_if<std::uint64_t>(&value)) return std::pair{false, *n};
  if (const auto* const n = std::get_if<std::int64_t>(&value)) return std::pair{*n < 0, static_cast<std::uint64_t>(*n)};
  return std::nullopt;
}

bool same(const StudyValue& a, const StudyValue& b) {
  const auto first = whole(a), second = whole(b);
  return first || second ? first == second : a == b;
}

bool is_in(double value, const FieldRule& rule) {
  return value >= rule.least && value <= rule.greatest;  // false for NaN
}

bool is_printable(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127; });
}

bool follows(const FieldRule& rule, const StudyValue& value) {
  if (rule.may_be_nothing && std::holds_alternative<std::monostate>(value)) return true;
  switch (rule.kind) {
    case Kind::exact:
      return same(rule.value, value);
    case Kind::count:
    case Kind::whole: {
      const auto number = whole(value);
      if (!number) return false;
      const auto* const negative = std::get_if<std::int64_t>(&value);
      return is_in(negative != nullptr ? static_cast<double>(*negative) : static_cast<double>(number->second), rule);
    }
    case Kind::real: {
      const auto* const number = std::get_if<double>(&value);
      return number != nullptr && is_in(*number, rule);
    }
    case Kind::text: {
      const auto* const text = std::get_if<std::string>(&value);
      return text != nullptr && static_cast<double>(text->size()) <= rule.greatest && is_printable(*text);
    }
  }
  return false;
}

std::string shown(const StudyValue& value) {
  if (std::holds_alternative<std::monostate>(value)) return "nothing";
  const std::string text = quotable(text_of(value));
  return std::holds_alternative<std::string>(value) ? "'" + text + "'" : text;
}

std::string expected_by(const FieldRule& rule) {
  std::string text;
  switch (rule.kind) {
    case Kind::exact:
      text = shown(rule.value);
      break;
    case Kind::count:
    case Kind::whole:
      text = fmt::format("a whole number from {:.17g} to {:.17g}", rule.least, rule.greatest);
      break;
    case Kind::real:
      text = fmt::format("a real number from {:g} to {:g}", rule.least, rule.greatest);
      break;
    case Kind::text:
      text = fmt::format("a text of at most {:.0f} bytes without control characters", rule.greatest);
      break;
  }
  return text + (rule.may_be_nothing ? ", or nothing" : "");
}

std::string wrong_with_row(const RowRule& rule, const StudyRow& row) {
  if (row.table != rule.table) {
    return fmt::format("belongs to the table '{}'; expected '{}'", quotable(row.table), rule.table);
  }
  if (row.fields.size() != rule.fields.size()) {
    return fmt::format("has {} fields; expected {}", row.fields.size(), rule.fields.size());
  }
  for (std::size_t i = 0; i < row.fields.size(); ++i) {
    const auto& [name, value] = row.fields[i];
    const FieldRule& field = rule.fields[i];
    if (name != field.name) return fmt::format("field {} is '{}'; expected '{}'", i + 1, quotable(name), field.name);
    if (!follows(field, value)) return fmt::format("{} is {}; expected {}", name, shown(value), expected_by(field));
  }
  return {};
}

}  // namespace

FieldRule exactly(std::string name, StudyValue value) {
  return {.name = std::move(name), .kind = Kind::exact, .value = std::move(value)};
}

FieldRule count_up_to(std::string name, double greatest) {
  return {.name = std::move(name), .kind = Kind::count, .greatest = greatest};
}

FieldRule whole_in(std::string name, double least, double greatest) {
  return {.name = std::move(name), .kind = Kind::whole, .least = least, .greatest = greatest};
}

FieldRule real_in(std::string name, double least, double greatest) {
  return {.name = std::move(name), .kind = Kind::real, .least = least, .greatest = greatest};
}

FieldRule text_up_to(std::string name, double bytes) {
  return {.name = std::move(name), .kind = Kind::text, .greatest = bytes};
}

FieldRule or_nothing(FieldRule rule) {
  rule.may_be_nothing = true;
  return rule;
}

std::string wrong_with_rows(std::span<const RowRule> rules, std::span<const StudyRow> rows) {
  if (rows.size() != rules.size()) return fmt::format("has {} rows; expected {}", rows.size(), rules.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (const std::string why = wrong_with_row(rules[i], rows[i]); !why.empty()) {
      return fmt::format("row {}: {}", i + 1, why);
    }
  }
  return {};
}

}  // namespace ninebit
