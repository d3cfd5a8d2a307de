#include "combiner_tests/language/explain_reader.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <string>

namespace ninebit::test {
namespace {

Real3 splat(double v) {
  return {v, v, v};
}

template <class F>
Real3 each(const Real3& a, const Real3& b, F f) {
  return {f(a[0], b[0]), f(a[1], b[1]), f(a[2], b[2])};
}

class Reader {
 public:
  Reader(std::string_view text, const Datapath& d, RegisterFile registers)
      : rest_(text), d_(d), registers_(registers) {}

  Real3 whole() {
    const Real3 value = expression();
    if (!rest_.empty()) fail("the end");
    return value;
  }

 private:
  [[noreturn]] void fail(const std::string& expected) const {
    throw std::runtime_error("expected " + expected + " before '" + std::string(rest_) + "'");
  }
  bool accept(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }
  void expect(std::string_view token) {
    if (!accept(token)) fail(std::string(token));
  }

  Real3 expression() {
    if (accept("odd(")) {
      const Real3 code = named();
      expect(") ? ");
      const Real3 yes = expression();
      expect(" : ");
      const Real3 no = expression();
      return std::lround(std::max(code[0], 0.0) * d_.one) % 2 != 0 ? yes : no;
    }
    const Real3 left = sum();
    if (!accept(" ≥ ")) return left;
    const Real3 right = product();
    expect(" ? ");
    const Real3 yes = expression();
    expect(" : ");
    const Real3 no = expression();
    return left[0] >= right[0] ? yes : no;
  }

  Real3 sum() {
    const bool negative = accept("−");
    Real3 total = product();
    if (negative) total = each(total, total, [](double v, double) { return -v; });
    while (true) {
      if (accept(" + ")) {
        total = each(total, product(), [](double a, double b) { return a + b; });
      } else if (accept(" − ")) {
        total = each(total, product(), [](double a, double b) { return a - b; });
      } else {
        return total;
      }
    }
  }

  Real3 product() {
    Real3 value = atom();
    while (true) {
      if (accept("·") || accept(" × ")) {
        value = each(value, atom(), [](double a, double b) { return a * b; });
      } else if (accept(" / ") || accept("/")) {
        value = each(value, atom(), [](double a, double b) { return a / b; });
      } else {
        return value;
      }
    }
  }

  Real3 call(double (*f)(double, double), double fixed) {
    expect(", ");
    const Real3 value = expression();
    expect(")");
    return each(value, splat(fixed), f);
  }

  Real3 atom() {
    if (accept("½")) return splat(d_.arithmetic == Arithmetic::integer ? real(d_.half) : 0.5);
    if (accept("max(0")) return call([](double a, double b) { return std::max(a, b); }, 0.0);
    if (accept("min(1")) return call([](double a, double b) { return std::min(a, b); }, 1.0);
    if (accept("expand(")) {
      const Real3 value = expression();
      expect(")");
      const double offset = d_.arithmetic == Arithmetic::integer ? real(d_.expand_offset) : 1.0;
      return each(value, splat(offset), [](double a, double b) { return 2.0 * a - b; });
    }
    if (accept("dot(")) {
      const Real3 a = expression();
      expect(", ");
      const Real3 b = expression();
      expect(")");
      return splat(a[0] * b[0] + a[1] * b[1] + a[2] * b[2]);
    }
    if (accept("(")) {
      const Real3 first = expression();
      if (accept(")")) return first;
      expect(", ");
      const Real3 second = expression();
      expect(", ");
      const Real3 third = expression();
      expect(")");
      return {first[0], second[1], third[2]};
    }
    if (!rest_.empty() && std::isdigit(static_cast<unsigned char>(rest_.front())) != 0) return number();
    return named();
  }

  Real3 number() {
    double value = 0.0;
    while (!rest_.empty() && std::isdigit(static_cast<unsigned char>(rest_.front())) != 0) {
      value = value * 10.0 + (rest_.front() - '0');
      rest_.remove_prefix(1);
    }
    return splat(value);
  }

  Real3 named() {
    constexpr std::array<std::pair<std::string_view, Register>, 11> kNames{{{"const0", Register::constant0},
                                                                            {"const1", Register::constant1},
                                                                            {"fog", Register::fog},
                                                                            {"primary", Register::primary},
                                                                            {"secondary", Register::secondary},
                                                                            {"spare0", Register::spare0},
                                                                            {"spare1", Register::spare1},
                                                                            {"tex0", Register::texture0},
                                                                            {"tex1", Register::texture1},
                                                                            {"tex2", Register::texture2},
                                                                            {"tex3", Register::texture3}}};
    for (const auto& [name, reg] : kNames) {
      if (!accept(name)) continue;
      const Rgba9& codes = registers_[reg];
      if (accept(".aaa") || accept(".a")) return splat(real(codes[kAlpha]));
      if (accept(".blue.blue.blue") || accept(".blue")) return splat(real(codes[kBlue]));
      return {real(codes[kRed]), real(codes[kGreen]), real(codes[kBlue])};
    }
    fail("a name");
  }

  [[nodiscard]] double real(int code) const { return static_cast<double>(code) / d_.one; }

  std::string_view rest_;
  const Datapath& d_;
  RegisterFile registers_;
};

}  // namespace

Real3 value_of(std::string_view expression, const Datapath& datapath, const RegisterFile& registers,
               const Rgba9& constant0, const Rgba9& constant1) {
  RegisterFile all = registers;
  all[Register::constant0] = constant0;
  all[Register::constant1] = constant1;
  return Reader(expression, datapath, all).whole();
}

}  // namespace ninebit::test
