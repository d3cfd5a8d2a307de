// Shared by the tests of studies.
#pragma once

#include <gtest/gtest.h>

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

// A change of a text, and what the fault that its reader reports says.
struct Damage {
  std::string from, to, message;
};

// Each damage alone is reported with its line. `read(text)` gives a Result.
template <class Read>
void expect_each_damage_reported(const std::string& text, const std::vector<Damage>& damages, const Read& read) {
  for (const Damage& one : damages) {
    SCOPED_TRACE(one.to);
    std::string damaged = text;
    const std::size_t at = damaged.find(one.from);
    ASSERT_NE(at, std::string::npos);
    damaged.replace(at, one.from.size(), one.to);
    const auto faulty = read(damaged);
    ASSERT_FALSE(faulty.ok());
    EXPECT_NE(faulty.error().text().find(one.message), std::string::npos) << faulty.error().text();
    EXPECT_GT(faulty.error().line, 0);
  }
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
