// The register components that a program's result depends on, after each general combiner.
#pragma once

#include <array>
#include <vector>

#include "ninebit/combiner/evaluate.h"

namespace ninebit::emit {

class LiveSet {
 public:
  void add(Register r, int component) { at(r, component) = true; }
  void remove(Register r, int component) { at(r, component) = false; }
  [[nodiscard]] bool has(Register r, int component) const {
    return r < Register::e_times_f && live_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)];
  }

 private:
  bool& at(Register r, int component) {
    return live_[static_cast<std::size_t>(r)][static_cast<std::size_t>(component)];
  }
  std::array<std::array<bool, 4>, kRegisterCount> live_{};
};

// Element i: the components that are live after general combiner i.
std::vector<LiveSet> live_after_stages(const Program& program);

}  // namespace ninebit::emit
