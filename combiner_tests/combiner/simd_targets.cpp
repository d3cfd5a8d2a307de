#include "combiner_tests/combiner/simd_targets.h"

// As where the library compiles its kernels.
#ifndef HWY_DISABLED_TARGETS
#define HWY_DISABLED_TARGETS (HWY_SVE | HWY_SVE2 | HWY_SVE_256 | HWY_SVE2_128 | HWY_RVV)
#endif
#include "hwy/highway.h"

namespace ninebit::test {

const std::vector<std::int64_t>& simd_targets() {
  static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  return targets;
}

std::string simd_target_name(std::int64_t target) {
  return hwy::TargetName(target);
}

bool chosen_at_run_time() {
  return (HWY_TARGETS & (HWY_TARGETS - 1)) != 0;
}

OnTarget::OnTarget(std::int64_t target) : target_(target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().DeInit();
}

OnTarget::~OnTarget() {
  // As 0 would, but for asking the processor again, which takes a virtual machine long.
  static const std::int64_t all = [] {
    hwy::SetSupportedTargetsForTest(0);
    return hwy::SupportedTargets();
  }();
  hwy::SetSupportedTargetsForTest(all);
  hwy::GetChosenTarget().DeInit();
}

bool OnTarget::ran_on(std::int64_t target) const {
  if (!chosen_at_run_time()) return target == HWY_TARGETS;
  hwy::ChosenTarget expected;
  expected.Update(target);
  const hwy::ChosenTarget& actual = hwy::GetChosenTarget();
  return actual.IsInitialized() && actual.GetIndex() == expected.GetIndex();
}

}  // namespace ninebit::test
