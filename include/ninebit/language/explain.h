// What a program computes, as equations in the order of execution: for people who read programs.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// "TARGET = EXPRESSION". A register's bare name stands for its red, green and blue, ".a" and ".blue" for one component;
// a × b multiplies component by component, a · b is the dot product, ½ is the profile's code for one half.
struct Equation {
  std::optional<int> stage{};              // 0-based general combiner; empty: final combiner
  PortionName portion = PortionName::rgb;  // which half of a general combiner
  std::string output{};                    // "AB", "CD", "sum", "mux"; of the final combiner "color", "alpha"
  std::string target{};                    // "spare0", "spare0.a"; of the final combiner "rgb", "alpha"
  std::string expression{};                // "4·(primary − tex0)"
  bool used = true;                        // something that reaches the final result reads it
  bool clamps = false;                     // the expression can leave what its target can hold, and is then cut
};

// A general combiner's portion that adds nothing to the result, with the reason as the end of a sentence about it.
struct DeadPortion {
  int stage = 0;                           // 0-based general combiner
  PortionName portion = PortionName::rgb;  // which half of it
  std::string reason;                      // "dead, nothing reads what it writes"
};

// A program as equations, and what a reader should know beside them.
struct Explanation {
  int num_general_combiners = 1;       // stages that run
  std::string profile;                 // its name
  std::vector<Equation> equations;     // stages in order, RGB before alpha; then the final combiner's two
  std::vector<DeadPortion> dead;       // stages in order
  std::vector<std::string> constants;  // what const0 and const1 hold where an equation reads them, a sentence each
  std::vector<std::string> notes;      // defaults that take part, a sentence each
  std::vector<std::string> legend;     // the marks that the equations use, a sentence each
};

// Multiplications by 1, 0 and -1 and mappings of `zero` are folded; inputs that a factor 0 hides count as not read.
// Registers are taken to start without negative parts, as texels, colours and constants of GL do: max(0, …) stands only
// where a stage may have written a negative value.
[[nodiscard]] Explanation explain(const Program& program, const HardwareProfile& profile);

// The explanation for people: several lines of UTF-8, the last with its newline.
[[nodiscard]] std::string print_explanation(const Explanation& explanation);

}  // namespace ninebit
