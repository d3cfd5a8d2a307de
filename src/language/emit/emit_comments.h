// Comments in the emitted text: the equations of a portion and of the final combiner, in ASCII.
#pragma once

#include <string>
#include <vector>

#include "ninebit/combiner/program.h"

namespace ninebit::emit {

// "General combiner 0, RGB portion", its inputs, and one equation for each output that `is_live` names.
struct LiveOutputs {
  bool ab = false, cd = false, sum = false;
  [[nodiscard]] bool any() const { return ab || cd || sum; }
};
std::vector<std::string> comments_of(const Program& program, int stage, PortionName name, const LiveOutputs& live);

std::vector<std::string> comments_of_final(const Program& program);

}  // namespace ninebit::emit
