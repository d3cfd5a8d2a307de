#include "src/tools/input/eval_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/combiner/given_registers.h"

namespace ninebit::tools {
std::string EvalColumn::name() const {
  return std::string(short_name(reg)) + '.' + kComponents[static_cast<std::size_t>(component)];
}

std::vector<EvalColumn> columns_named(std::string_view name, const HardwareProfile& profile) {
  const std::size_t dot = std::min(name.find('.'), name.size());
  const std::optional<Register> reg = register_named(name.substr(0, dot));
  std::vector<EvalColumn> found;
  if (!reg) return found;
  for (const EvalColumn& column : eval_columns(profile)) {
    const bool is_meant =
        dot == name.size() || name.substr(dot + 1) == kComponents.substr(static_cast<std::size_t>(column.component), 1);
    if (column.reg == *reg && is_meant) found.push_back(column);
  }
  return found;
}

std::vector<EvalColumn> eval_columns(const HardwareProfile& profile) {
  std::vector<EvalColumn> columns;
  for (std::size_t i = 0; i < kRegisterCount; ++i) {
    const auto reg = static_cast<Register>(i);
    if (reg == Register::zero || (is_texture(reg) && texture_unit_of(reg) >= profile.texture_units)) continue;
    for (int component = 0; component < 4; ++component) columns.push_back({reg, component});
  }
  return columns;
}

Result<std::vector<EvalColumn>> read_header(const CsvLine& line, const std::string& file,
                                            const HardwareProfile& profile) {
  std::vector<EvalColumn> columns;
  std::string_view rest = line.text;
  while (true) {
    const std::size_t comma = rest.find(',');
    const std::string_view field = trimmed(rest.substr(0, comma));
    const std::size_t at = column_of(line, field.empty() ? rest : field);
    const std::vector<EvalColumn> found = columns_named(field, profile);
    if (found.size() != 1) {
      return csv_fault(
          file, line.number, at,
          fmt::format("unknown column '{}'; expected REGISTER.COMPONENT with a register of const0, const1, "
                      "fog, primary, secondary, spare0, spare1, tex0 to tex{} and a component of r, g, b, a",
                      shown(field), profile.texture_units - 1));
    }
    if (std::find(columns.begin(), columns.end(), found[0]) != columns.end()) {
      return csv_fault(file, line.number, at, fmt::format("duplicate column {}", found[0].name()));
    }
    columns.push_back(found[0]);
    if (comma == std::string_view::npos) return columns;
    rest.remove_prefix(comma + 1);
  }
}

Result<CsvLine> header_line(CsvLines& lines) {
  auto header = lines.next();
  if (!header) return table_fault(lines, header.error());
  if (!*header) return csv_fault(lines.name(), 1, 1, "the table is empty; expected a header such as primary.r,tex0.a");
  return **header;
}

Result<EvalTable> EvalTable::open(const std::string& file, const HardwareProfile& profile) {
  auto input = InputFile::open(file);
  if (!input) return input.error();
  CsvLines lines(std::move(*input));
  auto header = header_line(lines);
  if (!header) return header.error();
  auto columns = read_header(*header, lines.name(), profile);
  if (!columns) return table_fault(lines, columns.error());
  return EvalTable{std::move(lines), *std::move(columns)};
}

EvalRows::EvalRows(std::vector<EvalColumn> columns, const HardwareProfile& profile)
    : columns_(std::move(columns)), lowest_(profile.lowest), one_(profile.one), defaults_(default_registers(profile)) {}

bool EvalRows::has(const EvalColumn& column) const {
  return std::find(columns_.begin(), columns_.end(), column) != columns_.end();
}

void EvalRows::begin(EvalBatch& batch) const {
  batch.count = 0;
  for (std::size_t i = 0; i < kRegisterCount; ++i) {
    const auto reg = static_cast<Register>(i);
    for (int component = 0; component < 4; ++component) {
      std::fill_n(batch.registers(reg, component), kBatchSize, defaults_[reg][static_cast<std::size_t>(component)]);
    }
  }
}

Status EvalRows::add(const CsvLine& line, const std::string& file, EvalBatch& batch) const {
  const char* at = line.text.data();
  const char* const end = at + line.text.size();
  const auto skip_space = [&] {
    while (at != end && (*at == ' ' || *at == '\t')) ++at;
  };
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    skip_space();
    const std::string_view rest(at, static_cast<std::size_t>(end - at));
    int value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    at = next;
    skip_space();
    if (error != std::errc{} || (at != end && *at != ',') || value < lowest_ || value > one_) {
      return csv_fault(file, line.number, column_of(line, rest),
                       fmt::format("{} must be a whole number from {} to {}, not '{}'", columns_[i].name(), lowest_,
                                   one_, shown(trimmed(rest.substr(0, rest.find(','))))));
    }
    batch.registers(columns_[i].reg, columns_[i].component)[batch.count] = static_cast<s9>(value);
    const bool last = i + 1 == columns_.size();
    if (last != (at == end)) {
      const auto fields = 1 + std::count(line.text.begin(), line.text.end(), ',');
      return csv_fault(
          file, line.number, column_of(line, {at, at}),
          fmt::format("the row has {} field{}, the header {}", fields, fields == 1 ? "" : "s", columns_.size()));
    }
    if (!last) ++at;
  }
  ++batch.count;
  return {};
}

void EvalRows::end(EvalBatch& batch) const {
  if (has({Register::spare0, kAlpha})) return;
  std::copy_n(batch.registers(Register::texture0, kAlpha), batch.count, batch.registers(Register::spare0, kAlpha));
}

}  // namespace ninebit::tools
