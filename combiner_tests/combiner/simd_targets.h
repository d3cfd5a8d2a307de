// Every SIMD target that was compiled and that this processor can run.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace ninebit::test {

// Highway's target bits, best first. Never empty.
const std::vector<std::int64_t>& simd_targets();

std::string simd_target_name(std::int64_t target);

// Whether there are several targets; with one, as on Arm, nothing is dispatched, and what ran cannot be told from what
// did not.
bool chosen_at_run_time();

// While it lives, the batch evaluator runs on this target.
class OnTarget {
 public:
  explicit OnTarget(std::int64_t target);
  ~OnTarget();
  OnTarget(const OnTarget&) = delete;
  OnTarget& operator=(const OnTarget&) = delete;

  // Whether something was dispatched since construction, and to this very target.
  [[nodiscard]] bool ran() const { return ran_on(target_); }
  [[nodiscard]] bool ran_on(std::int64_t target) const;

 private:
  std::int64_t target_;
};

}  // namespace ninebit::test
