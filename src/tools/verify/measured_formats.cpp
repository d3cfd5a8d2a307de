// The tables that `ninebit verify` knows, and what computes each.
#include <algorithm>

#include "src/tools/verify/measured_columns.h"
#include "src/tools/verify/measured_combiners.h"
#include "src/tools/verify/measured_pixels.h"
#include "src/tools/verify/measured_rows.h"
#include "src/tools/verify/measured_stages.h"
#include "src/tools/verify/measured_surfaces.h"
#include "src/tools/verify/measured_table.h"

namespace ninebit::tools {
namespace {

using namespace columns_of_tables;

// The background that a picture was blended over, and the alpha. Its colours, as the tables' comments give them.
constexpr StatedValue kUnderBlend{"under", "over ", StatedValue::Kind::list, 0, 255, "(32,32,32,255)", 4},
    kBlendConstant{"constant", "blend constant ", StatedValue::Kind::digits, 0, 0xFFFFFFFFP0, "55555555"},
    kUnderTexel{"under", "texel + (255-A)*", StatedValue::Kind::real, 0, 255, "16"},
    kAlphaUnderTexel{"alpha_under", "A*A + (255-A)*", StatedValue::Kind::real, 0, 255, "254"},
    kBlendAlpha{"alpha", "alpha ", StatedValue::Kind::real, 0, 255, "127"},
    kUnder{"under", "blended over ", StatedValue::Kind::real, 0, 255, "32"};
// Lines: their width in pixels, and corners in window coordinates, y growing downwards.
constexpr StatedValue kLineWidth{"width", "Line_", StatedValue::Kind::real, 0, 64, "16"},
    kQuadCorners{"quad",
                 "quad = PRIMITIVE_QUADS in polygon mode LINE, corners ",
                 StatedValue::Kind::list,
                 0,
                 4095,
                 "(160,398) (220,388) (218.5,473.375) (172.75,455.5)",
                 8,
                 true},
    kLoopCorners{
        "loop", "loop = LINE_LOOP through ", StatedValue::Kind::list, 0, 4095, "(356,95) (354,67) (342,145)", 0, true};
constexpr StatedValue kCube0{
    "rows of cube 0", "rows of cube 0: ", StatedValue::Kind::rows, -1e30, 1e30, "1 0 1; -1 -1 1; 0 0 0", 9},
    kCube1{"rows of cube 1", "rows of cube 1: ", StatedValue::Kind::rows, -1e30, 1e30, "1 0 1; 1 1 -1; 0 0 0", 9};
constexpr StatedValue kMuxAb{"AB", "AB=C0=", StatedValue::Kind::list, 0, 255, "(255,0,0)", 3},
    kMuxCd{"CD", "CD=C1=", StatedValue::Kind::list, 0, 255, "(0,0,255)", 3},
    kFullTexel{"full", "full = texel ", StatedValue::Kind::real, 0, 255, "255"},
    kDimTexel{"dim", "dim = texel ", StatedValue::Kind::real, 0, 255, "51"};

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
       draw_blend,
       wrong_blend,
       {kBlendConstant, kUnderBlend}},
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
       draw_dxt3,
       nullptr,
       {kUnderTexel, kAlphaUnderTexel}},
      {"DXT5",
       columns({{"c0,c1", digits},
                {"index", cut},
                {"alpha0,alpha1", any_byte},
                {"alpha_index", whole({}, 0, 7)},
                {"hw_R,hw_G,hw_B,hw_A", measured},
                {"texel_R,texel_G,texel_B,texel_A,model_R,model_G,model_B,model_A", note},
                {"match", match}}),
       draw_dxt5,
       nullptr,
       {kUnderTexel, kAlphaUnderTexel}},
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
       draw_weight,
       nullptr,
       {kBlendAlpha, kUnder}},
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

// Tables of triangles, lines and points.
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
       draw_smooth,
       nullptr,
       {},
       "nv2a_gouraud_triangles.csv",
       "triangle",
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
       draw_lines,
       wrong_lines,
       {kQuadCorners, kLoopCorners}},
      {"colours of lines",
       columns({{"Px,Py,Qx,Qy", position},
                {"c0,c1", digits},
                {"x,y", pixel},
                {"hw_R,hw_G,hw_B", measured},
                {"model_R,model_G,model_B", note},
                {"match", match}}),
       draw_line_color,
       wrong_line_color,
       {kLineWidth}},
      {"points",
       columns({{"picture", note},
                {"size_eighths", whole({}, 0, 512)},
                {"hw_first,hw_last", {{}, Kind::extent}},
                {"model_first,model_last", note},
                {"match", match}}),
       draw_point},
  };
}

// Tables of the combiners' own rules.
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
       run_mux,
       wrong_mux,
       {kMuxAb, kMuxCd}},
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
       run_product,
       nullptr,
       {kFullTexel, kDimTexel}},
  };
}

// Tables of texture-shader stages and of texel formats.
std::vector<MeasuredFormat> make_stage_formats() {
  const Column note{}, word{{}, Kind::word}, digits{{}, Kind::digits}, real{{}, Kind::real},
      measured{{}, Kind::measured}, any_byte = byte({}), flag = whole({}, 0, 1), pixel = whole({}, 0, 167),
                                    code = whole({}, 0, 65535), cube = whole({}, 0, 1);
  return {
      {"pass through",
       columns({{"s,t,r,q", real}, {"pic_r,pic_g,pic_b,pic_a", measured}, {"model_r,model_g,model_b,model_a", note}}),
       run_pass_through,
       wrong_stages,
       {kUnderBlend}},
      {"offset textures",
       columns({{"picture", note},
                {"Bs,Gs", flag},
                {"i,j", pixel},
                {"b_first,g_first,b_last,g_last", any_byte},
                {"b,g", note},
                {"m00,m01,m11,m10", real},
                {"class", measured}}),
       run_offset, wrong_stages},
      {"luminance of offset textures", columns({{"scale,offset", real}, {"L,T", any_byte}, {"out", measured}}),
       run_luminance, wrong_stages},
      {"dot products of cube maps",
       columns({{"mode,mapping,eye", word},
                {"cube", cube},
                {"R,G,B,A", any_byte},
                {"face,tx,ty", note},
                {"pic_r,pic_g,pic_b", measured},
                {"tex", word}}),
       run_dot_cube,
       wrong_dot_cube,
       {kCube0, kCube1},
       {},
       {},
       {},
       "nv2a_cube_radial.csv"},
      {"dot products of 16 bits",
       columns({{"picture", note},
                {"As,Gs", flag},
                {"i,j", pixel},
                {"hi0,lo0,hi1,lo1,hi2,lo2,hi3,lo3", code},
                {"H,L", note},
                {"class", measured}}),
       run_hilo_dots, wrong_stages},
      {"replaced depths",
       columns({{"x,y", note}, {"R,G,B", any_byte}, {"a0,a1,a2,b0,b1,b2", real}, {"depth", measured}, {"model", note}}),
       run_depth_replace, wrong_stages},
      {"cube maps", columns({{"s,t,r", real}, {"face,tx,ty", note}, {"pic_r,pic_g,pic_b", measured}}), run_cube_map,
       wrong_stages},
      {"culled fragments",
       columns({{"modes", word}, {"s0,t0,r0,q0,s1,t1,r1,q1,s2,t2,r2,q2", real}, {"visible", measured}}), run_cull,
       wrong_cull},
      {"YUV", columns({{"Y,U,V", any_byte}, {"R,G,B", measured}}), run_yuv, wrong_stages},
      {"texel formats",
       columns({{"format", word}, {"word", digits}, {"pic_r,pic_g,pic_b,pic_a", measured}}),
       run_texel_word,
       wrong_texel_word,
       {kUnderBlend}},
  };
}

// Tables of surfaces, and of what decides which pixels and samples are drawn.
std::vector<MeasuredFormat> make_surface_formats() {
  const Column word{{}, Kind::word}, real{{}, Kind::real}, measured{{}, Kind::measured},
      any_byte = byte({}), flag = whole({}, 0, 1), pixel = whole({}, 0, 4095);
  return {
      {"blending into surfaces",
       columns({{"surface,dst_factor", word},
                {"n", whole({}, 1, 4)},
                {"r1,g1,b1,a1,r2,g2,b2,a2,r3,g3,b3,a3,r4,g4,b4,a4", any_byte},
                {"pic_r,pic_g,pic_b", measured}}),
       blend_into_surface, wrong_surface_blend},
      {"colours in memory",
       columns({{"surface", word}, {"blend", flag}, {"r,g,b,a", any_byte}, {"word_hex", {{}, Kind::word_hex}}}),
       store_in_surface, wrong_surface_store},
      {"polygon stipple", columns({{"pattern", word}, {"x,y", pixel}, {"drawn", measured}}), draw_stippled,
       wrong_stipple},
      {"point sprites",
       columns({{"test", flag}, {"x,y", pixel}, {"r,g,b,a", any_byte}, {"pic_r,pic_g,pic_b,pic_a", measured}}),
       draw_sprite, wrong_sprite},
      {"smoothed triangles", columns({{"x0,y0,x1,y1,x2,y2", real}, {"x,y", pixel}, {"alpha", measured}}), draw_smoothed,
       wrong_smoothed},
      {"samples of rows", columns({{"mode", word}, {"sample", flag}, {"y", pixel}, {"first,last", measured}}),
       draw_samples, wrong_samples},
      {"samples of a square", columns({{"column,row", pixel}, {"covered", measured}}), draw_square, wrong_square},
  };
}

}  // namespace

std::string header_of(const std::vector<MeasuredColumn>& all) {
  std::string header;
  for (const MeasuredColumn& column : all) header += (header.empty() ? "" : ",") + std::string(column.name);
  return header;
}

namespace {

const std::vector<MeasuredFormat>& formats() {
  static const std::vector<MeasuredFormat> all = [] {
    std::vector<MeasuredFormat> joined = make_formats();
    for (const auto& more : {make_primitive_formats(), make_combiner_formats(), make_stage_formats(),
                             make_surface_formats(), make_pixel_formats()}) {
      joined.insert(joined.end(), more.begin(), more.end());
    }
    return joined;
  }();
  return all;
}

}  // namespace

std::string measured_places() {
  std::string places;
  for (const MeasuredFormat& format : formats()) places += (places.empty() ? "" : ", ") + std::string(format.place);
  return places;
}

const MeasuredFormat* measured_format(std::string_view header) {
  const auto found = std::find_if(formats().begin(), formats().end(),
                                  [&](const MeasuredFormat& format) { return header_of(format.columns) == header; });
  return found == formats().end() ? nullptr : &*found;
}

}  // namespace ninebit::tools
