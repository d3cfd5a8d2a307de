// Slow and naive models of the register combiners in real numbers, exact and in 32-bit floats. Their only job is to
// judge the library.
//
// Written from the text of NV_register_combiners and from docs/numerics.md alone, like combiner_oracle.h, and in
// another way than what they judge. Exact: after each general combiner all registers are brought to one common
// denominator, a fixed function of the stage's number; nothing is ever reduced. Floats: each operation is done in
// doubles and then rounded to a float, which gives the same as doing it in floats, since a double has more than twice
// the digits and two.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "combiner_tests/oracle/combiner_oracle.h"

namespace ninebit::oracle {

// Digits of 64 bits, the lowest first. The first few need no memory of their own: most numbers have no more.
class Digits {
 public:
  [[nodiscard]] std::size_t size() const { return size_; }
  [[nodiscard]] bool empty() const { return size_ == 0; }
  [[nodiscard]] const std::uint64_t* begin() const { return all_.empty() ? few_.data() : all_.data(); }
  [[nodiscard]] const std::uint64_t* end() const { return begin() + size_; }
  std::uint64_t operator[](std::size_t i) const { return begin()[i]; }
  [[nodiscard]] std::uint64_t* data() { return all_.empty() ? few_.data() : all_.data(); }
  std::uint64_t& operator[](std::size_t i) { return data()[i]; }
  [[nodiscard]] std::uint64_t back() const { return begin()[size_ - 1]; }
  std::uint64_t& back() { return (*this)[size_ - 1]; }

  void push_back(std::uint64_t digit) {
    if (all_.empty() && size_ == few_.size()) all_.assign(few_.begin(), few_.end());
    if (all_.empty()) {
      few_[size_] = digit;
    } else {
      all_.push_back(digit);
    }
    ++size_;
  }
  void pop_back() {
    if (!all_.empty()) all_.pop_back();
    --size_;
  }
  void assign_zeros(std::size_t size) {
    all_.assign(size > few_.size() ? size : 0, 0);
    few_.fill(0);
    size_ = size;
  }

 private:
  std::array<std::uint64_t, 6> few_{};
  std::vector<std::uint64_t> all_;  // instead of `few_`, unless empty
  std::size_t size_ = 0;
};

// A whole number of any size, and a sign.
struct Whole {
  Digits digits;  // the last one is not zero
  bool negative = false;

  Whole() = default;
  Whole(int n);
};
[[nodiscard]] Whole plus(const Whole& x, const Whole& y);
[[nodiscard]] Whole minus(const Whole& x, const Whole& y);
[[nodiscard]] Whole times(const Whole& x, const Whole& y);
[[nodiscard]] Whole times(int n, const Whole& x);
[[nodiscard]] bool less(const Whole& x, const Whole& y);

struct Ratio {
  Whole num;
  Whole den = 1;  // positive
};

// The nearest code, halves up, of a number in [-2, 2].
[[nodiscard]] int nearest_code(const HardwareProfile& profile, const Ratio& x);

// Whether no double is nearer to x; of two equally near ones, whether it is the even one.
[[nodiscard]] bool is_nearest_double(const Ratio& x, double d);

struct ExactOutcome {
  std::array<std::array<Ratio, 4>, kRegisterCount> registers;  // after the last general combiner
  std::array<Ratio, 4> color;                                  // what leaves the final combiner
};
[[nodiscard]] ExactOutcome run_exact(const CombinerState& state, const HardwareProfile& profile,
                                     const Registers& initial);

struct FloatOutcome {
  std::array<std::array<float, 4>, kRegisterCount> registers;
  std::array<float, 4> color;
};
[[nodiscard]] FloatOutcome run_float(const CombinerState& state, const HardwareProfile& profile,
                                     const Registers& initial);

// The codes that the registers and the colour leave as, by the profile's arithmetic (exact or float32).
[[nodiscard]] Outcome run_real(const CombinerState& state, const HardwareProfile& profile, const Registers& initial);

}  // namespace ninebit::oracle
