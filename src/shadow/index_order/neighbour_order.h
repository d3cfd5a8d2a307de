// Index codes that neighbours cannot be told apart by.
//
// Why so, and not otherwise:
//
// The article numbers polygons in the order of the file. Where two polygons meet, a pixel may look up a texel whose
// centre lies across the edge: the indices differ, and a dark line shows. One index for an object has no lines, but the
// object casts no shadow on itself. Both are the same question: which polygons may compare equal?
//
// Two polygons may, if neither can shadow the other. A surface that is flat or bends outward cannot shadow the side
// of itself that faces the light, so its polygons become one patch with one code (patches.h). But where patches meet at
// an edge they must differ from other patches and still compare equal across the edge, and "equal" is not transitive
// along a closed surface: with one code for all that meet, the whole object would have one.
//
// The comparison itself gives the way out. It squares nine-bit differences and drops the low bits, so it loses small
// differences: (1, -1, 1) compares equal to 0. It is a tolerance, not an equality. Codes are then points of a lattice,
// one axis a channel; codes within the tolerance are equal, all others differ. Neighbours get near codes, patches that
// could shadow one another get codes that are not near, and everything else is free. That is the embedding of a graph
// in a lattice (code_embedding.h): the surface is laid into the cube of codes like a crumpled sheet.
//
// - The tolerance is measured by running the combiners (lost_differences.h), not derived: it depends on the profile,
//   the format and the scales, and a formula for each would be a second arithmetic.
// - The embedding is greedy, the patch with the longest border first. Exact embedding is a problem of integers with as
//   many unknowns as patches; the engine has 14,561 of them. A border that does not fit is broken and shows as a joint,
//   as in the article: it costs a thin line. The other error, a lost shadow, is never made: a code that could confuse
//   a patch with one that it may shadow is not taken, whatever border it would mend.
// - Whether patches can shadow one another (lost_differences.h) is decided from planes and corners alone, without the
//   light, so that the codes stay the same while the light moves, but for a light inside a closed room. The answer may
//   be a needless yes, never a wrong no by more than the relief.
// - check_order() counts again from the codes alone, without the lattice, because an embedding that checks itself with
//   its own memory would repeat its own mistake.
// - If the lattice is too full for this, codes are counted out at its spacing, where nothing is lost; if there are
//   fewer of these than patches, that is an error. If the comparison loses no difference (real numbers do not), the
//   order of the file is used, and the report says so.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/frame/settings.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/technique.h"
#include "src/shadow/index_order/borders.h"
#include "src/shadow/index_order/lost_differences.h"

namespace ninebit {

struct NeighbourOrder {
  std::vector<std::uint32_t> patch_of_polygon;
  std::vector<CodeBytes> code;  // of each patch
  IndexOrderReport report;      // if report.order is `file`, nothing else is set but the reason
};

// Orders the patches of a valid scene. units: the unit of each polygon, numbered from 0 without gaps, if units are not
// polygons; otherwise empty, and patches are grown. The same on every run. Reports more patches than codes, and what
// index_comparison_state reports.
[[nodiscard]] Result<NeighbourOrder> order_by_neighbours(const Scene& scene, const IndexSettings& settings,
                                                         const HardwareProfile& profile,
                                                         std::span<const std::uint32_t> units = {});

// Checks an order of indices: which patches compare equal, and whether they may.

// Counts broken borders, and false neighbours over all pairs of patches that any comparison of their codes could lose.
// Uses only the codes: no lattice and nothing that the embedding remembers. `code` has one entry per patch.
void check_order(std::span<const CodeBytes> code, const Borders& borders, ShadowRelation& relation,
                 const LostDifferences& lost, IndexOrderReport& report);

}  // namespace ninebit
