// Vectors whose new elements nobody clears, because they are written at once.
#pragma once

#include <memory>
#include <utility>
#include <vector>

#include "ninebit/raster/plane_samples.h"

namespace ninebit {

template <class T, template <class> class Allocator = std::allocator>
struct RawAllocator : Allocator<T> {
  template <class U>
  struct rebind {
    using other = RawAllocator<U, Allocator>;
  };
  template <class U>
  void construct(U*) noexcept {}
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
};

// Of plain data: resize() leaves what it adds without a value.
template <class T>
using RawVector = std::vector<T, RawAllocator<T>>;

// The same in memory for planes.
template <class T>
using RawPlaneSamples = std::vector<T, RawAllocator<T, PlaneAllocator>>;

}  // namespace ninebit
