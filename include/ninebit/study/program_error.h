// How far a whole program is from exact arithmetic, and which of its stages took it there.
//
// The profile `ideal` computes a program in exact numbers, from the same registers. Between it and the real program
// stand others: for each k, the first k general combiners as the profile computes them, then everything else in exact
// numbers, starting from the codes that those k left. Going from k - 1 to k lets one more stage do what it really does,
// so the change of the colour is what stage k adds to the error; the final combiner, which is last, adds the rest. All
// additions together are the error of the whole program, for every fragment. An addition contains what later stages
// would make of a stage's error, and may undo those of others.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
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
  Register reg = Register::zero;  // one that holds a value
  int component = kRed;           // kRed to kAlpha
  // As tables name it: "tex0.r".
  [[nodiscard]] std::string name() const;
  friend bool operator==(const RegisterComponent&, const RegisterComponent&) = default;
};

// The fragments that a program is run over, all with the same components. Whatever is not among them reads 0, except
// alpha of textures and fog, which read one, spare0's alpha, which reads texture 0's, and constants, which are the
// program's; a constant among the components replaces it in every stage.
struct ProgramInputs {
  std::vector<RegisterComponent> components;  // at least one
  // A code for each component, fragment after fragment. Nothing: all combinations of the components' values, the last
  // component changing fastest; from 0 to one, what a byte can bring, and of spare0 and spare1 from lowest to one.
  std::optional<std::vector<s9>> codes{};
};

// Measures the program, which was compiled for the profile, over the inputs. Reports a profile whose arithmetic is not
// integer, inputs without components or fragments, and more than 2^26 combinations. A unit is up to 2^18 fragments.
//
// An error is a real number: what leaves the final combiner minus what `ideal` gives. One below 1e-10 counts as none.
//
// Rows of the table "rows", for each component of the colour:
//   profile, component
//   first, fragments           the unit's first fragment, and how many it has
//   exact                      those without an error
//   max_error, mean_error, mean_bias   as in datapath_error.h
//   worst, worst_code, worst_exact     the first inputs with the largest error; what comes out; what `ideal` gives
//
// Rows of the table "stages", for each stage and component of the colour:
//   profile, component, first, fragments
//   stage, name                1 to the number of general combiners, "general 1", …, then "final"
//   added_max, added_mean, added_bias, worst   what the stage adds, and the first inputs where it adds most
//   remaining_max, remaining_mean, remaining_bias   the error if all later stages were exact
[[nodiscard]] Result<std::unique_ptr<Study>> program_error_study(StudyQuestion question, const HardwareProfile& profile,
                                                                 const Program& program, ProgramInputs inputs);

// The colours of one fragment: ideal's, then with one more stage as the profile computes it each time; the last is what
// really leaves the final combiner. One more than the program has stages, the final combiner counted. Each number is
// within 1e-11 of the exact one. For integer arithmetic.
[[nodiscard]] std::vector<RealColor> colors_by_stage(const Program& program, const RegisterFile& initial);

}  // namespace ninebit
