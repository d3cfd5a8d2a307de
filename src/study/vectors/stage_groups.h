// The groups of a pack of texture-shader stages, and the programs and coordinates in them.
#pragma once

#include <span>

#include "ninebit/study/stage_vectors.h"
#include "src/study/vectors/vector_groups.h"

namespace ninebit::vectors {

struct StageGroup {
  const char *name, *rules, *what;
  int weight;  // its share of a pack's programs
  // Sets the state, `picture` and `is_signed` of a program whose state is stage_state().
  void (*make)(Maker& maker, StageVectorProgram& program);
};

// In the order in which they stand in a pack.
[[nodiscard]] std::span<const StageGroup> stage_groups_of_packs();

// Stages by the NV2A's rules, all of them off.
[[nodiscard]] TextureShaderState stage_state();

// The textures of all packs: two 2D ones, a 3D one, a cube map, a 1D one, a rectangle. The first one's red and green
// are different for each texel.
[[nodiscard]] std::vector<StagePicture> stage_pictures(std::uint64_t seed);

// Coordinates at which the stages show what they do.
[[nodiscard]] StageCoordinates random_coordinates(VectorRandom& random, const TextureShaderState& state);

}  // namespace ninebit::vectors
