#include <gtest/gtest.h>
#include <ninebit/numerics/visibility.h>

// With -fvisibility=hidden, a shared library exports what stands here.
namespace NINEBIT_PUBLIC plugin {
inline int twice(int code) {
  return 2 * code;
}
}  // namespace plugin

TEST(Examples, Visibility) {
  EXPECT_EQ(plugin::twice(64), 128);
}
