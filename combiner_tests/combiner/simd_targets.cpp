#include "combiner_tests/combiner/simd_targets.h"

#include "hwy/highway.h"

namespace ninebit::test {

const std::vector<std::int64_t>& simd_targets() {
  static const std::vector<std::int64_t> targets = hwy::SupportedAndGeneratedTargets();
  return targets;
}

std::string simd_target_name(std::int64_t target) {
  return hwy::TargetName(target);
}

OnTarget::OnTarget(std::int64_t target) : target_(target) {
  hwy::SetSupportedTargetsForTest(target);
  hwy::GetChosenTarget().DeInit();
}

OnTarget::~OnTarget() {
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
}

bool OnTarget::ran_on(std::int64_t target) const {
  hwy::ChosenTarget expected;
  expected.Update(target);
  const hwy::ChosenTarget& actual = hwy::GetChosenTarget();
  return actual.IsInitialized() && actual.GetIndex() == expected.GetIndex();
}

}  // namespace ninebit::test
