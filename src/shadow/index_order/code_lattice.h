// The lattice of index codes, and the patches that have one.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "src/shadow/index_order/lost_differences.h"

namespace ninebit {

// Each code holds at most one patch. Patches are kept in cubes of codes, so that those near a code are found at once.
class CodeLattice {
 public:
  // `step`: the smallest distance, in one channel, between codes that must differ. `lost` must outlive the lattice.
  CodeLattice(const LostDifferences& lost, int step, std::uint32_t patches);

  static constexpr int kLevels = 256;  // bytes per channel

  // Codes that differ by this much in one channel never conflict.
  [[nodiscard]] int spacing() const { return spacing_; }
  // The number of codes that are a multiple of the spacing in each channel, with the cleared map's.
  [[nodiscard]] std::size_t capacity() const;
  [[nodiscard]] int channels() const { return lost_.channels(); }
  // Whether two codes with this difference are too near to each other for patches that must differ.
  [[nodiscard]] bool conflict(const CodeBytes& d) const {
    return !lost_.never(d) || std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) < step_;
  }
  // Whether a code exists and is far enough from that of the cleared map, which is 0.
  [[nodiscard]] bool usable(const CodeBytes& code) const;

  [[nodiscard]] bool has_code(std::uint32_t patch) const { return code_[patch][0] >= 0; }
  [[nodiscard]] const CodeBytes& code(std::uint32_t patch) const { return code_[patch]; }
  void put(std::uint32_t patch, const CodeBytes& code);
  void take(std::uint32_t patch);
  void clear();

  // Calls each(patch) for patches whose code conflicts with this code, until it returns false. Returns whether no call
  // returned false.
  template <class Each>
  bool in_conflict_with(const CodeBytes& code, const Each& each) const {
    return near(code, spacing_ - 1,
                [&](std::uint32_t patch) { return !conflict(difference(code_[patch], code)) || each(patch); });
  }
  // Whether no patch's code differs by `reach` or less in all channels.
  [[nodiscard]] bool empty_around(const CodeBytes& code, int reach) const {
    return near(code, reach, [&](std::uint32_t patch) {
      const CodeBytes d = difference(code_[patch], code);
      return std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) > reach;
    });
  }

 private:
  static constexpr std::uint32_t kNone = ~0U;

  [[nodiscard]] std::size_t cube(int x, int y, int z) const {
    return static_cast<std::size_t>((z * cubes_ + y) * cubes_ + x);
  }
  [[nodiscard]] std::size_t cube_of(const CodeBytes& code) const {
    return cube(code[0] >> cube_bits_, code[1] >> cube_bits_, code[2] >> cube_bits_);
  }

  // Calls each(patch) for at least all patches within `reach`, until it returns false.
  template <class Each>
  bool near(const CodeBytes& code, int reach, const Each& each) const {
    std::array<int, 3> first{}, last{};
    for (std::size_t c = 0; c < 3; ++c) {
      first[c] = std::max(0, code[c] - reach) >> cube_bits_;
      last[c] = std::min(kLevels - 1, code[c] + reach) >> cube_bits_;
      if (static_cast<int>(c) >= lost_.channels()) last[c] = 0;
    }
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) {
          for (std::uint32_t patch = head_[cube(x, y, z)]; patch != kNone; patch = next_[patch]) {
            if (!each(patch)) return false;
          }
        }
      }
    }
    return true;
  }

  const LostDifferences& lost_;
  int step_, spacing_, cube_bits_ = 0, cubes_ = 1;
  std::vector<std::uint32_t> head_, next_;  // the first patch of each cube, and of each patch the next one
  std::vector<CodeBytes> code_;             // of each patch; the first is negative: none
};

}  // namespace ninebit
