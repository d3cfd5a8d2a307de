#include "src/combiner/real_batch.h"

#include <array>
#include <optional>

#include "ninebit/combiner/portion_walk.h"
#include "src/combiner/exact_field.h"
#include "src/combiner/real_rules.h"

namespace ninebit {
namespace {

// The registers that a program may read or write. The others need no numbers.
class UsedRegisters {
 public:
  explicit UsedRegisters(const Program& program) {
    use(Register::spare0);
    for (int i = 0; i < program.num_general_combiners; ++i) {
      const ProgramStage& stage = program.general[static_cast<std::size_t>(i)];
      for (const Portion* const p : {&stage.rgb, &stage.alpha}) {
        for (const Register r : {p->a.reg, p->b.reg, p->c.reg, p->d.reg}) use(r);
        const PortionName name = p == &stage.rgb ? PortionName::rgb : PortionName::alpha;
        for (int c = detail::first_component(name); c < detail::end_component(name); ++c) {
          for (std::size_t k = 0; k < 3; ++k) {
            detail::for_each_write({p->out, k, c}, [&](Register r, int component) {
              use(r);
              written[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)] = true;
            });
          }
        }
      }
    }
    const FinalCombiner& f = program.final_combiner;
    for (const CombinerInput& in : {f.a, f.b, f.c, f.d, f.e, f.f, f.g}) use(in.reg);
    use(Register::secondary);
  }

  std::array<bool, kRegisterCount> used{};
  std::array<std::array<bool, 4>, kRegisterCount> written{};

 private:
  void use(Register r) {
    const auto i = static_cast<std::size_t>(r);
    if (i < kRegisterCount && r != Register::zero && r != Register::constant0 && r != Register::constant1) {
      used[i] = true;
    }
  }
};

// Evaluates one fragment after another in one kind of numbers.
template <class Field>
class Runner {
 public:
  explicit Runner(const Program& program)
      : program_(program), field_(program.datapath.one), combiners_(field_), registers_{} {}

  Field& field() { return field_; }

  // code(r, c) returns the code of a register's component. deliver() passes the results to put(r, c, code) and
  // put_color(c, code).
  template <class Code>
  void compute(const UsedRegisters& registers, const Code& code) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      if (!registers.used[r]) continue;
      for (std::size_t c = 0; c < 4; ++c) registers_[r][c] = field_.of_code(code(r, c));
    }
    for (int i = 0; i < program_.num_general_combiners; ++i) {
      combiners_.run_general(program_.general[static_cast<std::size_t>(i)], registers_, stage_);
    }
    combiners_.run_final(program_, registers_, final_);
  }

  template <class Put, class PutColor>
  void deliver(const UsedRegisters& registers, const Put& put, const PutColor& put_color) {
    for (std::size_t r = 0; r < kRegisterCount; ++r) {
      for (std::size_t c = 0; c < 4; ++c) {
        if (registers.written[r][c]) put(r, c, static_cast<s9>(field_.nearest_code(registers_[r][c])));
      }
    }
    for (std::size_t c = 0; c < 4; ++c) put_color(c, static_cast<s9>(field_.nearest_code(final_.steps.color[c])));
  }

  RealColor color() {
    RealColor result{};
    for (std::size_t c = 0; c < 4; ++c) result[c] = field_.approximate(final_.steps.color[c]);
    return result;
  }

 private:
  const Program& program_;
  Field field_;
  RealCombiners<Field> combiners_;
  typename RealCombiners<Field>::Registers registers_;
  typename RealCombiners<Field>::Stage stage_;
  typename RealCombiners<Field>::Final final_;
};

// Evaluates one fragment after another in the smallest kind of numbers that holds the program's values.
class RealProgram {
 public:
  explicit RealProgram(const Program& program) : program_(program), registers_(program) {
    if (program.datapath.arithmetic == Arithmetic::float32) {
      floats_.emplace(program);
    } else {
      small_.emplace(program);
    }
  }

  template <class Code, class Put, class PutColor>
  void run(const Code& code, const Put& put, const PutColor& put_color) {
    if (floats_) {
      floats_->compute(registers_, code);
      floats_->deliver(registers_, put, put_color);
      return;
    }
    // After a few overflows small integers are no longer tried: the size of a program's numbers hardly depends on the
    // fragment.
    if (tries_ > 0) {
      small_->field().integers().forget_overflow();
      small_->compute(registers_, code);
      if (!small_->field().integers().overflowed()) {
        small_->deliver(registers_, put, put_color);
        if (!small_->field().integers().overflowed()) return;
      }
      --tries_;
    }
    if (!big_) big_.emplace(program_);
    big_->compute(registers_, code);
    big_->deliver(registers_, put, put_color);
  }

 private:
  const Program& program_;
  UsedRegisters registers_;
  std::optional<Runner<FloatField>> floats_;
  std::optional<Runner<ExactField<SmallIntegers>>> small_;
  std::optional<Runner<ExactField<BigIntegers>>> big_;
  int tries_ = 16;
};

}  // namespace

void evaluate_real_batch(const Program& program, RegisterBatch& registers, std::size_t count, OutputBatch& out) {
  RealProgram real(program);
  for (std::size_t i = 0; i < count; ++i) {
    real.run([&](std::size_t r, std::size_t c) { return registers.plane[r][c][i]; },
             [&](std::size_t r, std::size_t c, s9 code) { registers.plane[r][c][i] = code; },
             [&](std::size_t c, s9 code) { out.plane[c][i] = code; });
  }
}

EvaluatedFragment evaluate_fragment(const Program& program, const RegisterFile& initial) {
  EvaluatedFragment result{initial, {}};
  if (program.datapath.arithmetic == Arithmetic::integer) {
    evaluate_general(program, result.registers);
    result.color = evaluate_final(program, result.registers);
    return result;
  }
  RealProgram real(program);
  real.run([&](std::size_t r, std::size_t c) { return initial.value[r][c]; },
           [&](std::size_t r, std::size_t c, s9 code) { result.registers.value[r][c] = code; },
           [&](std::size_t c, s9 code) { result.color[c] = code; });
  return result;
}

struct ExactColors::Runners {
  explicit Runners(const Program& p) : program(p), registers(p), small(p) {}

  const Program& program;
  UsedRegisters registers;
  Runner<ExactField<SmallIntegers>> small;
  std::optional<Runner<ExactField<BigIntegers>>> big{};
  int tries = 16;  // as in RealProgram
};

ExactColors::ExactColors(const Program& program) : runners_(std::make_unique<Runners>(program)) {}
ExactColors::~ExactColors() = default;
ExactColors::ExactColors(ExactColors&&) noexcept = default;

RealColor ExactColors::operator()(const RegisterFile& initial) {
  Runners& r = *runners_;
  const auto code = [&](std::size_t reg, std::size_t c) { return initial.value[reg][c]; };
  if (r.tries > 0) {
    r.small.field().integers().forget_overflow();
    r.small.compute(r.registers, code);
    if (!r.small.field().integers().overflowed()) return r.small.color();
    --r.tries;
  }
  if (!r.big) r.big.emplace(r.program);
  r.big->compute(r.registers, code);
  return r.big->color();
}

Rgba9 detail::evaluate_real_final(const Program& program, const RegisterFile& registers) {
  Program last = program;
  last.num_general_combiners = 0;
  return evaluate_fragment(last, registers).color;
}

}  // namespace ninebit
