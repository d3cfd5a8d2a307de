// Fragments that are found one after the other, gathered as long as they lie side by side in a row.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace ninebit {

struct FragmentRow {
  static constexpr std::size_t kMost = 16;
  template <class T>
  using Each = std::array<T, kMost>;

  std::size_t count = 0;
  int x = 0, y = 0;  // the first one's pixel
  alignas(64) Each<std::uint32_t> depth{};
  alignas(64) std::array<Each<float>, 3> edge{};  // FragmentPlace::edge
  alignas(64) Each<std::uint32_t> coverage{};
};

// A sink of draw_line_or_point. `gather` takes a row of at most kMost fragments.
template <std::size_t kMost, class Gather>
class FragmentRows {
 public:
  static_assert(kMost <= FragmentRow::kMost);
  explicit FragmentRows(Gather gather) : gather_(gather) {}

  void operator()(int x, int y, std::uint32_t depth, const std::array<std::int64_t, 3>& edge, std::uint8_t coverage) {
    const bool is_next = y == row_.y && x == row_.x + static_cast<int>(row_.count);
    if (!is_next || row_.count == kMost) {
      end();
      row_.x = x;
      row_.y = y;
    }
    row_.depth[row_.count] = depth;
    for (std::size_t i = 0; i < 3; ++i) row_.edge[i][row_.count] = static_cast<float>(edge[i]);
    row_.coverage[row_.count++] = coverage;
  }

  // Hands over the last fragments.
  void end() {
    if (row_.count > 0) gather_(row_);
    row_.count = 0;
  }

 private:
  FragmentRow row_;
  Gather gather_;
};

}  // namespace ninebit
