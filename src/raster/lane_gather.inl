// Vectors of fragments into a batch. No include guard: included once inside Highway's namespace of every SIMD target,
// after lane_operations.inl and `Pen`.

// Those of the fragments that have to go into the batch, which then has room for them and no other at their pixels.
template <class D>
HWY_INLINE hn::Mask<D> gathered(D d, const LaneDraw<D>& draw, const Pen& pen, std::size_t place, hn::Mask<D> mask,
                                hn::Vec<D> depth) {
  const LaneOperations& operations = draw.operations;
  LaneTile& tile = pen.tile;
  const std::int32_t* const at = lanes_of(tile.tile.depth_stencil.data()) + place;
  const std::size_t row = place / kTileSize, column = place % kTileSize;
  if (operations.is_equal_alone) {
    // Fragments that are kept are those of all stencil values.
    const auto set = [&](std::uint32_t v) HWY_ATTR { return hn::Set(d, static_cast<std::int32_t>(v)); };
    const auto counts = set(pen.pass.keeps ? 0xFFFFFF00 : operations.equal_bits);
    const auto wanted = hn::Or(hn::ShiftLeft<8>(depth), set(pen.pass.keeps ? 0 : operations.equal_value));
    mask = hn::And(mask, hn::Eq(hn::And(hn::LoadU(d, at), counts), wanted));
  } else {
    // What waits may still change the outcome of tests.
    if (operations.tests_change && (tile.occupied[row] & (bits_of(d, mask) << column)) != 0) {
      flush_lanes(tile, pen.pass);
    }
    mask = not_lost(d, draw, mask, depth, hn::LoadU(d, at));
  }
  const std::uint64_t bits = bits_of(d, mask) << column;
  if ((tile.occupied[row] & bits) != 0 || tile.fragments->count + hn::Lanes(d) > kBatchSize) {
    flush_lanes(tile, pen.pass);
  }
  tile.occupied[row] |= bits;
  return mask;
}

template <class D>
HWY_INLINE void push(D d, const Pen& pen, std::size_t place, hn::Mask<D> mask, hn::Vec<D> depth,
                     const hn::Vec<hn::Rebind<float, D>> weight[3]) {
  LaneFragments& batch = *pen.tile.fragments;
  const hn::Rebind<float, D> df;
  const std::size_t at = batch.count;
  if (batch.runs == 0 || batch.run[batch.runs - 1].primitive != &pen.primitive) {
    batch.run[batch.runs++] = {&pen.primitive, &pen.block, at};
  }
  std::uint64_t bits = bits_of(d, mask);
  std::size_t span_first = at;
  do {  // mostly once
    const auto begin = static_cast<std::size_t>(__builtin_ctzll(bits));
    const auto length = static_cast<std::size_t>(__builtin_ctzll(~(bits >> begin)));
    batch.span[batch.spans++] = {static_cast<std::uint16_t>(place + begin), static_cast<std::uint8_t>(length),
                                 static_cast<std::uint16_t>(span_first)};
    span_first += length;
    bits = begin + length < 64 ? bits >> (begin + length) << (begin + length) : 0;
  } while (bits != 0);
  batch.count = span_first;
  const auto places = hn::Add(hn::Set(d, static_cast<std::int32_t>(place)), lane_numbers(d));
  const bool has_depth = !pen.pass.operations.are_tests_final;
  float* const weights = batch.weight[0].data() + at;
  const std::size_t stride = LaneFragments::kRoom;
  const auto& corner = pen.primitive.corner;
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
