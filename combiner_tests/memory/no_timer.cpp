// In place of what Highway's library measures as it is loaded. It reads the time stamp by rdtscp, which valgrind
// refuses on processors that do not announce it; virtual machines often hide it. Nothing here uses the timer.
#include <cstdint>

namespace hwy::platform {

std::uint64_t TimerResolution() {
  return 1;
}

}  // namespace hwy::platform
