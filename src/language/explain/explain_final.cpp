#include "src/language/explain/explain_final.h"

#include <algorithm>

#include "ninebit/combiner/evaluate.h"

namespace ninebit::explain_detail {
namespace {

// The inputs of the final combiner, with E·F and the colour sum expanded in place.
class FinalInputs {
 public:
  FinalInputs(const Program& program, const Scope& scope) : program_(program), scope_(scope) {}

  [[nodiscard]] Expression value(const CombinerInput& in) const {
    if (in.reg == Register::e_times_f) return mapped_value(d(), in.mapping, e_times_f());
    if (in.reg == Register::spare0_plus_secondary) return mapped_value(d(), in.mapping, color_sum());
    return mapped_input(scope_, in, false);
  }

 private:
  [[nodiscard]] const Datapath& d() const { return *scope_.datapath; }

  [[nodiscard]] Expression e_times_f() const {
    const FinalCombiner& f = program_.final_combiner;
    Expression ef = product(d(), mapped_input(scope_, f.e, false), mapped_input(scope_, f.f, false));
    const auto code = [&](int wide) {
      return reference::narrow(d().final_narrowing, std::max(0, wide), d().one, d().one);
    };
    if (ef.constant) ef.constant = code(*ef.constant);
    ef.range = {code(ef.range.low), code(ef.range.high)};
    return ef;
  }

  [[nodiscard]] Expression color_sum() const {
    const auto rgb = [&](Register reg, bool inverted) {
      const auto mapping = inverted ? InputMapping::unsigned_invert : InputMapping::unsigned_identity;
      return mapped_input(scope_, {reg, mapping, ComponentUsage::rgb}, false);
    };
    Expression e = sum(d(), rgb(Register::spare0, program_.color_sum_invert_spare0),
                       rgb(Register::secondary, program_.color_sum_invert_secondary), 1);
    if (program_.color_sum_clamp && e.range.high > d().one) {
      e.text = "min(1, " + e.text + ")";
      e.binding = Binding::atom;
      e.range.high = d().one;
    }
    return e;
  }

  const Program& program_;
  const Scope& scope_;
};

CombinerInput complement(CombinerInput in) {
  in.mapping =
      in.mapping == InputMapping::unsigned_identity ? InputMapping::unsigned_invert : InputMapping::unsigned_identity;
  return in;
}

// Converts a wide value to a code, in its constant and its range. Wide values that are whole codes are products by 1;
// the text does not show the unit and stays.
Expression as_code(const Datapath& d, Expression wide) {
  if (wide.constant) wide.constant = reference::narrow(d.final_narrowing, *wide.constant, d.one, 2 * d.one);
  wide.range = {wide.range.low / d.one, (wide.range.high + d.one - 1) / d.one};
  return wide;
}

}  // namespace

Expression final_color(const Program& program, const Scope& scope) {
  const Datapath& d = *scope.datapath;
  const FinalCombiner& f = program.final_combiner;
  const FinalInputs inputs(program, scope);
  const Expression b = inputs.value(f.b);
  const Expression c = inputs.value(f.c);
  Expression blend;
  if (f.b == f.c) {
    blend = b;  // whatever A is: A·B + (1 - A)·B is B to the bit
  } else {
    // A cannot exceed one, so 1 - A is the other unsigned mapping of the same register.
    const Expression ab = product(d, inputs.value(f.a), b);
    const Expression rest = product(d, inputs.value(complement(f.a)), c);
    blend = as_code(d, sum(d, ab, rest, d.one));
  }
  return sum(d, blend, inputs.value(f.d), 1);
}

Expression final_alpha(const Program& program, const Scope& scope) {
  return FinalInputs(program, scope).value(program.final_combiner.g);
}

bool is_default_color(const FinalCombiner& f) {
  const FinalCombiner gl;
  return f.a == gl.a && f.b == gl.b && f.c == gl.c && f.d == gl.d;
}

}  // namespace ninebit::explain_detail
