// Where a pass's combiners lost something: at each pixel and in each stage, truncation, clamps, and the distance from
// exact arithmetic.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "ninebit/combiner/trace.h"
#include "src/playground/drawing.h"

namespace ninebit::playground {
namespace {

// Each pixel of each stage is traced.
constexpr std::size_t kMostPixels = std::size_t{1} << 20;

// What one stage lost in one fragment: bit 0 truncated, bit 1 clamped, above them the largest distance from the exact
// value in codes, 63 at most.
class StageLoss {
 public:
  explicit StageLoss(int one) : one_(one) {}

  void truncated(const TracedWide& dropped) { bits_ |= dropped.units != 0 ? 1 : 0; }
  void clamped(const TracedCode& cut) { bits_ |= cut.code != 0 ? 2 : 0; }
  void written(const TracedCode& value) { distance_ = std::max(distance_, std::abs(value.real - value.ideal) * one_); }
  [[nodiscard]] std::uint8_t byte() const {
    return static_cast<std::uint8_t>(bits_ | std::min(63, static_cast<int>(std::floor(distance_ + 0.5))) << 2);
  }

 private:
  int one_;
  int bits_ = 0;
  double distance_ = 0;
};

void add(const TracedPortion& portion, StageLoss& loss) {
  for (const TracedChannel& channel : portion.channel) {
    for (const auto* output : {&channel.ab_output, &channel.cd_output, &channel.third_output}) {
      if (!*output) continue;
      loss.truncated((*output)->dropped);
      loss.clamped((*output)->cut);
      loss.written((*output)->written);
    }
  }
}

void add(const TracedFinal& final_combiner, StageLoss& loss) {
  for (const TracedFinalChannel& channel : final_combiner.rgb) {
    if (final_combiner.uses_e_times_f) loss.truncated(channel.e_times_f_dropped);
    if (final_combiner.uses_color_sum) {
      loss.clamped({.code = channel.color_sum_unclamped.code - channel.color_sum.code});
    }
    loss.truncated(channel.dropped);
    loss.clamped(channel.cut);
    loss.written(channel.written);
  }
  loss.clamped(final_combiner.alpha_cut);
  loss.written(final_combiner.alpha);
}

// The bytes of one fragment: a byte a general combiner, then the final combiner's.
std::vector<std::uint8_t> losses_of(const Trace& traced, int one) {
  std::vector<std::uint8_t> bytes;
  for (const TracedStage& stage : traced.stage) {
    StageLoss loss(one);
    add(stage.rgb, loss);
    add(stage.alpha, loss);
    bytes.push_back(loss.byte());
  }
  StageLoss loss(one);
  add(traced.final_combiner, loss);
  bytes.push_back(loss.byte());
  return bytes;
}

RegisterFile registers_at(const CombinerRecord& record, std::size_t pixel) {
  RegisterFile registers;
  for (std::size_t r = 0; r < record.inputs.size(); ++r) {
    for (std::size_t c = 0; c < 4; ++c) registers[kRecordedRegisters[r]][c] = record.inputs[r][c][pixel];
  }
  return registers;
}

// The plane of each stage, rows from the top; 0 where nothing was drawn.
void append_losses(const CombinerRecord& record, const HardwareProfile& profile, std::vector<std::uint8_t>& bytes) {
  const auto width = static_cast<std::size_t>(record.width), height = static_cast<std::size_t>(record.height);
  const std::size_t each = width * height;
  const std::size_t planes = static_cast<std::size_t>(record.program->num_general_combiners) + 1;
  bytes.assign(planes * each, 0);
  std::optional<RegisterFile> before;
  std::vector<std::uint8_t> losses;
  for (std::size_t i = 0; i < each; ++i) {
    if (!record.drawn[i]) continue;
    const RegisterFile registers = registers_at(record, i);
    // Neighbours often have the same registers.
    if (before != registers)
      losses = losses_of(trace(*record.program, profile, registers), record.program->datapath.one);
    before = registers;
    const std::size_t to = (height - 1 - i / width) * width + i % width;
    for (std::size_t p = 0; p < planes; ++p) bytes[p * each + to] = losses[p];
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
                   " are traced");
  }
  const Drawn drawn = draw_effect(*last_, shelf_, {.recorded_pass = static_cast<std::size_t>(pass)}, kept_);
  if (drawn.refused) return *drawn.refused;
  const CombinerRecord& record = kept_.renderer->recorded();
  append_losses(record, last_->profile.profile(), bytes_);
  return Json{{"width", record.width},
              {"height", record.height},
              {"pass", chosen.name},
              {"general_combiners", record.program->num_general_combiners},
              {"bytes", bytes_.size()}};
}

}  // namespace ninebit::playground
