// Meshes for effects that need no file: spheres, tori, planes and cubes, with normals and texture coordinates.
#pragma once

#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/scene/scene.h"

namespace NINEBIT_PUBLIC ninebit {

// The range of N in "sphere:N", "torus:N" and "plane:N".
inline constexpr int kMinMeshSegments = 1;
inline constexpr int kMaxMeshSegments = 4096;

// Whether a text names a generated mesh rather than a file: "cube", or one of the words above and a colon.
[[nodiscard]] bool is_generated_mesh(std::string_view text);

// A scene of one object of that name, without camera and light, with a white material.
//
// - "sphere:N": radius 1 around the origin, N segments around y (at least 3) and N / 2 (at least 2) from pole to pole.
// - "torus:N": around z, radius 0.7 and a tube of radius 0.3; N segments around and N / 2 around the tube, at least 3.
// - "plane:N": N × N squares from (-1, -1, 0) to (1, 1, 0), facing +z.
// - "cube": from -1 to 1, twelve triangles.
//
// s grows to the right and t downwards, as seen from the front with y up (z up for the torus); both are 0 to 1 over the
// mesh, over each face of the cube. Reports an unknown mesh and an N out of range.
[[nodiscard]] Result<Scene> generated_mesh(std::string_view text);

}  // namespace ninebit
