// Memory that runs out.
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cstdint>
#include <limits>
#include <new>
#include <vector>

#include "combiner_tests/support/slow_build.h"
#include "src/system/process.h"

namespace ninebit::posix {
namespace {

TEST(Memory, RoomIsThereOrNot) {
  EXPECT_TRUE(has_room(1U << 20U));
  EXPECT_FALSE(has_room(std::uint64_t{1} << 60U));
}

// Takes all memory in small pieces, and then half a mebibyte.
[[noreturn]] void run_out() {
  keep_memory_for_errors();
  const rlimit limit{rlim_t{1} << 28U, rlim_t{1} << 28U};
  if (::setrlimit(RLIMIT_AS, &limit) != 0) ::_exit(2);
  std::vector<void*> pieces;
  pieces.reserve(1U << 20U);
  try {
    for (;;) pieces.push_back(::operator new(4096));
  } catch (const std::bad_alloc&) {
  }
  ::_exit(::operator new (std::size_t{1} << 19U, std::nothrow) != nullptr ? 0 : 1);
}

TEST(MemoryDeathTest, SomeIsKeptForErrors) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "sanitizers map more than any limit";
  EXPECT_EXIT(run_out(), testing::ExitedWithCode(0), "");
}

}  // namespace
}  // namespace ninebit::posix
