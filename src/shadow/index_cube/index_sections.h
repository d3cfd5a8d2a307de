// Objects cut into clusters of neighbouring triangles.
#pragma once

#include <cstdint>
#include <vector>

#include "ninebit/scene/scene.h"

namespace ninebit {

struct Sections {
  std::vector<std::uint32_t> of_triangle;  // the section of each triangle of the scene
  std::uint32_t count = 0;
};

// Cuts each object of a valid scene into sections of at most `size` triangles (kMinSectionSize to kMaxSectionSize;
// rounded down to a multiple of four) and kMaxSectionVertices vertices; vertices at the same position count as one.
// Sections are meshoptimizer's meshlets: they grow from neighbour to neighbour and bend as little as they can, because
// within a section nothing shadows anything else. They are numbered object by object, and are the same on every run;
// another version of meshoptimizer may cut differently.
[[nodiscard]] Sections cut_into_sections(const Scene& scene, int size);

// An upper bound on the number of sections, computed without cutting.
[[nodiscard]] std::uint64_t most_sections(const Scene& scene, int size);

}  // namespace ninebit
