// Some fragments of a batch. No include guard: included once inside Highway's namespace of every SIMD target, after
// `places_from`.

// Bits of a batch's fragments.
struct FragmentBits {
  static constexpr std::size_t kWord = 64;
  std::array<std::uint64_t, kBatchSize / kWord> word{};

  // Of fragments from i on, a vector of them.
  HWY_INLINE void set(std::size_t i, std::uint64_t bits) { word[i / kWord] |= bits << i % kWord; }
  [[nodiscard]] HWY_INLINE std::uint64_t get(std::size_t i) const {
    return word[i / kWord] >> i % kWord & ((std::uint64_t{1} << kLanes) - 1);
  }
  // How many before fragment i are set.
  [[nodiscard]] std::size_t before(std::size_t i) const {
    std::size_t count = 0;
    for (std::size_t w = 0; w < i / kWord; ++w) count += static_cast<std::size_t>(__builtin_popcountll(word[w]));
    if (i % kWord == 0) return count;
    return count + static_cast<std::size_t>(__builtin_popcountll(word[i / kWord] << (kWord - i % kWord)));
  }
};

HWY_INLINE FragmentBits pass_stencil_test(const LaneTile& tile, const LaneOperations& operations,
                                          const LaneFragments& f) {
  FragmentBits passing;
  const LaneDraw<D> draw(kD, operations, true);
  for (std::size_t i = 0; i < f.count; i += kLanes) {
    const auto mask = hn::FirstN(kD, f.count - i);
    const V stored = hn::GatherIndex(kD, lanes_of(tile.tile.depth_stencil.data()), places_from(f, i, mask));
    passing.set(i, bits_of(kD, hn::And(mask, stencil_passes(kD, draw, stored))));
  }
  return passing;
}

HWY_INLINE void copy_some(const LaneFragments& f, const FragmentBits& which, LaneFragments& to) {
  to.clear();
  to.has_shares = f.has_shares;
  for (std::size_t i = 0; i < f.count; i += kLanes) {
    const std::uint64_t bits = which.get(i);
    std::array<std::uint8_t, 8> bytes{};
    std::memcpy(bytes.data(), &bits, sizeof bits);
    const auto mask = hn::LoadMaskBits(kD, bytes.data());
    hn::StoreU(hn::Compress(hn::LoadU(kD, lanes_of(f.place.data()) + i), mask), kD,
               lanes_of(to.place.data()) + to.count);
    for (std::size_t k = 0; k < 3; ++k) {
      const VF weight = hn::LoadU(kDF, f.weight[k].data() + i);
      hn::StoreU(hn::Compress(weight, hn::RebindMask(kDF, mask)), kDF, to.weight[k].data() + to.count);
    }
    to.count += static_cast<std::size_t>(__builtin_popcountll(bits));
  }
  for (std::size_t r = 0; r < f.runs; ++r) {
    const std::size_t first = which.before(f.run[r].first);
    if (which.before(f.run[r + 1].first) > first) to.run[to.runs++] = {f.run[r].primitive, f.run[r].block, first};
  }
  to.run[to.runs].first = to.count;
}
