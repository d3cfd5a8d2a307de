#include "src/tools/verify/verify_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <limits>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/validate.h"
#include "src/combiner/given_registers.h"
#include "src/system/inside_folder.h"
#include "src/system/nearest_name.h"

namespace ninebit::tools {
namespace {

// Whether a table's first line is a row.
bool has_numbers_alone(std::string_view line) {
  const auto fields = pieces(line, ',');
  return std::all_of(fields.begin(), fields.end(), number_of);
}

}  // namespace

std::int64_t Expectation::distance(int code) const {
  if (allowed.empty()) return 0;
  std::int64_t least = std::numeric_limits<std::int64_t>::max();
  for (const int value : allowed) least = std::min(least, std::abs(std::int64_t{value} - code));
  return least;
}

Result<VerifyTable> VerifyTable::open(const std::string& file, const ProgramFlags& program, bool allow_outside,
                                      const HardwareProfile& profile) {
  auto input = InputFile::open(file);
  if (!input) return input.error();
  VerifyTable table(CsvLines(std::move(*input)), program, profile);
  table.allow_outside_ = table.program_.allow_outside = allow_outside;
  if (file != "-") table.folder_ = std::filesystem::path(file).parent_path();
  constexpr std::size_t kMostComments = 64;
  std::vector<std::string> comments;
  while (true) {
    auto line = table.lines_.next();
    if (!line) return table_fault(table.lines_, line.error());
    if (!*line)
      return csv_fault(table.name(), 1, 1, "the table is empty; expected a header such as program,tex0.r,out.r");
    if ((*line)->text.starts_with('#')) {
      if (comments.size() < kMostComments) comments.emplace_back((*line)->text);
      continue;
    }
    if (has_numbers_alone((*line)->text)) {
      return csv_fault(table.name(), (*line)->number, 1,
                       "the first line has numbers alone; expected a header such as program,tex0.r,out.r");
    }
    if (Status read = table.read_header(**line, comments); !read) return table_fault(table.lines_, read.error());
    return table;
  }
}

std::optional<VerifyTable::Column> VerifyTable::column_named(std::string_view field) const {
  using Kind = Column::Kind;
  if (field == "program") return Column{.kind = Kind::program, .name = std::string(field)};
  if (field == "name") return Column{.kind = Kind::name, .name = std::string(field)};
  for (int c = 0; c < 4; ++c) {
    if (field == std::string("out.") + kComponents[static_cast<std::size_t>(c)]) {
      return Column{.kind = Kind::expected,
                    .name = std::string(field),
                    .expected = {.column = std::string(field), .stage = {}, .component = c, .allowed = {}}};
    }
  }
  std::optional<int> stage;
  std::string_view reg = field;
  if (field.starts_with("stage")) {
    const std::size_t dot = field.find('.');
    if (dot == std::string_view::npos) return std::nullopt;
    stage = number_of(field.substr(5, dot - 5));
    if (!stage || *stage < 0 || *stage >= profile_->general_combiners) return std::nullopt;
    reg = field.substr(dot + 1);
  }
  for (const EvalColumn& known : eval_columns(*profile_)) {
    const bool constant = known.reg == Register::constant0 || known.reg == Register::constant1;
    if (known.name() != reg || (stage && constant)) continue;
    Column column{.kind = stage ? Kind::expected : Kind::input, .name = std::string(field), .input = known};
    column.expected = {std::string(field), stage, known.reg, known.component, {}};
    return column;
  }
  return std::nullopt;
}

// Reports the columns of a header that are not known.
Status VerifyTable::check_columns(const CsvLine& line) const {
  std::vector<std::string_view> unknown;
  for (const std::string_view field : pieces(line.text, ',')) {
    if (!column_named(field)) unknown.push_back(field);
  }
  if (unknown.empty()) return {};
  constexpr std::size_t kMostNamed = 12;
  std::string names;
  for (std::size_t i = 0; i < std::min(unknown.size(), kMostNamed); ++i) {
    names += fmt::format("{}'{}'", i == 0 ? "" : ", ", shown(unknown[i]));
  }
  if (unknown.size() > kMostNamed) names += fmt::format(" and {} more", unknown.size() - kMostNamed);
  std::vector<std::string> known{"program", "name", "out.r", "out.g", "out.b", "out.a"};
  for (const EvalColumn& one : eval_columns(*profile_)) known.push_back(one.name());
  // Nor is the whole header that of a measured table.
  const bool several = unknown.size() > 1;
  return csv_fault(
      name(), line.number, static_cast<std::size_t>(unknown[0].data() - line.text.data()) + 1,
      fmt::format("unknown column{} {}; expected program, name, an input such as tex0.r or const0.a, or an "
                  "expected value: out.r, or stage0.spare0.r after general combiner 0 (of {}){}{}",
                  several ? "s" : "", names, profile_->general_combiners.value,
                  several ? "; or the header of a measured table (" + measured_places() + ")" : "",
                  did_you_mean(unknown[0], known)));
}

Status VerifyTable::read_header(const CsvLine& line, const std::vector<std::string>& comments) {
  format_ = measured_format(line.text);
  if (format_ != nullptr) {
    if (!program_.file.empty()) return csv_fault(name(), line.number, 1, "--program is not for measured tables");
    if (Status read = read_stated(format_->stated, comments, name(), line.number, stated_); !read) return read;
    if (format_->beside.empty()) return {};
    auto beside = read_beside((folder_ / format_->beside).string(), *format_);
    if (!beside) return beside.error();
    beside_ = std::move(*beside);
    return {};
  }
  if (Status known = check_columns(line); !known) return known;
  for (const std::string_view field : pieces(line.text, ',')) {
    const std::size_t at = static_cast<std::size_t>(field.data() - line.text.data()) + 1;
    auto column = column_named(field);
    const auto same = [&](const Column& other) { return other.name == column->name; };
    if (std::any_of(columns_.begin(), columns_.end(), same)) {
      return csv_fault(name(), line.number, at, fmt::format("duplicate column {}", column->name));
    }
    columns_.push_back(std::move(*column));
  }
  const auto expects = [](const Column& column) { return column.kind == Column::Kind::expected; };
  if (!std::any_of(columns_.begin(), columns_.end(), expects)) {
    return csv_fault(name(), line.number, 1,
                     "no column has an expected value; expected one such as out.r or stage0.spare0.r");
  }
  const auto names_program = [](const Column& column) { return column.kind == Column::Kind::program; };
  if (program_.file.empty() && !std::any_of(columns_.begin(), columns_.end(), names_program)) {
    return csv_fault(name(), line.number, 1,
                     "no program: the table has no column `program`, and --program is not given");
  }
  return {};
}

Status VerifyTable::read_cell(const Column& column, std::string_view field, const CsvLine& line, VerifyRow& row) const {
  const std::size_t at = static_cast<std::size_t>(field.data() - line.text.data()) + 1;
  if (column.kind == Column::Kind::program) {
    row.program_file = field;
  } else if (column.kind == Column::Kind::name) {
    row.name = field;
  } else if (field.empty()) {
    return {};
  } else if (column.kind == Column::Kind::input) {
    const auto code = number_of(field);
    const int lowest = profile_->lowest, one = profile_->one;
    if (!code || *code < lowest || *code > one) {
      return csv_fault(name(), line.number, at,
                       fmt::format("{} must be a whole number from {} to {}, or empty, not '{}'", column.name, lowest,
                                   one, shown(field)));
    }
    const EvalColumn& to = column.input;
    const auto value = static_cast<s9>(*code);
    if (to.reg == Register::constant0 || to.reg == Register::constant1) {
      row.constants.emplace_back(to, value);
    } else {
      row.registers[to.reg][static_cast<std::size_t>(to.component)] = value;
    }
  } else {
    Expectation expected = column.expected;
    for (const std::string_view piece : pieces(field, '|')) {
      const auto code = number_of(piece);
      if (!code) {
        return csv_fault(
            name(), line.number, at,
            fmt::format("{} must be whole numbers separated by |, or empty, not '{}'", column.name, shown(field)));
      }
      expected.allowed.push_back(*code);
    }
    row.expected.push_back(std::move(expected));
  }
  return {};
}

Status VerifyTable::find_program(const CsvLine& line, VerifyRow& row) {
  if (row.program_file.empty() && program_.file.empty()) {
    return csv_fault(name(), line.number, 1, "the row names no program, and --program is not given");
  }
  ProgramFlags flags = program_;
  const bool is_named_here = !row.program_file.empty();
  const std::string named = row.program_file;
  if (is_named_here) flags.file = (folder_ / named).string();
  row.program_file = flags.file;
  const auto known = programs_.find(flags.file);
  if (known != programs_.end()) {
    row.program = &known->second;
    return {};
  }
  if (is_named_here && !allow_outside_) {
    if (const auto why = posix::why_outside(folder_, named)) return csv_fault(name(), line.number, 1, *why);
  }
  // A row that names "-" means a file of that name, never standard input.
  if (flags.file == "-" && is_named_here) flags.file = "./-";
  auto file = read_program_file(flags, *profile_);
  if (!file) return file.error();
  say_notes(file->parsed.notes);
  if (!file->parsed) {
    const TextFault& fault = file->parsed.faults().front();
    return Diagnostic{.message = fault.text()};
  }
  if (const auto refused = validate(*file->parsed, *profile_); !refused.empty()) {
    return Diagnostic{.message = fmt::format("{}: {}", name_of(refused[0].gl_error), refused[0].message),
                      .file = file->name};
  }
  std::vector<EvalColumn> given;
  for (const Column& column : columns_) {
    if (column.kind == Column::Kind::input) given.push_back(column.input);
  }
  say_assumed_constants(file->name, normalize(file->parsed->state, *profile_), given);
  row.program = &programs_.emplace(flags.file, file->parsed->state).first->second;
  return {};
}

Result<std::optional<VerifyRow>> VerifyTable::measured_row(const CsvLine& line) {
  using Kind = MeasuredColumn::Kind;
  VerifyRow row;
  row.line = line.number;
  row.format = format_;
  MeasuredRow& cells = row.measured;
  cells = stated_;
  if (Status read = read_measured(format_->columns, quoted_pieces(line.text), name(), line.number, cells); !read) {
    return read.error();
  }
  if (format_->wrong != nullptr) {
    const std::string wrong = format_->wrong(cells, *profile_);
    if (!wrong.empty()) return csv_fault(name(), line.number, 1, wrong);
  }
  if (cells.has("match") && cells.text("match") == "0") {
    ++skipped_;
    return std::optional<VerifyRow>();
  }
  if (!format_->beside.empty()) {
    const std::string& key = cells.text(format_->key);
    const auto found = beside_.find(key);
    if (found == beside_.end()) {
      return csv_fault(name(), line.number, 1,
                       fmt::format("{} has no {} '{}'", format_->beside, format_->key, shown(key)));
    }
    cells.add(found->second);
  }
  for (const MeasuredColumn& column : format_->columns) {
    const std::string& text = cells.text(column.name);
    if (column.kind == Kind::word || column.kind == Kind::whole || column.kind == Kind::digits ||
        column.kind == Kind::real) {
      if (!text.empty()) row.name += fmt::format("{}{} {}", row.name.empty() ? "" : ", ", column.name, text);
    } else if (is_of_the_picture(column)) {
      row.expected.push_back({.column = std::string(column.name),
                              .stage = {},
                              .allowed = allowed_values(column, text),
                              .tolerance = format_->tolerance != nullptr ? format_->tolerance(cells) : 0});
    }
  }
  return std::optional(std::move(row));
}

Result<std::optional<VerifyRow>> VerifyTable::next() {
  while (true) {
    auto line = lines_.next();
    if (!line) return line.error();
    if (!*line) return std::optional<VerifyRow>();
    if ((*line)->text.starts_with('#')) continue;
    if (format_ != nullptr) {
      auto row = measured_row(**line);
      if (!row || *row) return row;
      continue;
    }
    const std::vector<std::string_view> fields = pieces((*line)->text, ',');
    if (fields.size() != columns_.size()) {
      return csv_fault(name(), (*line)->number, 1,
                       fmt::format("the row has {} fields, the header {}", fields.size(), columns_.size()));
    }
    VerifyRow row;
    row.line = (*line)->number;
    row.registers = default_registers(*profile_);
    bool has_spare0_alpha = false;
    for (std::size_t i = 0; i < fields.size(); ++i) {
      if (Status read = read_cell(columns_[i], fields[i], **line, row); !read) return read.error();
      has_spare0_alpha = has_spare0_alpha || (columns_[i].name == "spare0.a" && !fields[i].empty());
    }
    if (!has_spare0_alpha) row.registers[Register::spare0][kAlpha] = row.registers[Register::texture0][kAlpha];
    if (row.expected.empty()) return csv_fault(name(), (*line)->number, 1, "the row has no expected value");
    if (Status found = find_program(**line, row); !found) return found.error();
    for (const Expectation& expected : row.expected) {
      if (expected.stage.value_or(0) < row.program->num_general_combiners) continue;
      return csv_fault(name(), (*line)->number, 1,
                       fmt::format("{} is out of range; the program has {} general combiners, numbered from 0",
                                   expected.column, row.program->num_general_combiners));
    }
    std::stable_sort(row.expected.begin(), row.expected.end(), [](const Expectation& a, const Expectation& b) {
      return a.stage.value_or(kMaxGeneralCombiners) < b.stage.value_or(kMaxGeneralCombiners);
    });
    return std::optional(std::move(row));
  }
}

}  // namespace ninebit::tools
