// Vectors whose new elements are not cleared, because they are written immediately.
#pragma once

#include <memory>
#include <utility>
#include <vector>

namespace ninebit {

template <class T>
struct RawAllocator : std::allocator<T> {
  template <class U>
  struct rebind {
    using other = RawAllocator<U>;
  };
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
};

// For plain data: resize() leaves new elements uninitialized.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

}  // namespace ninebit
