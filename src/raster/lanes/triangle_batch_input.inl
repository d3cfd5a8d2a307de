// How triangle_batch.cpp, in whose per-target namespace this is read, comes to its vertices and keeps some lanes.

struct Corners {
  VI v[3];
};

// The vertex numbers of the triangles [first, first + lanes).
HWY_INLINE Corners corners_of(const TriangleBatch& batch, std::size_t first, std::size_t lanes) {
  const PrimitiveType type = batch.assembly.type();
  if (lanes < hn::Lanes(kDI)) {
    alignas(64) std::int32_t v[3][16];
    for (std::size_t i = 0; i < hn::Lanes(kDI); ++i) {
      const std::array<std::uint32_t, 3> t = batch.assembly.triangle(first + (i < lanes ? i : 0));
      for (std::size_t k = 0; k < 3; ++k) v[k][i] = static_cast<std::int32_t>(t[k]);
    }
    return {{hn::Load(kDI, v[0]), hn::Load(kDI, v[1]), hn::Load(kDI, v[2])}};
  }
  const auto* const list = reinterpret_cast<const std::int32_t*>(batch.assembly.indices().data());
  const VI number = hn::Iota(kDI, static_cast<std::int32_t>(first));
  if (type == PrimitiveType::triangles) {
    Corners c;
    if (list != nullptr) {
      hn::LoadInterleaved3(kDI, list + 3 * first, c.v[0], c.v[1], c.v[2]);
    } else {
      c.v[0] = hn::Mul(number, set(3));
      c.v[1] = hn::Add(c.v[0], set(1));
      c.v[2] = hn::Add(c.v[0], set(2));
    }
    return c;
  }
  const VI a = list != nullptr ? hn::LoadU(kDI, list + first) : number;
  const VI b = list != nullptr ? hn::LoadU(kDI, list + first + 1) : hn::Add(number, set(1));
  const VI c = list != nullptr ? hn::LoadU(kDI, list + first + 2) : hn::Add(number, set(2));
  if (type == PrimitiveType::triangle_fan) return {{set(list != nullptr ? list[0] : 0), b, c}};
  const MI odd = hn::TestBit(number, set(1));
  return {{hn::IfThenElse(odd, b, a), hn::IfThenElse(odd, a, b), c}};
}

HWY_INLINE VI word_of(const TriangleBatch& batch, int word, VI vertex) {
  return hn::GatherIndex(kDI, &batch.vertices.data()->x_q4_and_code + word, hn::ShiftLeft<2>(vertex));
}

HWY_INLINE VI min_of(const VI (&v)[3]) {
  return hn::Min(hn::Min(v[0], v[1]), v[2]);
}
HWY_INLINE VI max_of(const VI (&v)[3]) {
  return hn::Max(hn::Max(v[0], v[1]), v[2]);
}

HWY_INLINE std::uint64_t bits_of(MI mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kDI, mask, bytes);
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

// Stores the lanes of a mask one after the other, and something after them, up to a vector. (Highway's CompressStore
// copies a table at every call where there is no instruction for it.)
class Compressor {
 public:
  HWY_INLINE explicit Compressor(MI mask) : mask_(mask), order_(order_of(mask)) {}
  HWY_INLINE void operator()(VI v, std::int32_t* to) const {
    if constexpr (kHasInstruction) {
      hn::CompressStore(v, mask_, kDI, to);
    } else {
      hn::StoreU(hn::TableLookupLanes(v, hn::IndicesFromVec(kDI, order_)), kDI, to);
    }
  }

 private:
  static constexpr bool kHasInstruction = hn::MaxLanes(kDI) > 8;
  static HWY_INLINE VI order_of(MI mask) {
    if constexpr (kHasInstruction) return hn::Zero(kDI);
    const hn::Rebind<std::uint8_t, DI> bytes;
    return hn::PromoteTo(kDI, hn::LoadU(bytes, kLanesOfBits[bits_of(mask) & 0xFF].data()));
  }
  MI mask_;
  VI order_;
};
