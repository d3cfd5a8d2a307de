// Explains a program as equations, in the order of execution.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/texture_shader/stage_state.h"

namespace NINEBIT_PUBLIC ninebit {

// "TARGET = EXPRESSION". A register's bare name stands for its red, green and blue, ".a" and ".blue" for one component;
// a × b multiplies component by component, dot(a, b) is the dot product, ½ is the profile's code for one half.
struct Equation {
  std::optional<int> stage{};              // 0-based general combiner; empty: final combiner
  PortionName portion = PortionName::rgb;  // RGB or alpha portion of a general combiner
  std::string output{};                    // "AB", "CD", "sum", "mux"; of the final combiner "color", "alpha"
  std::string target{};                    // "spare0", "spare0.a"; of the final combiner "rgb", "alpha"
  std::string expression{};                // "4·(primary − tex0)"
  bool used = true;                        // the final result depends on it
  bool clamps = false;                     // the expression can exceed the range of its target, which clamps it
};

// A portion of a general combiner that does not affect the result, with the reason.
struct DeadPortion {
  int stage = 0;                           // 0-based general combiner
  PortionName portion = PortionName::rgb;  // RGB or alpha portion
  std::string reason;                      // "dead, nothing reads its outputs"
};

// A program as equations, with notes for the reader.
struct Explanation {
  int num_general_combiners = 1;       // stages that run
  std::string profile;                 // name of the profile
  std::vector<Equation> equations;     // stages in order, RGB before alpha; then the final combiner's two
  std::vector<DeadPortion> dead;       // stages in order
  std::vector<std::string> constants;  // values of const0 and const1 that equations read, one sentence each
  std::vector<std::string> notes;      // defaults that affect the result, one sentence each
  std::vector<std::string> legend;     // notation that the equations use, one sentence each
};

// A constant that is not set keeps its name, and `constants` says so. Multiplications by 1, 0 and -1 and mappings of
// `zero` are folded; an input multiplied by 0 counts as not read. Initial register values are not negative, because
// GL's texels, colours and constants are not: max(0, …) appears only where a stage may have written a negative value.
[[nodiscard]] Explanation explain(const Program& program, const HardwareProfile& profile);

// The explanation as text: several lines of UTF-8, each ending in a newline.
[[nodiscard]] std::string print_explanation(const Explanation& explanation);

// The stages before the combiners as equations, one a line, in the order of execution; empty: they are not enabled.
// tex0 to tex3 are texels, s1 the coordinates of unit 1, ds() and dt() the offsets in a texel, dot1 a dot product of
// stage 1, expand() and the like the mapping of its factor, reflect(d, e) the eye e reflected by d. The stages must be
// valid.
[[nodiscard]] std::vector<std::string> explain_stages(const TextureShaderState& state);

// The same as text, below a line "texture shader"; empty: they are not enabled.
[[nodiscard]] std::string print_stages(const TextureShaderState& state);

}  // namespace ninebit
