// Memory of planes: vectors that lie well in the processor's caches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <utility>
#include <vector>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Where in a page of 4,096 bytes the next large plane begins, always a line of 64 bytes: one after the other elsewhere,
// from any number of threads. The first cache keeps few lines from the same place of all pages, and pixels of several
// planes, and of several rows, are drawn together.
[[nodiscard]] std::size_t next_plane_offset();

// Allocates what begins with a line of the cache and, if it is large, at next_plane_offset().
template <class T>
struct PlaneAllocator {
  using value_type = T;                    // a sample
  using is_always_equal = std::true_type;  // any of them frees what another one has allocated
  PlaneAllocator() = default;
  // For containers that allocate other types as well; nothing is taken over.
  template <class U>
  explicit PlaneAllocator(const PlaneAllocator<U>&) noexcept {}

  // Throws std::bad_alloc, as std::allocator does.
  [[nodiscard]] T* allocate(std::size_t count) {
    if (!is_large(count)) return static_cast<T*>(::operator new (count * sizeof(T), std::align_val_t{kLine}));
    if (count > (SIZE_MAX - kPage) / sizeof(T)) throw std::bad_array_new_length();
    void* const page = ::operator new (count * sizeof(T) + kPage, std::align_val_t{kPage});
    return reinterpret_cast<T*>(static_cast<std::byte*>(page) + next_plane_offset());
  }
  void deallocate(T* samples, std::size_t count) noexcept {
    if (!is_large(count)) return ::operator delete (samples, std::align_val_t{kLine});
    std::byte* const first = reinterpret_cast<std::byte*>(samples);
    ::operator delete (first - reinterpret_cast<std::uintptr_t>(first) % kPage, std::align_val_t{kPage});
  }
  bool operator==(const PlaneAllocator&) const = default;

 private:
  static constexpr std::size_t kLine = 64, kPage = 4096, kLarge = 16 * kPage;
  static bool is_large(std::size_t count) { return count >= kLarge / sizeof(T); }
};

// The samples of a plane.
template <class T>
using PlaneSamples = std::vector<T, PlaneAllocator<T>>;

// Another allocator's memory for vectors of plain data whose new elements are written before they are read: resize()
// leaves them without a value, so that memory is touched once.
template <class T, template <class> class Allocator = std::allocator>
struct RawAllocator : Allocator<T> {
  // The same for elements of another type.
  template <class U>
  struct rebind {
    using other = RawAllocator<U, Allocator>;  // as the standard's allocators name it
  };
  // Of an element without arguments: nothing.
  template <class U>
  void construct(U*) noexcept {}
  // Of an element with a value: as any allocator.
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    std::construct_at(at, std::forward<Arguments>(arguments)...);
  }
};

// The samples of a plane that is drawn before it is read.
template <class T>
using RawPlaneSamples = std::vector<T, RawAllocator<T, PlaneAllocator>>;

}  // namespace ninebit
