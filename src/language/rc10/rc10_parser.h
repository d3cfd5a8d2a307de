// Shared by the parsers of the general combiners and of the final combiner: tokens, faults and operands.
#pragma once

#include <array>
#include <cstddef>
#include <initializer_list>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/texture_shader/stage_state.h"
#include "src/language/rc10/rc10_lexer.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {

// The note on a text that has only !!TS1.0.
inline constexpr std::string_view kNoRegisterCombiners =
    "there is no !!RC1.0; the register combiners have OpenGL's defaults";

enum class Rc10Suffix { none, rgb, alpha, blue };

// A register as written. `one` is the register zero with a mapping that map_one changes.
struct Rc10Register {
  std::size_t offset = 0;
  std::string_view text;
  Register reg = Register::zero;
  bool is_one = false;
  Rc10Suffix suffix = Rc10Suffix::none;
};

// The input or output register that a word names; empty: none.
[[nodiscard]] std::optional<Rc10Register> rc10_register(const Rc10Token& token);

// The mapping that turns zero into what `mapping` turns one into: 1, -1, 1/2, -1/2 or 0.
[[nodiscard]] InputMapping map_one(InputMapping mapping);

// The constants 0 and 1: zero under unsigned_identity and under unsigned_invert.
[[nodiscard]] constexpr CombinerInput rc10_zero(ComponentUsage usage) {
  return {Register::zero, InputMapping::unsigned_identity, usage};
}
[[nodiscard]] constexpr CombinerInput rc10_one(ComponentUsage usage) {
  return {Register::zero, InputMapping::unsigned_invert, usage};
}

// The suffix as component usage; without one it is `plain`.
[[nodiscard]] ComponentUsage usage_of(Rc10Suffix suffix, ComponentUsage plain);

// Reads tokens and reports faults. Functions that return bool return false after reporting a fault.
class Rc10Reader {
 public:
  Rc10Reader(std::string_view text, const HardwareProfile& of, SourceFaults& into)
      : profile(of), faults(into), lexer(text, into) {}

  bool expect(char c);
  // Expects each of them in turn.
  bool expect(std::initializer_list<char> all);
  // Reports that `what` was expected here; always false.
  bool expected(const std::string& what);
  // Expects a semicolon. If it is missing before a word or a closing brace, reports that and returns true.
  bool end_of_statement();
  // Reports a texture register that the profile does not have.
  void check_exists(const Rc10Register& reg);
  // Skips past the next semicolon, or to the end of the block.
  void skip_statement();
  // Skips a block, whose opening brace is the next token, and the blocks in it.
  void skip_block();

  const HardwareProfile& profile;
  SourceFaults& faults;
  Rc10Lexer lexer;
};

struct Rc10Constants {
  std::optional<ColorF> color[2];
};
// Reads "const0 = (r, g, b, a);", whose name is the next token. `where` is "global" or "local".
bool read_rc10_constant(Rc10Reader& in, Rc10Constants& constants, const char* where);
// Reads "{ … }", whose brace is the next token.
void read_rc10_stage(Rc10Reader& in, GeneralCombiner& stage, Rc10Constants& constants);

// Makes a general combiner write nothing, as when the program has none.
void clear_rc10_stage(GeneralCombiner& stage);

// The final combiner's statements.
class Rc10Final {
 public:
  // Whether a token begins a statement of the final combiner.
  [[nodiscard]] static bool begins(const Rc10Token& token);
  // Reads the statement that begins with the next token.
  bool read_statement(Rc10Reader& in);
  // Called after the last statement: makes the checks that need all statements, and sets the state.
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

  bool clamp_ = false, product_ = false, rgb_ = false, alpha_ = false;  // statements that were read
  Operand a_{}, b_{}, c_{}, d_{}, e_{}, f_{};
  Operand g_{rc10_zero(ComponentUsage::alpha), {}};
};

// Files of NVIDIA's fp20 profile: an !!RC1.0 program beside programs for the units before it, one after the other. Each
// part stands in a text of its own, with blanks for the others. Without a part !!RC1.0, `rc10` is the text behind the
// other parts.
struct Rc10Parts {
  std::string rc10{}, ts10{};            // with their headers
  std::optional<std::size_t> ts10_at{};  // the offset of the header !!TS1.0
  bool has_rc10 = false;
};
// The parts of a text; empty: it has no part but !!RC1.0. Parts that are skipped are named by notes; with
// `skips_stages`, !!TS1.0 is one of them. Reports parts whose headers are unknown, and a second !!TS1.0.
[[nodiscard]] std::optional<Rc10Parts> rc10_parts(std::string_view text, bool skips_stages, SourceFaults& faults,
                                                  SourceFaults& notes);

// The stages of a part !!TS1.0, of which every line takes the next one. Reports all faults, with those of validate().
[[nodiscard]] TextureShaderState read_ts10(const Rc10Parts& parts, const HardwareProfile& profile,
                                           SourceFaults& faults);
// The part !!TS1.0, or a Diagnostic that names what it cannot express.
[[nodiscard]] Result<std::string> print_ts10(const TextureShaderState& state);

// A chain of lines, such as dot_product_2d_1of2 and dot_product_2d_2of2.
struct Ts10Chain {
  std::string_view name;  // of each line before its "_1of2"
  std::array<TextureOperation, 3> operation;
  int lines;
  bool has_eye;  // the first line ends with three numbers
};
[[nodiscard]] std::span<const Ts10Chain> ts10_chains();

}  // namespace ninebit::detail
