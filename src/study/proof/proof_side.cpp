#include "src/study/proof/proof_side.h"

#include <algorithm>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/portion_walk.h"
#include "src/combiner/given_registers.h"

namespace ninebit::proof {
namespace {

constexpr std::array kConstants{Register::constant0, Register::constant1};
constexpr Portion kDead{{}, {}, {}, {}, {.sum = Register::discard}};

}  // namespace

ProofInput input_at(int index, std::uint8_t byte) {
  if (!is_constant(index)) return {register_at(index), index % 4, byte, {}};
  const int first = index < kRegisterComponents ? index_of(ConstantName{0}, 0) : index_of(ConstantName{2}, 0) - 2 * 4;
  return {Register::zero, index % 4, byte, static_cast<ConstantName>((index - first) / 4)};
}

ProofSide::ProofSide(const ProofSubject& from, const std::vector<ProofInput>& fixed)
    : profile(from.profile), program(normalize(from.state, from.profile)) {
  // With all inputs at 0, what the profile decides is what is left.
  FragmentInputs inputs;
  if (!from.fog_off) inputs.fog_factor = 0;
  for (std::size_t unit = 0; unit < 4; ++unit) {
    if (!from.texture_off[unit]) inputs.texture[unit] = Texel{};
  }
  const RegisterFile registers = initial_registers(profile, inputs);
  const auto input = [&](Register r, int component, Register named) {
    start[static_cast<std::size_t>(index_of(r, component))].input = index_of(named, component);
  };
  for (int i = 0; i < kRegisterComponents; ++i) {
    start[static_cast<std::size_t>(i)].code = registers[register_at(i)][static_cast<std::size_t>(i % 4)];
  }
  for (int c = 0; c < 4; ++c) {
    input(Register::primary, c, Register::primary);
    if (c != kAlpha || !from.fog_off) input(Register::fog, c, Register::fog);
    const bool has_one = c == kAlpha && profile.secondary_alpha == SecondaryAlpha::one;
    if (!has_one) input(Register::secondary, c, Register::secondary);
    for (int unit = 0; unit < 4; ++unit) {
      const Register r = texture_register(unit);
      if (!from.texture_off[static_cast<std::size_t>(unit)]) input(r, c, r);
    }
  }
  if (!from.texture_off[0]) input(Register::spare0, kAlpha, Register::texture0);
  for (int i = index_of(Register::fog, 0); i < kRegisterComponents; ++i) components.push_back(i);
  for (const ConstantName name : unset_constants(program)) {
    for (int c = 0; c < 4; ++c) {
      components.push_back(index_of(name, c));
      start[static_cast<std::size_t>(components.back())].input = components.back();
    }
  }
  for (const ProofInput& one : fixed) {
    const int named = one.constant ? index_of(*one.constant, one.component) : index_of(one.reg, one.component);
    for (Source& source : start) {
      if (source.input == named) source = {-1, from_byte(profile, one.byte)};
    }
  }
}

bool ProofSide::runs_in_rows() const {
  return !unset_constants(program).empty() && (!is_integer() || !varying_constants(program));
}

int ProofSide::evaluate(const ProofTarget& target, const std::array<std::uint8_t, kComponents>& bytes) const {
  RegisterFile registers;
  Program with_constants = program;
  for (const int i : components) {
    const Source& from = start[static_cast<std::size_t>(i)];
    const s9 code = from.input < 0 ? from.code : from_byte(profile, bytes[static_cast<std::size_t>(from.input)]);
    if (is_constant(i)) {
      replace_unset_constant(with_constants, *input_at(i, 0).constant, i % 4, code);
    } else {
      registers[register_at(i)][static_cast<std::size_t>(i % 4)] = code;
    }
  }
  const EvaluatedFragment fragment = evaluate_fragment(with_constants, registers);
  const Rgba9& value = target.reg ? fragment.registers[*target.reg] : fragment.color;
  return shown(target, value[static_cast<std::size_t>(target.component)]);
}

Program first_combiners(const Program& program, int count) {
  Program part = program;
  part.num_general_combiners = count;
  return part;
}

Program later_combiners(const Program& program, int count) {
  Program tail = program;
  const auto from = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < tail.general.size(); ++i) {
    if (i + from < tail.general.size()) {
      tail.general[i] = program.general[i + from];
    } else {
      tail.general[i] = {};
      tail.general[i].rgb = tail.general[i].alpha = kDead;
    }
  }
  tail.num_general_combiners = std::max(program.num_general_combiners - count, 1);
  return tail;
}

BatchOutputs outputs_for(const ProofTarget& target) {
  BatchOutputs outputs;
  outputs.registers = target.reg.has_value();
  for (int c = 0; c < 4; ++c) outputs.color[static_cast<std::size_t>(c)] = !target.reg && c == target.component;
  return outputs;
}

SideBatch::SideBatch(const ProofSide& side, const std::optional<Program>& program, const BatchOutputs& outputs)
    : side_(side),
      program_(program),
      outputs_(outputs),
      registers_(std::make_unique<RegisterBatch>()),
      constants_(static_cast<std::size_t>(std::count_if(side.components.begin(), side.components.end(), is_constant))) {
  if (!program_ || side.runs_in_rows()) return;
  varying_ = *varying_constants(side.program);
  ComponentSet varying;
  for (std::size_t which = 0; which < 2; ++which) {
    for (int c = 0; varying_[which] && c < 4; ++c) varying.add(kConstants[which], c);
  }
  batch_.emplace(*program_, outputs_, varying);
}

s9* SideBatch::plane(int index) {
  if (!is_constant(index)) return (*registers_)(register_at(index), index % 4);
  const auto first = std::find_if(side_.components.begin(), side_.components.end(), is_constant);
  const auto at = std::find(first, side_.components.end(), index);
  return constants_[static_cast<std::size_t>(at - first)].data();
}

void SideBatch::run(std::size_t count, OutputBatch& out) {
  if (!program_) return;
  if (!batch_) return run_in_rows(count, out);
  for (std::size_t which = 0; which < 2; ++which) {
    for (int c = 0; varying_[which] && c < 4; ++c) {
      std::copy_n(plane(index_of(*varying_[which], c)), count, (*registers_)(kConstants[which], c));
    }
  }
  batch_->run(*registers_, count, out);
}

void SideBatch::run_in_rows(std::size_t count, OutputBatch& out) {
  for (std::size_t k = 0; k < count; ++k) {
    RegisterFile file;
    for (const int i : side_.components) {
      const s9 code = plane(i)[k];
      if (is_constant(i)) {
        replace_unset_constant(*program_, *input_at(i, 0).constant, i % 4, code);
      } else {
        file[register_at(i)][static_cast<std::size_t>(i % 4)] = code;
      }
    }
    const EvaluatedFragment result = evaluate_fragment(*program_, file);
    for (std::size_t c = 0; c < 4; ++c) out.plane[c][k] = result.color[c];
    for (const int i : side_.components) {
      if (!outputs_.registers || is_constant(i)) continue;
      plane(i)[k] = result.registers[register_at(i)][static_cast<std::size_t>(i % 4)];
    }
  }
}

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
