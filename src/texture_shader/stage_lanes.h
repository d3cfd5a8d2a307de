// The rules of texture-shader stages for a batch of fragments, on the best SIMD target. They give the bits of
// stage_fragment.h: both are the same functions, compiled again for each target, and the compiler makes vectors of the
// loops.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/numerics/codes.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_program.h"

namespace ninebit {
namespace NINEBIT_PUBLIC stage_lanes {  // the library of the rasterizer calls it

// Arrays of at least `count` numbers each; what is written does not overlap what is read, unless the same.
using Three = std::array<const float*, 3>;
using Texels = std::array<const s9*, 4>;  // bytes

// a / b: coordinates over q, and replaced depths.
void divide(const float* a, const float* b, std::size_t count, float* to);

// Rule 33.
void bytes_of(const StageChoices& choices, const float* from, std::size_t count, s9* to);

// Rule 34: `at` moved by ds and dt, with their factors.
struct OffsetBy {
  const s9 *ds, *dt;
  float by_ds, by_dt;
};
void offset(const float* at, const OffsetBy& by, std::size_t count, float* to);

// Rule 35, in place.
void scale(const StageChoices& choices, const s9* luminance, float scale, float bias, std::size_t count, s9* texel);

// Rule 36: the dot products of `at` and the mapped texels.
void dot(DotMapping mapping, DotDivisors divisors, const Three& at, const Texels& texels, std::size_t count, float* to);

// Rule 37.
void dependent(const s9* bytes, float divisor, std::size_t count, float* to);

// Rule 38: one eye for each fragment.
void reflect(const Three& dots, const Three& eye, std::size_t count, const std::array<float*, 3>& to);

// Rule 42: sets `killed` to 1 where a coordinate kills.
void cull(CullMode mode, CullZero zero, const float* at, std::size_t count, std::uint8_t* killed);

// Rule 40, in place.
void convert_yuv(std::size_t count, const std::array<s9*, 3>& color);

}  // namespace stage_lanes
}  // namespace ninebit
