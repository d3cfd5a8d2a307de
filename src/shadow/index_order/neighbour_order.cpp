#include "src/shadow/index_order/neighbour_order.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "src/shadow/index_order/borders.h"
#include "src/shadow/index_order/code_embedding.h"
#include "src/shadow/index_order/lost_differences.h"
#include "src/shadow/index_order/patches.h"

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

namespace {

// Patches sorted by the cube that their code lies in. Codes at most one cube's side apart lie in adjacent cubes.
class CodeCubes {
 public:
  CodeCubes(std::span<const CodeBytes> code, int side) : code_(code), side_(side) {
    for (std::uint32_t patch = 0; patch < code.size(); ++patch) entries_.emplace_back(cube_of(code[patch]), patch);
    std::sort(entries_.begin(), entries_.end());
  }

  // Calls each(other) for the patches with larger numbers in the patch's cube and the 26 around it.
  template <class Each>
  void around(std::uint32_t patch, const Each& each) const {
    const std::array<int, 3> c = cube_of(code_[patch]);
    for (int z = c[2] - 1; z <= c[2] + 1; ++z) {
      for (int y = c[1] - 1; y <= c[1] + 1; ++y) {
        // Cubes along the last axis follow one another.
        const std::array<int, 3> low{z, y, c[0] - 1}, high{z, y, c[0] + 2};
        const auto entry_before = [](const Entry& e, const std::array<int, 3>& cube) { return e.first < cube; };
        auto e = std::lower_bound(entries_.begin(), entries_.end(), low, entry_before);
        for (; e != entries_.end() && e->first < high; ++e) {
          if (e->second > patch) each(e->second);
        }
      }
    }
  }

 private:
  using Entry = std::pair<std::array<int, 3>, std::uint32_t>;
  [[nodiscard]] std::array<int, 3> cube_of(const CodeBytes& c) const {
    return {c[2] / side_, c[1] / side_, c[0] / side_};
  }

  std::span<const CodeBytes> code_;
  int side_;
  std::vector<Entry> entries_;
};

}  // namespace

void check_order(std::span<const CodeBytes> code, const Borders& borders, ShadowRelation& relation,
                 const LostDifferences& lost, IndexOrderReport& report) {
  double broken = 0.0, all = 0.0;
  for (std::uint32_t patch = 0; patch < code.size(); ++patch) {
    for (const Border& border : borders.of(patch)) {
      if (border.patch < patch) continue;
      all += static_cast<double>(border.length);
      if (lost.always(difference(code[patch], code[border.patch]))) continue;
      broken += static_cast<double>(border.length);
      ++report.broken_borders;
    }
  }
  report.patches = code.size();
  report.borders = borders.count();
  report.broken_share = all > 0.0 ? broken / all : 0.0;

  const CodeCubes cubes(code, lost.radius() + 1);
  for (std::uint32_t patch = 0; patch < code.size(); ++patch) {
    cubes.around(patch, [&](std::uint32_t other) {
      if (lost.never(difference(code[patch], code[other])) && lost.never(difference(code[other], code[patch]))) return;
      if (!borders.are_neighbours(patch, other) && relation.may_shadow(patch, other)) ++report.false_neighbours;
    });
  }
}

}  // namespace ninebit
