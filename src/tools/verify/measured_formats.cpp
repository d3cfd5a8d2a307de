// The tables that `ninebit verify` knows, and what computes each.
#include <array>

#include "src/tools/verify/measured_combiners.h"
#include "src/tools/verify/measured_rows.h"
#include "src/tools/verify/measured_table.h"

namespace ninebit::tools {
namespace {

using Column = MeasuredColumn;
using Kind = MeasuredColumn::Kind;

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

}  // namespace

std::string header_of(const std::vector<MeasuredColumn>& all) {
  std::string header;
  for (const MeasuredColumn& column : all) header += (header.empty() ? "" : ",") + std::string(column.name);
  return header;
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

}  // namespace ninebit::tools
