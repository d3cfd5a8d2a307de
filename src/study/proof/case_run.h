// Runs cases of a question through the batch evaluator until the sides differ.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>

#include "src/study/proof/case_table.h"
#include "src/study/proof/proof_side.h"

namespace ninebit::proof {

// Bytes of all inputs, by the component that names them.
using InputBytes = std::array<std::uint8_t, kComponents>;

struct CaseRun {
  bool cancelled = false;
  std::optional<InputBytes> difference;  // inputs for which the sides differ: the first ones in the order of the run
};

// Runs every case of the table. `go_on` gets the part that is done; if it returns false, the run is cancelled.
[[nodiscard]] CaseRun run_all(const std::array<ProofSide, 2>& sides, const ProofTarget& target, const CaseTable& table,
                              const std::function<bool(double)>& go_on);

// Runs so many inputs at random, always the same ones: any bytes, bytes near the ends and the middle, and bytes that
// differ by little.
[[nodiscard]] CaseRun run_random(const std::array<ProofSide, 2>& sides, const ProofTarget& target, std::uint64_t count,
                                 const std::function<bool(double)>& go_on);

}  // namespace ninebit::proof
