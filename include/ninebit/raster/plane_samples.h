// Memory of planes: vectors that lie well in the processor's caches.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <new>
#include <type_traits>
#include <vector>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The offset in a page of 4,096 bytes at which the next large plane begins, a multiple of the 64-byte cache line.
// Successive calls, from any number of threads, return different offsets: the L1 cache holds few lines with the same
// page offset, and pixels of several planes and rows are drawn together.
[[nodiscard]] std::size_t next_plane_offset();

// How samples that are created without a value are initialized.
enum class NewSamples : std::uint8_t { zero, undrawn };

// Allocates memory aligned to a cache line; large blocks begin at next_plane_offset().
template <class T>
class PlaneAllocator {
 public:
  using value_type = T;                    // a sample
  using is_always_equal = std::true_type;  // any instance frees memory that another one allocated
  PlaneAllocator() = default;
  // For samples that are zeroed, or left uninitialized until they are drawn.
  explicit PlaneAllocator(NewSamples samples) : samples_(samples) {}
  // For containers that also allocate other types; no state is copied.
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

// A plane whose samples stay uninitialized until they are drawn, so the drawing threads touch its memory first.
template <class T>
[[nodiscard]] PlaneSamples<T> undrawn_samples(std::size_t count) {
  return PlaneSamples<T>(count, PlaneAllocator<T>(NewSamples::undrawn));
}

}  // namespace ninebit
