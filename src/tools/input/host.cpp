#include "src/tools/input/host.h"

namespace ninebit::tools {
namespace {

Host* current = nullptr;

}  // namespace

Host* host() noexcept {
  return current;
}

void set_host(Host* host) noexcept {
  current = host;
}

}  // namespace ninebit::tools
