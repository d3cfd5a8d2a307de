// Surfaces store their lowest row first, pictures their highest.
#pragma once

#include <cstddef>

namespace ninebit {

// The index in a picture of sample i of a plane of the same size.
[[nodiscard]] inline std::size_t upright_index(std::size_t i, int width, int height) {
  const auto row = static_cast<std::size_t>(width);
  return (static_cast<std::size_t>(height) - 1 - i / row) * row + i % row;
}

}  // namespace ninebit
