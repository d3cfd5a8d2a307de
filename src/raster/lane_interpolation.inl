// What the fragments of a batch have of their vertices' values. No include guard: included once inside Highway's
// namespace of every SIMD target, in lane_batch.cpp.

// Divides the weights by their sum.
HWY_INLINE void normalize(LaneFragments& f) {
  for (std::size_t i = 0; i < f.count; i += kLanes) {
    float* const w[3] = {f.weight[0].data() + i, f.weight[1].data() + i, f.weight[2].data() + i};
    const VF a = hn::Load(kDF, w[0]), b = hn::Load(kDF, w[1]), c = hn::Load(kDF, w[2]);
    const VF sum = hn::Add(hn::Add(a, b), c);
    hn::Store(hn::Div(a, sum), kDF, w[0]);
    hn::Store(hn::Div(b, sum), kDF, w[1]);
    hn::Store(hn::Div(c, sum), kDF, w[2]);
  }
}

HWY_INLINE void find_shares(LaneFragments& f) {
  if (f.has_shares) return;
  normalize(f);
  unclip(f);
  f.has_shares = true;
}

// A value at fragments from i on, from those at the vertices.
HWY_INLINE VF interpolate(const LaneFragments& f, std::size_t i, float a, float b, float c) {
  const VF wa = hn::LoadU(kDF, f.weight[0].data() + i), wb = hn::LoadU(kDF, f.weight[1].data() + i),
           wc = hn::LoadU(kDF, f.weight[2].data() + i);
  return hn::Add(hn::Add(hn::Mul(wa, hn::Set(kDF, a)), hn::Mul(wb, hn::Set(kDF, b))), hn::Mul(wc, hn::Set(kDF, c)));
}

HWY_INLINE void fill_smooth_colors(const LaneFragments& f, LaneBatch& batch, std::span<const ColorBytes> colors) {
  for (std::size_t r = 0; r < f.runs; ++r) {
    const std::array<std::uint32_t, 3>& v = f.run[r].corners->vertex;
    // Not read again for each vector, as what is stored might be a colour for all that the compiler knows.
    std::array<std::array<float, 3>, 4> corner;
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t n = 0; n < 3; ++n) corner[k][n] = static_cast<float>(colors[v[n]][k]);
    }
    // What is stored beyond the run's end, the next one stores again.
    for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; i += kLanes) {
      const auto byte = [&](std::size_t k) HWY_ATTR {
        const VF value = interpolate(f, i, corner[k][0], corner[k][1], corner[k][2]);
        return hn::Floor(hn::Min(hn::Max(hn::Add(value, hn::Set(kDF, 0.5F)), hn::Zero(kDF)), hn::Set(kDF, 255.0F)));
      };
      // Two bytes side by side, in the low bits of a float that is beyond 2^23: exact, and faster than conversions.
      const auto two_bytes = [&](std::size_t k) HWY_ATTR {
        const VF both = hn::Add(byte(k), hn::Mul(byte(k + 1), hn::Set(kDF, 256.0F)));
        return hn::BitCast(kD, hn::Add(both, hn::Set(kDF, 0x1p23F)));
      };
      const V low = hn::And(two_bytes(0), hn::Set(kD, 0xFFFF));
      hn::StoreU(hn::Or(hn::ShiftLeft<16>(two_bytes(2)), low), kD, lanes_of(batch.color.data()) + i);
    }
  }
}

HWY_INLINE void fill_coordinates(const LaneFragments& f, LaneBatch& batch, std::span<const glm::vec3> at_vertex,
                                 int components) {
  for (std::size_t r = 0; r < f.runs; ++r) {
    const std::array<std::uint32_t, 3>& v = f.run[r].corners->vertex;
    const glm::vec3 a = at_vertex[v[0]], b = at_vertex[v[1]], c = at_vertex[v[2]];
    for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; i += kLanes) {
      for (int k = 0; k < components; ++k) {
        hn::StoreU(interpolate(f, i, a[k], b[k], c[k]), kDF, batch.coordinate[static_cast<std::size_t>(k)].data() + i);
      }
    }
  }
}

// (s, t, r) / q.
HWY_INLINE void divide_coordinates(const LaneFragments& f, LaneBatch& batch, std::span<const float> q_at_vertex,
                                   int components) {
  for (std::size_t r = 0; r < f.runs; ++r) {
    const std::array<std::uint32_t, 3>& v = f.run[r].corners->vertex;
    const float a = q_at_vertex[v[0]], b = q_at_vertex[v[1]], c = q_at_vertex[v[2]];
    for (std::size_t i = f.run[r].first; i < f.run[r + 1].first; i += kLanes) {
      // The fragments beyond the run's end are another one's, which has its own q.
      const auto mask = hn::FirstN(kDF, f.run[r + 1].first - i);
      const VF q = interpolate(f, i, a, b, c);
      for (int k = 0; k < components; ++k) {
        float* const at = batch.coordinate[static_cast<std::size_t>(k)].data() + i;
        hn::BlendedStore(hn::Div(hn::LoadU(kDF, at), q), mask, kDF, at);
      }
    }
  }
}
