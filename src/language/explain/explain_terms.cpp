#include "src/language/explain/explain_terms.h"

#include <algorithm>
#include <cstdlib>
#include <numeric>
#include <utility>

#include "ninebit/combiner/evaluate.h"

namespace ninebit::explain_detail {
namespace {

const std::string kMinus = "−";

Expression constant_of(int value) {
  Expression e;
  e.constant = value;
  e.range = {value, value};
  return e;
}

bool same(const Expression& a, const Expression& b) {
  return !a.constant && !b.constant && a.text == b.text && a.negative == b.negative;
}

// The range of the product of two codes.
Range product_range(const Expression& a, const Expression& b) {
  return ninebit::product(a.range, b.range, same(a, b));
}

// The reads and marks of both; the caller sets text and range.
Expression joined(const Expression& a, const Expression& b) {
  Expression e;
  e.reads = a.reads;
  e.reads.insert(e.reads.end(), b.reads.begin(), b.reads.end());
  e.marks = a.marks;
  e.marks.insert(b.marks.begin(), b.marks.end());
  return e;
}

std::string parenthesized(const std::string& text) {
  return "(" + text + ")";
}

// The text without its sign as a factor of a product.
std::string factor(const Expression& e) {
  return e.binding < Binding::product ? parenthesized(e.text) : e.text;
}

// A register that an input reads, before its mapping.
Expression fetched(const Scope& scope, const CombinerInput& in, bool in_dot_product) {
  const bool all = in.usage == ComponentUsage::rgb;
  const auto first = static_cast<std::size_t>(all ? kRed : in.usage == ComponentUsage::alpha ? kAlpha : kBlue);
  if (in.reg == Register::zero) return constant_of(0);
  Expression e;
  e.text = short_name(in.reg);
  if (!all) e.text += in.usage == ComponentUsage::alpha ? ".a" : ".blue";
  if (!all && in_dot_product) {
    e.text += in.usage == ComponentUsage::alpha ? "aa" : ".blue.blue";
    e.marks.insert(Mark::swizzle);
  }
  const bool is_constant = in.reg == Register::constant0 || in.reg == Register::constant1;
  if (is_constant && scope.unset[in.reg == Register::constant0 ? 0 : 1]) {
    e.range = {0, scope.datapath->one};
  } else if (is_constant) {
    const Rgba9& value = in.reg == Register::constant0 ? scope.constant0 : scope.constant1;
    const auto last = all ? static_cast<std::size_t>(kBlue) : first;
    const auto [low, high] = std::minmax_element(value.begin() + static_cast<std::ptrdiff_t>(first),
                                                 value.begin() + static_cast<std::ptrdiff_t>(last) + 1);
    e.range = {*low, *high};
    if (*low == *high && (*low == 0 || *low == scope.datapath->one)) return constant_of(*low);
  } else {
    e.range = (*scope.ranges)[static_cast<std::size_t>(in.reg)][in.usage == ComponentUsage::alpha ? 1 : 0];
  }
  e.reads.push_back({in.reg, all && scope.per_channel && !in_dot_product, all ? kRgbBits : 1U << first});
  return e;
}

}  // namespace

std::string with_sign(const Expression& e) {
  if (!e.negative) return e.text;
  return kMinus + factor(e);
}

std::string code_text(const Datapath& d, int code, Marks& marks) {
  return constant_text(d, code, 1, marks);
}

std::string constant_text(const Datapath& d, int value, int unit, Marks& marks) {
  const std::string sign = value < 0 ? kMinus : "";
  const int size = std::abs(value);
  if (size == 0) return "0";
  if (size == d.one * unit) return sign + "1";
  if (size == d.half * unit) {
    marks.insert(Mark::half);
    return sign + "½";
  }
  // Integer codes are printed as codes; only real numbers are reduced to the shortest fraction.
  const int common = d.arithmetic == Arithmetic::integer ? (size % unit == 0 ? unit : 1) : std::gcd(size, d.one * unit);
  return sign + std::to_string(size / common) + "/" + std::to_string(d.one * unit / common);
}

Expression mapped_value(const Datapath& d, InputMapping mapping, const Expression& value) {
  if (value.constant) return constant_of(reference::map_input(d, mapping, *value.constant));
  Expression e = value;
  const bool keeps_sign = mapping == InputMapping::signed_identity || mapping == InputMapping::signed_negate;
  if (!keeps_sign && e.range.low < 0) {
    e.text = "max(0, " + e.text + ")";
    e.binding = Binding::atom;
    e.range.low = 0;
    e.range.high = std::max(0, e.range.high);
    e.marks.insert(Mark::max);
  }
  const bool reversed = mapping == InputMapping::unsigned_invert || mapping == InputMapping::expand_negate ||
                        mapping == InputMapping::half_bias_negate || mapping == InputMapping::signed_negate;
  const int low = reference::map_input(d, mapping, e.range.low);
  const int high = reference::map_input(d, mapping, e.range.high);
  e.range = reversed ? Range{high, low} : Range{low, high};
  switch (mapping) {
    case InputMapping::unsigned_identity:
    case InputMapping::signed_identity:
      return e;
    case InputMapping::signed_negate:
      e.negative = !e.negative;
      return e;
    case InputMapping::unsigned_invert:
      // Only the colour sum can exceed one; inverting it then gives 0.
      if (value.range.high > d.one) e.text = "min(1, " + e.text + ")";
      e.text = "1 " + kMinus + " " +
               (e.binding < Binding::product && value.range.high <= d.one ? parenthesized(e.text) : e.text);
      e.binding = Binding::sum;
      return e;
    case InputMapping::expand_normal:
    case InputMapping::expand_negate:
      e.text = "expand(" + e.text + ")";
      e.binding = Binding::atom;
      e.marks.insert(Mark::expand);
      e.negative = mapping == InputMapping::expand_negate;
      return e;
    case InputMapping::half_bias_normal:
      e.text += " " + kMinus + " ½";
      e.binding = Binding::sum;
      e.marks.insert(Mark::half);
      return e;
    case InputMapping::half_bias_negate:
      e.text = "½ " + kMinus + " " + e.text;
      e.binding = Binding::sum;
      e.marks.insert(Mark::half);
      return e;
  }
  return e;
}

Expression mapped_input(const Scope& scope, const CombinerInput& input, bool in_dot_product) {
  return mapped_value(*scope.datapath, input.mapping, fetched(scope, input, in_dot_product));
}

Expression product(const Datapath& d, const Expression& a, const Expression& b) {
  if (a.is(0) || b.is(0)) return constant_of(0);
  if (a.constant && b.constant) return constant_of(*a.constant * *b.constant);
  if (a.constant) return product(d, b, a);
  Expression e = joined(a, b);
  e.range = product_range(a, b);
  if (b.constant) {
    const int size = std::abs(*b.constant);
    e.negative = a.negative != (*b.constant < 0);
    if (size == d.one) {
      e.text = a.text;
      e.binding = a.binding;
    } else {
      e.text = code_text(d, size, e.marks) + "·" + factor(a);
      e.binding = Binding::product;
    }
    return e;
  }
  e.negative = a.negative != b.negative;
  e.text = factor(a) + " × " + factor(b);
  e.binding = Binding::product;
  e.marks.insert(Mark::product);
  return e;
}

Expression dot_product(const Datapath& d, const Expression& a, const Expression& b) {
  if (a.is(0) || b.is(0)) return constant_of(0);
  if (a.constant && b.constant) return constant_of(3 * *a.constant * *b.constant);
  if (a.constant) return dot_product(d, b, a);
  Expression e = joined(a, b);
  const Range each_range = product_range(a, b);
  e.range = {3 * each_range.low, 3 * each_range.high};
  std::string second = b.text;
  e.negative = a.negative != b.negative;
  if (b.constant) {
    const std::string each = code_text(d, std::abs(*b.constant), e.marks);
    e.negative = a.negative != (*b.constant < 0);
    second = parenthesized(each + ", " + each + ", " + each);
  }
  e.text = "dot(" + a.text + ", " + second + ")";
  e.binding = Binding::atom;
  e.marks.insert(Mark::dot);
  return e;
}

Expression sum(const Datapath& d, const Expression& a, const Expression& b, int unit) {
  if (a.is(0)) return b;
  if (b.is(0)) return a;
  if (a.constant && b.constant) return constant_of(*a.constant + *b.constant);
  const auto is_minus = [](const Expression& e) { return e.constant ? *e.constant < 0 : e.negative; };
  const bool by_sign = is_minus(a) && !is_minus(b);
  if (by_sign || (a.constant && is_minus(a) == is_minus(b))) return sum(d, b, a, unit);
  Expression e = joined(a, b);
  e.range = a.range + b.range;
  const auto operand = [&](const Expression& x, Binding too_loose) {
    if (x.constant) return constant_text(d, std::abs(*x.constant), unit, e.marks);
    return x.binding <= too_loose ? parenthesized(x.text) : x.text;
  };
  const std::string first = (is_minus(a) ? kMinus : "") + operand(a, is_minus(a) ? Binding::sum : Binding::choice);
  const std::string second = operand(b, is_minus(b) ? Binding::sum : Binding::choice);
  e.text = first + (is_minus(b) ? " " + kMinus + " " : " + ") + second;
  e.binding = Binding::sum;
  return e;
}

Picks mux_picks(const Datapath& d, bool by_lowest_bit, Range spare0_alpha) {
  const auto pick = [](bool cd) { return cd ? Picks::cd : Picks::ab; };
  if (by_lowest_bit) {
    const int low = std::max(0, spare0_alpha.low), high = std::max(0, spare0_alpha.high);
    // The codes for real numbers are finer here than in the program; only zero is the same in both.
    const bool is_known = low == high && (low == 0 || d.arithmetic == Arithmetic::integer);
    return is_known ? pick(low % 2 == 1) : Picks::either;
  }
  const bool cd = spare0_alpha.low >= d.half;
  return cd || spare0_alpha.high < d.half ? pick(cd) : Picks::either;
}

Expression choice(const Datapath& d, const Expression& ab, const Expression& cd, bool by_lowest_bit,
                  Range spare0_alpha) {
  if ((ab.constant && ab.constant == cd.constant) || same(ab, cd)) return ab;
  const Read reads_alpha{Register::spare0, false, kAlphaBit};
  if (const Picks picks = mux_picks(d, by_lowest_bit, spare0_alpha); picks != Picks::either) {
    Expression side = picks == Picks::ab ? ab : cd;
    side.reads.push_back(reads_alpha);  // the equation that wrote this alpha decides the side
    return side;
  }
  Expression e = joined(ab, cd);
  e.range = either(ab.range, cd.range);
  const auto branch = [&](const Expression& x) {
    return x.constant ? constant_text(d, *x.constant, d.one, e.marks) : with_sign(x);
  };
  e.text = (by_lowest_bit ? "odd(spare0.a) ? " : "spare0.a ≥ ½ ? ") + branch(cd) + " : " + branch(ab);
  e.binding = Binding::choice;
  e.marks.insert(by_lowest_bit ? Mark::odd : Mark::half);
  e.reads.push_back(reads_alpha);
  return e;
}

Expression combiner_output(const Datapath& d, Scale scale, Bias bias, const Expression& wide) {
  if (wide.constant) {
    Expression e = constant_of(reference::combiner_output(d, scale, bias, *wide.constant));
    e.reads = wide.reads;  // a mux that can pick only this side has read the deciding alpha
    return e;
  }
  Expression e = bias == Bias::none ? wide : sum(d, wide, constant_of(-d.half * d.one), d.one);
  const int twice = scale == Scale::by_one_half ? 1 : scale == Scale::none ? 2 : scale == Scale::by_two ? 4 : 8;
  const auto code = [&](int value, bool up) {
    const int n = value * twice;
    const int divisor = 2 * d.one;
    const int down = n >= 0 ? n / divisor : -((-n + divisor - 1) / divisor);
    return up && down * divisor != n ? down + 1 : down;
  };
  e.range = {code(e.range.low, false), code(e.range.high, true)};
  if (scale == Scale::none) return e;
  if (scale == Scale::by_one_half) {
    e.text = factor(e) + " / 2";
  } else {
    const std::string factor = scale == Scale::by_two ? "2·" : "4·";
    e.text = factor + (e.binding < Binding::atom ? parenthesized(e.text) : e.text);
  }
  e.binding = Binding::product;
  return e;
}

}  // namespace ninebit::explain_detail
