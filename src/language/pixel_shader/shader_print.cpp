// A program as a ps.1.1 text: an instruction, or a pair of them, for each general combiner.
#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/pixel_shader/shader_parser.h"
#include "src/language/pixel_shader/shader_stage.h"
#include "src/language/pixel_shader/shader_words.h"
#include "src/system/digits.h"

namespace ninebit {
namespace {

using detail::PortionPlace;
using detail::PrintedConstants;
using detail::PrintedPortion;

using RegisterFlags = std::array<bool, kRegisterCount>;

constexpr std::array kPortionInputs{&Portion::a, &Portion::b, &Portion::c, &Portion::d};

class ShaderPrinter {
 public:
  ShaderPrinter(const CombinerState& state, const Program& program, const HardwareProfile& profile)
      : state_(state), program_(program), profile_(profile), constants_(program) {
    for (int i = 0; i < program.num_general_combiners; ++i) {
      const auto& stage = program.general.at(static_cast<std::size_t>(i));
      if (is_live(stage.rgb.out) || is_live(stage.alpha.out)) stages_.push_back(stage);
    }
    own_constants_ = state.per_stage_constants;
  }

  Result<std::string> print(const TextureShaderState& stages) {
    last_ = add_last();
    find_blue_result();
    for (std::size_t i = 0; i < stages_.size() && why_.empty(); ++i) print_stage(i);
    if (why_.empty() && stages_.size() > kMostInstructions) why_ = "more than 8 instructions";
    if (why_.empty() && static_cast<int>(stages_.size()) > profile_.general_combiners) {
      why_ = "the final combiner outputs other registers than spare0, for which all general combiners are in use";
    }
    if (why_.empty() && !written_rgb_[index(Register::spare0)]) why_ = "spare0's colour is read before it is written";
    if (!why_.empty()) return Diagnostic{.message = "ps.1.1 cannot express this: " + why_};
    std::string text = "ps.1.1\n" + constants_.text();
    if (stages.enabled) return with_stages(text, stages);
    for (std::size_t i = 0; i < 4; ++i) {
      if (fetched_[index(Register::texture0) + i]) text += "tex t" + std::to_string(i) + "\n";
    }
    return text + body_;
  }

 private:
  static constexpr std::size_t kMostInstructions = 8;
  static std::size_t index(Register reg) { return static_cast<std::size_t>(reg); }

  // The text with the texture instructions of stages.
  Result<std::string> with_stages(std::string text, const TextureShaderState& stages) {
    std::string eye;  // a constant that nothing else uses
    for (int i = 7; i >= 0 && eye.empty(); --i) {
      const std::string name = "c" + std::to_string(i);
      if ((text + body_).find(name) == std::string::npos) eye = name;
    }
    for (const TextureStage& stage : stages.stage) {
      if (stage.operation != TextureOperation::dot_product_const_eye_reflect_cube_map) continue;
      if (eye.empty()) return Diagnostic{.message = "ps.1.1 cannot express this: a ninth constant, for an eye vector"};
      text += "def " + eye;
      for (const float component : stage.eye) text += ", " + digits_of(component);
      text += ", 0\n";
    }
    const Result<std::string> lines = detail::print_textures(stages, eye);
    if (!lines) return lines;
    for (std::size_t i = 0; i < stages.stage.size(); ++i) {
      if (!fetched_[index(Register::texture0) + i] || stages.stage[i].operation != TextureOperation::none) continue;
      return Diagnostic{.message = "ps.1.1 cannot express this: t" + std::to_string(i) +
                                   " is read, and texture stage " + std::to_string(i) + " is none"};
    }
    return text + *lines + body_;
  }

  // The input whose value the final combiner outputs as it is; empty: it computes.
  [[nodiscard]] std::optional<CombinerInput> passed() const {
    const FinalCombiner& f = program_.final_combiner;
    const bool no_product = detail::is_nothing(f.a) || detail::is_nothing(f.b);
    const bool no_rest = detail::is_unit(f.a) || detail::is_nothing(f.c);
    if (no_product && no_rest) return f.d;
    if (!detail::is_nothing(f.d)) return std::nullopt;
    if (detail::is_unit(f.a)) return f.b;
    return detail::is_nothing(f.a) ? std::optional(f.c) : std::nullopt;
  }

  // Adds moves to spare0 if the final combiner outputs other registers.
  bool add_last() {
    const auto color = passed();
    CombinerInput alpha = program_.final_combiner.g;
    if (!color || color->reg >= Register::e_times_f) {
      why_ = "a final combiner that computes; it may output spare0 or another register";
      return false;
    }
    const auto is_result = [](const CombinerInput& in, ComponentUsage usage) {
      return in.reg == Register::spare0 && in.mapping == InputMapping::unsigned_identity && in.usage == usage;
    };
    const bool moves_color = !is_result(*color, ComponentUsage::rgb);
    const bool blue = is_result(alpha, ComponentUsage::blue) && !profile_.blue_to_alpha;
    const bool moves_alpha = !is_result(alpha, ComponentUsage::alpha) && !blue;
    if (!moves_color && !moves_alpha) return false;
    ProgramStage stage;
    stage.unset = program_.unset;
    stage.rgb.out.sum = stage.alpha.out.sum = Register::discard;
    const auto move = [](Portion& portion, const CombinerInput& from) {
      portion.a = from;
      portion.b = {Register::zero, InputMapping::unsigned_invert, ComponentUsage::rgb};
      portion.out.ab = Register::spare0;
      // The final combiner takes what is below 0 as 0.
      if (from.mapping == InputMapping::unsigned_identity && from.reg != Register::zero) {
        portion.a.mapping = InputMapping::signed_identity;
      }
    };
    if (moves_color) move(stage.rgb, *color);
    if (moves_alpha) move(stage.alpha, alpha);
    stages_.push_back(stage);
    return true;
  }

  // Without blue to alpha, a dot product's alpha as the result is spare0's blue.
  void find_blue_result() {
    const CombinerInput& g = program_.final_combiner.g;
    if (g.usage != ComponentUsage::blue || g.reg != Register::spare0 || last_) return;
    for (std::size_t i = stages_.size(); i > 0; --i) {
      const PortionOutput& out = stages_[i - 1].rgb.out;
      if (detail::written_register(stages_[i - 1].alpha.out) == Register::spare0) break;
      if (detail::written_register(out) != Register::spare0) continue;
      if (out.ab == Register::spare0 && out.ab_dot_product && !is_live(stages_[i - 1].alpha.out)) {
        blue_result_ = i - 1;
        return;
      }
      break;
    }
    if (why_.empty()) why_ = "spare0's blue as the resulting alpha";
  }

  // The registers that a stage may read without their sign.
  void find_unsigned(PortionPlace& place) const {
    for (std::size_t i = 0; i < kRegisterCount; ++i) {
      const auto reg = static_cast<Register>(i);
      const bool constant = reg == Register::constant0 || reg == Register::constant1;
      const bool color = reg == Register::primary || reg == Register::secondary;
      // Texels may have a sign with chips of the GeForce3's class.
      const bool given = color || (is_texture(reg) && !profile_.per_stage_constants);
      place.unsigned_rgb[i] = constant || (written_rgb_[i] ? saturated_rgb_[i] : given);
      place.unsigned_alpha[i] = constant || (written_alpha_[i] ? saturated_alpha_[i] : given);
    }
  }

  void check_reads(const ProgramStage& stage) {
    const bool muxes = detail::has_mux(stage);
    for (const Register reg : {Register::spare0, Register::spare1}) {
      bool rgb = false, alpha = muxes && reg == Register::spare0;
      for (const Portion* const portion : {&stage.rgb, &stage.alpha}) {
        for (const CombinerInput Portion::*const in : kPortionInputs) {
          if ((portion->*in).reg != reg) continue;
          ((portion->*in).usage == ComponentUsage::alpha ? alpha : rgb) = true;
        }
      }
      if ((rgb && !written_rgb_[index(reg)]) || (alpha && !written_alpha_[index(reg)])) {
        why_ = std::string(name_of(reg)) + " is read before it is written";
      }
    }
    std::array<RegisterFlags, 2> read{};
    for (const Portion* const portion : {&stage.rgb, &stage.alpha}) {
      for (const CombinerInput Portion::*const in : kPortionInputs) {
        const Register reg = (portion->*in).reg;
        if (is_texture(reg)) fetched_[index(reg)] = read[portion == &stage.alpha ? 1 : 0][index(reg)] = true;
      }
    }
    for (const RegisterFlags& one : read) {
      if (std::count(one.begin(), one.end(), true) > 2 && why_.empty()) why_ = "three textures in one instruction";
    }
  }

  void print_stage(std::size_t i) {
    const ProgramStage& stage = stages_[i];
    const std::string name =
        last_ && i + 1 == stages_.size() ? "final combiner" : "general combiner " + std::to_string(i);
    check_reads(stage);
    if (!why_.empty()) why_ = name + ": " + why_;
    if (own_constants_) constants_.next_scope();
    const bool is_last = last_ && i + 1 == stages_.size();
    if (is_last && own_constants_) constants_.next_scope();
    std::array<std::optional<PrintedPortion>, 2> printed;
    for (const PortionName which : {PortionName::rgb, PortionName::alpha}) {
      const bool alpha = which == PortionName::alpha;
      const Portion& portion = alpha ? stage.alpha : stage.rgb;
      if (!is_live(portion.out) || !why_.empty()) continue;
      PortionPlace place{.which = which, .saturates = saturates(i, stage, alpha)};
      find_unsigned(place);
      const bool own = own_constants_ && !is_last;
      const GeneralCombiner& from = state_.general.at(stage_number(i));
      place.unset = stage.unset;
      place.constants = {own ? from.constant0 : state_.constant0, own ? from.constant1 : state_.constant1};
      std::string why;
      printed.at(alpha ? 1 : 0) = words_of(portion, place, constants_, why);
      if (!why.empty()) why_ = name + (is_last ? "" : alpha ? ", alpha portion" : ", RGB portion") + ": " + why;
    }
    if (!why_.empty()) return;
    if (blue_result_ == i) printed[0]->blue_to_alpha = true;
    note_written(i, stage);
    write(printed[0], printed[1]);
  }

  // The number of a printed stage in the state: stages that write nothing are left out.
  [[nodiscard]] std::size_t stage_number(std::size_t i) const {
    std::size_t live = 0;
    for (std::size_t k = 0; k < program_.general.size(); ++k) {
      const ProgramStage& stage = program_.general[k];
      if (!is_live(stage.rgb.out) && !is_live(stage.alpha.out)) continue;
      if (live++ == i) return k;
    }
    return 0;
  }

  bool saturates(std::size_t i, const ProgramStage& stage, bool alpha) {
    const PortionOutput& out = alpha ? stage.alpha.out : stage.rgb.out;
    const Register reg = detail::written_register(out);
    detail::ReadSigns signs = detail::signs_of(stages_, i, reg, alpha);
    if (!alpha && (out.ab_blue_to_alpha || out.cd_blue_to_alpha)) {
      const detail::ReadSigns raised = detail::signs_of(stages_, i, reg, true);
      signs.without = signs.without || raised.without;
      signs.with = signs.with || raised.with;
    }
    if (signs.without && signs.with && why_.empty()) {
      why_ = "general combiner " + std::to_string(i) + ": " + std::string(name_of(reg)) +
             " is read both with its sign and without";
    }
    return signs.without;
  }

  void note_written(std::size_t i, const ProgramStage& stage) {
    const auto note = [](RegisterFlags& written, RegisterFlags& saturated, Register reg, bool is_saturated) {
      if (reg == Register::discard) return;
      written[index(reg)] = true;
      saturated[index(reg)] = is_saturated;
    };
    const Register rgb = detail::written_register(stage.rgb.out), alpha = detail::written_register(stage.alpha.out);
    const bool rgb_saturates = rgb != Register::discard && saturates(i, stage, false);
    note(written_rgb_, saturated_rgb_, rgb, rgb_saturates);
    if (stage.rgb.out.ab_blue_to_alpha || stage.rgb.out.cd_blue_to_alpha) {
      note(written_alpha_, saturated_alpha_, rgb, rgb_saturates);
    }
    note(written_alpha_, saturated_alpha_, alpha, alpha != Register::discard && saturates(i, stage, true));
  }

  static std::string register_of(Register reg) {
    if (is_texture(reg)) return "t" + std::to_string(texture_unit_of(reg));
    return reg == Register::spare0 ? "r0" : "r1";
  }

  static std::string line(const PrintedPortion& portion, const std::string& mask) {
    std::string text = portion.name + " " + register_of(portion.to) + mask;
    for (const PrintedPortion::Source& source : portion.sources) text += ", " + source.text + source.selector;
    return text + "\n";
  }

  // Whether one instruction does what both portions do.
  static bool is_same(const PrintedPortion& rgb, const PrintedPortion& alpha) {
    if (rgb.name != alpha.name || rgb.to != alpha.to || rgb.sources.size() != alpha.sources.size()) return false;
    if (rgb.name.starts_with("dp3")) return false;
    for (std::size_t i = 0; i < rgb.sources.size(); ++i) {
      const PrintedPortion::Source &one = rgb.sources[i], &other = alpha.sources[i];
      if (one.text != other.text || other.selector == ".b") return false;
    }
    return true;
  }

  void write(const std::optional<PrintedPortion>& rgb, const std::optional<PrintedPortion>& alpha) {
    if (rgb && alpha && is_same(*rgb, *alpha)) {
      body_ += line(*rgb, "");
      return;
    }
    if (rgb) body_ += line(*rgb, rgb->blue_to_alpha ? "" : ".rgb");
    if (alpha) body_ += (rgb ? "+" : "") + line(*alpha, ".a");
  }

  const CombinerState& state_;
  const Program& program_;
  const HardwareProfile& profile_;
  std::vector<ProgramStage> stages_;
  PrintedConstants constants_;
  RegisterFlags written_rgb_{}, written_alpha_{}, saturated_rgb_{}, saturated_alpha_{}, fetched_{};
  std::optional<std::size_t> blue_result_;
  bool own_constants_ = false, last_ = false;
  std::string why_, body_;
};

}  // namespace

Result<std::string> print_pixel_shader(const CombinerState& state, const HardwareProfile& profile,
                                       const TextureShaderState& texture_shader) {
  const Result<Program> program = compile(state, profile);
  if (!program) return program.error();
  for (const ProgramStage& stage : program->general) {
    if (!stage.mux_by_lowest_bit) continue;
    return Diagnostic{.message = "ps.1.1 cannot express this: a mux by the lowest bit of spare0's alpha"};
  }
  Result<std::string> text = ShaderPrinter(state, *program, profile).print(texture_shader);
  if (!text) return text;
  // The printer may have added more than the profile has, such as a third constant.
  TextureShaderState stages;
  const auto back =
      parse_pixel_shader({*text, "the text"}, profile, {}, {}, texture_shader.enabled ? &stages : nullptr);
  if (back) return text;
  return Diagnostic{.message = "ps.1.1 cannot express this: " + back.faults().front().message};
}

}  // namespace ninebit
