// A batch program: a program's components as vector operations over planes of 16-bit codes.
//
// Why so, and not otherwise: the rules of arithmetic.inl divide by 255, and their sums need more than 16 bits. Run in
// lanes of 32 bits with real divisions they are ten times slower than what is here. So a batch does not include the
// rules. It takes four steps, each in a file of its own:
//
// 1. This file follows the program once, symbolically, through the same walks as the reference (portion_walk.h,
//    final_walk.h). Every component becomes a value of a ValueGraph. Equal formulas are one value, so that a stage that
//    computes red, green and blue alike from equal inputs is computed once, and what nobody reads is never computed.
// 2. Each value has the range of its codes (value_graph.h). wide_sum.cpp chooses with it the cheapest kernel that is
// exact:
//    additions alone, a product of values without signs in 16 bits, signed products, or 32 bits and floats where the
//    sum does not fit. Most programs need no more than 16 bits, which have twice as many lanes.
// 3. batch_plan.cpp keeps the operations that the outputs need, lets multiplications read their sources through lines
//    (x, 1 - x, 2x - 1), and moves like operations together, so that one kernel runs over several planes.
// 4. batch_kernels.cpp has the kernels, once for each SIMD target. Each has a proof in its comment that its formula
// gives
//    the rules' bits, and tests try every input.
//
// Planes, and not fragments in registers of the processor: an operation's fixed cost is shared by 512 fragments, and 48
// planes of them stay in the first-level cache. A whole-program function made at run time gained 1.14 to 1.27
// (docs/internals/performance.md) for executable memory and a second form of every kernel.
//
// The lines of a mapping are found by calling the reference's map_input, never copied: a rule that changes in
// arithmetic.inl changes both, or a test of all inputs fails.
#include <algorithm>
#include <array>
#include <map>
#include <optional>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/final_walk.h"
#include "ninebit/combiner/portion_walk.h"
#include "src/combiner/batch_plan.h"
#include "src/combiner/wide_sum.h"

namespace ninebit::detail {
namespace {

std::size_t at(int component) {
  return static_cast<std::size_t>(component);
}

// Follows a program symbolically: each register component holds a value of the graph.
class Compiler {
 public:
  Compiler(const Program& program, const ComponentSet& varying_constants, BatchInputs inputs)
      : program_(program), varying_constants_(varying_constants), graph_(program.datapath, inputs) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (int c = 0; c < 4; ++c) registers_[r][at(c)] = graph_.input(static_cast<Register>(r), c);
    }
  }

  VectorCode compile(const BatchOutputs& outputs) {
    for (int i = 0; i < program_.num_general_combiners; ++i) {
      const ProgramStage& stage = program_.general[at(i)];
      General domain(*this, stage);
      StageSteps<General> steps;
      walk_stage(domain, stage, steps);
    }
    std::vector<WantedValue> wanted;
    Final domain(*this);
    FinalSteps<Final> steps;
    walk_final(domain, program_, steps, outputs.color);
    for (int c = 0; c < 4; ++c) {
      if (outputs.color[at(c)]) wanted.push_back({{Space::colors, static_cast<std::uint16_t>(c)}, steps.color[at(c)]});
    }
    for (std::size_t r = 0; outputs.registers && r < kRegisterCount; ++r) {
      for (int c = 0; c < 4; ++c) {
        const Value value = registers_[r][at(c)];
        if (value == graph_.input(static_cast<Register>(r), c)) continue;
        wanted.push_back({{Space::registers, static_cast<std::uint16_t>(4 * r + at(c))}, value});
      }
    }
    return schedule(graph_, wanted);
  }

 private:
  using Registers = std::array<std::array<Value, 4>, kRegisterCount>;

  // The value domain of a general combiner (portion_walk.h).
  class General {
   public:
    using Input = Linear;
    // A sum of products or, with `or_cd`, a mux's AB and CD: output() decides where to choose.
    struct Wide {
      WideSum sum;
      std::optional<WideSum> or_cd{};
    };
    using Output = Value;

    General(Compiler& compiler, const ProgramStage& stage) : compiler_(compiler), stage_(stage) {}

    Linear input(const CombinerInput& in, int component) {
      return compiler_.mapped(compiler_.read(in.reg, component, stage_.constant0, stage_.constant1), in.mapping);
    }
    static Wide product(const Linear& x, const Linear& y) {
      Wide result;
      result.sum.add(x, y);
      return result;
    }
    static Wide sum(const Wide& x, const Wide& y) {
      Wide result{x.sum};
      result.sum.add(y.sum);
      return result;
    }
    static Wide mux(const Wide& ab, const Wide& cd) { return {ab.sum, cd.sum}; }
    Value output(const Target& target, const Wide& wide) {
      const PortionOutput& out = target.out;
      return wide.or_cd ? compiler_.mux(wide.sum, *wide.or_cd, out, stage_.mux_by_lowest_bit)
                        : combiner_output(compiler_.graph_, wide.sum, out.scale, out.bias);
    }
    void write(Register to, int component, Value value) {
      compiler_.registers_[static_cast<std::size_t>(to)][at(component)] = value;
    }

   private:
    Compiler& compiler_;
    const ProgramStage& stage_;
  };

  // The value domain of the final combiner (final_walk.h).
  class Final {
   public:
    using Input = Linear;
    using Code = Value;
    static constexpr bool kEveryStep = false;

    explicit Final(Compiler& compiler)
        : compiler_(compiler), graph_(compiler.graph_), program_(compiler.program_), one_(program_.datapath.one) {}

    Linear input(const CombinerInput& in, int component) {
      Linear linear = map(in.mapping, compiler_.read(in.reg, component, program_.constant0, program_.constant1));
      // Three channels read the value: its positive part is taken once.
      if (in.usage == ComponentUsage::alpha && !linear.is_constant() && linear.floored) {
        linear.value = graph_.chosen({linear.value, true});
        linear.floored = false;
      }
      return linear;
    }
    Linear map(InputMapping mapping, const Value& value) { return compiler_.mapped(value, mapping); }
    Value product(const Linear& e, const Linear& f) {
      WideSum product;
      product.add(e, f);
      return narrow(graph_, product, narrowing());
    }
    Linear sum_part(bool inverted, Register r, int component) {
      const Value value = compiler_.registers_[static_cast<std::size_t>(r)][at(component)];
      return inverted ? map(InputMapping::unsigned_invert, value) : Linear{value, true, 1, 0};
    }
    Value sum(bool clamp, const Linear& spare0, const Linear& secondary) {
      const std::array<Linear, 2> terms{spare0, secondary};
      return graph_.affine(terms, Scale::none, Narrowing::toward_zero, 0, clamp ? one_ : 2 * one_);
    }
    Value rgb(int, const Linear& a, const Linear& b, const Linear& c, const Linear& d) {
      const Linear one_minus_a{a.value, a.floored, -a.factor, one_ - a.offset};
      WideSum mix;
      mix.add(a, b);
      mix.add(one_minus_a, c);
      Narrowed how = narrowing();
      how.added = d;
      return narrow(graph_, mix, how);
    }
    Value alpha(const Linear& g) { return graph_.affine({&g, 1}, Scale::none, Narrowing::toward_zero, 0, one_); }

   private:
    Narrowed narrowing() const { return {.narrowing = program_.datapath.final_narrowing, .low = 0, .high = one_}; }

    Compiler& compiler_;
    ValueGraph& graph_;
    const Program& program_;
    const int one_;
  };

  // A mapping consists of at most two straight lines, which meet at zero or, for values above one, at one. They are
  // read off the reference.
  Linear mapped(Value value, InputMapping mapping) {
    const Datapath& d = program_.datapath;
    const auto rule = [&](int v) { return reference::map_input(d, mapping, v); };
    Range r = graph_.range(value);
    Linear linear{.value = value, .floored = rule(-1) == rule(0), .factor = rule(1) - rule(0), .offset = rule(0)};
    if (r.high > d.one && rule(r.high) != linear.factor * r.high + linear.offset) {
      const Linear itself{value, false, 1, 0};
      linear.value = graph_.affine({&itself, 1}, Scale::none, d.final_narrowing, r.low, d.one);
      r = graph_.range(linear.value);
    }
    return r.low == r.high ? Linear{.offset = rule(r.low)} : linear;
  }

  Value read(Register reg, int component, const Rgba9& constant0, const Rgba9& constant1) {
    const bool varies = varying_constants_.contains(reg, component);
    if (reg == Register::zero) return graph_.constant(0);
    if (reg == Register::constant0 && !varies) return graph_.constant(constant0[at(component)]);
    if (reg == Register::constant1 && !varies) return graph_.constant(constant1[at(component)]);
    return registers_[static_cast<std::size_t>(reg)][at(component)];
  }

  // Rule 11. Lane by lane, the choice may come before or after the rest. Chosen first, the factors of two products need
  // only one multiplication.
  Value mux(const WideSum& ab, const WideSum& cd, const PortionOutput& out, bool by_lowest_bit) {
    const Value by = registers_[static_cast<std::size_t>(Register::spare0)][kAlpha];
    const auto select = [&](const Operand& no, const Operand& yes) {
      return by_lowest_bit ? graph_.select_odd(by, no, yes) : graph_.select(by, no, yes);
    };
    const auto is_product = [&](const WideSum& w) {
      return w.products().size() == 1 && w.constant() == 0 && !is_affine(graph_, w);
    };
    if (out.ab != Register::discard || out.cd != Register::discard || !is_product(ab) || !is_product(cd)) {
      return select({combiner_output(graph_, ab, out.scale, out.bias), false},
                    {combiner_output(graph_, cd, out.scale, out.bias), false});
    }
    const WideSum::Product &p = ab.products()[0], &q = cd.products()[0];
    const auto chosen = [&](const Linear& no, const Linear& yes) {
      const Value value = select(graph_.operand(no), graph_.operand(yes));
      return Linear{value, false, 1, 0};
    };
    WideSum sum;
    sum.add(chosen(p.x, q.x), chosen(p.y, q.y));
    return combiner_output(graph_, sum, out.scale, out.bias);
  }

  const Program& program_;
  const ComponentSet& varying_constants_;
  ValueGraph graph_;
  Registers registers_{};
};

}  // namespace

VectorCode compile_batch(const Program& program, const BatchOutputs& outputs, const ComponentSet& varying_constants,
                         BatchInputs inputs) {
  return Compiler(program, varying_constants, inputs).compile(outputs);
}

namespace {

class Scheduler {
 public:
  explicit Scheduler(const ValueGraph& graph) : graph_(graph), home_(graph.nodes().size()), last_use_(home_.size()) {}

  VectorCode run(const std::vector<WantedValue>& wanted) {
    std::vector<Value> values;
    for (const WantedValue& w : wanted) values.push_back(w.value);
    const std::vector<PlannedOperation> operations = plan(graph_, values);
    for (std::size_t i = 0; i < operations.size(); ++i) {
      for (std::size_t k = 0; k < sources_of(operations[i]); ++k) last_use_[operations[i].of[k]] = i;
    }
    for (const WantedValue& w : wanted) {
      last_use_[w.value] = operations.size();
      // No operation reads a colour's plane, so the wanted value is computed there directly.
      const bool is_operation = graph_.nodes()[w.value].source == Source::operation;
      if (w.plane.space == Space::colors && is_operation && !home_[w.value]) home_[w.value] = w.plane;
    }
    for (std::size_t i = 0; i < operations.size(); ++i) emit(operations[i], i);
    deliver(wanted);
    return std::move(code_);
  }

 private:
  static std::size_t sources_of(const PlannedOperation& operation) {
    return static_cast<std::size_t>(operation.formula.sources());
  }

  PlanePlace new_temporary() {
    if (free_.empty()) return {Space::temporaries, static_cast<std::uint16_t>(code_.temporaries++)};
    const PlanePlace plane = free_.back();
    free_.pop_back();
    return plane;
  }

  PlanePlace constant_plane(int code) {
    const auto [at, is_new] = constants_.try_emplace(code, static_cast<std::uint16_t>(code_.constants.size()));
    if (is_new) code_.constants.emplace_back().lane.fill(static_cast<s9>(code));
    return {Space::constants, at->second};
  }

  PlanePlace plane_of(Value v) {
    const ValueGraph::Node& node = graph_.nodes()[v];
    switch (node.source) {
      case Source::constant:
        return constant_plane(node.number);
      case Source::input:
        code_.reads.add(static_cast<Register>(node.number / 4), node.number % 4);
        return {Space::registers, static_cast<std::uint16_t>(node.number)};
      case Source::operation:
        break;
    }
    return *home_[v];
  }

  // `place` is the operation's place in the order of all.
  void emit(const PlannedOperation& planned, std::size_t place) {
    VectorOperation operation;
    operation.formula = planned.formula;
    operation.lines = planned.lines;
    operation.line = planned.line;
    const std::size_t sources = sources_of(planned);
    for (std::size_t k = 0; k < sources; ++k) operation.source[k] = plane_of(planned.of[k]);
    // Kernels read a lane of all sources before they write that lane, so a source's plane may become the target.
    for (std::size_t k = 0; k < sources; ++k) {
      const PlanePlace plane = operation.source[k];
      const auto here = operation.source.begin() + static_cast<std::ptrdiff_t>(k);
      const bool seen = std::find(operation.source.begin(), here, plane) != here;
      if (last_use_[planned.of[k]] == place && plane.space == Space::temporaries && !seen) free_.push_back(plane);
    }
    std::optional<PlanePlace>& home = home_[planned.value];
    if (!home) home = new_temporary();
    operation.target = *home;
    if (last_ != nullptr && planned.is_like(*last_)) {
      ++code_.operations[first_alike_].alike;
    } else {
      first_alike_ = code_.operations.size();
    }
    last_ = &planned;
    code_.operations.push_back(operation);
  }

  void copy(const PlanePlace& from, const PlanePlace& to) {
    VectorOperation operation;
    operation.source[0] = from;
    operation.target = to;
    code_.operations.push_back(operation);
  }

  // Copies the wanted values that were not computed in place. Registers come last: none is overwritten before all have
  // been read.
  void deliver(const std::vector<WantedValue>& wanted) {
    std::vector<std::pair<PlanePlace, PlanePlace>> late;
    for (const WantedValue& w : wanted) {
      PlanePlace from = plane_of(w.value);
      if (from == w.plane) continue;
      if (w.plane.space == Space::colors) {
        copy(from, w.plane);
        continue;
      }
      if (from.space == Space::registers) {
        const PlanePlace kept = new_temporary();
        copy(from, kept);
        from = kept;
      }
      late.emplace_back(from, w.plane);
    }
    for (const auto& [from, to] : late) copy(from, to);
  }

  const ValueGraph& graph_;
  VectorCode code_;
  std::vector<std::optional<PlanePlace>> home_;
  std::vector<std::size_t> last_use_;
  std::vector<PlanePlace> free_;
  std::map<int, std::uint16_t> constants_;
  const PlannedOperation* last_ = nullptr;  // the last one emitted
  std::size_t first_alike_ = 0;             // the first of the operations that are like it
};

}  // namespace

VectorCode schedule(const ValueGraph& graph, const std::vector<WantedValue>& wanted) {
  return Scheduler(graph).run(wanted);
}

}  // namespace ninebit::detail
