#include "src/tools/eval/eval_stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "ninebit/combiner/normalize.h"
#include "src/combiner/given_registers.h"

namespace ninebit::tools {
namespace {

constexpr std::string_view kCoordinates = "strq";

// The fields of a line, without blanks around them.
std::vector<std::string_view> fields_of(std::string_view text) {
  std::vector<std::string_view> fields;
  while (true) {
    const std::size_t comma = text.find(',');
    const std::string_view field = trimmed(text.substr(0, comma));
    fields.push_back(field.empty() ? text.substr(0, 0) : field);
    if (comma == std::string_view::npos) return fields;
    text.remove_prefix(comma + 1);
  }
}

// "at1.s" and "texel0.r"; empty: another column.
std::optional<GivenComponent> given_column(std::string_view name) {
  const auto components = given_components(name);
  return components.size() == 1 ? std::optional(components[0]) : std::nullopt;
}

Result<StageColumn> column_called(std::string_view name, const CsvLine& header, const std::string& file,
                                  const HardwareProfile& profile) {
  if (const auto given = given_column(name)) return StageColumn{.given = given};
  for (const EvalColumn& known : eval_columns(profile)) {
    const bool is_constant = known.reg == Register::constant0 || known.reg == Register::constant1;
    if (known.name() != name || is_texture(known.reg) || is_constant) continue;
    return StageColumn{.code = known};
  }
  return csv_fault(
      file, header.number, column_of(header, name),
      fmt::format("unknown column '{}'; expected atN.s, .t, .r or .q, the coordinates of unit N, texelN.r, "
                  ".g, .b or .a, the bytes of its texel, or REGISTER.COMPONENT with a register of fog, "
                  "primary, secondary, spare0, spare1",
                  shown(name)));
}

// The values of a row.
struct Row {
  GivenFragment given{};
  RegisterFile registers{};
};

Status read_field(const StageColumn& column, const CsvLine& line, std::string_view field, const std::string& file,
                  const HardwareProfile& profile, Row& row) {
  const auto fault = [&](const std::string& expected) {
    return csv_fault(file, line.number, column_of(line, field), fmt::format("{}, not '{}'", expected, shown(field)));
  };
  if (column.given && !column.given->is_texel) {
    float value = 0.0F;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size()) {
      return fault(fmt::format("{} must be a number", name_of(*column.given)));
    }
    give(row.given, *column.given, value);
    return {};
  }
  const int least = column.given ? 0 : profile.lowest.value, most = column.given ? 255 : profile.one.value;
  int value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || value < least || value > most) {
    const std::string name = column.given ? name_of(*column.given) : column.code.name();
    return fault(fmt::format("{} must be a whole number from {} to {}", name, least, most));
  }
  if (column.given) {
    give(row.given, *column.given, static_cast<float>(value));
  } else {
    row.registers[column.code.reg][static_cast<std::size_t>(column.code.component)] = static_cast<s9>(value);
  }
  return {};
}

}  // namespace

bool has_stage_columns(std::string_view header) {
  const auto fields = fields_of(header);
  return std::any_of(fields.begin(), fields.end(),
                     [](std::string_view name) { return given_column(name).has_value(); });
}

Result<EvalStages> EvalStages::make(const TextProgram& program, const HardwareProfile& profile, const CsvLine& header,
                                    const std::string& file) {
  EvalStages made;
  made.profile_ = profile;
  made.program_ = normalize(program.state, profile);
  const auto names = fields_of(header.text);
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (std::find(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(i), names[i]) !=
        names.begin() + static_cast<std::ptrdiff_t>(i)) {
      return csv_fault(file, header.number, column_of(header, names[i]), fmt::format("duplicate column {}", names[i]));
    }
    auto column = column_called(names[i], header, file, profile);
    if (!column) return column.error();
    made.columns_.push_back(*column);
  }
  auto stages = compile_for_given(program.texture_shader, profile);
  if (!stages) return stages.error();
  made.stages_ = *std::move(stages);
  made.warnings_ = made.stages_.warnings();
  return made;
}

std::vector<std::string> EvalStages::result_names() {
  std::vector<std::string> names;
  for (const char c : kComponents) names.push_back(std::string("out.") + c);
  for (int unit = 0; unit < kTextureStages; ++unit) {
    for (const char c : kComponents) names.push_back(fmt::format("tex{}.{}", unit, c));
  }
  names.insert(names.end(), {"culled", "depth"});
  for (int unit = 0; unit < kTextureStages; ++unit) {
    for (const char c : kCoordinates.substr(0, 3)) names.push_back(fmt::format("read{}.{}", unit, c));
  }
  return names;
}

Result<std::vector<std::string>> EvalStages::evaluate(const CsvLine& line, const std::string& file) const {
  Row row;
  row.registers = default_registers(profile_);
  const auto fields = fields_of(line.text);
  if (fields.size() != columns_.size()) {
    return csv_fault(file, line.number, 1,
                     fmt::format("the row has {} field{}, the header {}", fields.size(), fields.size() == 1 ? "" : "s",
                                 columns_.size()));
  }
  bool gives_spare0_alpha = false;
  for (std::size_t i = 0; i < columns_.size(); ++i) {
    if (Status read = read_field(columns_[i], line, fields[i], file, profile_, row); !read) return read.error();
    const EvalColumn spare0_alpha{Register::spare0, kAlpha};
    gives_spare0_alpha = gives_spare0_alpha || (!columns_[i].given && columns_[i].code == spare0_alpha);
  }
  const TextureShaderResult result = evaluate_given(stages_, profile_, row.given, gives_spare0_alpha, row.registers);
  const Rgba9 color = ninebit::evaluate(program_, row.registers);

  std::vector<std::string> values;
  for (const s9 code : color) values.push_back(fmt::format("{}", code));
  for (const StageValues& stage : result.stage) {
    for (const s9 code : stage.codes) values.push_back(fmt::format("{}", code));
  }
  values.push_back(result.is_culled ? "1" : "0");
  values.push_back(result.depth ? fmt::format("{}", *result.depth) : "");
  for (const StageValues& stage : result.stage) {
    for (std::size_t k = 0; k < 3; ++k) values.push_back(stage.at ? fmt::format("{}", (*stage.at)[k]) : "");
  }
  return values;
}

}  // namespace ninebit::tools
