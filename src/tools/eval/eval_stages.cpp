#include "src/tools/eval/eval_stages.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>

#include "ninebit/combiner/normalize.h"
#include "src/combiner/given_registers.h"

namespace ninebit::tools {
namespace {

constexpr std::string_view kCoordinates = "strq";

std::size_t column_of(const CsvLine& line, std::string_view field) {
  return static_cast<std::size_t>(field.data() - line.text.data()) + 1;
}

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
std::optional<StageColumn> stage_column(std::string_view name) {
  for (const auto& [word, components, kind] :
       {std::tuple{std::string_view("at"), kCoordinates, StageColumn::Kind::coordinate},
        {std::string_view("texel"), kComponents, StageColumn::Kind::texel}}) {
    if (!name.starts_with(word) || name.size() != word.size() + 3 || name[word.size() + 1] != '.') continue;
    const char unit = name[word.size()];
    const std::size_t component = components.find(name.back());
    if (unit < '0' || unit >= '0' + kTextureStages || component == std::string_view::npos) continue;
    return StageColumn{.kind = kind, .unit = static_cast<std::size_t>(unit - '0'), .component = component};
  }
  return std::nullopt;
}

Result<StageColumn> column_called(std::string_view name, const CsvLine& header, const std::string& file,
                                  const HardwareProfile& profile) {
  if (const auto column = stage_column(name)) return *column;
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

StageTextures textures_of(const TextureShaderState& state) {
  StageTextures textures;
  for (std::size_t i = 0; i < textures.size(); ++i) {
    const StageTarget target = info_of(state.stage[i].operation).target;
    if (target != StageTarget::none) textures[i] = StageTexture{.target = target};
  }
  for (const TextureStage& stage : state.stage) {
    const StageInput input = info_of(stage.operation).input;
    auto& read = textures[static_cast<std::size_t>(stage.previous)];
    if ((input == StageInput::offset || input == StageInput::luminance) && read) read->format = TextureFormat::dsdt_mag;
  }
  return textures;
}

// The values of a row.
struct Row {
  StageInputs inputs{};
  std::array<Bytes4, kTextureStages> texel{};
  RegisterFile registers{};
};

Status read_field(const StageColumn& column, const CsvLine& line, std::string_view field, const std::string& file,
                  const HardwareProfile& profile, Row& row) {
  const auto fault = [&](const std::string& expected) {
    return csv_fault(file, line.number, column_of(line, field), fmt::format("{}, not '{}'", expected, shown(field)));
  };
  if (column.kind == StageColumn::Kind::coordinate) {
    float value = 0.0F;
    const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
    if (error != std::errc{} || end != field.data() + field.size()) {
      return fault(fmt::format("at{}.{} must be a number", column.unit, kCoordinates[column.component]));
    }
    row.inputs.at[column.unit][column.component] = value;
    return {};
  }
  const bool is_texel = column.kind == StageColumn::Kind::texel;
  const int least = is_texel ? 0 : profile.lowest.value, most = is_texel ? 255 : profile.one.value;
  int value = 0;
  const auto [end, error] = std::from_chars(field.data(), field.data() + field.size(), value);
  if (error != std::errc{} || end != field.data() + field.size() || value < least || value > most) {
    const std::string name =
        is_texel ? fmt::format("texel{}.{}", column.unit, kComponents[column.component]) : column.code.name();
    return fault(fmt::format("{} must be a whole number from {} to {}", name, least, most));
  }
  if (is_texel) {
    row.texel[column.unit][column.component] = static_cast<std::uint8_t>(value);
  } else {
    row.registers[column.code.reg][static_cast<std::size_t>(column.code.component)] = static_cast<s9>(value);
  }
  return {};
}

}  // namespace

bool has_stage_columns(std::string_view header) {
  const auto fields = fields_of(header);
  return std::any_of(fields.begin(), fields.end(),
                     [](std::string_view name) { return stage_column(name).has_value(); });
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
  auto stages = compile(program.texture_shader, textures_of(program.texture_shader), profile);
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
  for (auto& unit : row.inputs.at) unit[3] = 1.0F;
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
    gives_spare0_alpha =
        gives_spare0_alpha || (columns_[i].kind == StageColumn::Kind::code && columns_[i].code == spare0_alpha);
  }
  row.inputs.right = row.inputs.above = row.inputs.at;
  const TextureShaderResult result =
      ninebit::evaluate(stages_, profile_, row.inputs,
                        [&](int unit, const TexturePlace&) { return row.texel[static_cast<std::size_t>(unit)]; });
  for (std::size_t unit = 0; unit < kTextureStages; ++unit) {
    row.registers[static_cast<Register>(static_cast<std::size_t>(Register::texture0) + unit)] =
        result.stage[unit].codes;
  }
  if (!gives_spare0_alpha) row.registers[Register::spare0][kAlpha] = row.registers[Register::texture0][kAlpha];
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
