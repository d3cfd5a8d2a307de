// What the parser of general combiners and that of the final combiner share: tokens, faults and operands.
#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/language/rc10/rc10_lexer.h"

namespace ninebit::detail {

enum class Rc10Suffix { none, rgb, alpha, blue };

// A register as it is written. `one` is the register zero with a mapping of its own: see map_one.
struct Rc10Register {
  std::size_t offset = 0;
  std::string_view text;
  Register reg = Register::zero;
  bool is_one = false;
  Rc10Suffix suffix = Rc10Suffix::none;
};

// What an input or output register of a word is; empty: the word names none.
[[nodiscard]] std::optional<Rc10Register> rc10_register(const Rc10Token& token);

// The mapping of zero that gives what `mapping` makes of one: 1, -1, 1/2, -1/2 or 0.
[[nodiscard]] InputMapping map_one(InputMapping mapping);

// zero under unsigned_identity, which is 0, and under unsigned_invert, which is 1.
[[nodiscard]] constexpr CombinerInput rc10_zero(ComponentUsage usage) {
  return {Register::zero, InputMapping::unsigned_identity, usage};
}
[[nodiscard]] constexpr CombinerInput rc10_one(ComponentUsage usage) {
  return {Register::zero, InputMapping::unsigned_invert, usage};
}

// The suffix as component usage; without one it is `plain`.
[[nodiscard]] ComponentUsage usage_of(Rc10Suffix suffix, ComponentUsage plain);

// The reading of tokens with their faults. Functions that answer bool answer false after they have reported a fault.
class Rc10Reader {
 public:
  Rc10Reader(std::string_view text, const HardwareProfile& of, SourceFaults& into)
      : profile(of), faults(into), lexer(text, into) {}

  bool expect(char c);
  // Each of them in its turn.
  bool expect(std::initializer_list<char> all);
  // Reports that something else stands here; always false.
  bool expected(const std::string& what);
  // A semicolon. Where it alone is missing, before a word, nothing is lost.
  bool end_of_statement();
  // Reports a texture register that the profile lacks.
  void check_exists(const Rc10Register& reg);
  // Skips to after the semicolon, or to the end of the block.
  void skip_statement();
  // Skips a block whose opening brace comes next, with the blocks in it.
  void skip_block();

  const HardwareProfile& profile;
  SourceFaults& faults;
  Rc10Lexer lexer;
};

struct Rc10Constants {
  std::optional<ColorF> color[2];
};
// "const0 = (r, g, b, a);", the name being next. `where` is "global" or "local".
bool read_rc10_constant(Rc10Reader& in, Rc10Constants& constants, const char* where);
// "{ … }", the brace being next.
void read_rc10_stage(Rc10Reader& in, GeneralCombiner& stage, Rc10Constants& constants);

// A general combiner that writes nothing, as it is when the program has none.
void clear_rc10_stage(GeneralCombiner& stage);

// The final combiner's statements.
class Rc10Final {
 public:
  // Whether a word begins one.
  [[nodiscard]] static bool begins(const Rc10Token& token);
  // Reads one, which is next.
  bool read_statement(Rc10Reader& in);
  // After the last: what only all of them together can tell is checked, and the state set.
  void finish(Rc10Reader& in, CombinerState& state);

 private:
  struct Operand {
    CombinerInput input;
    Rc10Register written;
  };
  enum class Of { rgb, product, alpha };

  bool read_assigned(Rc10Reader& in, const Rc10Token& name);
  bool read_operand(Rc10Reader& in, Operand& out, Of of);
  bool read_register(Rc10Reader& in, Operand& out, Of of, InputMapping mapping);
  bool read_rgb(Rc10Reader& in);
  bool read_lerp(Rc10Reader& in);
  void move_color_sum(Rc10Reader& in);

  bool clamp_ = false, product_ = false, rgb_ = false, alpha_ = false;  // which statements there are
  Operand a_{}, b_{}, c_{}, d_{}, e_{}, f_{};
  Operand g_{rc10_zero(ComponentUsage::alpha), {}};
};

}  // namespace ninebit::detail
