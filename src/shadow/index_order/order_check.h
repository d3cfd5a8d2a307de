// Checks an order of indices: which patches compare equal, and whether they may.
#pragma once

#include <cstdint>
#include <span>

#include "ninebit/shadow/technique.h"
#include "src/shadow/index_order/borders.h"
#include "src/shadow/index_order/lost_differences.h"
#include "src/shadow/index_order/shadow_relation.h"

namespace ninebit {

// Counts broken borders, and false neighbours over all pairs of patches that any comparison of their codes could lose.
// Uses only the codes: no lattice and nothing that the embedding remembers. `code` has one entry per patch.
void check_order(std::span<const CodeBytes> code, const Borders& borders, ShadowRelation& relation,
                 const LostDifferences& lost, IndexOrderReport& report);

}  // namespace ninebit
