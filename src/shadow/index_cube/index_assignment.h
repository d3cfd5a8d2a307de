// The index of each polygon of a scene.
#pragma once

#include <cstdint>
#include <vector>

#include "ninebit/frame/index_codes.h"
#include "ninebit/frame/settings.h"
#include "ninebit/scene/scene.h"
#include "ninebit/shadow/technique.h"

namespace ninebit {

struct IndexAssignment {
  IndexCodes codes;
  std::uint32_t used = 0;               // with IndexOrder::file indices 1 to `used` are assigned; otherwise so many
  std::vector<std::uint32_t> number{};  // the index of each triangle
  std::vector<ColorBytes> color{};      // the same as a primary colour
  IndexOrderReport order{};
};

// Reports the same faults as assign_indices in less time. Sections are only counted by cutting the scene, so with
// IndexScope::section only the section size is checked, and with IndexOrder::neighbour nothing else than that and the
// ranges.
[[nodiscard]] Status check_index_settings(const Scene& scene, const IndexSettings& settings);

// Numbers polygons, sections or objects from 1, in the order of the scene's triangles; or gives patches of polygons,
// sections or objects codes by IndexOrder::neighbour, with IndexCodes of step 1. If the comparison under this profile
// loses nothing, the order of the file is used. Reports what check_index_codes reports, a section size or a patch angle
// out of range, and what index_comparison_state reports.
[[nodiscard]] Result<IndexAssignment> assign_indices(const Scene& scene, const IndexSettings& settings,
                                                     const HardwareProfile& profile);

// The polygon, section or object that a code number identifies.
[[nodiscard]] PickedIndex owner_of(std::uint32_t number, const Scene& scene, IndexScope scope,
                                   const IndexAssignment& indices);

}  // namespace ninebit
