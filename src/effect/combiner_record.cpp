#include "src/effect/combiner_record.h"

#include <algorithm>
#include <utility>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/state.h"

namespace ninebit {
namespace {

constexpr s9 kNoCode = 0x7FFF;  // outside of all codes: no fragment was there

// A program that changes no register: after it, registers are as before the first general combiner.
Program idle_program(const HardwareProfile& profile) {
  CombinerState state;
  state.num_general_combiners = 1;
  state.general[0].rgb.out.sum = state.general[0].alpha.out.sum = Register::discard;
  return normalize(state, profile);
}

// A surface like the target before the draw.
Result<Surface> depth_copy(const RecordedDraw& draw, const RenderTarget& target) {
  auto copy = Surface::make(target.width, target.height, {.depth_stencil = target.format, .samples = target.samples});
  if (!copy) return copy;
  if (draw.clear) {
    copy->fill(*draw.clear);
    return copy;
  }
  RenderTarget to = copy->target();
  const int columns = target.width * sample_columns(target.samples), rows = target.height * sample_rows(target.samples);
  for (int y = 0; y < rows; ++y) {
    std::copy_n(target.depth.row(y), columns, to.depth.row(y));
    if (target.stencil) std::copy_n(target.stencil.row(y), columns, to.stencil.row(y));
  }
  return copy;
}

// Draws with the given program and output planes. The alpha test is left out: what it reads depends on the program, and
// the same fragments must remain.
Status draw_copy(const RecordedDraw& draw, const RenderTarget& target, Program program,
                 std::vector<OutputPlane> outputs) {
  auto copy = depth_copy(draw, target);
  if (!copy) return copy.error();
  PipelineState state = draw.state;
  state.program = std::move(program);
  state.alpha_test = {};
  state.blend = {};
  RenderTarget into = copy->target();
  into.outputs = std::move(outputs);
  return rasterize(state, draw.projection, draw.arrays, draw.units, into);
}

}  // namespace

Result<CombinerRecord> record_combiners(const RecordedDraw& draw, const RenderTarget& target) {
  CombinerRecord record{.program = draw.state.program,
                        .width = target.width * sample_columns(target.samples),
                        .height = target.height * sample_rows(target.samples)};
  const auto pixels = static_cast<std::size_t>(record.width) * static_cast<std::size_t>(record.height);
  std::vector<OutputPlane> inputs, outputs;
  for (std::size_t r = 0; r < record.inputs.size(); ++r) {
    for (std::size_t c = 0; c < 4; ++c) {
      record.inputs[r][c].assign(pixels, kNoCode);
      inputs.push_back({.source = OutputSource::register_code,
                        .reg = kRecordedRegisters[r],
                        .component = static_cast<int>(c),
                        .time = OutputTime::at_depth_pass,
                        .plane = Plane<s9>{record.inputs[r][c].data(), record.width}});
    }
  }
  for (std::size_t c = 0; c < 4; ++c) {
    record.output[c].assign(pixels, 0);
    outputs.push_back({.source = OutputSource::output_code,
                       .component = static_cast<int>(c),
                       .time = OutputTime::at_depth_pass,
                       .plane = Plane<std::uint8_t>{record.output[c].data(), record.width}});
  }
  if (Status drawn = draw_copy(draw, target, idle_program(draw.state.profile), std::move(inputs)); !drawn) {
    return drawn.error();
  }
  if (Status drawn = draw_copy(draw, target, *draw.state.program, std::move(outputs)); !drawn) return drawn.error();
  record.drawn.resize(pixels);
  for (std::size_t i = 0; i < pixels; ++i) {
    record.drawn[i] = record.inputs[0][0][i] != kNoCode;
    if (record.drawn[i]) continue;
    for (auto& planes : record.inputs) {
      for (auto& plane : planes) plane[i] = 0;
    }
  }
  return record;
}

}  // namespace ninebit
