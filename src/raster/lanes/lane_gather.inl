// Vectors of fragments into a batch. No include guard: included once inside Highway's namespace of every SIMD target,
// after lane_operations.inl and `Pen`.

// Calls visit(row, bits) for the rows of the tile in which lanes of the mask lie, with a bit for each column.
template <class Rows, class D, class Visit>
HWY_INLINE void for_rows(D d, std::size_t place, hn::Mask<D> mask, Visit visit) {
  constexpr std::size_t kColumns = hn::MaxLanes(D()) / Rows::kRows;
  std::uint64_t bits = bits_of(d, mask);
  const std::size_t column = place % kTileSize;
  for (std::size_t r = 0; r < Rows::kRows; ++r, bits >>= kColumns) {
    visit(place / kTileSize + r, (bits & ((std::uint64_t{1} << kColumns) - 1)) << column);
  }
}

// Those of the fragments that have to go into the batch, which then has room for them and no other at their pixels.
template <class Rows, class D>
HWY_INLINE hn::Mask<D> gathered(D d, const LaneDraw<D>& draw, const Pen& pen, std::size_t place, hn::Mask<D> mask,
                                hn::Vec<D> depth) {
  const LaneOperations& operations = draw.operations;
  LaneTile& tile = pen.tile;
  const std::int32_t* const at = lanes_of(tile.tile.depth_stencil.data()) + place;
  const auto meet = [&](hn::Mask<D> lanes) HWY_ATTR {
    bool any = false;
    for_rows<Rows>(d, place, lanes, [&](std::size_t row, std::uint64_t bits) HWY_ATTR {
      any = any || (tile.occupied[row] & bits) != 0;
    });
    return any;
  };
  if (operations.asks_equal_depth) {
    const auto stored = Rows::load(d, at);
    mask = hn::And(mask, has_depth(d, stored, depth));
    // Fragments that are kept are those of all stencil values.
    if (operations.stencil_decides && !pen.pass.keeps) mask = hn::And(mask, stencil_passes(d, draw, stored));
  } else {
    // What waits may still change the outcome of tests.
    if (operations.tests_change && meet(mask)) flush_lanes(tile, pen.pass);
    mask = not_lost(d, draw, mask, depth, Rows::load(d, at));
  }
  if (meet(mask) || tile.fragments->count + hn::Lanes(d) > kBatchSize) flush_lanes(tile, pen.pass);
  for_rows<Rows>(d, place, mask, [&](std::size_t row, std::uint64_t bits) HWY_ATTR { tile.occupied[row] |= bits; });
  return mask;
}

// Unless the last fragments are the same primitive's.
HWY_INLINE void begin_run(LaneFragments& batch, const Pen& pen) {
  if (batch.runs == 0 || batch.run[batch.runs - 1].primitive != &pen.primitive) {
    batch.run[batch.runs++] = {&pen.primitive, pen.corners, pen.block.weights_of(*pen.corners), batch.count};
  }
}

template <class Rows, class D>
HWY_INLINE void push(D d, const Pen& pen, std::size_t place, hn::Mask<D> mask, hn::Vec<D> depth,
                     const hn::Vec<hn::Rebind<float, D>> weight[3]) {
  LaneFragments& batch = *pen.tile.fragments;
  const hn::Rebind<float, D> df;
  const std::size_t at = batch.count;
  begin_run(batch, pen);
  std::size_t span_first = at;
  for_rows<Rows>(d, place, mask, [&](std::size_t row, std::uint64_t bits) HWY_ATTR {
    while (bits != 0) {  // mostly once
      const auto begin = static_cast<std::size_t>(__builtin_ctzll(bits));
      const auto length = static_cast<std::size_t>(__builtin_ctzll(~(bits >> begin)));
      batch.span[batch.spans++] = {static_cast<std::uint16_t>(row * kTileSize + begin),
                                   static_cast<std::uint8_t>(length), static_cast<std::uint16_t>(span_first)};
      span_first += length;
      bits = begin + length < 64 ? bits >> (begin + length) << (begin + length) : 0;
    }
  });
  batch.count = span_first;
  const auto places = hn::Add(hn::Set(d, static_cast<std::int32_t>(place)), Rows::places(d));
  const bool has_depth = !pen.pass.operations.are_tests_final;
  float* const weights = batch.weight[0].data() + at;
  const std::size_t stride = LaneFragments::kRoom;
  const auto& corner = pen.corners->corner;
  if (hn::AllTrue(d, mask)) {
    hn::StoreU(places, d, lanes_of(batch.place.data()) + at);
    if (has_depth) hn::StoreU(depth, d, lanes_of(batch.depth.data()) + at);
    for (std::size_t i = 0; i < 3; ++i) hn::StoreU(weight[i], df, weights + corner[i] * stride);
  } else {
    // Compressed in registers: to memory it would be slow on some processors. What follows the last lane is written
    // again by the next fragments.
    hn::StoreU(hn::Compress(places, mask), d, lanes_of(batch.place.data()) + at);
    if (has_depth) hn::StoreU(hn::Compress(depth, mask), d, lanes_of(batch.depth.data()) + at);
    const auto float_mask = hn::RebindMask(df, mask);
    for (std::size_t i = 0; i < 3; ++i) {
      hn::StoreU(hn::Compress(weight[i], float_mask), df, weights + corner[i] * stride);
    }
  }
}
