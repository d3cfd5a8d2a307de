// Memory of planes: vectors whose alignment suits the processor's caches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The offset of the next large plane within a page of 4,096 bytes: a multiple of 64 that changes from plane to plane;
// for any number of threads. The first-level cache holds only a few lines from the same offset of different pages, and
// a draw touches several planes and rows at once.
[[nodiscard]] std::size_t next_plane_offset();

// The initial value of samples that are constructed without one.
enum class NewSamples : std::uint8_t { zero, undrawn };

// Allocates memory that begins on a cache line; large blocks begin at next_plane_offset().
template <class T>
class PlaneAllocator {
 public:
  using value_type = T;                    // a sample
  using is_always_equal = std::true_type;  // any instance frees the memory of another
  PlaneAllocator() = default;
  // For samples that are zero, or uninitialized until they are drawn.
  explicit PlaneAllocator(NewSamples samples) : samples_(samples) {}
  // For containers that allocate other types as well; copies no state.
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
  // A sample that is constructed without a value.
  template <class U>
  void construct(U* at) noexcept {
    if (samples_ == NewSamples::zero) std::construct_at(at);
  }
  bool operator==(const PlaneAllocator&) const { return true; }

 private:
  static constexpr std::size_t kLine = 64, kPage = 4096, kLarge = 16 * kPage;
  static bool is_large(std::size_t count) { return count >= kLarge / sizeof(T); }

  NewSamples samples_ = NewSamples::zero;
};

// The samples of a plane.
template <class T>
using PlaneSamples = std::vector<T, PlaneAllocator<T>>;

// A plane whose samples are uninitialized until they are drawn. Its memory is first touched by the drawing threads.
template <class T>
[[nodiscard]] PlaneSamples<T> undrawn_samples(std::size_t count) {
  return PlaneSamples<T>(count, PlaneAllocator<T>(NewSamples::undrawn));
}

}  // namespace ninebit
