#include "src/tools/common/kit_table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "src/tools/input/csv_lines.h"

namespace ninebit::tools {
namespace {

constexpr int kNothing = -1;
constexpr std::string_view kColors = "out.r,out.g,out.b";

// The byte of a grey "53,53,53"; empty: it is none.
std::optional<int> grey_of(std::string_view text) {
  int grey = kNothing;
  for (int i = 0; i < 3; ++i) {
    const std::size_t comma = text.find(',');
    if ((comma == std::string_view::npos) != (i == 2)) return std::nullopt;
    const std::string_view field = trimmed(text.substr(0, comma));
    int value = 0;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size() || value < 0 || value > 255) return std::nullopt;
    if (grey != kNothing && value != grey) return std::nullopt;
    grey = value;
    if (i < 2) text.remove_prefix(comma + 1);
  }
  return grey;
}

Status read_row(const ChipKit& kit, const CsvLine& line, const std::string& file, KitResults& results) {
  for (std::size_t i = 0; i < kit.programs.size(); ++i) {
    const std::string row = kit_row(kit, i);
    if (!line.text.starts_with(row)) continue;
    if (results.shown[i] != kNothing) {
      return csv_fault(file, line.number, 1, fmt::format("program {} has two rows", kit_name(i)));
    }
    const auto grey = grey_of(std::string_view(line.text).substr(row.size()));
    if (!grey) {
      return csv_fault(file, line.number, row.size() + 1,
                       fmt::format("expected three equal numbers from 0 to 255, as the kit's programs show a grey; "
                                   "found '{}'",
                                   shown(std::string_view(line.text).substr(row.size()))));
    }
    results.shown[i] = *grey;
    return {};
  }
  return csv_fault(file, line.number, 1,
                   fmt::format("'{}' is no row of the kit for family {}", shown(line.text), kit.family.name));
}

}  // namespace

void add_family_flag(CLI::App& verb, std::string& family) {
  verb.add_option("--family", family,
                  "Profile whose open fields are decided: geforce2 for GeForce 256, 2 and 4 MX, "
                  "nv2a for GeForce 3, 4 Ti and the Xbox")
      ->capture_default_str()
      ->check(CLI::IsMember({"geforce2", "nv2a"}));
}

const HardwareProfile& profile_of_family(const std::string& family) {
  return family == profiles::nv2a.name ? profiles::nv2a : profiles::geforce2;
}

std::string kit_name(std::size_t program) {
  return fmt::format("k{}", program + 1);
}

std::string kit_header() {
  return fmt::format("name,program,tex0,tex1,primary,unit_off,{}", kColors);
}

std::string kit_row(const ChipKit& kit, std::size_t program) {
  const Discriminator& of = kit.programs[program];
  std::string text = of.rc10;
  std::replace(text.begin(), text.end(), '\n', ' ');
  const auto off = std::find(of.texture_off.begin(), of.texture_off.end(), true);
  return fmt::format("{},{},{},{},", kit_name(program), trimmed(text), fmt::join(of.bytes, ","),
                     off == of.texture_off.end() ? "none" : std::to_string(off - of.texture_off.begin()));
}

Result<KitResults> read_kit_results(InputFile file, const ChipKit& kit) {
  CsvLines lines(std::move(file));
  KitResults results;
  results.shown.assign(kit.programs.size(), kNothing);
  bool has_header = false;
  int last = 1;
  while (true) {
    auto line = lines.next();
    if (!line) return line.error();
    if (!*line) break;
    last = (*line)->number;
    const std::string_view text = (*line)->text;
    if (text.starts_with('#')) {
      results.comments.emplace_back(trimmed(text.substr(1)));
    } else if (has_header) {
      if (Status read = read_row(kit, **line, lines.name(), results); !read) return read.error();
    } else if (text == kit_header()) {
      has_header = true;
    } else {
      return table_fault(lines, csv_fault(lines.name(), last, 1, "expected the header " + kit_header()));
    }
  }
  const auto rows = static_cast<std::size_t>(
      std::count_if(results.shown.begin(), results.shown.end(), [](int shown) { return shown != kNothing; }));
  if (rows == kit.programs.size()) return results;
  const auto missing = std::find(results.shown.begin(), results.shown.end(), kNothing) - results.shown.begin();
  return csv_fault(lines.name(), last, 1,
                   fmt::format("the table ends with {} of {} rows: {} is missing", rows, kit.programs.size(),
                               kit_name(static_cast<std::size_t>(missing))));
}

}  // namespace ninebit::tools
