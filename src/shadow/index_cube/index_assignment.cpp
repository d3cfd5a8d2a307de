#include "src/shadow/index_cube/index_assignment.h"

#include <fmt/format.h>

#include <algorithm>

#include "src/shadow/index_cube/index_sections.h"

namespace ninebit {

Status check_index_settings(const Scene& scene, const IndexSettings& settings) {
  if (settings.section_size < kMinSectionSize || settings.section_size > kMaxSectionSize) {
    return Diagnostic{.message = fmt::format("section size {} is out of range; expected {} to {}",
                                             settings.section_size, kMinSectionSize, kMaxSectionSize)};
  }
  if (settings.scope == IndexScope::section) return {};
  return check_index_codes(settings.format, settings.step, settings.scope,
                           {.polygons = scene.triangles.size(),
                            .sections = most_sections(scene, settings.section_size),
                            .objects = scene.objects.size()});
}

Result<IndexAssignment> assign_indices(const Scene& scene, const IndexSettings& settings) {
  if (Status checked = check_index_settings(scene, settings); !checked) return checked.error();
  IndexCounts counts{.polygons = scene.triangles.size(), .objects = scene.objects.size()};
  Sections sections;
  if (settings.scope == IndexScope::section) {
    sections = cut_into_sections(scene, settings.section_size);
    counts.sections = sections.count;
    Status enough = check_index_codes(settings.format, settings.step, settings.scope, counts);
    if (!enough) return enough.error();
  }

  IndexAssignment assignment{.codes = IndexCodes(settings.step, settings.format),
                             .used = static_cast<std::uint32_t>(counts.of(settings.scope))};
  assignment.number.resize(scene.triangles.size());
  assignment.color.resize(scene.triangles.size());
  for (std::size_t t = 0; t < scene.triangles.size(); ++t) {
    const std::uint32_t number = settings.scope == IndexScope::polygon   ? static_cast<std::uint32_t>(t)
                                 : settings.scope == IndexScope::section ? sections.of_triangle[t]
                                                                         : scene.triangle_object[t];
    assignment.number[t] = number + 1;
    assignment.color[t] = assignment.codes.color(number + 1);
  }
  return assignment;
}

PickedIndex owner_of(std::uint32_t number, const Scene& scene, IndexScope scope, const IndexAssignment& indices) {
  PickedIndex picked{.number = number};
  const auto found = std::find(indices.number.begin(), indices.number.end(), number);
  if (found == indices.number.end()) return picked;
  if (scope == IndexScope::polygon) picked.polygon = number - 1;
  if (scope == IndexScope::section) picked.section = number - 1;
  picked.object = scene.triangle_object[static_cast<std::size_t>(found - indices.number.begin())];
  return picked;
}

}  // namespace ninebit
