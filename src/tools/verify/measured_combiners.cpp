// Measured tables of the combiners' own rules.
#include <array>
#include <optional>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/numerics/fixed9.h"
#include "src/tools/verify/measured_rows.h"

namespace ninebit::tools {
namespace {

using namespace columns_of_tables;

struct OutputOption {
  Scale scale;
  Bias bias;
};
constexpr Words<OutputOption, 6> kOptions{{{"IDENTITY", {Scale::none, Bias::none}},
                                           {"BIAS", {Scale::none, Bias::by_negative_one_half}},
                                           {"SHL1", {Scale::by_two, Bias::none}},
                                           {"SHL1_BIAS", {Scale::by_two, Bias::by_negative_one_half}},
                                           {"SHL2", {Scale::by_four, Bias::none}},
                                           {"SHR1", {Scale::by_one_half, Bias::none}}}};
constexpr Words<PortionName, 2> kPortions{{{"rgb", PortionName::rgb}, {"alpha", PortionName::alpha}}};
constexpr Words<bool, 2> kMuxBits{{{"LSB", true}, {"MSB", false}}};

CombinerInput input(Register reg, ComponentUsage usage = ComponentUsage::rgb) {
  return {reg, InputMapping::unsigned_identity, usage};
}

CombinerInput one(ComponentUsage usage) {
  return {Register::zero, InputMapping::unsigned_invert, usage};
}

// General combiners that write nothing; the output is `d`, with an alpha of 1.0.
CombinerState state_with(const CombinerInput& d) {
  CombinerState state;
  for (GeneralCombiner& stage : state.general) stage.rgb.out.sum = stage.alpha.out.sum = Register::discard;
  const CombinerInput zero = input(Register::zero);
  state.final_combiner = {zero, zero, zero, d, zero, zero, one(ComponentUsage::blue)};
  return state;
}

// The bytes of the output colour.
std::array<int, 4> run(const CombinerState& state, const RegisterFile& registers, const HardwareProfile& profile) {
  const Rgba9 color = evaluate(normalize(state, profile), registers);
  std::array<int, 4> bytes{};
  for (std::size_t k = 0; k < 4; ++k) bytes[k] = to_byte(profile, color[k]);
  return bytes;
}

FragmentInputs with_vertex_color(const MeasuredRow& row, const char* column, const HardwareProfile& profile) {
  const std::uint8_t byte = byte_of_vertex_color(profile, static_cast<float>(row.real(column)));
  FragmentInputs inputs;
  inputs.primary = {byte, byte, byte, 255};
  return inputs;
}

Texel gray(std::uint8_t byte, bool is_signed) {
  return {.value = {byte, byte, byte, byte}, .format = TextureFormat::rgba, .is_signed = is_signed};
}

// A byte through a scale and bias, in one portion.
std::vector<int> run_scale(const MeasuredRow& row, const HardwareProfile& profile) {
  CombinerState state = state_with(input(Register::spare0));
  const auto [scale, bias] = *value_of(kOptions, row.text("op"));
  Portion &rgb = state.general[0].rgb, &alpha = state.general[0].alpha;
  rgb.a = input(Register::constant0);
  rgb.b = one(ComponentUsage::rgb);
  alpha.a = input(Register::constant0, ComponentUsage::blue);
  alpha.b = one(ComponentUsage::alpha);
  for (Portion* portion : {&rgb, &alpha}) {
    portion->out.ab = Register::spare0;
    portion->out.scale = scale;
    portion->out.bias = bias;
  }
  state.final_combiner.g = input(Register::spare0, ComponentUsage::alpha);
  state.constant0.fill(static_cast<float>(row.byte("in")) / 255.0F);
  const bool is_alpha = *value_of(kPortions, row.text("portion")) == PortionName::alpha;
  return {run(state, {}, profile)[is_alpha ? 3 : 0]};
}

// Red as AB or blue as CD.
std::vector<int> run_mux(const MeasuredRow& row, const HardwareProfile& profile) {
  CombinerState state = state_with(input(Register::primary));
  state.num_general_combiners = 2;
  state.mux_by_lowest_bit = *value_of(kMuxBits, row.text("mux_select"));
  Portion &alpha = state.general[0].alpha, &rgb = state.general[1].rgb;
  alpha.a = input(Register::constant0, ComponentUsage::alpha);
  alpha.b = one(ComponentUsage::alpha);
  alpha.out.ab = Register::spare0;
  rgb.a = input(Register::constant0);
  rgb.c = input(Register::constant1);
  rgb.b = rgb.d = one(ComponentUsage::rgb);
  rgb.out.sum = Register::primary;
  rgb.out.mux_sum = true;
  const auto part = [&](const char* color, std::size_t k) { return static_cast<float>(row.list(color)[k]) / 255.0F; };
  state.constant0 = {part("AB", 0), part("AB", 1), part("AB", 2),
                     static_cast<float>(row.byte("spare0_alpha_byte")) / 255.0F};
  state.constant1 = {part("CD", 0), part("CD", 1), part("CD", 2), 0.0F};
  const std::array<int, 4> color = run(state, {}, profile);
  return {color.begin(), color.end()};
}

// A signed texel, as it leaves the final combiner.
std::vector<int> run_signed_texel(const MeasuredRow& row, const HardwareProfile& profile) {
  FragmentInputs inputs;
  inputs.texture[0] = gray(row.byte("texel_byte"), true);
  const auto color = run(state_with(input(Register::texture0)), initial_registers(profile, inputs), profile);
  return {color[0], color[1], color[2]};
}

// A float vertex colour, likewise.
std::vector<int> run_vertex_color(const MeasuredRow& row, const HardwareProfile& profile) {
  const FragmentInputs inputs = with_vertex_color(row, "float", profile);
  return {run(state_with(input(Register::primary)), initial_registers(profile, inputs), profile)[0]};
}

// A float vertex colour times a texel of 255, and of 51, in the final combiner.
std::vector<int> run_product(const MeasuredRow& row, const HardwareProfile& profile) {
  CombinerState state = state_with(input(Register::zero));
  state.final_combiner.a = input(Register::texture0);
  state.final_combiner.b = input(Register::primary);
  FragmentInputs inputs = with_vertex_color(row, "diffuse_float", profile);
  std::vector<int> products;
  for (const char* const texel : {"full", "dim"}) {
    inputs.texture[0] = gray(row.byte(texel), false);
    products.push_back(run(state, initial_registers(profile, inputs), profile)[0]);
  }
  return products;
}

// Three bytes of constants or registers of the quads' programs.
using Triple = std::array<int, 3>;

// The program of a quad in the tables' pictures.
struct QuadProgram {
  CombinerState state;
  Triple constant{}, secondary{};
};

ColorF color_of_bytes(const Triple& bytes) {
  ColorF color{0.0F, 0.0F, 0.0F, 0.0F};
  for (std::size_t k = 0; k < 3; ++k) color[k] = static_cast<float>(bytes[k]) / 255.0F;
  return color;
}

// Both portions of stage 0 write constant 0 to spare0, alpha its blue.
CombinerState constant_to_spare0() {
  CombinerState state = state_with(input(Register::spare0));
  Portion &rgb = state.general[0].rgb, &alpha = state.general[0].alpha;
  rgb.a = input(Register::constant0);
  rgb.b = one(ComponentUsage::rgb);
  alpha.a = input(Register::constant0, ComponentUsage::blue);
  alpha.b = one(ComponentUsage::alpha);
  rgb.out.ab = alpha.out.ab = Register::spare0;
  return state;
}

// 25, 63, 255 by an option of the output.
QuadProgram option_quad(OutputOption option, bool own_alpha) {
  QuadProgram quad{.state = constant_to_spare0(), .constant = {25, 63, 255}};
  for (Portion* portion : {&quad.state.general[0].rgb, &quad.state.general[0].alpha}) {
    portion->out.scale = option.scale;
    portion->out.bias = option.bias;
  }
  if (own_alpha) quad.state.final_combiner.g = input(Register::spare0, ComponentUsage::alpha);
  return quad;
}

// The row's colour, its blue as alpha.
QuadProgram blue_quad(const MeasuredRow& row, bool is_cd, bool own_alpha) {
  QuadProgram quad{.state = constant_to_spare0()};
  Portion &rgb = quad.state.general[0].rgb, &alpha = quad.state.general[0].alpha;
  alpha = state_with(input(Register::zero)).general[0].alpha;
  if (is_cd) {
    rgb.c = rgb.a;
    rgb.d = rgb.b;
    rgb.out.ab = Register::discard;
    rgb.out.cd = Register::spare0;
  }
  (is_cd ? rgb.out.cd_blue_to_alpha : rgb.out.ab_blue_to_alpha) = true;
  const char* const columns[] = {"r", "g", "b"};
  for (std::size_t k = 0; k < 3; ++k) quad.constant[k] = number_of(row.text(columns[k])).value_or(0);
  if (own_alpha) quad.state.final_combiner.g = input(Register::spare0, ComponentUsage::alpha);
  return quad;
}

// The colour sum of R0, the constant, and V1.
QuadProgram sum_quad(const Triple& r0, const Triple& v1, bool inverts_r0 = false, bool inverts_v1 = false) {
  QuadProgram quad{.state = constant_to_spare0(), .constant = r0, .secondary = v1};
  quad.state.final_combiner.d = input(Register::spare0_plus_secondary);
  quad.state.color_sum_invert_spare0 = inverts_r0;
  quad.state.color_sum_invert_secondary = inverts_v1;
  return quad;
}

// 127 times the colour sum of 255 and 255.
QuadProgram doubled_quad(bool clamps) {
  QuadProgram quad = sum_quad({255, 255, 255}, {255, 255, 255});
  FinalCombiner& last = quad.state.final_combiner;
  last.a = input(Register::constant1);
  last.b = last.d;
  last.d = input(Register::zero);
  quad.state.constant1 = color_of_bytes({127, 127, 127});
  quad.state.color_sum_clamp = clamps;
  return quad;
}

// E·F of the constant and 127.
QuadProgram product_quad() {
  QuadProgram quad{.state = constant_to_spare0(), .constant = {255, 191, 127}};
  FinalCombiner& last = quad.state.final_combiner;
  last.d = input(Register::e_times_f);
  last.e = input(Register::spare0);
  last.f = input(Register::constant1);
  quad.state.constant1 = color_of_bytes({127, 127, 127});
  return quad;
}

constexpr Words<OutputOption, 6> kQuadOptions{{{"identity", {Scale::none, Bias::none}},
                                               {"bias", {Scale::none, Bias::by_negative_one_half}},
                                               {"shl1", {Scale::by_two, Bias::none}},
                                               {"shl1_bias", {Scale::by_two, Bias::by_negative_one_half}},
                                               {"shl2", {Scale::by_four, Bias::none}},
                                               {"shr1", {Scale::by_one_half, Bias::none}}}};

// Empty: the row's operation is not known.
std::optional<QuadProgram> quad_of(const MeasuredRow& row) {
  const std::string &picture = row.text("picture"), &operation = row.text("operation");
  const bool own_alpha = !row.text("computes").ends_with("alpha one");
  if (picture == "CombinerOps") {
    const auto option = value_of(kQuadOptions, operation);
    return option ? std::optional(option_quad(*option, own_alpha)) : std::nullopt;
  }
  if (operation.starts_with("blue to alpha ")) return blue_quad(row, operation.ends_with("CD"), own_alpha);
  constexpr Triple kR0{63, 127, 191}, kV1{178, 127, 38}, kGrey{191, 191, 191};
  if (operation == "EF_PROD") return product_quad();
  if (operation == "SPEC_R0_SUM") return picture == "Flags" ? sum_quad(kGrey, {}) : sum_quad(kR0, kV1);
  if (operation == "SPEC_R0_SUM inv R0") return sum_quad(kR0, kV1, true);
  if (operation == "SPEC_R0_SUM inv V1") return sum_quad(kR0, kV1, false, true);
  if (operation == "SPEC_R0_SUM inverted") return sum_quad(kGrey, {}, true);
  if (operation == "SPEC_R0_SUM unclamped") return doubled_quad(false);
  if (operation == "SPEC_R0_SUM clamped") return doubled_quad(true);
  return std::nullopt;
}

std::string wrong_scale(const MeasuredRow& row, const HardwareProfile&) {
  const std::string wrong = wrong_word(row, "op", kOptions);
  return wrong.empty() ? wrong_word(row, "portion", kPortions) : wrong;
}

std::string wrong_mux(const MeasuredRow& row, const HardwareProfile& profile) {
  const std::string wrong = wrong_word(row, "mux_select", kMuxBits);
  if (!wrong.empty() || profile.mux_by_lowest_bit || !*value_of(kMuxBits, row.text("mux_select"))) return wrong;
  return fmt::format("profile {} has no mux by the lowest bit of spare0's alpha (NV2A)", profile.name);
}

constexpr StatedValue kMuxAb{"AB", "AB=C0=", StatedValue::Kind::list, 0, 255, "(255,0,0)", 3},
    kMuxCd{"CD", "CD=C1=", StatedValue::Kind::list, 0, 255, "(0,0,255)", 3},
    kFullTexel{"full", "full = texel ", StatedValue::Kind::real, 0, 255, "255"},
    kDimTexel{"dim", "dim = texel ", StatedValue::Kind::real, 0, 255, "51"};

}  // namespace

CombinerState quad_state(Register reg, bool own_alpha) {
  CombinerState state = state_with(input(reg));
  if (own_alpha) state.final_combiner.g = input(reg, ComponentUsage::alpha);
  return state;
}

std::vector<int> run_quad(const MeasuredRow& row, const HardwareProfile& profile) {
  QuadProgram quad = *quad_of(row);
  quad.state.constant0 = color_of_bytes(quad.constant);
  FragmentInputs inputs;
  for (std::size_t k = 0; k < 3; ++k) inputs.secondary[k] = static_cast<std::uint8_t>(quad.secondary[k]);
  const std::array<int, 4> color = run(quad.state, initial_registers(profile, inputs), profile);
  return {color.begin(), color.end()};
}

std::string wrong_quad(const MeasuredRow& row, const HardwareProfile& profile) {
  const auto quad = quad_of(row);
  if (!quad)
    return fmt::format("the operation '{}' of {} is not known", shown(row.text("operation")),
                       shown(row.text("picture")));
  const auto refused = validate(quad->state, profile);
  return refused.empty() ? "" : fmt::format("profile {}: {}", profile.name, refused[0].message);
}

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

}  // namespace ninebit::tools
