// The index of each polygon of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "ninebit/scene/scene.h"
#include "ninebit/shadow/index_codes.h"
#include "ninebit/shadow/settings.h"
#include "ninebit/shadow/technique.h"

namespace ninebit {

struct IndexAssignment {
  IndexCodes codes;
  std::uint32_t used = 0;               // indices 1 to `used` are assigned
  std::vector<std::uint32_t> number{};  // the index of each triangle
  std::vector<ColorBytes> color{};      // the same as a primary colour
};

// Reports the same faults as assign_indices in less time. Sections are only counted by cutting the scene, so with
// IndexScope::section only the section size is checked.
[[nodiscard]] Status check_index_settings(const Scene& scene, const IndexSettings& settings);

// Numbers polygons, sections or objects from 1, in the order of the scene's triangles. Reports what check_index_codes
// reports, and a section size outside kMinSectionSize to kMaxSectionSize.
[[nodiscard]] Result<IndexAssignment> assign_indices(const Scene& scene, const IndexSettings& settings);

// The polygon, section or object that a code number identifies.
[[nodiscard]] PickedIndex owner_of(std::uint32_t number, const Scene& scene, IndexScope scope,
                                   const IndexAssignment& indices);

}  // namespace ninebit
