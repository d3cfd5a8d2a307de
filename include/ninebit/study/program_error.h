// The error of a whole program against exact arithmetic, divided among its stages.
//
// The profile `ideal` computes a program in exact numbers, from the same registers. Between `ideal` and the real
// program there is a hybrid for each k: the first k general combiners run as in the profile, and everything after them
// runs in exact numbers from the codes that those k left. From hybrid k - 1 to hybrid k one more stage becomes real;
// the change of the colour is the error that stage k adds. The final combiner is last and adds the rest. For every
// fragment, the additions of all stages sum to the error of the whole program. An addition includes the effect of later
// stages on a stage's error, and may cancel other additions.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/evaluate_real.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/study.h"

namespace NINEBIT_PUBLIC ninebit {

// One component of a register.
struct RegisterComponent {
  Register reg = Register::zero;  // a register that holds a value
  int component = kRed;           // kRed to kAlpha
  // The name used in tables: "tex0.r".
  [[nodiscard]] std::string name() const;
  friend bool operator==(const RegisterComponent&, const RegisterComponent&) = default;
};

// The fragments that a program runs over, all with the same components. Components that are not listed hold what the
// profile gives a fragment with fog and all texture units off and bytes of 0, with these exceptions: spare0's alpha is
// texture 0's; constants are the program's. A listed constant replaces the program's in every stage.
struct ProgramInputs {
  std::vector<RegisterComponent> components;  // at least one, each once
  // A code for each component, fragment after fragment. std::nullopt: all combinations of the components' values, the
  // last component changing fastest. Values range from 0 to one, as bytes do; in spare0 and spare1 from lowest to one.
  std::optional<std::vector<s9>> codes{};
  // Components that hold this code in all fragments. None of them is among `components`.
  std::vector<std::pair<RegisterComponent, s9>> fixed{};
};

// Measures the program, which was compiled for the profile, over the inputs. Constants that the program reads and does
// not set are inputs, too: they are added to combinations, and a table must have them. Reports a profile whose
// arithmetic is not integer, inputs without components or fragments, a component that is given twice, and too many
// combinations. A unit is up to 2^18 fragments.
//
// Up to 2^26 combinations are all run. If there are more, each component of the colour is measured over the
// combinations of those components that it depends on (of the others, any value gives the same result): 2^16 for each
// of red and green where red depends on primary.r and tex0.r, green on primary.g and tex0.g. If one of them still has
// more than 2^26, the inputs are reported.
//
// An error is the final combiner's output minus that of `ideal`, in codes: 1 is a register's last bit. An error below
// 1e-10 of one counts as zero.
//
// Rows of the table "rows", for each component of the colour:
//   profile, component
//   over                       the names of the components that vary: "primary.r, tex0.r"; "none"
//   first, fragments           the unit's first fragment, and its number of fragments
//   exact                      fragments without an error
//   misrounded                 fragments whose code is not the nearest to the exact value: off by more than half a code
//   max_error_codes, mean_error_codes, mean_bias_codes   largest and mean size; mean with its sign
//   worst, worst_code, worst_exact_codes   the first inputs with the largest error; the result; the result of `ideal`
//
// Rows of the table "stages", for each stage and component of the colour:
//   profile, component, over, first, fragments
//   stage, name                1 to the number of general combiners, "general 1", …, then "final"
//   added_max_codes, added_mean_codes, added_bias_codes, worst   the error that the stage adds; the first inputs where
//                              it adds most
//   remaining_max_codes, remaining_mean_codes, remaining_bias_codes   the error if all later stages were exact
//
// Rows of the table "histogram", for each component of the colour and each whole number of codes from -8 to 8:
//   profile, component, over, first, fragments
//   error_codes, count         fragments whose error, rounded to whole codes, is this; -8 and 8 include all errors
//   beyond
//
// Study::draw adds to the report a heat map for each component of the colour that has an error, over all combinations
// of two or more components: the first runs to the right, the second upward. If there are at most 2^20 fragments, it
// also adds the files error.csv, a line for each fragment with its inputs and the errors of red, green, blue and alpha
// in codes, and error.npy, the same errors as 32-bit floats of NumPy (an axis for each component of combinations, or
// one for the fragments of a table; then the colour). Components of the colour that are measured over different inputs
// have files of their own: error-r.csv, error-gb.csv.
[[nodiscard]] Result<std::unique_ptr<Study>> program_error_study(StudyQuestion question, const HardwareProfile& profile,
                                                                 const Program& program, ProgramInputs inputs);

// The colours of one fragment: that of `ideal`, then with one more stage as the profile computes it each time; the last
// is the final combiner's real output. There is one colour more than the program has stages, counting the final
// combiner. Each number is within 1e-11 of the exact one. For integer arithmetic.
[[nodiscard]] std::vector<RealColor> colors_by_stage(const Program& program, const RegisterFile& initial);

}  // namespace ninebit
