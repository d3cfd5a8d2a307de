// Finds everything that is wrong with a state, each with the error that GL raises for it.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// OpenGL's error codes, by GL's numbers.
enum class GlError : std::uint16_t {
  no_error = 0,
  invalid_enum = 0x0500,
  invalid_value = 0x0501,
  invalid_operation = 0x0502
};

// "GL_NO_ERROR", "GL_INVALID_ENUM", …
[[nodiscard]] std::string_view name_of(GlError error);

// The parameters of a state that are neither a portion's nor a variable's.
enum class StateParameter : std::uint8_t {
  num_general_combiners,
  per_stage_constants,
  mux_by_lowest_bit,
  color_sum_inverts
};

// One fault of a state, with its place.
struct StateDiagnostic {
  std::optional<int> stage;                 // 0-based general combiner; empty: final combiner or global
  std::optional<PortionName> portion;       // empty: not about one portion
  std::optional<Variable> variable;         // empty: an output, a parameter
  std::optional<StateParameter> parameter;  // empty: about a portion or the final combiner
  GlError gl_error = GlError::no_error;     // that GL's setter would have raised
  std::string message;                      // one sentence: what is wrong and what is allowed
};

// Returns the diagnostics of a whole state, in the order stages, portions, variables, outputs, final combiner; empty:
// valid. Stages past num_general_combiners are checked too: GL would have refused them when they were set.
// Rules: NV_register_combiners, errors of CombinerInputNV, CombinerOutputNV, FinalCombinerInputNV,
// CombinerParameter*NV. A feature of the NV2A alone is GL_INVALID_ENUM with a profile that does not have it.
[[nodiscard]] std::vector<StateDiagnostic> validate(const CombinerState& state, const HardwareProfile& profile);

// The same for the arguments of a single GL setter. GL_INVALID_ENUM comes before other errors.
[[nodiscard]] std::vector<StateDiagnostic> validate_input(int stage, PortionName portion, Variable variable,
                                                          const CombinerInput& input, const HardwareProfile& profile);
[[nodiscard]] std::vector<StateDiagnostic> validate_output(int stage, PortionName portion, const PortionOutput& output,
                                                           const HardwareProfile& profile);
[[nodiscard]] std::vector<StateDiagnostic> validate_final_input(Variable variable, const CombinerInput& input,
                                                                const HardwareProfile& profile);

}  // namespace ninebit
