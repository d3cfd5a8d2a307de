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

// Where in a page of 4,096 bytes the next large plane begins, always a line of 64 bytes: one after the other elsewhere,
// from any number of threads. The first cache keeps few lines from the same place of all pages, and pixels of several
// planes, and of several rows, are drawn together.
[[nodiscard]] std::size_t next_plane_offset();

// What becomes of samples that get no value when they are made.
enum class NewSamples : std::uint8_t { zero, undrawn };

// Allocates what begins with a line of the cache and, if it is large, at next_plane_offset().
template <class T>
class PlaneAllocator {
 public:
  using value_type = T;                    // a sample
  using is_always_equal = std::true_type;  // any of them frees what another one has allocated
  PlaneAllocator() = default;
  // For samples that are zero, or left without a value until they are drawn.
  explicit PlaneAllocator(NewSamples samples) : samples_(samples) {}
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
  // A sample without a value of its own.
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

// A plane whose samples have no values until they are drawn: its memory is touched only then, by all threads that draw.
template <class T>
[[nodiscard]] PlaneSamples<T> undrawn_samples(std::size_t count) {
  return PlaneSamples<T>(count, PlaneAllocator<T>(NewSamples::undrawn));
}

}  // namespace ninebit
