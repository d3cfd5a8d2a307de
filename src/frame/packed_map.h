// A shadow map packed into bytes and read as floats, as three.js' shaders did it; beyond the hardware.
#pragma once

#include <array>
#include <cstdint>
#include <deque>
#include <span>
#include <vector>

#include "ninebit/frame/depth_packing.h"
#include "ninebit/frame/rendering.h"

namespace ninebit {

class PackedMap {
 public:
  // Packs the codes of a depth surface of size² texels. Texels that still hold `cleared` become white, as three.js
  // clears its maps. The planes go into `maps` as packed_depth, which must outlive this.
  PackedMap(const DepthPacking& packing, ChannelStorage storage, int size, std::span<const std::uint32_t> codes,
            std::uint32_t cleared, std::deque<Layer>& maps);

  // The largest change that packing made to a drawn depth, in the range [0, 1].
  [[nodiscard]] double largest_error() const { return largest_error_; }

  // The memory of its texels.
  [[nodiscard]] std::uint64_t bytes() const {
    std::uint64_t sum = 0;
    for (const auto& plane : bytes_) sum += plane.size();
    return sum;
  }

  // The depth that a shader reads at the nearest texel; s and t are from 0 to 1.
  [[nodiscard]] float depth_at(float s, float t) const;

 private:
  const DepthPacking* packing_;
  int size_;
  std::array<std::span<std::uint8_t>, 4> bytes_;
  double largest_error_ = 0.0;
};

}  // namespace ninebit
