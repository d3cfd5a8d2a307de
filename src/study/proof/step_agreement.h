// Whether two profiles agree in the steps of the arithmetic, over all codes that registers can hold.
#pragma once

#include <cstdint>

#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::proof {

struct StepAgreement {
  bool start = false;  // initial registers, for all bytes, with each texture unit on and off
  bool final_combiner = false;
  bool byte_stage = false;  // one general combiner on initial registers, as the final combiner reads its output
  bool any_stage = false;   // general combiners on all codes
  std::uint64_t cases = 0;

  // No program without general combiners differs; none with one; none of any length.
  [[nodiscard]] bool without_stages() const { return start && final_combiner; }
  [[nodiscard]] bool one_stage() const { return without_stages() && byte_stage; }
  [[nodiscard]] bool any_length() const { return without_stages() && any_stage; }
};

// For any two profiles. Steps agree in arithmetics that are the same; steps without integers are not compared.
[[nodiscard]] StepAgreement compare_steps(const HardwareProfile& a, const HardwareProfile& b);

}  // namespace ninebit::proof
