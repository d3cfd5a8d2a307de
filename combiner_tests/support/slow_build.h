// How fast this build is: large loops do less in a slow one, and tests that would take minutes there skip themselves.
#pragma once

namespace ninebit::test {

#if defined(__has_feature)
#define NINEBIT_HAS_SANITIZER(name) __has_feature(name)
#else
#define NINEBIT_HAS_SANITIZER(name) 0
#endif

#if defined(__SANITIZE_THREAD__) || NINEBIT_HAS_SANITIZER(thread_sanitizer)
inline constexpr bool kThreadSanitizer = true;
#else
inline constexpr bool kThreadSanitizer = false;
#endif

#if defined(__SANITIZE_ADDRESS__) || NINEBIT_HAS_SANITIZER(address_sanitizer) || NINEBIT_HAS_SANITIZER(memory_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = kThreadSanitizer;
#endif
#undef NINEBIT_HAS_SANITIZER

#if defined(__OPTIMIZE__)
inline constexpr bool kSlowBuild = kSanitized;
#else
inline constexpr bool kSlowBuild = true;
#endif

// How many of a number of random cases are run: an eighth in a slow build. What is asked of them all is asked of as
// many.
template <class Count>
constexpr Count cases_here(Count cases) {
  return kSlowBuild ? cases / 8 : cases;
}

// Whether lines are counted, by the preset coverage.
#if defined(NINEBIT_COVERAGE)
inline constexpr bool kCoverage = true;
#else
inline constexpr bool kCoverage = false;
#endif

}  // namespace ninebit::test
