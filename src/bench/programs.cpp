#include "src/bench/programs.h"

#include <array>
#include <cstddef>

#include "ninebit/shadow/index_cube.h"

namespace ninebit::bench {
namespace {

using enum InputMapping;
using R = Register;

constexpr ComponentUsage kRgb = ComponentUsage::rgb;
constexpr ComponentUsage kA = ComponentUsage::alpha;
constexpr ComponentUsage kB = ComponentUsage::blue;

CombinerState heavy_state() {
  CombinerState state;
  state.num_general_combiners = 2;
  state.constant0 = {0.25F, 0.5F, 0.75F, 0.6F};
  state.constant1 = {0.9F, 0.1F, 0.4F, 0.3F};
  // Bump mapping of that time: a normal and a light vector, both expanded; and a biased modulation.
  state.general[0].rgb = {
      {R::texture0, expand_normal, kRgb},
      {R::texture1, expand_normal, kRgb},
      {R::primary, unsigned_identity, kRgb},
      {R::secondary, half_bias_normal, kRgb},
      {.ab = R::spare0, .cd = R::spare1, .sum = R::discard, .scale = Scale::by_two, .ab_dot_product = true}};
  state.general[0].alpha = {{R::texture0, expand_normal, kA},
                            {R::primary, unsigned_identity, kA},
                            {R::constant0, unsigned_identity, kA},
                            {R::texture1, unsigned_invert, kA},
                            {.sum = R::spare0, .scale = Scale::by_two, .bias = Bias::by_negative_one_half}};
  state.general[1].rgb = {{R::spare0, signed_identity, kRgb},
                          {R::primary, unsigned_identity, kRgb},
                          {R::spare1, signed_negate, kRgb},
                          {R::texture1, unsigned_invert, kRgb},
                          {.ab = R::spare1, .sum = R::spare0, .scale = Scale::by_two, .mux_sum = true}};
  state.general[1].alpha = {{R::spare0, signed_identity, kA},
                            {R::texture0, unsigned_identity, kA},
                            {R::spare1, signed_identity, kB},
                            {R::constant1, unsigned_identity, kA},
                            {.sum = R::spare1}};
  state.final_combiner = {{R::spare1, unsigned_identity, kA},
                          {R::e_times_f, unsigned_identity, kRgb},
                          {R::spare0_plus_secondary, unsigned_identity, kRgb},
                          {R::constant0, unsigned_identity, kRgb},
                          {R::spare1, unsigned_identity, kRgb},
                          {R::texture0, unsigned_identity, kRgb},
                          {R::spare1, unsigned_identity, kA}};
  return state;
}

// The RGB portion of a stage, which reads the results of the previous stage from `last0` and `last1`. The operation
// depends on the stage's number.
Portion eight_rgb(std::size_t stage, R last0, R last1, R texture) {
  switch (stage % 4) {
    case 0:  // a dot product and a modulation
      return {{last0, signed_identity, kRgb},
              {last1, half_bias_negate, kRgb},
              {texture, unsigned_identity, kRgb},
              {last1, unsigned_invert, kRgb},
              {.ab = R::spare0, .cd = R::spare1, .sum = R::discard, .scale = Scale::by_two, .ab_dot_product = true}};
    case 1:  // a weighted sum
      return {{last0, signed_identity, kRgb},
              {R::constant0, unsigned_identity, kRgb},
              {last1, signed_negate, kRgb},
              {texture, expand_normal, kRgb},
              {.cd = R::spare1, .sum = R::spare0}};
    case 2:  // a mux
      return {{last0, half_bias_normal, kRgb},
              {texture, unsigned_invert, kRgb},
              {last1, expand_negate, kRgb},
              {R::constant0, unsigned_identity, kRgb},
              {.ab = R::spare1, .sum = R::spare0, .scale = Scale::by_two, .mux_sum = true}};
    default:  // two modulations, then expanded
      return {{last0, unsigned_invert, kRgb},
              {R::constant0, unsigned_identity, kRgb},
              {last1, unsigned_invert, kRgb},
              {texture, unsigned_identity, kRgb},
              {.ab = R::spare0,
               .cd = R::spare1,
               .sum = R::discard,
               .scale = Scale::by_two,
               .bias = Bias::by_negative_one_half}};
  }
}

// Each stage reads all results of the previous one, and no stage discards what earlier stages computed.
CombinerState eight_state() {
  constexpr std::array kTextures{R::texture0, R::texture1, R::texture2, R::texture3};
  CombinerState state = heavy_state();
  state.num_general_combiners = 8;
  state.per_stage_constants = true;
  for (std::size_t i = 0; i < 8; ++i) {
    GeneralCombiner& stage = state.general[i];
    const float share = static_cast<float>(i) / 32.0F;
    stage.constant0 = {0.7F + share, 0.95F - share, 0.8F, 1.0F};
    stage.constant1 = {1.0F, 1.0F, 1.0F, 0.65F + share};
    // The spare registers hold no results before the first stage.
    const R last0 = i == 0 ? R::primary : R::spare0, last1 = i == 0 ? R::secondary : R::spare1;
    stage.rgb = eight_rgb(i, last0, last1, kTextures[i % 4]);
    stage.alpha = {{last0, i % 2 == 0 ? signed_identity : unsigned_invert, kA},
                   {R::constant1, unsigned_identity, kA},
                   {last1, i % 2 == 0 ? unsigned_invert : signed_negate, kA},
                   {kTextures[(i + 1) % 4], i % 2 == 0 ? half_bias_normal : expand_normal, kA},
                   {.cd = R::spare1, .sum = R::spare0, .scale = i == 5 ? Scale::by_one_half : Scale::none}};
  }
  return state;
}

}  // namespace

Result<std::vector<MeasuredProgram>> measured_programs(const HardwareProfile& profile) {
  const auto index = index_comparison_state(profile);
  if (!index) return index.error();
  const HardwareProfile& large = profile.general_combiners < 8 ? profiles::nv2a : profile;
  return std::vector<MeasuredProgram>{
      {"index", "the article's comparison of two indices", *index, profile},
      {"heavy", "two stages: expand, dot product, mux, bias, scale, E times F", heavy_state(), profile},
      {"eight", "eight stages, each with both portions and constants of its own", eight_state(), large},
      {"default", "OpenGL's default state: colour sum and fog", CombinerState{}, profile}};
}

}  // namespace ninebit::bench
