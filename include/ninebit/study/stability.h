// Does anything that nobody has measured change what a program computes?
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/combiner_fields.h"
#include "ninebit/study/equivalence.h"

namespace NINEBIT_PUBLIC ninebit {

// The effect of a field on the program's colour.
struct FieldEffect {
  CombinerField field;                       // with the profile's value and its rivals
  ProofAnswer answer = ProofAnswer::proved;  // proved: none of its values changes any colour, whatever the other open
                                             // fields are; refuted: one does
  // If it is refuted: the profile's value and the rival (numbers in field.values), the values of other fields that the
  // example needs, as names and words, the unit that is off (-1: none), whether fog is off, and an input.
  std::size_t rival = 0;  // of the value that changes a colour; 0: none does
  std::vector<std::pair<std::string, std::string>> others;
  int texture_off = -1;
  bool fog_off = false;
  std::optional<Counterexample> example;
};

// Whether the fields that nobody has measured change what a program computes.
struct StabilityAnswer {
  ProofAnswer answer = ProofAnswer::proved;      // proved: no open field changes any colour
  ProofMethod method = ProofMethod::exhaustive;  // smt: a question needed the solver, or all had the same formulas
  std::uint64_t cases = 0;                       // that were run
  std::uint64_t combinations = 0;                // of values of open fields, in all settings of units that were asked
  std::vector<FieldEffect> fields;               // the open fields, in the order of HardwareProfile
  std::string reason;                            // if it is unknown: one sentence
};

// Asks for every combination of the values of open fields whether it gives the colours of another one, with all texture
// units and fog on, with each unit off that the program reads, and with fog off if it reads fog's alpha.
// `options.targets` is not read. Fails as prove_equivalent does, and for a profile whose arithmetic is not integer.
[[nodiscard]] Result<StabilityAnswer> prove_stable(const CombinerState& state, const HardwareProfile& profile,
                                                   const EquivalenceOptions& options = {});

}  // namespace ninebit
