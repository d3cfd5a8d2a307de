// Stand-ins for Highway's library: Emscripten has its headers alone. There is one target, chosen by the
// compiler.
#include <hwy/highway.h>

namespace hwy {

int64_t SupportedTargets() {
  return HWY_TARGETS;
}

}  // namespace hwy
