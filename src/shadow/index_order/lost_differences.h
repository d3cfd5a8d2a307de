// The differences of two index codes that a comparison loses.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/frame/index_codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"

namespace ninebit {

// The bytes of a code in the channels of its format, or a difference of two codes. Channels that the format does not
// have are 0.
using CodeBytes = std::array<int, 3>;

[[nodiscard]] constexpr CodeBytes difference(const CodeBytes& a, const CodeBytes& b) {
  return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

// The number of channels of a format: 3, 2 or 1.
[[nodiscard]] int channels_of(IndexFormat format);

// The code's number in IndexCodes(1, format).
[[nodiscard]] std::uint32_t code_number(const CodeBytes& code);

// A table of differences, measured by evaluation: the comparison runs as a program of register combiners, and a
// difference is lost where the alpha that leaves them is byte 0. Which differences are lost depends on the profile, the
// format and the scales. Where the register bits are fewer than the code's, it also depends on the codes.
class LostDifferences {
 public:
  // Reports what index_comparison_state reports.
  [[nodiscard]] static Result<LostDifferences> measure(const HardwareProfile& profile, IndexFormat format,
                                                       IndexScales scales);

  [[nodiscard]] int channels() const { return channels_; }
  // The largest component of a difference that any pair of codes loses; 0: all differences are found.
  [[nodiscard]] int radius() const { return radius_; }
  // Whether every pair of codes with this difference compares equal.
  [[nodiscard]] bool always(const CodeBytes& d) const { return within(d) && verdict_[place(d)] == Verdict::always; }
  // Whether no pair of codes with this difference compares equal.
  [[nodiscard]] bool never(const CodeBytes& d) const { return !within(d) || verdict_[place(d)] == Verdict::never; }
  // All differences but 0 that are always lost.
  [[nodiscard]] const std::vector<CodeBytes>& all_always() const { return always_; }

 private:
  enum class Verdict : std::uint8_t { never, sometimes, always };
  class Comparison;

  explicit LostDifferences(int channels) : channels_(channels) {}
  void find_radius(const Comparison& comparison);
  void judge(const Comparison& comparison);

  [[nodiscard]] bool within(const CodeBytes& d) const {
    const auto in = [this](int v) { return v >= -radius_ && v <= radius_; };
    return in(d[0]) && in(d[1]) && in(d[2]);
  }
  [[nodiscard]] std::size_t place(const CodeBytes& d) const {
    const int side = 2 * radius_ + 1;
    return static_cast<std::size_t>(((d[2] + radius_) * side + d[1] + radius_) * side + d[0] + radius_);
  }

  int channels_;
  int radius_ = 0;
  std::vector<Verdict> verdict_{Verdict::always};
  std::vector<CodeBytes> always_;
};

}  // namespace ninebit
