#include "src/shadow/index_cube/index_assignment.h"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <string>
#include <utility>

#include "src/shadow/index_cube/index_sections.h"
#include "src/shadow/index_order/neighbour_order.h"

namespace ninebit {
namespace {

IndexAssignment assign_in_order(const Scene& scene, const IndexSettings& settings, const IndexCounts& counts,
                                const std::vector<std::uint32_t>& sections) {
  IndexAssignment assignment{.codes = IndexCodes(settings.step, settings.format),
                             .used = static_cast<std::uint32_t>(counts.of(settings.scope))};
  assignment.number.resize(scene.triangles.size());
  assignment.color.resize(scene.triangles.size());
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const std::uint32_t number = settings.scope == IndexScope::polygon   ? static_cast<std::uint32_t>(t)
                                 : settings.scope == IndexScope::section ? sections[t]
                                                                         : scene.triangle_object[t];
    assignment.number[t] = number + 1;
    assignment.color[t] = assignment.codes.color(number + 1);
  }
  return assignment;
}

Result<IndexAssignment> assign_by_neighbours(const Scene& scene, const IndexSettings& settings,
                                             const HardwareProfile& profile,
                                             const std::vector<std::uint32_t>& sections) {
  const std::span<const std::uint32_t> units = settings.scope == IndexScope::section  ? std::span(sections)
                                               : settings.scope == IndexScope::object ? std::span(scene.triangle_object)
                                                                                      : std::span(sections).first(0);
  auto order = order_by_neighbours(scene, settings, profile, units);
  if (!order) return order.error();
  IndexAssignment assignment{.codes = IndexCodes(1, settings.format),
                             .used = static_cast<std::uint32_t>(order->code.size()),
                             .order = std::move(order->report)};
  for (const std::uint32_t patch : order->patch_of_polygon) {
    assignment.number.push_back(code_number(order->code[patch]));
    assignment.color.push_back(assignment.codes.color(assignment.number.back()));
  }
  return assignment;
}

}  // namespace

Status check_index_settings(const Scene& scene, const IndexSettings& settings) {
  if (settings.section_size < kMinSectionSize || settings.section_size > kMaxSectionSize) {
    return Diagnostic{.message = fmt::format("section size {} is out of range; expected {} to {}",
                                             settings.section_size, kMinSectionSize, kMaxSectionSize)};
  }
  if (settings.step < 1 || settings.step > kMaxIndexStep) {
    return check_index_codes(settings.format, settings.step, settings.scope, {});
  }
  if (!(settings.patch_degrees >= kMinPatchDegrees && settings.patch_degrees <= kMaxPatchDegrees)) {
    return Diagnostic{.message = fmt::format("patch angle {} is out of range; expected {} to {} degrees",
                                             settings.patch_degrees, kMinPatchDegrees, kMaxPatchDegrees)};
  }
  if (settings.scope == IndexScope::section || settings.order == IndexOrder::neighbour) return {};
  return check_index_codes(settings.format, settings.step, settings.scope,
                           {.polygons = scene.triangles.size(),
                            .sections = most_sections(scene, settings.section_size),
                            .objects = scene.objects.size()});
}

Result<IndexAssignment> assign_indices(const Scene& scene, const IndexSettings& settings,
                                       const HardwareProfile& profile) {
  if (Status checked = check_index_settings(scene, settings); !checked) return checked.error();
  std::vector<std::uint32_t> sections;
  IndexCounts counts{.polygons = scene.triangles.size(), .objects = scene.objects.size()};
  if (settings.scope == IndexScope::section) {
    Sections cut = cut_into_sections(scene, settings.section_size);
    sections = std::move(cut.of_triangle);
    counts.sections = cut.count;
  }
  std::string reason;
  if (settings.order == IndexOrder::neighbour) {
    auto assignment = assign_by_neighbours(scene, settings, profile, sections);
    if (!assignment || assignment->order.order == IndexOrder::neighbour) return assignment;
    reason = std::move(assignment->order.reason);
  }
  Status enough = check_index_codes(settings.format, settings.step, settings.scope, counts);
  if (!enough) return enough.error();
  IndexAssignment assignment = assign_in_order(scene, settings, counts, sections);
  assignment.order.reason = std::move(reason);
  return assignment;
}

PickedIndex owner_of(std::uint32_t number, const Scene& scene, IndexScope scope, const IndexAssignment& indices) {
  PickedIndex picked{.number = number};
  const auto found = std::find(indices.number.begin(), indices.number.end(), number);
  if (found == indices.number.end()) return picked;
  const auto first = static_cast<std::size_t>(found - indices.number.begin());
  picked.object = scene.triangle_object[first];
  if (indices.order.order == IndexOrder::neighbour) {
    // A patch of one polygon names it; sections have no numbers of their own.
    const bool alone = std::find(found + 1, indices.number.end(), number) == indices.number.end();
    if (scope == IndexScope::polygon && alone) picked.polygon = static_cast<std::uint32_t>(first);
    return picked;
  }
  if (scope == IndexScope::polygon) picked.polygon = number - 1;
  if (scope == IndexScope::section) picked.section = number - 1;
  return picked;
}

}  // namespace ninebit
