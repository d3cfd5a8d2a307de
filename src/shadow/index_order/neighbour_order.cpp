#include "src/shadow/index_order/neighbour_order.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/shadow/index_order/borders.h"
#include "src/shadow/index_order/code_embedding.h"
#include "src/shadow/index_order/code_lattice.h"
#include "src/shadow/index_order/order_check.h"
#include "src/shadow/index_order/patches.h"
#include "src/shadow/index_order/scene_surface.h"
#include "src/shadow/index_order/shadow_relation.h"

namespace ninebit {

Result<NeighbourOrder> order_by_neighbours(const Scene& scene, const IndexSettings& settings,
                                           const HardwareProfile& profile, std::span<const std::uint32_t> units) {
  const auto lost = LostDifferences::measure(profile, settings.format, settings.scales);
  if (!lost) return lost.error();
  NeighbourOrder order;
  if (lost->all_always().empty()) {
    order.report.reason =
        fmt::format("with profile {}, format {} and scales {} the comparison always loses no difference", profile.name,
                    name_of(settings.format), name_of(settings.scales));
    return order;
  }
  const SceneSurface surface(scene);
  const auto degrees = static_cast<double>(settings.patch_degrees);
  const Patches patches = units.empty()
                              ? Patches::grow(surface, scene.triangle_object, degrees)
                              : Patches::of_units(surface, units, *std::max_element(units.begin(), units.end()) + 1);
  CodeLattice lattice(*lost, settings.step, patches.count());
  std::vector<bool> back_is_hidden(patches.count());
  const std::vector<bool> hidden = find_hidden_backs(scene, surface);
  for (std::uint32_t t = 0; t < surface.polygons(); ++t) {
    back_is_hidden[patches.of_polygon(t)] = hidden[scene.triangle_object[t]];
  }
  ShadowRelation relation(surface, patches, back_is_hidden);
  const Borders borders = Borders::find(surface, patches, relation, degrees);
  if (!CodeEmbedding(patches, borders, relation, *lost, lattice).run()) {
    return Diagnostic{
        .message = fmt::format("too many patches: {} of them and the cleared map need {} codes, index format {} with "
                               "codes {} apart has {}; a larger patch angle gives fewer patches",
                               patches.count(), patches.count() + std::uint64_t{1}, name_of(settings.format),
                               lattice.spacing(), lattice.capacity())};
  }

  order.report.order = IndexOrder::neighbour;
  for (std::uint32_t patch = 0; patch < patches.count(); ++patch) order.code.push_back(lattice.code(patch));
  ShadowRelation afresh(surface, patches, back_is_hidden);
  check_order(order.code, borders, afresh, *lost, order.report);
  order.patch_of_polygon.resize(surface.polygons());
  for (std::uint32_t t = 0; t < surface.polygons(); ++t) order.patch_of_polygon[t] = patches.of_polygon(t);
  return order;
}

}  // namespace ninebit
