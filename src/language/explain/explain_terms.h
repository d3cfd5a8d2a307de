// The algebra of explain: mapped inputs, their products and sums as text, with constants folded and with the range of
// their values.
#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/language/explain.h"
#include "src/combiner/interval.h"

namespace ninebit::explain_detail {

using Range = IntervalOf<int>;

// The range of each register's components in codes: [register][0] for red, green and blue, [register][1] for alpha.
using Ranges = std::array<std::array<Range, 2>, kRegisterCount>;

// A read of components of a register: the reader's own channels, or always the same components.
struct Read {
  Register reg = Register::zero;
  bool per_channel = false;
  unsigned components = 0;  // bit 0 red … bit 3 alpha, unless per_channel
  [[nodiscard]] unsigned needed(unsigned channels) const { return per_channel ? channels & 7U : components; }
};

inline constexpr unsigned kRgbBits = 7U;
inline constexpr unsigned kAlphaBit = 8U;

// Notation that the legend explains.
enum class Mark { expand, half, odd, product, dot, swizzle, max };
using Marks = std::set<Mark>;

// How tightly an expression binds, loosest first.
enum class Binding { choice, sum, product, atom };

// A value: a constant, or text without its sign.
struct Expression {
  std::optional<int> constant;  // factors: a code; wide values: units of 1/one²
  bool negative = false;        // of the text
  std::string text;
  Binding binding = Binding::atom;
  Range range;  // of the value, sign included; codes or wide units as above
  std::vector<Read> reads;
  Marks marks;
  [[nodiscard]] bool is(int value) const { return constant == value; }
};

// The context in which an input is read.
struct Scope {
  const Datapath* datapath = nullptr;
  const Ranges* ranges = nullptr;
  Rgba9 constant0{}, constant1{};
  std::array<bool, 2> unset{};  // constants whose colours are not known
  bool per_channel = true;      // the reader has separate red, green and blue channels
};

[[nodiscard]] std::string with_sign(const Expression& e);

// A constant code: "0", "1", "−1", "½", "−½" or "64/255".
[[nodiscard]] std::string code_text(const Datapath& d, int code, Marks& marks);
// The same in units of 1/(one × unit): unit 1 for codes, `one` for wide values.
[[nodiscard]] std::string constant_text(const Datapath& d, int value, int unit, Marks& marks);

// A variable after its mapping, as a code. In a dot product, an input that uses one component for all channels is
// spelled out.
[[nodiscard]] Expression mapped_input(const Scope& scope, const CombinerInput& input, bool in_dot_product);
// The same for a computed value, such as the final combiner's E·F.
[[nodiscard]] Expression mapped_value(const Datapath& d, InputMapping mapping, const Expression& value);

// Products of two codes, as wide values.
[[nodiscard]] Expression product(const Datapath& d, const Expression& a, const Expression& b);
[[nodiscard]] Expression dot_product(const Datapath& d, const Expression& a, const Expression& b);
// The sum of two wide values with unit `one`, or of two codes with unit 1.
[[nodiscard]] Expression sum(const Datapath& d, const Expression& a, const Expression& b, int unit);

// The product that a mux picks, if the range of spare0's alpha leaves no choice.
enum class Picks { either, ab, cd };
[[nodiscard]] Picks mux_picks(const Datapath& d, bool by_lowest_bit, Range spare0_alpha);

// The mux of two wide values, or the only one that it can pick.
[[nodiscard]] Expression choice(const Datapath& d, const Expression& ab, const Expression& cd, bool by_lowest_bit,
                                Range spare0_alpha);

// The value that a general combiner writes for a wide value: the expression with bias and scale, and its range as codes
// before the clamp.
[[nodiscard]] Expression combiner_output(const Datapath& d, Scale scale, Bias bias, const Expression& wide);

// The notes, constants and legend beside the equations.

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
