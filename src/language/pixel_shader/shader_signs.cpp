#include "src/language/pixel_shader/shader_signs.h"

#include <array>

#include "src/language/pixel_shader/shader_words.h"

namespace ninebit::detail {
namespace {

constexpr std::array kSignedInputs{&Portion::a, &Portion::b, &Portion::c, &Portion::d};

bool stage_writes(const ProgramStage& stage, Register reg, bool alpha) {
  const PortionOutput& rgb = stage.rgb.out;
  if (!alpha) return written_register(rgb) == reg;
  const bool raised = (rgb.ab == reg && rgb.ab_blue_to_alpha) || (rgb.cd == reg && rgb.cd_blue_to_alpha);
  return written_register(stage.alpha.out) == reg || raised;
}

// Whether an input is the weight of lrp, which is read without its sign anyway.
bool is_weight(const Portion& portion, std::size_t n) {
  if (portion.out.sum == Register::discard || portion.out.mux_sum) return false;
  const CombinerInput& in = portion.*kSignedInputs.at(n);
  if (in.mapping != InputMapping::unsigned_identity) return false;
  for (const CombinerInput Portion::*const one : kSignedInputs) {
    if (is_unit(portion.*one) || is_unit(portion.*one, true)) return false;  // mad
  }
  CombinerInput rest = in;
  rest.mapping = InputMapping::unsigned_invert;
  const std::size_t other = n < 2 ? 2 : 0;
  return portion.*kSignedInputs.at(other) == rest || portion.*kSignedInputs.at(other + 1) == rest;
}

}  // namespace

ReadSigns signs_of(std::span<const ProgramStage> stages, std::size_t i, Register reg, bool alpha) {
  ReadSigns out;
  for (std::size_t k = i + 1; k < stages.size(); ++k) {
    const ProgramStage& stage = stages[k];
    for (const Portion* const portion : {&stage.rgb, &stage.alpha}) {
      for (std::size_t n = 0; n < kSignedInputs.size(); ++n) {
        const CombinerInput& in = portion->*kSignedInputs.at(n);
        if (in.reg != reg || (in.usage == ComponentUsage::alpha) != alpha || is_weight(*portion, n)) continue;
        out.without = out.without || in.mapping == InputMapping::unsigned_identity;
        out.with = out.with || in.mapping == InputMapping::signed_identity || in.mapping == InputMapping::signed_negate;
      }
    }
    if (stage_writes(stage, reg, alpha)) break;
  }
  return out;
}

}  // namespace ninebit::detail
