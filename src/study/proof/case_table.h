// All cases of a question between two programs, as combinations of independent groups.
//
// Why so, and not otherwise:
//
// A question is whether two programs give the same for all inputs. An input is a byte, and the article's comparison has
// six of them: 2^48 cases. Running them all would take months. A solver of bit vectors answers many such questions,
// but nobody can say before how long it takes. Interval arithmetic is
// fast and proves little, because it forgets that two registers come from the same byte.
//
// This is possible because combiners forget. A register holds 511 codes at most, whatever was multiplied and summed to
// make it. So we cut both programs between two general combiners, look at the registers there that the rest reads, and
// run the rest once for each combination of values that these registers can take together.
//
// "Together" is the hard word. If spare0.r and spare0.g both depend on tex0.r, then running all pairs of their values
// would show differences that no input gives. So components that depend on a common input, on either side, form one
// group. The rows of a group are the values that its components take together, found by running all bytes of the
// group's inputs through the combiners before the cut. Groups share no input, so every combination of rows is what
// some input gives, and no other combination is: the table is exact, neither a sample nor an estimate. A row
// remembers bytes that give it, so that a difference becomes a counterexample in inputs.
//
// - A group with two inputs has 65,536 rows at most and is found at once; three inputs take 2^24 runs, which is a
//   second. A cut that puts four inputs into a group is not tried.
// - Which cut is best cannot be seen beforehand: an early one has few inputs a group, a late one few rows. There are at
//   most nine cuts a side, so the search tries pairs of them and keeps the table with the fewest cases.
// - The two sides may be cut at different places, because equivalent programs need not do the same work in the same
//   combiner.
// - Registers of real numbers take too many values to cut between combiners: such sides are cut before the first one,
//   where the groups are the inputs themselves.
// - If the best table still has too many cases, the solver gets the question; random cases check its proofs.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "src/study/proof/proof_side.h"

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
[[nodiscard]] std::optional<CaseTable> make_case_table(const std::array<ProofSide, 2>& sides, const ProofTarget& target,
                                                       const std::function<bool()>& go_on);

}  // namespace ninebit::proof
