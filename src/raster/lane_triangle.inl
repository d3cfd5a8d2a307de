// One triangle in a tile, vector by vector. No include guard: included once inside Highway's namespace of every SIMD
// target, in tile_lanes.cpp.

// What becomes of a triangle's fragments.
enum class Drawing {
  nearest,  // LaneOperations::is_nearest_alone, and window depths are codes
  flat,     // one colour, through the operations
  gathers   // into the batch
};

// The depth plane of triangle k along a row and up the rows, 32 fraction bits.
struct DepthLanes {
  V64 row;  // the lower half of the lanes
  V64 half, step, up;
  HWY_INLINE DepthLanes(const TileTriangles& t, std::size_t k) {
    row = at_first_lanes(t, k, hn::Mul(real_lane_numbers(), hn::Set(kDD, t.depth_x[k])));
    const auto step_x = static_cast<std::int64_t>(t.depth_x[k]);
    half = hn::Set(kD64, step_x * (kLanes / 2));
    step = hn::Set(kD64, step_x * kLanes);
    up = hn::Set(kD64, static_cast<std::int64_t>(t.depth_y[k]));
  }
  static HWY_INLINE V64 at_first_lanes(const TileTriangles& t, std::size_t k, hn::Vec<DD> from_origin) {
    return hn::ConvertTo(kD64, hn::Add(hn::Set(kDD, t.depth[k]), from_origin));
  }
};

template <Drawing kDrawing, class Rows>
HWY_INLINE void draw_fragments(const LaneDraw<D>& draw, const Pen& pen, const TileTriangles& t, std::size_t k, int x,
                               int y, std::size_t place, M mask, V64 z_low, V64 z_high, const V e[3]) {
  const SetupPrimitive& p = pen.primitive;
  const hn::RebindToUnsigned<D> du;
  const auto low = hn::BitCast(du, z_low), high = hn::BitCast(du, z_high);
  V z24 = hn::BitCast(kD, hn::ConcatOdd(du, high, low));
  const auto fraction = hn::Add(hn::ConcatEven(du, high, low), hn::Set(du, kDepthDoubt));
  const M doubtful = hn::And(mask, hn::RebindMask(kD, hn::Lt(fraction, hn::Set(du, 2 * kDepthDoubt))));
  if (HWY_UNLIKELY(!hn::AllFalse(kD, doubtful))) z24 = exact_depth<Rows>(p, x, y, doubtful, z24);
  if constexpr (kDrawing == Drawing::nearest) {
    std::int32_t* const at = lanes_of(pen.tile.tile.depth_stencil.data()) + place;
    // Whatever the stencil value is: depth × 256 + 255 is less where the depth is.
    const auto stencil_bits = hn::Set(du, 0xFF), stored = hn::BitCast(du, Rows::load(kD, at));
    const auto depth = hn::Or(hn::ShiftLeft<8>(hn::BitCast(du, z24)), stencil_bits);
    const M drawn = hn::And(mask, hn::RebindMask(kD, hn::Lt(depth, stored)));
    const auto after = hn::Or(hn::AndNot(stencil_bits, depth), hn::And(stencil_bits, stored));
    Rows::blend(hn::BitCast(kD, after), drawn, kD, at);
    if (draw.operations.color) {
      Rows::blend(hn::Set(kD, static_cast<std::int32_t>(pen.color)), drawn, kD,
                  lanes_of(pen.tile.tile.color.data()) + place);
    }
  } else if constexpr (kDrawing == Drawing::flat) {
    draw_flat<Rows>(kD, draw, pen, place, mask, depth_codes(kD, pen.pass, p, z24));
  } else {
    const V depth = depth_codes(kD, pen.pass, p, z24);
    mask = gathered<Rows>(kD, draw, pen, place, mask, depth);
    if (hn::AllFalse(kD, mask)) return;
    hn::Vec<DF> weight[3];
    for (std::size_t i = 0; i < 3; ++i) {
      const auto edge =
          t.is_narrow[k] ? hn::ConvertTo(kDF, hn::Add(e[i], hn::Set(kD, t.threshold[i][k]))) : wide_edge(t, k, i, x, y);
      weight[i] = hn::Mul(edge, hn::Set(kDF, p.inv_w[i]));
    }
    push<Rows>(kD, pen, place, mask, depth, weight);
  }
}

template <Drawing kDrawing>
HWY_NOINLINE void draw_triangle(const Pen& pen, const TileTriangles& t, std::size_t k) {
  const LaneDraw<D> draw(kD, pen.pass.operations, pen.primitive.front_facing);
  const V lane = lane_numbers(kD);
  V row[3];
  for (std::size_t i = 0; i < 3; ++i) {
    row[i] = hn::Add(hn::Set(kD, t.inside[i][k]), hn::Mul(lane, hn::Set(kD, t.inside_x[i][k])));
  }
  DepthLanes z(t, k);
  const int left = t.left[k], right = t.right[k], top = t.top[k];
  // Where the region ends, the triangle may go on.
  const M last = hn::FirstN(kD, static_cast<std::size_t>((right - left) % kLanes + 1));
  auto row_place = static_cast<std::size_t>((t.bottom[k] - pen.tile.bottom) * kTileSize + (left - pen.tile.left));
  for (int y = t.bottom[k];; ++y, row_place += kTileSize) {
    V e[3] = {row[0], row[1], row[2]};
    V64 z_low = z.row;
    std::size_t place = row_place;
    for (int x = left;; x += kLanes, place += kLanes) {
      M mask = hn::Gt(hn::Or(hn::Or(e[0], e[1]), e[2]), hn::Set(kD, -1));
      const bool is_last = x + kLanes > right;
      if (is_last) mask = hn::And(mask, last);
      if (!hn::AllFalse(kD, mask)) {
        draw_fragments<kDrawing, OneRow>(draw, pen, t, k, x, y, place, mask, z_low, hn::Add(z_low, z.half), e);
      }
      if (is_last) break;
      for (std::size_t i = 0; i < 3; ++i) e[i] = hn::Add(e[i], hn::Set(kD, t.inside_x[i][k] * kLanes));
      z_low = hn::Add(z_low, z.step);
    }
    if (y == top) break;
    for (std::size_t i = 0; i < 3; ++i) row[i] = hn::Add(row[i], hn::Set(kD, t.inside_y[i][k]));
    z.row = hn::Add(z.row, z.up);
  }
}

// The same for a triangle whose region is no wider than a row of Rows.
template <Drawing kDrawing, class Rows>
HWY_NOINLINE void draw_slim_triangle(const Pen& pen, const TileTriangles& t, std::size_t k) {
  constexpr int kRows = static_cast<int>(Rows::kRows);
  const LaneDraw<D> draw(kD, pen.pass.operations, pen.primitive.front_facing);
  const V column = Rows::columns(), row = Rows::rows(kD);
  V e[3], up[3];
  for (std::size_t i = 0; i < 3; ++i) {
    e[i] = hn::Add(hn::Set(kD, t.inside[i][k]), hn::Mul(column, hn::Set(kD, t.inside_x[i][k])));
    up[i] = hn::Set(kD, t.inside_y[i][k]);
    for (int bit = 1; bit < kRows; bit *= 2) {
      e[i] = hn::IfThenElse(hn::TestBit(row, hn::Set(kD, bit)), hn::Add(e[i], up[i]), e[i]);
      up[i] = hn::Add(up[i], up[i]);
    }
  }
  V64 z_low = DepthLanes::at_first_lanes(t, k, Rows::in_lower_half(t.depth_x[k], t.depth_y[k]));
  const auto step_y = static_cast<std::int64_t>(t.depth_y[k]);
  V64 z_high = hn::Add(z_low, hn::Set(kD64, step_y * (kRows / 2)));
  const V64 z_up = hn::Set(kD64, step_y * kRows);
  const int left = t.left[k], top = t.top[k];
  const M within = hn::Lt(column, hn::Set(kD, t.right[k] - left + 1));
  auto place = static_cast<std::size_t>((t.bottom[k] - pen.tile.bottom) * kTileSize + (left - pen.tile.left));
  for (int y = t.bottom[k];; y += kRows, place += Rows::kRows * kTileSize) {
    M mask = hn::And(within, hn::Gt(hn::Or(hn::Or(e[0], e[1]), e[2]), hn::Set(kD, -1)));
    mask = hn::And(mask, hn::Lt(row, hn::Set(kD, top - y + 1)));
    if (!hn::AllFalse(kD, mask)) {
      draw_fragments<kDrawing, Rows>(draw, pen, t, k, left, y, place, mask, z_low, z_high, e);
    }
    if (y + kRows > top) break;
    for (std::size_t i = 0; i < 3; ++i) e[i] = hn::Add(e[i], up[i]);
    z_low = hn::Add(z_low, z_up);
    z_high = hn::Add(z_high, z_up);
  }
}

template <Drawing kDrawing>
HWY_INLINE void draw_in_rows(const Pen& pen, const TileTriangles& t, std::size_t k) {
  const int columns = t.right[k] - t.left[k] + 1;
  if constexpr (kLanes == 16) {
    using Rows = SeveralRows<4>;
    if (columns <= Rows::kColumns && t.is_narrow[k]) return draw_slim_triangle<kDrawing, Rows>(pen, t, k);
  }
  if constexpr (kLanes >= 8) {
    using Rows = SeveralRows<2>;
    if (columns <= Rows::kColumns && t.is_narrow[k]) return draw_slim_triangle<kDrawing, Rows>(pen, t, k);
  }
  draw_triangle<kDrawing>(pen, t, k);
}
