// Triangles on their way through set-up in vectors.
#pragma once

#include <cstddef>
#include <cstdint>

namespace ninebit {

// The triangles that remain of a range, as arrays: corners in counter-clockwise order.
struct TriangleCandidates {
  static constexpr std::size_t kRoom = 128;
  using Lanes = std::int32_t[kRoom + 16];
  alignas(64) Lanes x[3], y[3];
  alignas(64) Lanes edge[3];    // of a single pixel: the edge functions there
  alignas(64) Lanes vertex[3];  // in the primitive's order
  alignas(64) Lanes low, high;  // the box
  alignas(64) Lanes kind;       // kind and front_facing, as they lie in SetupPrimitive, and kSwapped
  alignas(64) Lanes primitive;
  std::size_t count = 0;
  bool has_pixels = false;

  // Set in `kind` of a clockwise triangle: its second and third corner have changed places.
  static constexpr int kSwapped = 1 << 16;
};

}  // namespace ninebit
