#include "src/tools/verify/measured_combiners.h"

#include <array>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/fixed9.h"
#include "src/tools/verify/measured_rows.h"

namespace ninebit::tools {
namespace {

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

}  // namespace

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

std::vector<int> run_signed_texel(const MeasuredRow& row, const HardwareProfile& profile) {
  FragmentInputs inputs;
  inputs.texture[0] = gray(row.byte("texel_byte"), true);
  const auto color = run(state_with(input(Register::texture0)), initial_registers(profile, inputs), profile);
  return {color[0], color[1], color[2]};
}

std::vector<int> run_vertex_color(const MeasuredRow& row, const HardwareProfile& profile) {
  const FragmentInputs inputs = with_vertex_color(row, "float", profile);
  return {run(state_with(input(Register::primary)), initial_registers(profile, inputs), profile)[0]};
}

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

std::string wrong_scale(const MeasuredRow& row, const HardwareProfile&) {
  const std::string wrong = wrong_word(row, "op", kOptions);
  return wrong.empty() ? wrong_word(row, "portion", kPortions) : wrong;
}

std::string wrong_mux(const MeasuredRow& row, const HardwareProfile& profile) {
  const std::string wrong = wrong_word(row, "mux_select", kMuxBits);
  if (!wrong.empty() || profile.mux_by_lowest_bit || !*value_of(kMuxBits, row.text("mux_select"))) return wrong;
  return fmt::format("profile {} has no mux by the lowest bit of spare0's alpha (NV2A)", profile.name);
}

}  // namespace ninebit::tools
