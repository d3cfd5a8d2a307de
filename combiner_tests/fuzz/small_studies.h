// One small study of each kind, for checks that must hold of all of them.
#pragma once

#include <memory>
#include <string_view>
#include <vector>

#include "ninebit/study/study.h"

namespace ninebit::fuzz {

// Index steps, datapath, AB + CD, a whole program, depth packing, shadows. Made once; aborts if one cannot be made.
[[nodiscard]] const std::vector<std::unique_ptr<Study>>& small_studies();

// Rows that follow a unit's rules: exact values, and otherwise `share` (0 to 1) of the way from the least to the
// greatest.
[[nodiscard]] std::vector<StudyRow> rows_by_rules(const Study& study, std::size_t unit, double share);

}  // namespace ninebit::fuzz
