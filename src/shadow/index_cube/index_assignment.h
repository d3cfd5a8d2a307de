// Which index each polygon of a scene has.
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
  std::uint32_t used = 0;               // numbers 1 to `used` are given
  std::vector<std::uint32_t> number{};  // one a triangle
  std::vector<ColorBytes> color{};      // the same as primary colours
};

// Reports what assign_indices reports, without the time that it takes: of sections, which only cutting counts, their
// size alone.
[[nodiscard]] Status check_index_settings(const Scene& scene, const IndexSettings& settings);

// Counts indices afresh, from 1, in the order of the scene's triangles. Reports what check_index_codes reports, and a
// section size outside kMinSectionSize to kMaxSectionSize.
[[nodiscard]] Result<IndexAssignment> assign_indices(const Scene& scene, const IndexSettings& settings);

// What a code number stands for, in a scope.
[[nodiscard]] PickedIndex owner_of(std::uint32_t number, const Scene& scene, IndexScope scope,
                                   const IndexAssignment& indices);

}  // namespace ninebit
