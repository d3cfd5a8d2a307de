// All cases of a question between two programs, as combinations of independent groups.
//
// Both programs are cut between two general combiners. The components that the rests read there fall into groups: two
// components are in one group if they depend on a common input. Inputs of different groups are independent, so every
// combination of one row of each group is what some input gives, and no other combination is.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "src/study/proof/subject.h"

namespace ninebit::proof {

// A component of one side where it is cut.
struct CutComponent {
  std::size_t side = 0;
  int index = 0;
};

// The values that a group's components take together.
struct CaseGroup {
  std::vector<int> inputs;               // by the component that names them
  std::vector<CutComponent> components;  // of both sides
  std::vector<std::vector<s9>> columns;  // by component: the values, row by row; all rows differ
  std::vector<std::uint32_t> origin;     // by row: bytes of `inputs` that give it, the first one lowest

  [[nodiscard]] std::size_t rows() const { return origin.size(); }
};

struct CaseTable {
  std::array<int, 2> cut{};                            // general combiners before the cut, by side
  std::vector<CaseGroup> groups;                       // that have an input
  std::array<std::array<s9, kComponents>, 2> fixed{};  // by side: components that depend on no input

  // The number of combinations; saturates at the largest number.
  [[nodiscard]] std::uint64_t cases() const;
};

// The table with the fewest cases. `go_on` is called now and then; if it returns false, the result is empty.
[[nodiscard]] std::optional<CaseTable> make_case_table(const std::array<Subject, 2>& sides, const ProofTarget& target,
                                                       const std::function<bool()>& go_on);

}  // namespace ninebit::proof
