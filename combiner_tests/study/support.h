// Shared by the tests of studies.
#pragma once

#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/study/study.h"

namespace ninebit::test {

inline std::unique_ptr<Study> valid(Result<std::unique_ptr<Study>> study) {
  if (!study) throw std::runtime_error(study.error().text());
  return std::move(study).value();
}

// The rows of all units, in their order.
inline std::vector<StudyRow> all_rows(const Study& study) {
  std::vector<StudyRow> rows;
  for (std::size_t unit = 0; unit < study.units(); ++unit) {
    auto more = study.run(unit, {});
    if (!more) throw std::runtime_error(more.error().text());
    rows.insert(rows.end(), more->begin(), more->end());
  }
  return rows;
}

// geforce2 with few codes, so that everything can be tried: 1.0 is `one`, which is odd, as 255 is.
inline HardwareProfile small_profile(int one) {
  HardwareProfile profile = profiles::geforce2;
  profile.name = "small";
  profile.one.value = one;
  profile.lowest.value = profile.lowest_output.value = -one;
  profile.half.value = (one + 1) / 2;
  profile.expand_offset.value = one;
  return profile;
}

}  // namespace ninebit::test
