// How the lanes of a vector lie in a tile. No include guard: included once inside Highway's namespace of every SIMD
// target, in tile_lanes.cpp.

// Side by side in a row.
struct OneRow {
  static constexpr std::size_t kRows = 1;
  static constexpr int column(int lane) { return lane; }
  static constexpr int row(int) { return 0; }

  // From the first one's place on, here and below.
  template <class D>
  static HWY_INLINE hn::Vec<D> load(D d, const std::int32_t* at) {
    return hn::LoadU(d, at);
  }
  template <class D>
  static HWY_INLINE void store(hn::Vec<D> v, D d, std::int32_t* at) {
    hn::StoreU(v, d, at);
  }
  // Stores the lanes of the mask alone.
  template <class D>
  static HWY_INLINE void blend(hn::Vec<D> v, hn::Mask<D> mask, D d, std::int32_t* at) {
    hn::BlendedStore(v, mask, d, at);
  }
  // How much farther the places of the others are.
  template <class D>
  static HWY_INLINE hn::Vec<D> places(D d) {
    return lane_numbers(d);
  }
};

// One half in a row, the other in the next.
struct TwoRows {
  static constexpr std::size_t kRows = 2;
  static constexpr int kColumns = std::max(kLanes / 2, 1);
  static constexpr int column(int lane) { return lane % kColumns; }
  static constexpr int row(int lane) { return lane / kColumns; }

  static HWY_INLINE V load(D d, const std::int32_t* at) {
    const hn::Half<D> half;
    return hn::Combine(d, hn::LoadU(half, at + kTileSize), hn::LoadU(half, at));
  }
  static HWY_INLINE void store(V v, D, std::int32_t* at) {
    const hn::Half<D> half;
    hn::StoreU(hn::LowerHalf(half, v), half, at);
    hn::StoreU(hn::UpperHalf(half, v), half, at + kTileSize);
  }
  static HWY_INLINE void blend(V v, M mask, D d, std::int32_t* at) {
    store(hn::IfThenElse(mask, v, load(d, at)), d, at);
  }
  static HWY_INLINE V columns() { return hn::And(lane_numbers(kD), hn::Set(kD, kColumns - 1)); }
  static HWY_INLINE V places(D d) {
    const V lane = lane_numbers(d);
    return hn::Add(
        lane, hn::And(hn::Neg(hn::ShiftRightSame(lane, __builtin_ctz(kColumns))), hn::Set(d, kTileSize - kColumns)));
  }
};
