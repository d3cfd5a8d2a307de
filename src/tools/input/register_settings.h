// The registers of a fragment from --set.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/program.h"
#include "src/texture_shader/given_stages.h"
#include "src/tools/input/eval_table.h"

namespace ninebit::tools {

struct RegisterSettings {
  RegisterFile registers;                              // with eval's defaults for registers that are not set
  std::vector<std::pair<EvalColumn, s9>> constants{};  // components of constants that were set
  std::vector<EvalColumn> set{};                       // all components that were
};

// Parses texts of the form REGISTER=R,G,B,A or REGISTER.COMPONENT=VALUE, in codes of the profile. The Diagnostic is
// wrong usage.
[[nodiscard]] Result<RegisterSettings> parse_register_settings(const std::vector<std::string>& texts,
                                                               const HardwareProfile& profile);

struct StageSettings {
  GivenFragment fragment{};           // with its defaults for what is not set
  std::vector<GivenComponent> set{};  // all components that were
};

// Parses the texts that set coordinates and texels, and removes them: atN=S,T, S,T,R or S,T,R,Q, texelN=R,G,B,A, or one
// component, as in at1.s=0.5. The Diagnostic is wrong usage.
[[nodiscard]] Result<StageSettings> take_stage_settings(std::vector<std::string>& texts);

}  // namespace ninebit::tools
