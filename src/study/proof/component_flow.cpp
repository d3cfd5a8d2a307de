#include "src/study/proof/component_flow.h"

#include "ninebit/combiner/portion_walk.h"

namespace ninebit::proof {
namespace {

// A value: what it depends on, and its code if that is nothing.
struct Value {
  ComponentMask depends;
  std::optional<int> code;
  [[nodiscard]] bool is(int number) const { return code == number; }
};

// `from`: the general combiner, or the program for the final one.
template <class Stage>
Value read(const ComponentFlow& flow, Register r, int component, const Stage& from) {
  const auto i = static_cast<std::size_t>(component);
  if (r == Register::zero) return {{}, 0};
  if (r == Register::constant0 || r == Register::constant1) {
    const bool first = r == Register::constant0;
    if (const auto& name = from.unset[first ? 0 : 1]) return {mask_of(index_of(*name, component)), std::nullopt};
    return {{}, (first ? from.constant0 : from.constant1)[i]};
  }
  return {flow[static_cast<std::size_t>(index_of(r, component))], std::nullopt};
}

Value mapped(const Datapath& d, InputMapping mapping, Value value) {
  if (value.code) value.code = reference::map_input(d, mapping, *value.code);
  return value;
}

// The value domain of portion_walk.h.
class FlowDomain {
 public:
  using Input = Value;
  using Wide = Value;
  using Output = ComponentMask;

  FlowDomain(const Datapath& d, const ProgramStage& stage, ComponentFlow& flow)
      : d_(d), stage_(stage), flow_(flow), mux_(flow[static_cast<std::size_t>(index_of(Register::spare0, kAlpha))]) {}

  Value input(const CombinerInput& in, int component) const {
    return mapped(d_, in.mapping, read(flow_, in.reg, component, stage_));
  }
  static Value product(const Value& x, const Value& y) {
    if (x.is(0) || y.is(0)) return {{}, 0};
    return {x.depends | y.depends, std::nullopt};
  }
  static Value sum(const Value& x, const Value& y) { return {x.depends | y.depends, std::nullopt}; }
  Value mux(const Value& ab, const Value& cd) const { return {mux_ | ab.depends | cd.depends, std::nullopt}; }
  static ComponentMask output(const detail::Target& /*target*/, const Value& wide) { return wide.depends; }
  void write(Register to, int component, ComponentMask depends) {
    flow_[static_cast<std::size_t>(index_of(to, component))] = depends;
  }

 private:
  const Datapath& d_;
  const ProgramStage& stage_;
  ComponentFlow& flow_;
  ComponentMask mux_;
};

ComponentMask color_reads(const Program& program, const ComponentFlow& flow, int component) {
  const FinalCombiner& f = program.final_combiner;
  const auto plain = [&](const CombinerInput& in) {
    const int at = detail::component_of(in.usage, component);
    return mapped(program.datapath, in.mapping, read(flow, in.reg, at, program));
  };
  const auto value = [&](const CombinerInput& in) -> Value {
    if (in.reg == Register::e_times_f) return {plain(f.e).depends | plain(f.f).depends, std::nullopt};
    if (in.reg != Register::spare0_plus_secondary) return plain(in);
    return {read(flow, Register::spare0, component, program).depends |
                read(flow, Register::secondary, component, program).depends,
            std::nullopt};
  };
  if (component == kAlpha) return value(f.g).depends;
  const Value a = value(f.a), b = value(f.b), c = value(f.c);
  const ComponentMask added = value(f.d).depends;
  if (a.is(0)) return c.depends | added;
  if (a.is(program.datapath.one)) return b.depends | added;
  if (b.is(0) && c.is(0)) return added;
  return a.depends | b.depends | c.depends | added;
}

}  // namespace

ComponentFlow flow_through(const Program& program, int from, int to) {
  ComponentFlow flow{};
  for (int i = 0; i < kComponents; ++i) flow[static_cast<std::size_t>(i)] = mask_of(i);
  for (int i = from; i < to; ++i) {
    const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
    FlowDomain domain(program.datapath, stage, flow);
    detail::StageSteps<FlowDomain> steps;
    detail::walk_stage(domain, stage, steps);
  }
  return flow;
}

ComponentMask reads_of(const Program& program, int from, const ProofTarget& target) {
  const ComponentFlow flow = flow_through(program, from, program.num_general_combiners);
  if (target.reg) return flow[static_cast<std::size_t>(index_of(*target.reg, target.component))];
  return color_reads(program, flow, target.component);
}

}  // namespace ninebit::proof
