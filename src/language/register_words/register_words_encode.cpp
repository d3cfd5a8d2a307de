// Encodes a state as words.
#include <algorithm>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/register_words/register_words_layout.h"

namespace ninebit {
namespace words {
namespace {

std::uint32_t input_byte(const CombinerInput& input) {
  return code_of(input.reg) | static_cast<std::uint32_t>(input.usage == ComponentUsage::alpha) << kUsageBit |
         static_cast<std::uint32_t>(input.mapping) << kMappingShift;
}

std::uint32_t input_word(const CombinerInput& a, const CombinerInput& b, const CombinerInput& c,
                         const CombinerInput& d) {
  return input_byte(a) << 24 | input_byte(b) << 16 | input_byte(c) << 8 | input_byte(d);
}

std::uint32_t input_word(const Portion& p) {
  return input_word(p.a, p.b, p.c, p.d);
}

std::uint32_t flag(bool set, int bit) {
  return static_cast<std::uint32_t>(set) << bit;
}

std::uint32_t output_word(const PortionOutput& out) {
  return code_of(out.cd) << kCdShift | code_of(out.ab) << kAbShift | code_of(out.sum) << kSumShift |
         flag(out.cd_dot_product, kCdDotBit) | flag(out.ab_dot_product, kAbDotBit) | flag(out.mux_sum, kMuxBit) |
         flag(out.bias != Bias::none, kBiasBit) | static_cast<std::uint32_t>(out.scale) << kScaleShift |
         flag(out.cd_blue_to_alpha, kCdBlueToAlphaBit) | flag(out.ab_blue_to_alpha, kAbBlueToAlphaBit);
}

std::uint32_t argb_of(const ColorF& color) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint32_t>(byte_of_color(color[i])); };
  return byte(3) << 24 | byte(0) << 16 | byte(1) << 8 | byte(2);
}

std::uint32_t final1_word(const CombinerState& state) {
  const FinalCombiner& f = state.final_combiner;
  return input_byte(f.e) << 24 | input_byte(f.f) << 16 | input_byte(f.g) << 8 |
         flag(state.color_sum_clamp, kColorSumClampBit) | flag(state.color_sum_invert_spare0, kSumInvertSpare0Bit) |
         flag(state.color_sum_invert_secondary, kSumInvertSecondaryBit);
}

bool has_texture_beyond(std::initializer_list<Register> registers, int units) {
  for (const Register r : registers) {
    if (is_texture(r) && texture_unit_of(r) >= units) return true;
  }
  return false;
}

bool has_texture_beyond(const Portion& p, int units) {
  return has_texture_beyond({p.a.reg, p.b.reg, p.c.reg, p.d.reg, p.out.ab, p.out.cd, p.out.sum}, units);
}

// The feature of a valid state that NV10 does not have; empty: none.
std::string nv10_lacks(const CombinerState& state) {
  if (state.num_general_combiners > 2) {
    return "NV10 has 2 general combiners, but the program uses " + std::to_string(state.num_general_combiners);
  }
  if (state.per_stage_constants) return "NV10 has no per-stage constants, but the program enables them";
  const FinalCombiner& f = state.final_combiner;
  for (std::size_t i = 0; i < 2; ++i) {
    const PortionOutput& out = state.general[i].rgb.out;
    if (out.ab_blue_to_alpha || out.cd_blue_to_alpha)
      return "NV10 has no blue-to-alpha outputs, but the program uses them";
  }
  bool beyond = has_texture_beyond({f.a.reg, f.b.reg, f.c.reg, f.d.reg, f.e.reg, f.f.reg, f.g.reg}, 2);
  for (std::size_t i = 0; i < 2; ++i) {
    beyond = beyond || has_texture_beyond(state.general[i].rgb, 2) || has_texture_beyond(state.general[i].alpha, 2);
  }
  return beyond ? "NV10 has 2 texture units, but the program uses texture2 or texture3" : "";
}

// Whether the words of an unused stage differ from GL's defaults.
bool differs(const GeneralCombiner& stage, bool with_constants) {
  const GeneralCombiner plain;
  if (with_constants && (argb_of(stage.constant0) != 0 || argb_of(stage.constant1) != 0)) return true;
  return stage.rgb != plain.rgb || stage.alpha != plain.alpha;
}

// `state` has GL's defaults in the general combiners that its profile does not have, because those were not validated.
std::vector<RegisterWord> encode(const CombinerState& state, bool mux_by_lowest_bit, ChipClass chip) {
  std::vector<RegisterWord> found;
  const auto put = [&](Kind kind, int index, std::uint32_t value) {
    found.push_back({canonical_name({kind, index}, chip), value, {}});
  };
  const bool nv10 = chip == ChipClass::nv10;
  const auto count = static_cast<std::uint32_t>(state.num_general_combiners);
  const auto mux_msb = static_cast<std::uint32_t>(!mux_by_lowest_bit);
  for (int i = 0; i < stages_of(chip); ++i) {
    const GeneralCombiner& stage = state.general[static_cast<std::size_t>(i)];
    const bool used = i < state.num_general_combiners || differs(stage, state.per_stage_constants);
    const std::uint32_t control = nv10 && i == 1 ? count << kNv10CountShift | mux_msb << kNv10MuxMsbBit : 0;
    if (used) {
      put(Kind::in_alpha, i, input_word(stage.alpha));
      put(Kind::in_rgb, i, input_word(stage.rgb));
      put(Kind::out_alpha, i, output_word(stage.alpha.out));
    }
    if (used || control != 0) put(Kind::out_rgb, i, output_word(stage.rgb.out) | control);
    if (!nv10 && used && (state.per_stage_constants || i == 0)) {
      const bool own = state.per_stage_constants;
      const auto is_unset = [&](std::size_t which) {
        return own ? state.origin[static_cast<std::size_t>(i)][which].unset : is_shared_constant_unset(state, which);
      };
      if (!is_unset(0)) put(Kind::stage_color0, i, argb_of(own ? stage.constant0 : state.constant0));
      if (!is_unset(1)) put(Kind::stage_color1, i, argb_of(own ? stage.constant1 : state.constant1));
    }
  }
  if (!is_shared_constant_unset(state, 0)) put(Kind::color, 0, argb_of(state.constant0));
  if (!is_shared_constant_unset(state, 1)) put(Kind::color, 1, argb_of(state.constant1));
  const FinalCombiner& f = state.final_combiner;
  const std::uint32_t final0 = input_word(f.a, f.b, f.c, f.d), final1 = final1_word(state);
  // The NV2A reads two words of 0 as spare0. The alpha of zero is 0, too.
  const bool is_black = !nv10 && final0 == 0 && final1 == 0;
  put(Kind::final0, 0, final0);
  put(Kind::final1, 0, is_black ? 1U << (8 + kUsageBit) : final1);
  if (!nv10) {
    const auto unique = static_cast<std::uint32_t>(state.per_stage_constants);
    put(Kind::enable, 0,
        count << kNv20CountShift | mux_msb << kNv20MuxMsbBit | unique << kNv20Unique0Bit | unique << kNv20Unique1Bit);
  }
  return found;
}

}  // namespace
}  // namespace words

Result<std::vector<RegisterWord>> encode_register_words(const CombinerState& state, ChipClass chip,
                                                        const HardwareProfile& profile) {
  const std::vector<StateDiagnostic> wrong = validate(state, profile);
  if (!wrong.empty()) return Diagnostic{"register words: the state is not valid: " + wrong.front().message};
  CombinerState held = state;
  for (int i = profile.general_combiners; i < kMaxGeneralCombiners; ++i) held.general[static_cast<std::size_t>(i)] = {};
  if (chip == ChipClass::nv10) {
    const std::string lacks = words::nv10_lacks(held);
    if (!lacks.empty()) return Diagnostic{"register words: " + lacks};
  }
  // If no mux uses the bit, it is OpenGL's.
  const Program program = normalize(state, profile);
  const bool mux_by_lowest_bit = std::any_of(program.general.begin(), program.general.end(),
                                             [](const ProgramStage& stage) { return stage.mux_by_lowest_bit; });
  return words::encode(held, mux_by_lowest_bit, chip);
}

}  // namespace ninebit
