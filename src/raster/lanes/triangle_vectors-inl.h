// The vectors in which triangles are set up, of at most 16 lanes.
#if defined(NINEBIT_RASTER_LANES_TRIANGLE_VECTORS_INL_H_) == defined(HWY_TARGET_TOGGLE)
#ifdef NINEBIT_RASTER_LANES_TRIANGLE_VECTORS_INL_H_
#undef NINEBIT_RASTER_LANES_TRIANGLE_VECTORS_INL_H_
#else
#define NINEBIT_RASTER_LANES_TRIANGLE_VECTORS_INL_H_
#endif

#include <cstddef>
#include <cstdint>
#include <cstring>

#include "hwy/highway.h"
#include "src/raster/lanes/lanes_of_bits.h"
#include "src/system/emscripten/wasm_doubles-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using DI = hn::CappedTag<std::int32_t, 16>;
using DD = hn::CappedTag<double, 8>;
using VI = hn::Vec<DI>;
using VD = hn::Vec<DD>;
using MI = hn::Mask<DI>;
constexpr DI kDI;
constexpr DD kDD;
constexpr hn::Rebind<std::int32_t, DD> kHalfI;

HWY_INLINE VI set(int v) {
  return hn::Set(kDI, v);
}
// -1 where negative, else 0.
HWY_INLINE VI sign(VI v) {
  return hn::ShiftRight<31>(v);
}

HWY_INLINE VI min_of(const VI (&v)[3]) {
  return hn::Min(hn::Min(v[0], v[1]), v[2]);
}
HWY_INLINE VI max_of(const VI (&v)[3]) {
  return hn::Max(hn::Max(v[0], v[1]), v[2]);
}

// A bit for each lane, the first lane in the lowest bit.
HWY_INLINE std::uint64_t bits_of(MI mask) {
  std::uint8_t bytes[8] = {};
  hn::StoreMaskBits(kDI, mask, bytes);
  std::uint64_t bits = 0;
  std::memcpy(&bits, bytes, sizeof bits);
  return bits;
}

// Stores the lanes of a mask one after the other, and anything after them, up to a whole vector. (Where there is no
// instruction for it, Highway's Compress copies a table at every call. Where there is one, CompressStore would take it
// with memory as its target, which is many times slower on Zen 4.)
class Compressor {
 public:
  HWY_INLINE explicit Compressor(MI mask) : mask_(mask), order_(order_of(mask)) {}
  HWY_INLINE void operator()(VI v, std::int32_t* to) const {
    if constexpr (kHasInstruction) {
      hn::StoreU(hn::Compress(v, mask_), kDI, to);
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

}  // namespace ninebit::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#endif  // per-target include guard
