#include "ninebit/combiner/program.h"

#include <algorithm>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/state.h"

namespace ninebit {

Result<Program> compile(const CombinerState& state, const HardwareProfile& profile) {
  const std::vector<StateDiagnostic> faults = validate(state, profile);
  if (faults.empty()) return normalize(state, profile);
  std::string message;
  for (const StateDiagnostic& fault : faults) {
    if (!message.empty()) message += '\n';
    message += fault.message;
  }
  return Diagnostic{.message = message};
}

}  // namespace ninebit
