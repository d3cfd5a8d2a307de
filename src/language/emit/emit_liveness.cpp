#include "src/language/emit/emit_liveness.h"

#include "ninebit/combiner/portion_walk.h"

namespace ninebit::emit {
namespace {

LiveSet read_by_final(const Program& program) {
  LiveSet live;
  const FinalCombiner& f = program.final_combiner;
  const auto read = [&](const CombinerInput& in, int channel) {
    if (in.reg < Register::e_times_f) live.add(in.reg, reference::component_of(in.usage, channel));
    if (in.reg == Register::spare0_plus_secondary) {
      live.add(Register::spare0, channel);
      live.add(Register::secondary, channel);
    }
  };
  for (int c = 0; c < 3; ++c) {
    for (const CombinerInput* const in : {&f.a, &f.b, &f.c, &f.d}) {
      read(*in, c);
      if (in->reg != Register::e_times_f) continue;
      read(f.e, c);
      read(f.f, c);
    }
  }
  read(f.g, kAlpha);
  return live;
}

// Adds the components that a portion reads for its outputs that are live afterwards.
void read_by_portion(const Portion& portion, int first, int channels, const LiveSet& after, LiveSet& live) {
  const PortionOutput& out = portion.out;
  const auto read = [&](const CombinerInput& x, const CombinerInput& y, int channel, bool dot) {
    for (int c = dot ? 0 : channel; c < (dot ? channels : channel + 1); ++c) {
      live.add(x.reg, reference::component_of(x.usage, c));
      live.add(y.reg, reference::component_of(y.usage, c));
    }
  };
  for (int c = 0; c < channels; ++c) {
    const auto is_live = [&](std::size_t k) {
      bool any = false;
      detail::for_each_write({out, k, first + c}, [&](Register to, int i) { any = any || after.has(to, i); });
      return any;
    };
    const bool third = is_live(2);
    if (third || is_live(0)) read(portion.a, portion.b, c, out.ab_dot_product);
    if (third || is_live(1)) read(portion.c, portion.d, c, out.cd_dot_product);
    if (third && out.mux_sum) live.add(Register::spare0, kAlpha);
  }
}

void remove_written(const Portion& portion, int first, int channels, LiveSet& live) {
  for (int c = first; c < first + channels; ++c) {
    for (std::size_t k = 0; k < 3; ++k) {
      detail::for_each_write({portion.out, k, c}, [&](Register to, int component) { live.remove(to, component); });
    }
  }
}

}  // namespace

std::vector<LiveSet> live_after_stages(const Program& program) {
  std::vector<LiveSet> after(static_cast<std::size_t>(program.num_general_combiners));
  LiveSet live = read_by_final(program);
  for (std::size_t i = after.size(); i-- > 0;) {
    const ProgramStage& stage = program.general[i];
    after[i] = live;
    remove_written(stage.rgb, kRed, 3, live);
    remove_written(stage.alpha, kAlpha, 1, live);
    read_by_portion(stage.rgb, kRed, 3, after[i], live);
    read_by_portion(stage.alpha, kAlpha, 1, after[i], live);
  }
  return after;
}

}  // namespace ninebit::emit
