#include "src/frame/packed_map.h"

#include <algorithm>
#include <cmath>
#include <string>

#include "src/frame/camera_frame.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {

PackedMap::PackedMap(const DepthPacking& packing, ChannelStorage storage, int size,
                     std::span<const std::uint32_t> codes, std::uint32_t cleared, std::deque<Layer>& maps)
    : packing_(&packing), storage_(storage), size_(size) {
  for (std::size_t c = 0; c < 4; ++c) {
    bytes_[c] = add_layer<std::uint8_t>(maps, "packed_depth", std::string(1, "RGBA"[c]), size, size);
  }
  const auto pack = [&](std::size_t begin, std::size_t end) {
    double largest = 0.0;
    for (std::size_t i = begin; i != end; ++i) {
      const bool drawn = codes[i] != cleared;
      const auto depth = static_cast<float>(static_cast<double>(codes[i]) / static_cast<double>(cleared));
      const DepthBytes bytes = drawn ? store_depth(packing, depth, storage) : DepthBytes{255, 255, 255, 255};
      for (std::size_t c = 0; c < 4; ++c) bytes_[c][i] = bytes[c];
      if (drawn) {
        const double read = static_cast<double>(read_depth(packing, bytes, storage));
        largest = std::max(largest, std::fabs(read - static_cast<double>(depth)));
      }
    }
    return largest;
  };
  largest_error_ = parallel_reduce(codes.size(), 16384, 0.0, pack, [](double a, double b) { return std::max(a, b); });
}

float PackedMap::depth_at(float s, float t) const {
  // Exact: the size is a power of two.
  const auto texel = [this](float at) { return std::min(static_cast<int>(at * static_cast<float>(size_)), size_ - 1); };
  const std::size_t i =
      static_cast<std::size_t>(texel(t)) * static_cast<std::size_t>(size_) + static_cast<std::size_t>(texel(s));
  return read_depth(*packing_, {bytes_[0][i], bytes_[1][i], bytes_[2][i], bytes_[3][i]}, storage_);
}

}  // namespace ninebit
