#include "src/tools/verify/measured_table.h"

#include <fmt/format.h>

#include <array>
#include <charconv>

#include "src/tools/verify/measured_combiners.h"
#include "src/tools/verify/measured_rows.h"

namespace ninebit::tools {
namespace {

using Column = MeasuredColumn;
using Kind = MeasuredColumn::Kind;

template <class T>
bool reads(std::string_view text, T& value, int base = 10) {
  if constexpr (std::is_floating_point_v<T>) {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    return error == std::errc{} && end == text.data() + text.size();
  } else {
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value, base);
    return error == std::errc{} && end == text.data() + text.size();
  }
}

Column whole(std::string_view name, std::int64_t low, std::int64_t high) {
  return {name, Kind::whole, low, high};
}
Column byte(std::string_view name) {
  return whole(name, 0, 255);
}

// Columns of one kind, from their part of the header.
void add(std::vector<Column>& to, std::string_view names, Column like) {
  for (const std::string_view name : pieces(names, ',')) {
    like.name = name;
    to.push_back(like);
  }
}
std::vector<Column> columns(std::initializer_list<std::pair<std::string_view, Column>> groups) {
  std::vector<Column> all;
  for (const auto& [names, like] : groups) add(all, names, like);
  return all;
}

// Their pictures: abaire/nxdk_pgraph_tests_golden_results.
std::vector<MeasuredFormat> make_formats() {
  const Column note{}, word{{}, Kind::word}, digits{{}, Kind::digits}, real{{}, Kind::real},
      measured{{}, Kind::measured}, match{{}, Kind::match},
      any_byte = byte({}), cut = whole({}, 0, 3), weight = whole({}, 0, 255), next_level{{}, Kind::whole, 0, 255, true},
      depth = whole({}, 0, (1 << 24) - 1);
  return {
      {"alpha test",
       columns({{"func", word},
                {"ref,alpha_byte", any_byte},
                {"hw_drawn", measured},
                {"pixels,model_drawn", note},
                {"match", match}}),
       draw_alpha_test, wrong_alpha_test},
      {"blending",
       columns({{"equation,sfactor,dfactor", word},
                {"s,d", digits},
                {"bR,bG,bB,bA", note},
                {"hw_R,hw_G,hw_B,hw_A", measured},
                {"model_R,model_G,model_B,model_A", note},
                {"match", match}}),
       draw_blend, wrong_blend},
      {"DXT1",
       columns({{"c0,c1", digits},
                {"index,x_and_3,y_and_3", cut},
                {"hw_R,hw_G,hw_B,hw_A", measured},
                {"model_R,model_G,model_B", note},
                {"match", match}}),
       draw_dxt1},
      {"DXT3",
       columns({{"c0,c1", digits},
                {"index", cut},
                {"alpha4", whole({}, 0, 15)},
                {"hw_R,hw_G,hw_B,hw_A", measured},
                {"texel_R,texel_G,texel_B,texel_A,model_R,model_G,model_B,model_A", note},
                {"match", match}}),
       draw_dxt3},
      {"DXT5",
       columns({{"c0,c1", digits},
                {"index", cut},
                {"alpha0,alpha1", any_byte},
                {"alpha_index", whole({}, 0, 7)},
                {"hw_R,hw_G,hw_B,hw_A", measured},
                {"texel_R,texel_G,texel_B,texel_A,model_R,model_G,model_B,model_A", note},
                {"match", match}}),
       draw_dxt5},
      {"linear filters",
       columns({{"bias,level", note},
                {"fu,fv", weight},
                {"A,B,C,D", any_byte},
                {"f", weight},
                {"fu2,fv2,A2,B2,C2,D2", next_level},
                {"hw", measured},
                {"model", note},
                {"match", match}}),
       draw_filter},
      {"weights of linear filters",
       columns({{"row", note},
                {"place", real},
                {"w,lum", note},
                {"hw_R(values seen)", measured},
                {"model_out", note},
                {"match", match},
                {"model_out_if_nearest,match_if_nearest", note}}),
       draw_weight},
      {"depth comparison",
       columns({{"picture", note},
                {"mode", word},
                {"bits", whole({}, 16, 24)},
                {"r", depth},
                {"func", word},
                {"t", depth},
                {"hw", measured},
                {"model", note},
                {"match", match}}),
       draw_shadow, wrong_shadow},
  };
}

// Of triangles, lines and points.
std::vector<MeasuredFormat> make_primitive_formats() {
  const Column note{}, word{{}, Kind::word}, digits{{}, Kind::digits}, real{{}, Kind::real},
      measured{{}, Kind::measured}, match{{}, Kind::match},
      position = whole({}, -100'000, 100'000), pixel = whole({}, 0, 4095), depth = whole({}, 0, (1 << 24) - 1);
  return {
      {"smooth colours",
       columns({{"triangle", word},
                {"x,y", pixel},
                {"hw_R,hw_G,hw_B", measured},
                {"model_R,model_G,model_B", note},
                {"match", match}}),
       draw_smooth, nullptr, "nv2a_gouraud_triangles.csv", "triangle",
       columns({{"triangle", word},
                {"picture,vertices", note},
                {"x0,y0,x1,y1,x2,y2", position},
                {"w0,w1,w2", real},
                {"c0,c1,c2", digits},
                {"pixels,wrong,uncovered", note}})},
      {"depth codes",
       columns({{"bits", whole({}, 16, 24)},
                {"x0,x1", pixel},
                {"z_left,z_right", depth},
                {"x", pixel},
                {"exact", note},
                {"hw", measured},
                {"model_floor", note},
                {"match", match},
                {"match_if_nearest", note}}),
       draw_depth, wrong_depth},
      {"lines",
       columns({{"picture", note},
                {"width", real},
                {"object", word},
                {"y", pixel},
                {"hw_runs", {{}, Kind::runs}},
                {"model_runs", note},
                {"match", match}}),
       draw_lines, wrong_lines},
      {"colours of lines",
       columns({{"Px,Py,Qx,Qy", position},
                {"c0,c1", digits},
                {"x,y", pixel},
                {"hw_R,hw_G,hw_B", measured},
                {"model_R,model_G,model_B", note},
                {"match", match}}),
       draw_line_color},
      {"points",
       columns({{"picture", note},
                {"size_eighths", whole({}, 0, 512)},
                {"hw_first,hw_last", {{}, Kind::extent}},
                {"model_first,model_last", note},
                {"match", match}}),
       draw_point},
  };
}

// Of the combiners' own rules.
std::vector<MeasuredFormat> make_combiner_formats() {
  const Column note{}, word{{}, Kind::word}, real{{}, Kind::real}, measured{{}, Kind::measured}, match{{}, Kind::match},
      any_byte = byte({});
  return {
      {"scale and bias",
       columns({{"op", word},
                {"op_code_bits15_17", note},
                {"portion", word},
                {"channel", note},
                {"in", any_byte},
                {"hw_out", measured},
                {"model_out", note},
                {"match", match},
                {"how", note}}),
       run_scale, wrong_scale},
      {"mux",
       columns({{"mux_select", word},
                {"spare0_alpha_byte", any_byte},
                {"R,G,B,A", measured},
                {"hw_selected,model_selected", note},
                {"match", match}}),
       run_mux, wrong_mux},
      {"signed texels",
       columns({{"texel_byte", any_byte},
                {"as_int8", note},
                {"hw_R,hw_G,hw_B", measured},
                {"model", note},
                {"match", match}}),
       run_signed_texel},
      {"vertex colours", columns({{"float", real}, {"model", note}, {"hw", measured}, {"match", match}}),
       run_vertex_color},
      {"A·B of the final combiner",
       columns({{"col,row,ch", note},
                {"diffuse_float", real},
                {"f2b_model", note},
                {"hw_full,hw_dim", measured},
                {"model_dim,f2b_match,dim_match", note}}),
       run_product},
  };
}

std::string header_of(const std::vector<Column>& all) {
  std::string header;
  for (const Column& column : all) header += (header.empty() ? "" : ",") + std::string(column.name);
  return header;
}

// What a field should have been; empty: it is right.
std::string read_cell(const Column& column, std::string_view field, MeasuredRow::Cell& cell) {
  cell.text = field;
  if (column.kind == Kind::note || column.kind == Kind::word) return "";
  const bool is_extent = column.kind == Kind::extent;
  if (field.empty() && (column.kind == Kind::measured || is_extent || column.may_be_empty)) return "";
  if (column.kind == Kind::real) {
    const std::string_view number = field.ends_with(')') ? trimmed(field.substr(0, field.find('('))) : field;
    return reads(number, cell.real) ? "" : "a number";
  }
  if (column.kind == Kind::digits) {
    if (field.starts_with("0x")) field.remove_prefix(2);
    return field.size() <= 8 && reads(field, cell.whole, 16) ? "" : "up to eight hexadecimal digits";
  }
  if (column.kind == Kind::match) return field == "0" || field == "1" ? "" : "0 or 1";
  if (column.kind == Kind::measured) {
    int value = 0;
    for (const std::string_view piece : pieces(field, '|')) {
      if (!reads(piece, value)) return "whole numbers of 32 bits separated by |, or empty";
    }
    return "";
  }
  if (column.kind == Kind::runs) return pixel_runs(field) ? "" : "runs of pixels, such as 3-5 7-7, or empty";
  if (is_extent) return reads(field, cell.whole) ? "" : "a whole number, or empty";
  if (reads(field, cell.whole) && cell.whole >= column.low && cell.whole <= column.high) return "";
  return fmt::format("a whole number from {} to {}", column.low, column.high);
}

}  // namespace

std::vector<std::string_view> pieces(std::string_view text, char separator) {
  std::vector<std::string_view> found;
  while (true) {
    const std::size_t end = text.find(separator);
    found.push_back(trimmed(text.substr(0, end)));
    if (end == std::string_view::npos) return found;
    text.remove_prefix(end + 1);
  }
}

std::optional<std::vector<PixelRun>> pixel_runs(std::string_view text) {
  std::vector<PixelRun> runs;
  if (text.empty()) return runs;
  for (const std::string_view piece : pieces(text, ' ')) {
    PixelRun run;
    const std::size_t dash = piece.find('-');
    if (dash == std::string_view::npos) return std::nullopt;
    if (!reads(piece.substr(0, dash), run.first) || !reads(piece.substr(dash + 1), run.last)) return std::nullopt;
    runs.push_back(run);
  }
  return runs;
}

bool is_of_the_picture(const MeasuredColumn& column) {
  return column.kind == Kind::measured || column.kind == Kind::extent || column.kind == Kind::runs;
}

std::vector<int> allowed_values(const MeasuredColumn& column, const std::string& text) {
  if (column.kind == Kind::runs) return {0};
  if (column.kind == Kind::extent && text.empty()) return {kNothingDrawn};
  std::vector<int> allowed;
  for (const std::string_view piece : pieces(text, '|')) {
    int value = 0;
    if (reads(piece, value)) allowed.push_back(value);
  }
  return allowed;
}

const MeasuredFormat* measured_format(std::string_view header) {
  static const std::array formats{make_formats(), make_primitive_formats(), make_combiner_formats()};
  for (const std::vector<MeasuredFormat>& of_kind : formats) {
    for (const MeasuredFormat& format : of_kind) {
      if (header_of(format.columns) == header) return &format;
    }
  }
  return nullptr;
}

Status read_measured(const std::vector<MeasuredColumn>& columns, const std::vector<std::string_view>& fields,
                     const std::string& file, int line, MeasuredRow& row) {
  if (fields.size() != columns.size()) {
    return csv_fault(file, line, 1, fmt::format("the row has {} fields, the header {}", fields.size(), columns.size()));
  }
  for (std::size_t i = 0; i < fields.size(); ++i) {
    MeasuredRow::Cell cell;
    const std::string expected = read_cell(columns[i], fields[i], cell);
    if (!expected.empty()) {
      return csv_fault(file, line, static_cast<std::size_t>(fields[i].data() - fields[0].data()) + 1,
                       fmt::format("{} must be {}, not '{}'", columns[i].name, expected, shown(fields[i])));
    }
    row.set(columns[i].name, std::move(cell));
  }
  return {};
}

Result<std::map<std::string, MeasuredRow>> read_beside(const std::string& file, const MeasuredFormat& format) {
  auto input = InputFile::open(file);
  if (!input) return input.error();
  CsvLines lines(std::move(*input));
  const std::string header = header_of(format.columns_beside);
  std::map<std::string, MeasuredRow> rows;
  for (bool is_header = true;;) {
    auto line = lines.next();
    if (!line) return line.error();
    if (!*line) return rows;
    const std::string_view text = (*line)->text;
    if (text.starts_with('#')) continue;
    if (is_header) {
      if (text != header) return csv_fault(file, (*line)->number, 1, "expected the header " + header);
      is_header = false;
      continue;
    }
    MeasuredRow row;
    if (Status read = read_measured(format.columns_beside, pieces(text, ','), file, (*line)->number, row); !read) {
      return read.error();
    }
    std::string key = row.text(format.key);
    rows.insert_or_assign(std::move(key), std::move(row));
  }
}

}  // namespace ninebit::tools
