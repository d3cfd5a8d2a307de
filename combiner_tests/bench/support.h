// Fragments for the programs that are measured.
#pragma once

#include <array>
#include <random>
#include <vector>

#include "ninebit/combiner/evaluate.h"

namespace bench_test {

// Registers as initial_registers makes them: codes of 0 to 255, every fourth one at an edge.
inline std::vector<ninebit::RegisterFile> random_fragments(std::size_t count) {
  constexpr std::array<ninebit::s9, 6> kEdges{0, 1, 127, 128, 254, 255};
  std::mt19937 random(20);
  std::vector<ninebit::RegisterFile> fragments(count);
  for (ninebit::RegisterFile& fragment : fragments) {
    for (ninebit::Rgba9& reg : fragment.value) {
      for (ninebit::s9& code : reg) {
        code = random() % 4 == 0 ? kEdges[random() % kEdges.size()] : static_cast<ninebit::s9>(random() % 256);
      }
    }
  }
  return fragments;
}

}  // namespace bench_test
