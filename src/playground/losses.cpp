// Where a pass's combiners lost something: at each pixel and in each stage, truncation, clamps, and the distance from
// exact arithmetic.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/final_walk.h"
#include "ninebit/combiner/portion_walk.h"
#include "src/combiner/real_rules.h"
#include "src/playground/drawing.h"

namespace ninebit::playground {
namespace {

constexpr std::size_t kMostPixels = std::size_t{1} << 20;

// Real numbers as doubles: each step is off by less than 1e-15, where the exact fractions of a trace would take a
// thousand times longer (real_rules.h).
class Doubles {
 public:
  using Number = double;
  explicit Doubles(int one) : one_(one) {}
  static double whole(int n) { return n; }
  static double half() { return 0.5; }
  [[nodiscard]] double of_code(int code) const { return static_cast<double>(code) / one_; }
  static double add(double x, double y) { return x + y; }
  static double sub(double x, double y) { return x - y; }
  static double mul(double x, double y) { return x * y; }
  static double scaled(double x, int exponent) { return std::ldexp(x, exponent); }
  static bool is_negative(double x) { return x < 0; }
  static bool less(double x, double y) { return x < y; }
  [[nodiscard]] int nearest_code(double x) const { return static_cast<int>(std::floor(x * one_ + 0.5)); }

 private:
  int one_;
};

// What one stage lost in one fragment: bit 0 truncated, bit 1 clamped, above them the largest distance from the exact
// value in codes, 63 at most.
class StageLoss {
 public:
  explicit StageLoss(int one) : one_(one) {}

  void truncated(bool it_was) { bits_ |= it_was ? 1 : 0; }
  void clamped(bool it_was) { bits_ |= it_was ? 2 : 0; }
  void written(int code, double exact) { distance_ = std::max(distance_, std::abs(code - exact * one_)); }
  [[nodiscard]] std::uint8_t byte() const {
    return static_cast<std::uint8_t>(bits_ | std::min(63, static_cast<int>(std::floor(distance_ + 0.5))) << 2);
  }

 private:
  int one_;
  int bits_ = 0;
  double distance_ = 0;
};

// The value domain of a general combiner (portion_walk.h): codes, with what each output lost.
class LossyCodes {
 public:
  using Input = int;
  using Wide = int;
  struct Output {
    int written = 0;
    bool truncated = false, clamped = false;
  };

  LossyCodes(const Datapath& d, const ProgramStage& stage, RegisterFile& registers)
      : d_(d), codes_(d, stage, registers) {}

  [[nodiscard]] int input(const CombinerInput& in, int component) const { return codes_.input(in, component); }
  [[nodiscard]] int product(int x, int y) const { return codes_.product(x, y); }
  [[nodiscard]] int sum(int x, int y) const { return codes_.sum(x, y); }
  [[nodiscard]] int mux(int ab, int cd) const { return codes_.mux(ab, cd); }
  [[nodiscard]] Output output(const detail::Target& target, int wide) const {
    const int most = 64 * d_.one;  // as in a trace: six products below two each, the bias, a scale of four
    const int biased = reference::add_bias(d_, target.out.bias, wide);
    const int twice = reference::scale_output(target.out.scale, reference::narrow_before_scale(d_, biased));
    const int narrowed = reference::narrow_output(d_, twice, most);
    Output out{.written = reference::clamp_output(d_, narrowed)};
    out.truncated = reference::scale_output(target.out.scale, biased) != 2 * d_.one * narrowed;
    out.clamped = out.written != narrowed;
    return out;
  }
  void write(Register to, int component, const Output& value) { codes_.write(to, component, value.written); }

 private:
  const Datapath& d_;
  reference::CodeDomain codes_;
};

// The value domain of the final combiner (final_walk.h): codes; what is lost goes into a StageLoss.
class LossyFinal {
 public:
  using Input = int;
  using Code = int;
  static constexpr bool kEveryStep = false;

  LossyFinal(const Program& program, const RegisterFile& registers, StageLoss& loss)
      : d_(program.datapath), codes_(program, registers), loss_(loss) {}

  [[nodiscard]] int input(const CombinerInput& in, int component) const { return codes_.input(in, component); }
  [[nodiscard]] int map(InputMapping mapping, int e) const { return codes_.map(mapping, e); }
  [[nodiscard]] int product(int e, int f) const {
    const int narrowed = codes_.product(e, f);
    loss_.truncated(e * f != d_.one * narrowed);
    return narrowed;
  }
  [[nodiscard]] int sum_part(bool inverted, Register r, int component) const {
    return codes_.sum_part(inverted, r, component);
  }
  [[nodiscard]] int sum(bool clamp, int spare0, int secondary) const {
    const int sum = codes_.sum(clamp, spare0, secondary);
    loss_.clamped(sum != codes_.sum(false, spare0, secondary));
    return sum;
  }
  [[nodiscard]] int rgb(int channel, int a, int b, int c, int added) const {
    const int mix = a * b + reference::one_minus_a_times_c(d_, a, c);
    const int narrowed = reference::narrow_mix(d_, mix);
    const int written = codes_.rgb(channel, a, b, c, added);
    loss_.truncated(mix != d_.one * narrowed);
    loss_.clamped(written != narrowed + added);
    return written;
  }
  [[nodiscard]] int alpha(int g) const {
    const int written = codes_.alpha(g);
    loss_.clamped(written != g);
    return written;
  }

 private:
  const Datapath& d_;
  reference::FinalCodes codes_;
  StageLoss& loss_;
};

// Runs a program of integer arithmetic over one fragment. Gives a byte a general combiner, then the final combiner's.
class LossWalk {
 public:
  explicit LossWalk(const Program& program) : program_(program), field_(program.datapath.one), real_(field_) {}

  void run(RegisterFile registers, std::span<std::uint8_t> bytes) {
    RealCombiners<Doubles>::Registers exact{};
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) exact[r][c] = field_.of_code(registers.value[r][c]);
    }
    const auto count = static_cast<std::size_t>(program_.num_general_combiners);
    for (std::size_t i = 0; i < count; ++i) bytes[i] = run_stage(program_.general[i], registers, exact);
    StageLoss loss(program_.datapath.one);
    LossyFinal domain(program_, registers, loss);
    detail::FinalSteps<LossyFinal> steps;
    detail::walk_final(domain, program_, steps);
    RealCombiners<Doubles>::Final last;
    real_.run_final(program_, exact, last);
    for (std::size_t c = 0; c < 4; ++c) loss.written(steps.color[c], last.steps.color[c]);
    bytes[count] = loss.byte();
  }

 private:
  std::uint8_t run_stage(const ProgramStage& stage, RegisterFile& registers, RealCombiners<Doubles>::Registers& exact) {
    LossyCodes domain(program_.datapath, stage, registers);
    detail::StageSteps<LossyCodes> steps{};
    detail::walk_stage(domain, stage, steps);
    RealCombiners<Doubles>::Stage real;
    real_.run_general(stage, exact, real);
    StageLoss loss(program_.datapath.one);
    for (std::size_t c = 0; c < 4; ++c) {
      const PortionOutput& out = c == kAlpha ? stage.alpha.out : stage.rgb.out;
      for (std::size_t k = 0; k < 3; ++k) {
        if (detail::register_of(out, k) == Register::discard) continue;
        loss.truncated(steps[c].output[k].truncated);
        loss.clamped(steps[c].output[k].clamped);
        loss.written(steps[c].output[k].written, real.channel[c].output[k].written);
      }
    }
    return loss.byte();
  }

  const Program& program_;
  Doubles field_;
  RealCombiners<Doubles> real_;
};

RegisterFile registers_at(const CombinerRecord& record, std::size_t pixel) {
  RegisterFile registers;
  for (std::size_t r = 0; r < record.inputs.size(); ++r) {
    for (std::size_t c = 0; c < 4; ++c) registers[kRecordedRegisters[r]][c] = record.inputs[r][c][pixel];
  }
  return registers;
}

// The plane of each stage, rows from the top; 0 where nothing was drawn.
void append_losses(const CombinerRecord& record, std::vector<std::uint8_t>& bytes) {
  const auto width = static_cast<std::size_t>(record.width), height = static_cast<std::size_t>(record.height);
  const std::size_t each = width * height;
  std::vector<std::uint8_t> losses(static_cast<std::size_t>(record.program->num_general_combiners) + 1);
  bytes.assign(losses.size() * each, 0);
  LossWalk walk(*record.program);
  for (std::size_t i = 0; i < each; ++i) {
    if (!record.drawn[i]) continue;
    walk.run(registers_at(record, i), losses);
    const std::size_t to = (height - 1 - i / width) * width + i % width;
    for (std::size_t p = 0; p < losses.size(); ++p) bytes[p * each + to] = losses[p];
  }
}

}  // namespace

Reply Engine::losses(Request& request) {
  request.allow({"pass"});
  if (!last_) return refusal("nothing was drawn yet");
  const auto& passes = last_->effect.passes;
  const int pass = request.number("pass", 0, static_cast<int>(passes.size()) - 1);
  if (request.failed()) return request.refused();
  const EffectPass& chosen = passes[static_cast<std::size_t>(pass)];
  if (chosen.program.empty()) return refusal("pass " + json::in_quotes(chosen.name) + " has no program");
  const auto pixels = static_cast<std::size_t>(last_->effect.width) * static_cast<std::size_t>(last_->effect.height);
  if (chosen.target != kPictureTarget) {
    return refusal("pass " + json::in_quotes(chosen.name) + " does not draw into the picture");
  }
  if (pixels > kMostPixels) {
    return refusal("the picture has " + std::to_string(pixels) + " pixels; at most " + std::to_string(kMostPixels) +
                   " are examined");
  }
  const Drawn drawn = draw_effect(*last_, shelf_, {.recorded_pass = static_cast<std::size_t>(pass)}, kept_);
  if (drawn.refused) return *drawn.refused;
  const CombinerRecord& record = kept_.renderer->recorded();
  if (record.program->datapath.arithmetic != Arithmetic::integer) {
    return refusal("profile " + std::string(last_->profile.profile().name) +
                   " computes in real numbers: nothing is lost");
  }
  append_losses(record, bytes_);
  return Json{{"width", record.width},
              {"height", record.height},
              {"pass", chosen.name},
              {"general_combiners", record.program->num_general_combiners},
              {"bytes", bytes_.size()}};
}

}  // namespace ninebit::playground
