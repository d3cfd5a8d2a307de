// The values of a batch's fragments between those of their vertices.
#if defined(NINEBIT_RASTER_LANES_LANE_INTERPOLATION_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_LANE_INTERPOLATION_INL_H_
#undef NINEBIT_RASTER_LANES_LANE_INTERPOLATION_INL_H_
#else
#define NINEBIT_RASTER_LANES_LANE_INTERPOLATION_INL_H_
#endif

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

#include "hwy/highway.h"
#include "ninebit/numerics/fixed9.h"
#include "src/raster/fragment/draw_context.h"
#include "src/raster/fragment/fog.h"
#include "src/raster/fragment/interpolation.h"
#include "src/raster/lanes/lane_batch.h"
#include "src/raster/lanes/lane_fragments.h"
#include "src/raster/lanes/lane_inputs.h"
#include "src/raster/lanes/lane_vectors-inl.h"
#include "src/raster/rules/fragment_vector-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

#if HWY_TARGET != HWY_SCALAR

// True where three divisions by one sum use its reciprocal, because vectors divide slowly.
#if HWY_NATIVE_FMA
constexpr bool kHasQuotients = true;
#else
constexpr bool kHasQuotients = false;
#endif

// a / b, rounded as the division is, from b's reciprocal, rounded likewise, for weights that are_plain() (Markstein,
// Computation of elementary functions on the IBM RISC System/6000 processor, 1990: a quotient that is off by at most
// one unit in the last place becomes the nearest one; that of the first line may be off by two units).
HWY_INLINE VF quotient(VF a, VF b, VF reciprocal) {
  VF q = hn::Mul(a, reciprocal);
  q = hn::MulAdd(hn::NegMulAdd(q, b, a), reciprocal, q);
  return hn::MulAdd(hn::NegMulAdd(q, b, a), reciprocal, q);
}

// The next vector's first fragment. All vectors of a run but the first are aligned, so the second one may repeat
// fragments of the first.
constexpr std::size_t next_vector(std::size_t i, std::size_t lanes) {
  return (i / lanes + 1) * lanes;
}

// Divides the weights by their sum, which it stores. Returns whether that is one number, as it is up to rounding where
// a triangle lies parallel to the screen.
template <bool kQuotients>
HWY_INLINE bool normalize(LaneFragments& f, LaneFragments::Lanes<float>& sums) {
  const std::size_t count = f.count;
  // Lanes after the last fragment have the first one's weights.
  for (std::size_t k = 0; k < 3; ++k) hn::StoreU(hn::Set(kDF, f.weight[k][0]), kDF, f.weight[k].data() + count);
  const VF first = hn::Set(kDF, (f.weight[0][0] + f.weight[1][0]) + f.weight[2][0]);
  const VF of_first = kQuotients ? hn::Div(hn::Set(kDF, 1.0F), first) : first;
  bool is_one = true;
  for (std::size_t i = 0; i < count; i += kLaneCount) {
    const VF w[3] = {hn::Load(kDF, f.weight[0].data() + i), hn::Load(kDF, f.weight[1].data() + i),
                     hn::Load(kDF, f.weight[2].data() + i)};
    const VF sum = hn::Add(hn::Add(w[0], w[1]), w[2]);
    hn::Store(sum, kDF, sums.data() + i);
    VF reciprocal = of_first;
    if (HWY_UNLIKELY(!hn::AllTrue(kDF, hn::Eq(sum, first)))) {
      is_one = false;
      if (kQuotients) reciprocal = hn::Div(hn::Set(kDF, 1.0F), sum);
    }
    for (std::size_t k = 0; k < 3; ++k) {
      hn::Store(kQuotients ? quotient(w[k], sum, reciprocal) : hn::Div(w[k], sum), kDF, f.weight[k].data() + i);
    }
  }
  return is_one;
}

using Shares = std::array<LaneFragments::Lanes<float>, 3>;

// The changes of the corners' shares: a share is g / sum, g being edge / w, which is linear in the window, so its
// derivative is (g' - share × sum') / sum. is_one: f has one run, with one sum; returns whether the changes are one,
// too.
HWY_INLINE bool find_changes(const LaneFragments& f, std::size_t r, const std::array<float, 3>& step, bool is_one,
                             const LaneFragments::Lanes<float>& sums, Shares& to) {
  const SetupCorners& corners = *f.run[r].corners;
  std::array<float, 3> change{};
  for (std::size_t k = 0; k < 3; ++k) change[corners.corner[k]] = step[k] * corners.inv_w[k];
  const float change_of_sum = (change[0] + change[1]) + change[2];
  if (is_one && change_of_sum == 0.0F) {
    for (std::size_t k = 0; k < 3; ++k) std::fill_n(to[k].begin(), f.count, change[k] / sums[0]);
    return true;
  }
  const VF sum_change = hn::Set(kDF, change_of_sum);
  for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; i = next_vector(i, kLaneCount)) {
    const VF sum = hn::LoadU(kDF, sums.data() + i);
    for (std::size_t k = 0; k < 3; ++k) {
      const VF share = hn::LoadU(kDF, f.weight[k].data() + i);
      const VF difference = hn::Sub(hn::Set(kDF, change[k]), hn::Mul(share, sum_change));
      hn::StoreU(hn::Div(difference, sum), kDF, to[k].data() + i);
    }
  }
  return false;
}

// Turns the weights of a batch into shares, once, and finds their changes if textures need them.
HWY_INLINE void find_shares(LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  if (f.has_shares) return;
  const bool are_plain = kHasQuotients && f.are_plain();
  bool is_one = are_plain ? normalize<kHasQuotients>(f, batch.weight_sum) : normalize<false>(f, batch.weight_sum);
  is_one = is_one && f.runs == 1 && f.run[0].is_plain();
  for (std::size_t r = 0; r < f.runs && context.needs_texture_changes; ++r) {
    const EdgeSteps steps = edge_steps(*f.run[r].primitive);
    const bool one_x = find_changes(f, r, steps.x, is_one, batch.weight_sum, batch.dx.share);
    const bool one_y = find_changes(f, r, steps.y, is_one, batch.weight_sum, batch.dy.share);
    f.has_one_change = one_x && one_y;
  }
  if (!are_plain) {
    unclip(f, f.weight);
    if (context.needs_texture_changes) {
      unclip(f, batch.dx.share);
      unclip(f, batch.dy.share);
    }
  }
  f.has_shares = true;
}

// The vertices' shares of fragments from i on, or their changes.
struct ShareLanes {
  VF a, b, c;
  HWY_INLINE ShareLanes(const Shares& shares, std::size_t i)
      : a(hn::LoadU(kDF, shares[0].data() + i)),
        b(hn::LoadU(kDF, shares[1].data() + i)),
        c(hn::LoadU(kDF, shares[2].data() + i)) {}

  HWY_INLINE ShareLanes(VF of_a, VF of_b, VF of_c) : a(of_a), b(of_b), c(of_c) {}

  // A value at these fragments, from those at the vertices.
  [[nodiscard]] HWY_INLINE VF interpolate(float at_a, float at_b, float at_c) const {
    return hn::Add(hn::Add(hn::Mul(a, hn::Set(kDF, at_a)), hn::Mul(b, hn::Set(kDF, at_b))),
                   hn::Mul(c, hn::Set(kDF, at_c)));
  }
};

HWY_INLINE ShareLanes eight_bit_weights(const ShareLanes& shares, bool is_line) {
  const VectorValues<decltype(kD)> o;
  const auto weights = HWY_UNLIKELY(is_line) ? eight_bit_line_weights(o, shares.a, shares.b, shares.c)
                                             : eight_bit_weights(o, shares.a, shares.c);
  return {weights.first, weights.second, weights.third};
}

// The colours of a run's vertices, as floats. A copy: the compiler would read them again for each vector, because the
// vectors that are stored might alias them.
struct CornerColors {
  std::array<std::array<float, 3>, 4> value;  // by component and vertex
  bool has_one_alpha;
  HWY_INLINE CornerColors(const LaneFragments::Run& run, std::span<const ColorBytes> colors) {
    for (std::size_t n = 0; n < 3; ++n) {
      const ColorBytes color = colors[run.corners->vertex[n]];
      for (std::size_t k = 0; k < 4; ++k) value[k][n] = static_cast<float>(color[k]);
    }
    has_one_alpha = value[kAlpha][0] == value[kAlpha][1] && value[kAlpha][0] == value[kAlpha][2];
  }
};

// kPlain: for a run that is_plain() and has one alpha, which is then the alpha of all its fragments. Its values exceed
// the range of the corners' values by at most 2^-20.
template <bool kPlain, bool kEightBits>
HWY_INLINE void fill_smooth_run(const LaneFragments& f, LaneBatch& batch, std::size_t r, const CornerColors& corner) {
  const VF alpha = hn::Set(kDF, corner.value[kAlpha][0]);
  const bool is_line = !kPlain && f.run[r].primitive->kind == SetupKind::line;
  // The next run overwrites what is stored beyond this one's end.
  for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; i = next_vector(i, kLaneCount)) {
    const ShareLanes exact(f.weight, i);
    const ShareLanes shares = kEightBits ? eight_bit_weights(exact, is_line) : exact;
    const auto byte = [&](std::size_t k) HWY_ATTR {
      VF value = shares.interpolate(corner.value[k][0], corner.value[k][1], corner.value[k][2]);
      value = hn::Add(value, hn::Set(kDF, 0.5F));
      if (!kPlain) value = hn::Min(hn::Max(value, hn::Zero(kDF)), hn::Set(kDF, 255.0F));
      return hn::Floor(value);
    };
    // Two bytes side by side, in the low bits of a float above 2^23: exact, and faster than conversions.
    const auto two_bytes = [&](VF low, VF high) HWY_ATTR {
      const VF both = hn::Add(low, hn::Mul(high, hn::Set(kDF, 256.0F)));
      return hn::BitCast(kD, hn::Add(both, hn::Set(kDF, 0x1p23F)));
    };
    const V low = hn::And(two_bytes(byte(0), byte(1)), hn::Set(kD, 0xFFFF));
    const V high = two_bytes(byte(2), kPlain ? alpha : byte(3));
    hn::StoreU(hn::Or(hn::ShiftLeft<16>(high), low), kD, lanes_of(batch.color.data()) + i);
  }
}

template <bool kEightBits>
HWY_INLINE void fill_smooth_runs(const LaneFragments& f, LaneBatch& batch, std::span<const ColorBytes> colors) {
  for (std::size_t r = 0; r < f.runs; ++r) {
    const CornerColors corner(f.run[r], colors);
    if (corner.has_one_alpha && f.run[r].is_plain()) {
      fill_smooth_run<true, kEightBits>(f, batch, r, corner);
    } else {
      fill_smooth_run<false, kEightBits>(f, batch, r, corner);
    }
  }
}

// Colours interpolated between the vertices.
HWY_INLINE void fill_smooth_colors(const LaneFragments& f, LaneBatch& batch, const DrawContext& context,
                                   std::span<const ColorBytes> colors) {
  if (context.state.profile.color_weights.value == ColorWeights::eight_bits) {
    fill_smooth_runs<true>(f, batch, colors);
  } else {
    fill_smooth_runs<false>(f, batch, colors);
  }
}

// Colours of the vertices that a register reads: the primary or the secondary ones.
struct VertexColors {
  Register reg;
  std::span<const ColorBytes> colors;
  int components;  // that come from the colours; alpha comes last
};

// True if each run's corners have one colour, which weights of eight bits give all its fragments, as their sum is 1.
HWY_INLINE bool have_equal_corners(const LaneFragments& f, const DrawContext& context,
                                   std::span<const ColorBytes> colors) {
  if (context.state.profile.color_weights.value != ColorWeights::eight_bits) return false;
  return std::all_of(f.run.data(), f.run.data() + f.runs, [&](const LaneFragments::Run& run) {
    const std::array<std::uint32_t, 3>& v = run.corners->vertex;
    return run.is_plain() && colors[v[0]] == colors[v[1]] && colors[v[0]] == colors[v[2]];
  });
}

// Colours that are constant over each run, color_of(run), as codes: the components that the program reads.
template <class ColorOf>
HWY_NOINLINE void fill_flat_codes(const LaneFragments& f, LaneBatch& batch, const DrawContext& context,
                                  const VertexColors& from, const ColorOf& color_of) {
  constexpr hn::CappedTag<s9, 32> kCodes;
  constexpr std::size_t kLanesOfCodes = hn::MaxLanes(kCodes);
  for (std::size_t r = 0; r < f.runs; ++r) {
    const ColorBytes color = color_of(f.run[r]);
    for (int k = 0; k < from.components; ++k) {
      if (!context.program->reads().contains(from.reg, k)) continue;
      s9* const to = batch.registers(from.reg, k);
      const auto code = static_cast<s9>(color[static_cast<std::size_t>(k)] >> context.state.profile.byte_shift);
      const std::size_t end = f.run[r + 1].first;
      std::size_t i = f.run[r].first;
      // The next run overwrites what is stored beyond this one's end.
      for (; i < end && i + kLanesOfCodes <= kBatchSize; i = next_vector(i, kLanesOfCodes)) {
        hn::StoreU(hn::Set(kCodes, code), kCodes, to + i);
      }
      for (; i < end; ++i) to[i] = code;
    }
  }
}

// The fog factors of fragments, as codes.
HWY_NOINLINE void fill_fog(const LaneFragments& f, LaneBatch& batch, const DrawContext& context) {
  const Fog fog = context.state.fog;
  const std::span<const float> values = context.arrays.fog_factors;
  LaneFragments::Lanes<float>& at_fragment = batch.coordinate[0];
  for (std::size_t r = 0; r < f.runs; ++r) {
    std::array<float, 3> corner{};
    for (std::size_t n = 0; n < 3; ++n) corner[n] = fog_at_vertex(fog, values[f.run[r].corners->vertex[n]]);
    for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; i = next_vector(i, kLaneCount)) {
      hn::StoreU(ShareLanes(f.weight, i).interpolate(corner[0], corner[1], corner[2]), kDF, at_fragment.data() + i);
    }
  }
  const HardwareProfile& profile = context.state.profile;
  s9* const codes = batch.registers(Register::fog, kAlpha);
  // The compiler vectorizes the loop.
  with_fog_function(fog.function, [&](auto function) HWY_ATTR {
    std::array<std::uint8_t, kBatchSize> bytes;
    for (std::size_t i = 0; i < f.count; ++i) bytes[i] = fog_byte_of<function()>(profile, fog, at_fragment[i]);
    for (std::size_t i = 0; i < f.count; ++i) codes[i] = from_byte(profile, bytes[i]);
  });
}

// Texture coordinates, or their changes: s and t, and r if there are three components. only_first: of the first vector.
HWY_INLINE void fill_coordinates(const LaneFragments& f, const Shares& shares, Shares& to,
                                 const VertexCoordinates& at_vertex, int components, bool only_first = false) {
  for (std::size_t r = 0; r < f.runs; ++r) {
    const std::array<glm::vec3, 3> corner = at_vertex.of(f.run[r].corners->vertex);
    // Copies: the compiler would read the corners again for each vector, because what is stored might alias them.
    const glm::vec3 a = corner[0], b = corner[1], c = corner[2];
    const std::size_t end = only_first ? 1 : f.run[r + 1].first;
    for (std::size_t i = f.run[r].first; i < end; i = next_vector(i, kLaneCount)) {
      const ShareLanes at(shares, i);
      hn::StoreU(at.interpolate(a.x, b.x, c.x), kDF, to[0].data() + i);
      hn::StoreU(at.interpolate(a.y, b.y, c.y), kDF, to[1].data() + i);
      if (components == 3) hn::StoreU(at.interpolate(a.z, b.z, c.z), kDF, to[2].data() + i);
    }
  }
}

// Where a unit's coordinates for stages go: s, t, r, q, of the fragments or their changes; null: FragmentStages::needs
// none.
using StageLanes = std::array<float*, 4>;

// The coordinates of a unit that stages read.
HWY_INLINE void fill_stage_coordinates(const LaneFragments& f, const Shares& shares, const DrawContext& context,
                                       std::size_t unit, const StageLanes& to) {
  const std::span<const float> q = context.arrays.texture_q[unit];
  const VertexCoordinates coordinates = context.coordinates(unit);
  const bool needs_str = to[0] != nullptr || to[1] != nullptr || to[2] != nullptr;
  for (std::size_t r = 0; r < f.runs; ++r) {
    const std::array<std::uint32_t, 3>& v = f.run[r].corners->vertex;
    const std::array<glm::vec3, 3> str = needs_str ? coordinates.of(v) : std::array<glm::vec3, 3>{};
    std::array<std::array<float, 3>, 4> corner{};  // by coordinate and vertex
    for (std::size_t n = 0; n < 3; ++n) {
      for (std::size_t k = 0; k < 4; ++k) {
        if (to[k] != nullptr) corner[k][n] = k == 3 ? q[v[n]] : str[n][static_cast<int>(k)];
      }
    }
    for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; i = next_vector(i, kLaneCount)) {
      const ShareLanes at(shares, i);
      for (std::size_t k = 0; k < 4; ++k) {
        if (to[k] == nullptr) continue;
        hn::StoreU(at.interpolate(corner[k][0], corner[k][1], corner[k][2]), kDF, to[k] + i);
      }
    }
  }
}

// Divides s, t and, if there are three components, r by q: (s, t, r) / q, and the change of s/q: (s' - (s/q) q') / q.
HWY_INLINE void divide_coordinates(const LaneFragments& f, LaneBatch& batch, std::span<const float> q_at_vertex,
                                   int components, bool changes) {
  for (std::size_t r = 0; r < f.runs; ++r) {
    const std::array<std::uint32_t, 3>& v = f.run[r].corners->vertex;
    const float a = q_at_vertex[v[0]], b = q_at_vertex[v[1]], c = q_at_vertex[v[2]];
    for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; i += kLaneCount) {
      // Fragments beyond the run's end belong to the next run, which has its own q.
      const auto mask = hn::FirstN(kDF, f.run[r + 1].first - i);
      const VF q = ShareLanes(f.weight, i).interpolate(a, b, c);
      for (int k = 0; k < components; ++k) {
        const auto n = static_cast<std::size_t>(k);
        float* const at = batch.coordinate[n].data() + i;
        const VF divided = hn::Div(hn::LoadU(kDF, at), q);
        store_where(mask, divided, kDF, at);
        if (!changes) continue;
        for (LaneBatch::Changes* const change : {&batch.dx, &batch.dy}) {
          float* const by = change->coordinate[n].data() + i;
          const VF of_q = ShareLanes(change->share, i).interpolate(a, b, c);
          const VF difference = hn::Sub(hn::LoadU(kDF, by), hn::Mul(divided, of_q));
          store_where(mask, hn::Div(difference, q), kDF, by);
        }
      }
    }
  }
}

#endif  // HWY_TARGET != HWY_SCALAR

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
