// Several triangles placed in a tile at a time. No include guard: included once inside Highway's namespace of every
// SIMD target, with `hn` for its operations, D the tag of up to 16 words and DD that of half as many doubles.

// Triangles of which all corners lie within 2^14 sixteenths of a pixel of their region's origin: the rest is
// TileTriangles::place.
HWY_INLINE hn::Mask<D> place_small(TileTriangles& t, const SetupBlock& block, const std::uint32_t* indices,
                                   const PixelBox& tile, hn::Mask<D>& is_drawn) {
  const auto store_float = [](V v, TileTriangles::Each<float>& to)
                               HWY_ATTR { hn::Store(hn::ConvertTo(kDF, v), kDF, to.data()); };
  const V record = hn::Mul(hn::LoadU(kD, reinterpret_cast<const std::int32_t*>(indices)),
                           hn::Set(kD, static_cast<std::int32_t>(sizeof(SetupPrimitive))));
  const SetupPrimitive& first = block.primitives[0];
  const auto field = [&](const void* of_first)
                         HWY_ATTR { return hn::GatherOffset(kD, static_cast<const std::int32_t*>(of_first), record); };
  // Two bounds in a word, the first one in its lower half.
  static_assert(offsetof(PixelBounds, bottom) == 2 && offsetof(PixelBounds, right) == 4 &&
                offsetof(PixelBounds, top) == 6);
  const V low = field(&first.box.left), high = field(&first.box.right);
  const auto lower = [](V word) HWY_ATTR { return hn::ShiftRight<16>(hn::ShiftLeft<16>(word)); };
  const V left = hn::Max(lower(low), hn::Set(kD, tile.left)), right = hn::Min(lower(high), hn::Set(kD, tile.right - 1));
  const V bottom = hn::Max(hn::ShiftRight<16>(low), hn::Set(kD, tile.bottom));
  const V top = hn::Min(hn::ShiftRight<16>(high), hn::Set(kD, tile.top - 1));
  hn::Store(left, kD, t.left.data());
  hn::Store(right, kD, t.right.data());
  hn::Store(bottom, kD, t.bottom.data());
  hn::Store(top, kD, t.top.data());
  const V columns = hn::Sub(right, left), rows = hn::Sub(top, bottom);
  const V zero = hn::Zero(kD), one = hn::Set(kD, 1);
  is_drawn = hn::Gt(hn::Min(columns, rows), hn::Set(kD, -1));

  const V centre_x = hn::Add(hn::ShiftLeft<4>(left), hn::Set(kD, 8));
  const V centre_y = hn::Add(hn::ShiftLeft<4>(bottom), hn::Set(kD, 8));
  V x[3], y[3];
  V reach = zero;
  const V high_y = field(&first.position.word[3]);
  constexpr int kLow = PackedPositions::kLow, kHigh = PackedPositions::kHigh;
  for (std::size_t i = 0; i < 3; ++i) {
    const V word = field(&first.position.word[i]);
    const V high_part = hn::ShiftRight<32 - kHigh>(hn::ShiftLeftSame(high_y, 32 - kHigh - kHigh * static_cast<int>(i)));
    const V low_part = hn::And(word, hn::Set(kD, (1 << kLow) - 1));
    x[i] = hn::Sub(hn::ShiftRight<kLow>(word), centre_x);
    y[i] = hn::Sub(hn::Or(hn::ShiftLeft<kLow>(high_part), low_part), centre_y);
    reach = hn::Max(reach, hn::Max(hn::Abs(x[i]), hn::Abs(y[i])));
  }
  V edge[3], step_x[3], step_y[3];
  for (std::size_t i = 0; i < 3; ++i) {
    // The edge from corner a to corner b: at the origin its function is the cross product of the two.
    const std::size_t a = (i + 1) % 3, b = (i + 2) % 3;
    edge[i] = hn::Sub(hn::Mul(x[a], y[b]), hn::Mul(y[a], x[b]));
    const V dx = hn::Sub(x[b], x[a]), dy = hn::Sub(y[b], y[a]);
    const auto keeps_zero = hn::Or(hn::Lt(dy, zero), hn::And(hn::Eq(dy, zero), hn::Lt(dx, zero)));
    const V threshold = hn::IfThenElse(keeps_zero, zero, one);
    step_x[i] = hn::ShiftLeft<4>(hn::Neg(dy));
    step_y[i] = hn::ShiftLeft<4>(dx);
    const V inside = hn::Sub(edge[i], threshold);
    const V across = hn::Max(hn::Mul(step_x[i], columns), zero), up = hn::Max(hn::Mul(step_y[i], rows), zero);
    is_drawn = hn::And(is_drawn, hn::Gt(hn::Add(inside, hn::Add(across, up)), hn::Set(kD, -1)));
    hn::Store(inside, kD, t.inside[i].data());
    hn::Store(step_x[i], kD, t.inside_x[i].data());
    hn::Store(step_y[i], kD, t.inside_y[i].data());
    hn::Store(threshold, kD, t.threshold[i].data());
    store_float(inside, t.float_inside[i]);
    store_float(step_x[i], t.float_inside_x[i]);
    store_float(step_y[i], t.float_inside_y[i]);
  }
  const V z0 = field(&first.z24[0]);
  const V dz1 = hn::Sub(field(&first.z24[1]), z0), dz2 = hn::Sub(field(&first.z24[2]), z0);
  const V area = hn::Add(hn::Add(edge[0], edge[1]), edge[2]);
  const hn::Half<D> half;
  const auto real = [&](V v, bool upper) HWY_ATTR {
    return hn::PromoteTo(kDD, upper ? hn::UpperHalf(half, v) : hn::LowerHalf(half, v));
  };
  for (const bool upper : {false, true}) {
    const auto r = [&](V v) HWY_ATTR { return real(v, upper); };
    // See TileTriangles::place.
    const auto scale = hn::Div(hn::Set(kDD, 1.0), r(area));
    const auto z1 = r(dz1), z2 = r(dz2), e1 = r(edge[1]), e2 = r(edge[2]);
    const auto plane = [&](auto first_edge, auto second_edge) HWY_ATTR {
      return hn::Mul(hn::Add(hn::Mul(first_edge, z1), hn::Mul(second_edge, z2)), scale);
    };
    const auto slope_x = plane(r(step_x[1]), r(step_x[2])), slope_y = plane(r(step_y[1]), r(step_y[2]));
    const auto origin = hn::Add(hn::Add(r(z0), plane(e1, e2)), hn::Set(kDD, 0.5));
    const auto steep = hn::Max(hn::Abs(slope_x), hn::Abs(slope_y));
    const auto far = hn::Mul(hn::Add(hn::Abs(e1), hn::Abs(e2)), scale);
    const auto is_sure =
        hn::And(hn::And(hn::Le(steep, hn::Set(kDD, kSteepestDepth)), hn::Le(far, hn::Set(kDD, kFarthestDepth))),
                hn::Le(hn::Abs(origin), hn::Set(kDD, kHighestDepth)));
    const auto kept = hn::IfThenElseZero(is_sure, hn::Set(kDD, kDepthOne));
    const std::size_t at = upper ? hn::Lanes(kDD) : 0;
    hn::Store(hn::Mul(origin, kept), kDD, t.depth.data() + at);
    const auto kept_x = hn::Mul(slope_x, kept), kept_y = hn::Mul(slope_y, kept);
    hn::Store(kept_x, kDD, t.depth_x.data() + at);
    hn::Store(kept_y, kDD, t.depth_y.data() + at);
    hn::Store(hn::ConvertTo(kD64, kept_x), kD64, t.depth_step_x.data() + at);
    hn::Store(hn::ConvertTo(kD64, kept_y), kD64, t.depth_step_y.data() + at);
  }
  t.is_narrow.fill(true);
  // A region's vectors reach 8 columns and 68 rows from its origin: differences of corners and their pixels stay below
  // 2,700, twice the products below 2^24.
  const V has_floats = hn::VecFromMask(kD, hn::Lt(reach, hn::Set(kD, 1536)));
  hn::Store(hn::And(has_floats, one), kD, t.has_floats.data());
  return hn::Lt(reach, hn::Set(kD, 1 << 14));
}
