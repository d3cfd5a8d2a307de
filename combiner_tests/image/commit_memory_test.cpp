// A commit for which memory runs out, at each of its allocations in turn.
#include <gtest/gtest.h>

#include <cstdlib>
#include <new>

#include "combiner_tests/image/read_back.h"
#include "ninebit/image/staged_files.h"

namespace {

thread_local int allocations_left = -1;  // the one after them fails; negative: none fails

}  // namespace

// Sanitizers have operators of their own.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define NINEBIT_OWN_NEW 0
#elif defined(__has_feature)
#define NINEBIT_OWN_NEW !(__has_feature(address_sanitizer) || __has_feature(thread_sanitizer))
#else
#define NINEBIT_OWN_NEW 1
#endif

#if NINEBIT_OWN_NEW
// Not inlined: where they are, g++ takes new and free for a mismatch.
[[gnu::noinline]] void* operator new(std::size_t bytes) {
  if (allocations_left >= 0 && allocations_left-- == 0) throw std::bad_alloc();
  if (void* const memory = std::malloc(bytes > 0 ? bytes : 1)) return memory;
  throw std::bad_alloc();
}

[[gnu::noinline]] void operator delete(void* memory) noexcept {
  std::free(memory);
}

[[gnu::noinline]] void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}

namespace {

using image_test::read_bytes;
using image_test::TempFolder;
using image_test::write_bytes;

TEST(CommitWithoutMemory, LeavesTheOlderFilesAndNothingElse) {
  int fails = 0;
  for (bool committed = false; !committed; ++fails) {
    SCOPED_TRACE(fails);
    ASSERT_LT(fails, 1000);
    const TempFolder folder;
    for (const char* name : {"a", "b", "c"}) write_bytes(folder.path() / name, "older");
    {
      auto staged = ninebit::StagedFiles::open(folder.path());
      ASSERT_TRUE(staged.ok());
      for (const char* name : {"a", "b", "c"}) write_bytes(staged->stage(name), "newer");
      allocations_left = fails;
      try {
        committed = staged->commit().ok();
      } catch (const std::bad_alloc&) {
      }
      allocations_left = -1;
    }
    EXPECT_EQ(folder.names(), (std::vector<std::string>{"a", "b", "c"}));
    for (const char* name : {"a", "b", "c"}) EXPECT_EQ(read_bytes(folder.path() / name), committed ? "newer" : "older");
  }
  EXPECT_GT(fails, 10);
}

}  // namespace
#else
TEST(CommitWithoutMemory, LeavesTheOlderFilesAndNothingElse) {
  GTEST_SKIP() << "sanitizers have operators of their own";
}
#endif
