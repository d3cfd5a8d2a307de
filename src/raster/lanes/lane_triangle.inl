// One triangle in a tile, vector by vector. No include guard: included once inside Highway's namespace of every SIMD
// target, in tile_lanes.cpp.

// What becomes of a triangle's fragments.
enum class Drawing {
  nearest,  // LanePass::draws_nearest_alone
  noted,    // the same, and notes_owners
  flat,     // one colour, through the operations
  gathers   // into the batch
};

constexpr bool is_nearest(Drawing drawing) {
  return drawing == Drawing::nearest || drawing == Drawing::noted;
}

// The depth plane of triangle k along a row and up the rows, 32 fraction bits.
struct DepthLanes {
  V64 row;  // the lower half of the lanes
  V64 half, step, up;
  HWY_INLINE DepthLanes(const TileTriangles& t, std::size_t k) {
    row = at_first_lanes(t, k, hn::Mul(real_lane_numbers(), hn::Set(kDD, t.depth_x[k])));
    half = hn::Set(kD64, t.depth_step_x[k] * (kLanes / 2));
    step = hn::Set(kD64, t.depth_step_x[k] * kLanes);
    up = hn::Set(kD64, t.depth_step_y[k]);
  }
  static HWY_INLINE V64 at_first_lanes(const TileTriangles& t, std::size_t k, hn::Vec<DD> from_origin) {
    return hn::ConvertTo(kD64, hn::Add(hn::Set(kDD, t.depth[k]), from_origin));
  }
};

// Window depths of the lanes of the mask, the first of which is pixel (x, y).
template <class Rows>
HWY_INLINE V find_depths(const SetupPrimitive& p, int x, int y, M mask, V64 z_low, V64 z_high) {
  const hn::RebindToUnsigned<D> du;
  const auto low = hn::BitCast(du, z_low), high = hn::BitCast(du, z_high);
  const V z24 = hn::BitCast(kD, hn::ConcatOdd(du, high, low));
  const auto fraction = hn::Add(hn::ConcatEven(du, high, low), hn::Set(du, kDepthDoubt));
  const M doubtful = hn::And(mask, hn::RebindMask(kD, hn::Lt(fraction, hn::Set(du, 2 * kDepthDoubt))));
  if (HWY_UNLIKELY(!hn::AllFalse(kD, doubtful))) return exact_depth<Rows>(p, x, y, doubtful, z24);
  return z24;
}

// An edge function × 1/w of its corner at a vector of pixels, the first of which is (x, y); `inside` is that of
// TileTriangles there.
HWY_INLINE hn::Vec<DF> weight_of(const Pen& pen, const TileTriangles& t, std::size_t k, std::size_t i, int x, int y,
                                 V inside) {
  const auto edge =
      t.is_narrow[k] ? hn::ConvertTo(kDF, hn::Add(inside, hn::Set(kD, t.threshold[i][k]))) : wide_edge(t, k, i, x, y);
  return hn::Mul(edge, hn::Set(kDF, pen.corners->inv_w[i]));
}
// The same where `inside` is in floats.
HWY_INLINE hn::Vec<DF> weight_of(const Pen& pen, const TileTriangles& t, std::size_t k, std::size_t i, int, int,
                                 hn::Vec<DF> inside) {
  const auto edge = hn::Add(inside, hn::ConvertTo(kDF, hn::Set(kD, t.threshold[i][k])));
  return hn::Mul(edge, hn::Set(kDF, pen.corners->inv_w[i]));
}

template <Drawing kDrawing, class Rows, class Inside>
HWY_INLINE void draw_fragments(const LaneDraw<D>& draw, const Pen& pen, const TileTriangles& t, std::size_t k, int x,
                               int y, std::size_t place, M mask, V64 z_low, V64 z_high, const Inside e[3]) {
  const SetupPrimitive& p = pen.primitive;
  const hn::RebindToUnsigned<D> du;
  const V z24 = find_depths<Rows>(p, x, y, mask, z_low, z_high);
  if constexpr (is_nearest(kDrawing)) {
    std::int32_t* const at = lanes_of(pen.tile.tile.depth_stencil.data()) + place;
    // Whatever the stencil value is: depth × 256 + 255 is less where the depth is.
    const auto stencil_bits = hn::Set(du, 0xFF), stored = hn::BitCast(du, Rows::load(kD, at));
    const auto depth = hn::Or(hn::ShiftLeft<8>(hn::BitCast(du, z24)), stencil_bits);
    const M drawn = hn::And(mask, hn::RebindMask(kD, hn::Lt(depth, stored)));
    const auto after = hn::Or(hn::AndNot(stencil_bits, depth), hn::And(stencil_bits, stored));
    Rows::blend(hn::BitCast(kD, after), drawn, kD, at);
    if constexpr (kDrawing == Drawing::noted) {
      const M equal = hn::And(mask, has_depth(kD, hn::BitCast(kD, stored), z24));
      if (HWY_UNLIKELY(!hn::AllFalse(kD, equal))) pen.tile.knows_owners = false;
      Rows::put(hn::Set(kD, static_cast<std::int32_t>(pen.number)), drawn, kD,
                lanes_of(pen.tile.tile.owner.data()) + place);
    }
    if (draw.operations.color) {
      Rows::put(hn::Set(kD, static_cast<std::int32_t>(pen.color)), drawn, kD,
                lanes_of(pen.tile.tile.color.data()) + place);
    }
  } else if constexpr (kDrawing == Drawing::flat) {
    draw_flat<Rows>(kD, draw, pen, place, mask, depth_codes(kD, pen.pass, p, z24));
  } else {
    const V depth = depth_codes(kD, pen.pass, p, z24);
    mask = gathered<Rows>(kD, draw, pen, place, mask, depth);
    if (hn::AllFalse(kD, mask)) return;
    hn::Vec<DF> weight[3];
    for (std::size_t i = 0; i < 3; ++i) weight[i] = weight_of(pen, t, k, i, x, y, e[i]);
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

// Fragments of a row, a bit for each from the region's left side on, into the batch: a span at a time.
HWY_INLINE void push_row(const Pen& pen, const TileTriangles& t, std::size_t k, int y, std::size_t row_place,
                         const V row[3], std::uint64_t bits) {
  LaneTile& tile = pen.tile;
  const std::uint64_t columns = bits << row_place % kTileSize;
  const auto count = static_cast<std::size_t>(std::popcount(bits));
  if ((tile.occupied[row_place / kTileSize] & columns) != 0 || tile.fragments->count + count > kBatchSize) {
    flush_lanes(tile, pen.pass);
  }
  tile.occupied[row_place / kTileSize] |= columns;
  LaneFragments& batch = *tile.fragments;
  begin_run(batch, pen);
  while (bits != 0) {
    const int column = std::countr_zero(bits);
    const int length = std::min(std::countr_one(bits >> column), kLanes);
    bits &= ~(((std::uint64_t{1} << length) - 1) << column);
    const std::size_t at = batch.count, place = row_place + static_cast<std::size_t>(column);
    batch.span[batch.spans++] = {static_cast<std::uint16_t>(place), static_cast<std::uint8_t>(length),
                                 static_cast<std::uint16_t>(at)};
    // What follows the last lane is written again by the next fragments.
    hn::StoreU(hn::Add(hn::Set(kD, static_cast<std::int32_t>(place)), lane_numbers(kD)), kD,
               lanes_of(batch.place.data()) + at);
    for (std::size_t i = 0; i < 3; ++i) {
      const V inside = hn::Add(row[i], hn::Set(kD, t.inside_x[i][k] * column));
      hn::StoreU(weight_of(pen, t, k, i, t.left[k] + column, y, inside), kDF,
                 batch.weight[pen.corners->corner[i]].data() + at);
    }
    batch.count += static_cast<std::size_t>(length);
  }
}

// A triangle of a pass that asks_equal_depth: rows are looked at whole before their fragments are gathered. kOwned: of
// a tile that knows_owners.
template <bool kOwned>
HWY_NOINLINE void gather_rows(const Pen& pen, const TileTriangles& t, std::size_t k) {
  const LaneDraw<D> draw(kD, pen.pass.operations, pen.primitive.front_facing);
  const bool asks_stencil = draw.operations.stencil_decides && !pen.pass.keeps;
  const V lane = lane_numbers(kD);
  V row[3], step[3], up[3];
  for (std::size_t i = 0; i < 3; ++i) {
    row[i] = hn::Add(hn::Set(kD, t.inside[i][k]), hn::Mul(lane, hn::Set(kD, t.inside_x[i][k])));
    step[i] = hn::Set(kD, t.inside_x[i][k] * kLanes);
    up[i] = hn::Set(kD, t.inside_y[i][k]);
  }
  DepthLanes z(t, k);
  const int left = t.left[k], columns = t.right[k] - left + 1, top = t.top[k];
  // Where the region ends, the triangle may go on.
  const std::uint64_t region = ~std::uint64_t{0} >> (kTileSize - columns);
  auto row_place = static_cast<std::size_t>((t.bottom[k] - pen.tile.bottom) * kTileSize + (left - pen.tile.left));
  const std::int32_t* const stored = lanes_of(pen.tile.tile.depth_stencil.data());
  const std::int32_t* const owner = lanes_of(pen.tile.tile.owner.data());
  const V number = hn::Set(kD, static_cast<std::int32_t>(pen.number));
  for (int y = t.bottom[k];; ++y, row_place += kTileSize) {
    V e[3] = {row[0], row[1], row[2]};
    V64 z_low = z.row;
    std::uint64_t bits = 0;
    for (int column = 0; column < columns; column += kLanes) {
      if constexpr (kOwned) {
        const std::size_t at = row_place + static_cast<std::size_t>(column);
        M mask = hn::Eq(hn::LoadU(kD, owner + at), number);
        if (asks_stencil) mask = hn::And(mask, stencil_passes(kD, draw, hn::LoadU(kD, stored + at)));
        bits |= bits_of(kD, mask) << column;
        continue;
      }
      M mask = hn::Gt(hn::Or(hn::Or(e[0], e[1]), e[2]), hn::Set(kD, -1));
      if (!hn::AllFalse(kD, mask)) {
        const V z24 = find_depths<OneRow>(pen.primitive, left + column, y, mask, z_low, hn::Add(z_low, z.half));
        const V depth = depth_codes(kD, pen.pass, pen.primitive, z24);
        const V here = hn::LoadU(kD, stored + row_place + static_cast<std::size_t>(column));
        mask = hn::And(mask, has_depth(kD, here, depth));
        if (asks_stencil) mask = hn::And(mask, stencil_passes(kD, draw, here));
        bits |= bits_of(kD, mask) << column;
      }
      for (std::size_t i = 0; i < 3; ++i) e[i] = hn::Add(e[i], step[i]);
      z_low = hn::Add(z_low, z.step);
    }
    bits &= region;
    if (bits != 0) push_row(pen, t, k, y, row_place, row, bits);
    if (y == top) break;
    for (std::size_t i = 0; i < 3; ++i) row[i] = hn::Add(row[i], up[i]);
    z.row = hn::Add(z.row, z.up);
  }
}

// As draw_triangle, for a triangle that has_floats and whose region is no wider than a row of Rows.
template <Drawing kDrawing, class Rows>
HWY_INLINE void draw_slim_triangle(const Pen& pen, const TileTriangles& t, std::size_t k) {
  constexpr int kRows = static_cast<int>(Rows::kRows);
  const LaneDraw<D> draw(kD, pen.pass.operations, pen.primitive.front_facing);
  const V column = Rows::columns(), row = Rows::rows(kD);
  const auto float_column = hn::ConvertTo(kDF, column), float_row = hn::ConvertTo(kDF, row);
  hn::Vec<DF> e[3], up[3];
  for (std::size_t i = 0; i < 3; ++i) {
    const auto step_y = hn::Set(kDF, t.float_inside_y[i][k]);
    const auto in_column = hn::MulAdd(float_row, step_y, hn::Set(kDF, t.float_inside[i][k]));
    e[i] = hn::MulAdd(float_column, hn::Set(kDF, t.float_inside_x[i][k]), in_column);
    up[i] = hn::Mul(step_y, hn::Set(kDF, kRows));
  }
  V64 z_low = DepthLanes::at_first_lanes(t, k, Rows::in_lower_half(t.depth_x[k], t.depth_y[k]));
  const V64 z_step = hn::Set(kD64, t.depth_step_y[k]);
  V64 z_high = hn::Add(z_low, hn::ShiftLeft<kRows / 4>(z_step));
  const V64 z_up = hn::ShiftLeft<kRows / 2>(z_step);
  const int left = t.left[k], top = t.top[k];
  const M within = hn::Lt(column, hn::Set(kD, t.right[k] - left + 1));
  auto place = static_cast<std::size_t>((t.bottom[k] - pen.tile.bottom) * kTileSize + (left - pen.tile.left));
  for (int y = t.bottom[k];; y += kRows, place += Rows::kRows * kTileSize) {
    M mask = hn::And(within, hn::Gt(hn::BitCast(kD, hn::Or(hn::Or(e[0], e[1]), e[2])), hn::Set(kD, -1)));
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
    if (columns <= Rows::kColumns && t.has_floats[k] != 0) return draw_slim_triangle<kDrawing, Rows>(pen, t, k);
  }
  if constexpr (kLanes >= 8) {
    using Rows = SeveralRows<2>;
    if (columns <= Rows::kColumns && t.has_floats[k] != 0) return draw_slim_triangle<kDrawing, Rows>(pen, t, k);
  }
  if (kDrawing == Drawing::gathers && pen.pass.operations.asks_equal_depth) {
    return pen.tile.knows_owners ? gather_rows<true>(pen, t, k) : gather_rows<false>(pen, t, k);
  }
  draw_triangle<kDrawing>(pen, t, k);
}
