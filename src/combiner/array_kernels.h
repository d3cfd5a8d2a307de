// Loops between arrays in memory and planes of codes, in vectors, for the layouts that are common.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "ninebit/numerics/codes.h"

namespace ninebit::detail {

// The codes of red, green, blue and alpha; nullptr: not wanted, or not there.
using ComponentPlanes = std::array<s9*, 4>;

// Bytes one beside the other to codes.
void load_bytes(const std::uint8_t* from, std::size_t count, s9* to);
// Four bytes a fragment, and three; the fourth plane is then left alone.
void load_rgba8(const std::uint8_t* from, std::size_t count, const ComponentPlanes& to);
void load_rgb8(const std::uint8_t* from, std::size_t count, const ComponentPlanes& to);
// Four codes a fragment.
void load_rgba16(const s9* from, std::size_t count, const ComponentPlanes& to);

// All four planes are there.
void store_rgba8(const std::array<const s9*, 4>& from, std::size_t count, std::uint8_t* to);
void store_rgba16(const std::array<const s9*, 4>& from, std::size_t count, s9* to);

// Whether no code is outside of [lowest, highest].
[[nodiscard]] bool all_within(const s9* codes, std::size_t count, s9 lowest, s9 highest);

}  // namespace ninebit::detail
