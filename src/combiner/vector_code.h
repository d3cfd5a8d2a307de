// A compiled batch program: a list of vector operations over planes of int16 codes.
#pragma once

#include <array>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/numerics/codes.h"

namespace ninebit::detail {

// The result of an operation, lane by lane, from its sources x0, x1, …. A source whose bit is set in `floors` is read
// as max(0, x).
enum class Kernel : std::uint8_t {
  // clamp(factor[0] · x0 + factor[1] · x1 + offset). With `halves` one half of the sum, toward zero or, with `nearest`,
  // halves up. One or two terms.
  affine,
  // Products of values that are not negative, in 16 bits: min((x0·x1 + x2·x3 + …) · 2^doublings / 255, high), the
  // quotient rounded down or to nearest. `offset` or, with `adds`, a last source is added to the quotient. One to
  // three terms. The sum saturates at 65535; the quotient of what is too large comes out as 256 at least.
  unsigned_products,
  // One product of values of any sign, in 16 bits: x0·x1 · 2^doublings / 255, toward zero or to nearest, no farther
  // from zero than `high`. With `positive_first` x0 is not negative; with `positive_part`, too, negative results
  // become 0. Without `positive_first` no source has a floor.
  signed_product,
  // The same of one or two products of values of any sign and `offset`, where the sum always fits into 16 bits. Any of
  // them may have `positive_part`.
  signed_sum,
  // clamp((x0·x1 + x2·x3 + … + bias) · reciprocal), in 32 bits and floats, toward zero or to nearest. One to six terms.
  products,
  // x0 >= low ? x2 : x1
  select,
  // x0 odd ? x2 : x1
  select_odd,
  copy
};

inline constexpr int kLowest16 = -32768, kMost16 = 32767;

struct Formula {
  Kernel kernel = Kernel::copy;
  int terms = 1;
  std::uint32_t floors = 0;
  bool adds = false;
  bool halves = false;
  bool nearest = false;
  bool positive_first = false;
  bool positive_part = false;
  int doublings = 0;
  std::array<int, 2> factor{};
  int offset = 0;
  int low = kLowest16, high = kMost16;  // of the clamp; of `select`, low is the limit
  float bias = 0;
  float reciprocal = 0;

  [[nodiscard]] int sources() const {
    switch (kernel) {
      case Kernel::affine:
        return terms;
      case Kernel::unsigned_products:
        return 2 * terms + (adds ? 1 : 0);
      case Kernel::signed_product:
        return 2;
      case Kernel::signed_sum:
      case Kernel::products:
        return 2 * terms;
      case Kernel::select:
      case Kernel::select_odd:
        return 3;
      case Kernel::copy:
        return 1;
    }
    return 0;
  }
  [[nodiscard]] bool clamps() const { return low != kLowest16 || high != kMost16; }
  [[nodiscard]] bool is_floored(std::size_t source) const { return (floors >> source & 1U) != 0; }
  friend auto operator<=>(const Formula&, const Formula&) = default;
};
inline constexpr std::size_t kMostSources = 12;

// The storage of a plane.
enum class Space : std::uint8_t { registers, colors, constants, temporaries };
struct PlanePlace {
  Space space = Space::temporaries;
  std::uint16_t index = 0;
  friend bool operator==(const PlanePlace&, const PlanePlace&) = default;
};

// A straight line through which a kernel that multiplies reads a source: factor · x + offset, after the floor.
struct Line {
  s9 factor = 1, offset = 0;
  friend bool operator==(const Line&, const Line&) = default;
};

struct VectorOperation {
  Formula formula;
  std::uint32_t lines = 0;  // the sources that are read through a line, a bit each
  std::array<Line, kMostSources> line{};
  std::array<PlanePlace, kMostSources> source{};
  PlanePlace target;
  std::size_t alike = 1;  // the number of operations, this one and the next, that differ in their planes alone
};

struct alignas(64) ConstantPlane {
  std::array<s9, kBatchSize> lane;
};

using AnyKernel = void (*)();

struct VectorCode {
  std::vector<VectorOperation> operations;
  // The kernel of each operation, for the SIMD target `prepared_for`. Another target chooses kernels as it runs.
  std::vector<AnyKernel> kernels;
  std::int64_t prepared_for = 0;
  std::vector<ConstantPlane> constants;
  std::size_t temporaries = 0;  // planes
  ComponentSet reads;
};

}  // namespace ninebit::detail
