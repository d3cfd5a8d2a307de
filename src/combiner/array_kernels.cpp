#include "src/combiner/array_kernels.h"

#include <algorithm>
#include <bit>

#include "src/numerics/simd_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "src/combiner/array_kernels.cpp"
#include "hwy/foreach_target.h"  // IWYU pragma: keep
#include "hwy/highway.h"
#include "src/combiner/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace ninebit::detail::HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using U8 = hn::Rebind<std::uint8_t, D16>;
constexpr U8 kU8;

// Calls vector(i) for whole vectors and one(i) for the fragments that are left.
template <class Vector, class One>
HWY_INLINE void for_fragments(std::size_t count, const Vector& vector, const One& one) {
  std::size_t i = 0;
  if constexpr (std::endian::native == std::endian::little) {
    for (const std::size_t lanes = hn::Lanes(kD16); i + lanes <= count; i += lanes) vector(i);
  }
  for (; i < count; ++i) one(i);
}

HWY_INLINE void store(V16 v, s9* plane, std::size_t i) {
  if (plane != nullptr) hn::StoreU(v, kD16, plane + i);
}

HWY_INLINE V16 codes(VU16 v) {
  return hn::BitCast(kD16, v);
}

void bytes_in(const std::uint8_t* from, std::size_t count, s9* to) {
  for_fragments(
      count, [&](std::size_t i) HWY_ATTR { hn::StoreU(hn::PromoteTo(kD16, hn::LoadU(kU8, from + i)), kD16, to + i); },
      [&](std::size_t i) { to[i] = from[i]; });
}

// Red and green are a word of 16 bits, blue and alpha the next one.
void rgba8_in(const std::uint8_t* from, std::size_t count, const ComponentPlanes& to) {
  for_fragments(
      count,
      [&](std::size_t i) HWY_ATTR {
        VU16 rg, ba;
        hn::LoadInterleaved2(kU16, reinterpret_cast<const std::uint16_t*>(from + 4 * i), rg, ba);
        store(codes(hn::And(rg, set_unsigned(255))), to[0], i);
        store(codes(hn::ShiftRight<8>(rg)), to[1], i);
        store(codes(hn::And(ba, set_unsigned(255))), to[2], i);
        store(codes(hn::ShiftRight<8>(ba)), to[3], i);
      },
      [&](std::size_t i) {
        for (std::size_t c = 0; c < 4; ++c) {
          if (to[c] != nullptr) to[c][i] = from[4 * i + c];
        }
      });
}

void rgb8_in(const std::uint8_t* from, std::size_t count, const ComponentPlanes& to) {
  for_fragments(
      count,
      [&](std::size_t i) HWY_ATTR {
        hn::Vec<U8> r, g, b;
        hn::LoadInterleaved3(kU8, from + 3 * i, r, g, b);
        store(hn::PromoteTo(kD16, r), to[0], i);
        store(hn::PromoteTo(kD16, g), to[1], i);
        store(hn::PromoteTo(kD16, b), to[2], i);
      },
      [&](std::size_t i) {
        for (std::size_t c = 0; c < 3; ++c) {
          if (to[c] != nullptr) to[c][i] = from[3 * i + c];
        }
      });
}

void rgba16_in(const s9* from, std::size_t count, const ComponentPlanes& to) {
  for_fragments(
      count,
      [&](std::size_t i) HWY_ATTR {
        V16 r, g, b, a;
        hn::LoadInterleaved4(kD16, from + 4 * i, r, g, b, a);
        store(r, to[0], i);
        store(g, to[1], i);
        store(b, to[2], i);
        store(a, to[3], i);
      },
      [&](std::size_t i) {
        for (std::size_t c = 0; c < 4; ++c) {
          if (to[c] != nullptr) to[c][i] = from[4 * i + c];
        }
      });
}

void rgba8_out(const std::array<const s9*, 4>& from, std::size_t count, std::uint8_t* to) {
  const auto pair = [&](std::size_t low, std::size_t i) HWY_ATTR {
    const auto first = hn::BitCast(kU16, hn::LoadU(kD16, from[low] + i));
    const auto second = hn::BitCast(kU16, hn::LoadU(kD16, from[low + 1] + i));
    return hn::Or(first, hn::ShiftLeft<8>(second));
  };
  for_fragments(
      count,
      [&](std::size_t i) HWY_ATTR {
        hn::StoreInterleaved2(pair(0, i), pair(2, i), kU16, reinterpret_cast<std::uint16_t*>(to + 4 * i));
      },
      [&](std::size_t i) {
        for (std::size_t c = 0; c < 4; ++c) to[4 * i + c] = static_cast<std::uint8_t>(from[c][i]);
      });
}

void rgba16_out(const std::array<const s9*, 4>& from, std::size_t count, s9* to) {
  const auto plane = [&](std::size_t c, std::size_t i) HWY_ATTR { return hn::LoadU(kD16, from[c] + i); };
  for_fragments(
      count,
      [&](std::size_t i)
          HWY_ATTR { hn::StoreInterleaved4(plane(0, i), plane(1, i), plane(2, i), plane(3, i), kD16, to + 4 * i); },
      [&](std::size_t i) {
        for (std::size_t c = 0; c < 4; ++c) to[4 * i + c] = from[c][i];
      });
}

// Whether those of `count` codes are within that fill whole vectors; takes these off.
template <class D>
bool all_within_vectors(D d, const s9*& from, std::size_t& count, s9 lowest, s9 highest) {
  const auto low = hn::Set(d, lowest), high = hn::Set(d, highest);
  auto outside = hn::Zero(d);  // a sign for each that is
  for (; count >= hn::Lanes(d); count -= hn::Lanes(d), from += hn::Lanes(d)) {
    const auto v = hn::LoadU(d, from);
    outside = hn::Or(outside, hn::Or(hn::SaturatedSub(v, low), hn::SaturatedSub(high, v)));
  }
  return hn::AllFalse(d, hn::Lt(outside, hn::Zero(d)));
}

bool within(const s9* from, std::size_t count, s9 lowest, s9 highest) {
  // A few fragments are not copied to a long vector, which would wait for the copy.
  if (!all_within_vectors(kD16, from, count, lowest, highest)) return false;
  if (!all_within_vectors(hn::CappedTag<s9, 8>(), from, count, lowest, highest)) return false;
  return std::all_of(from, from + count, [&](s9 code) { return lowest <= code && code <= highest; });
}

}  // namespace ninebit::detail::HWY_NAMESPACE
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace ninebit::detail {
HWY_EXPORT(bytes_in);
HWY_EXPORT(rgba8_in);
HWY_EXPORT(rgb8_in);
HWY_EXPORT(rgba16_in);
HWY_EXPORT(rgba8_out);
HWY_EXPORT(rgba16_out);
HWY_EXPORT(within);

void load_bytes(const std::uint8_t* from, std::size_t count, s9* to) {
  HWY_DYNAMIC_DISPATCH(bytes_in)(from, count, to);
}
void load_rgba8(const std::uint8_t* from, std::size_t count, const ComponentPlanes& to) {
  HWY_DYNAMIC_DISPATCH(rgba8_in)(from, count, to);
}
void load_rgb8(const std::uint8_t* from, std::size_t count, const ComponentPlanes& to) {
  HWY_DYNAMIC_DISPATCH(rgb8_in)(from, count, to);
}
void load_rgba16(const s9* from, std::size_t count, const ComponentPlanes& to) {
  HWY_DYNAMIC_DISPATCH(rgba16_in)(from, count, to);
}
void store_rgba8(const std::array<const s9*, 4>& from, std::size_t count, std::uint8_t* to) {
  HWY_DYNAMIC_DISPATCH(rgba8_out)(from, count, to);
}
void store_rgba16(const std::array<const s9*, 4>& from, std::size_t count, s9* to) {
  HWY_DYNAMIC_DISPATCH(rgba16_out)(from, count, to);
}
bool all_within(const s9* codes, std::size_t count, s9 lowest, s9 highest) {
  return HWY_DYNAMIC_DISPATCH(within)(codes, count, lowest, highest);
}

}  // namespace ninebit::detail
#endif
