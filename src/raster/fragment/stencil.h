// The stencil test and its operations for fragments of one facing, decided once a draw.
#pragma once

#include <array>
#include <cstdint>

#include "ninebit/raster/pipeline_state.h"

namespace ninebit {

// The result of an operation on a stored value of `bits` bits; both values fit these bits. Applies no mask.
[[nodiscard]] std::uint8_t stencil_result(StencilOperation operation, std::uint8_t stored, std::uint8_t reference,
                                          int bits);

// A byte of the stencil plane holds a value in its low `bits` bits (1 to 8). The other bits are neither compared
// nor changed.
class StencilSide {
 public:
  StencilSide() = default;
  StencilSide(const StencilFace& face, int bits);

  [[nodiscard]] bool passes(std::uint8_t stored) const { return compare(function_, reference_, stored & mask_); }
  // The new value after a fragment that failed this test, that passed it but not the depth test, or that passed both.
  [[nodiscard]] std::uint8_t after_fail(std::uint8_t stored) const { return fail_[stored]; }
  [[nodiscard]] std::uint8_t after_depth_fail(std::uint8_t stored) const { return depth_fail_[stored]; }
  [[nodiscard]] std::uint8_t after_depth_pass(std::uint8_t stored) const { return depth_pass_[stored]; }

  // Whether a fragment that is not drawn leaves every stored value as it was; whether any fragment does.
  [[nodiscard]] bool failing_changes_nothing() const { return failing_changes_nothing_; }
  [[nodiscard]] bool changes_nothing() const { return failing_changes_nothing_ && passing_changes_nothing_; }

 private:
  using Table = std::array<std::uint8_t, 256>;  // stored value to new value

  CompareFunction function_ = CompareFunction::always;
  std::uint8_t reference_ = 0;  // masked
  std::uint8_t mask_ = 0;
  bool failing_changes_nothing_ = true;
  bool passing_changes_nothing_ = true;
  Table fail_{}, depth_fail_{}, depth_pass_{};
};

}  // namespace ninebit
