// The random numbers of all tests.
#pragma once

#include <cstdint>
#include <initializer_list>
#include <string_view>

namespace ninebit::test {

// SplitMix64: the same numbers from the same seed with every compiler and library.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  // Case `index` of a run with `seed`; it needs no earlier case.
  Random(std::uint64_t seed, std::uint64_t index) : state_(seed) { state_ = next() ^ (index * 0xD1342543DE82EF95U); }

  // The numbers are those bytes, one a number and repeated to fill it, and zeros behind the last: what a fuzzer changes
  // in a byte changes one number. 0x01010101 has no factor below 257, so below(n) can be everything.
  explicit Random(std::string_view bytes) : bytes_(bytes), of_bytes_(true) {}

  std::uint64_t next() {
    if (of_bytes_) {
      if (bytes_.empty()) return 0;
      const auto byte = static_cast<unsigned char>(bytes_.front());
      bytes_.remove_prefix(1);
      return byte * std::uint64_t{0x0101010101010101U};
    }
    state_ += 0x9E3779B97F4A7C15U;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xBF58476D1CE4E5B9U;
    z = (z ^ (z >> 27)) * 0x94D049BB133111EBU;
    return z ^ (z >> 31);
  }
  // A whole number in [0, count), count > 0.
  // cppcheck-suppress zerodiv  // it thinks of texts that might be empty
  int below(int count) { return static_cast<int>((next() >> 32) % static_cast<std::uint64_t>(count)); }
  // One in [low, high].
  int between(int low, int high) { return low + below(high - low + 1); }
  bool one_in(int n) { return below(n) == 0; }
  // A real number in [low, high).
  double real(double low, double high) { return low + (high - low) * static_cast<double>(next() >> 11) * 0x1p-53; }
  float real_f(double low, double high) { return static_cast<float>(real(low, high)); }
  std::uint8_t byte() { return static_cast<std::uint8_t>(next() & 255); }
  template <class T>
  T pick(std::initializer_list<T> values) {
    return values.begin()[below(static_cast<int>(values.size()))];
  }

 private:
  std::uint64_t state_ = 0;
  std::string_view bytes_{};
  bool of_bytes_ = false;
};

}  // namespace ninebit::test
