// What Highway's library defines: there are its headers alone for Emscripten. There is one target, chosen by the
// compiler.
#include <hwy/highway.h>

namespace hwy {

int64_t SupportedTargets() {
  return HWY_TARGETS;
}

}  // namespace hwy
