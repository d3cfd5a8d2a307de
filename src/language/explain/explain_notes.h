// The notes, constants and legend beside the equations of an explanation.
#pragma once

#include <string>
#include <vector>

#include "ninebit/language/explain.h"
#include "src/language/explain/explain_terms.h"

namespace ninebit::explain_detail {

// An equation with the data for following values through the program.
struct Fact {
  Equation equation;
  Register target = Register::discard;  // general combiners only
  unsigned components = 0;              // of the target: kRgbBits or kAlphaBit
  std::vector<Read> reads;
  Marks marks;
  Range range;              // of the value written, codes
  std::string mux_picks{};  // "AB" or "CD": the only product that the mux can pick
};

// Results in the order of the stages; `used` of the facts must be final.
[[nodiscard]] std::vector<DeadPortion> dead_portions(const Program& program, const std::vector<Fact>& facts);
[[nodiscard]] std::vector<std::string> constant_sentences(const Program& program, const std::vector<Fact>& facts);
[[nodiscard]] std::vector<std::string> notes_of(const Program& program, const HardwareProfile& profile,
                                                const std::vector<Fact>& facts);
[[nodiscard]] std::vector<std::string> legend_of(const Datapath& d, const std::vector<Fact>& facts);

// The final combiner's two equations for explain.

// RGB = A·B + (1 - A)·C + D and alpha = G, simplified; codes before the clamp to [0, 1].
[[nodiscard]] Expression final_color(const Program& program, const Scope& scope);
[[nodiscard]] Expression final_alpha(const Program& program, const Scope& scope);

// Whether the color equation is GL's default: fog and colour sum.
[[nodiscard]] bool is_default_color(const FinalCombiner& f);

}  // namespace ninebit::explain_detail
