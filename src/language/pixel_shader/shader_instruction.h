// A pixel shader as its instructions, before it is translated.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"

namespace ninebit::detail {

// The version that a shader's header names.
struct ShaderVersion {
  int minor = 1;            // of ps.1.x and xps.1.1
  bool is_xbox = false;     // xps.1.1
  bool is_nvparse = false;  // !!PS1.0
  std::string name{};       // as messages name it: "ps.1.1"
};

enum class ShaderFile : std::uint8_t { temporary, texture, color, constant, fog, zero, one, sum, product, discard };
// `other`: of a texture instruction's source, one that is neither _bx2 nor none, such as _dz.
enum class ShaderModifier : std::uint8_t { none, bias, expand, by_two, saturate, other };
enum class ShaderSelector : std::uint8_t { none, rgb, alpha, blue, red, green };

// A source: -r0_bx2.a, 1-t0.
struct ShaderOperand {
  std::size_t offset = 0;
  std::string_view text{};  // the register as written
  ShaderFile file = ShaderFile::zero;
  int index = 0;
  ShaderModifier modifier = ShaderModifier::none;
  ShaderSelector selector = ShaderSelector::none;
  bool negate = false;  // -x
  bool invert = false;  // 1 - x
};

// A destination: r0, r0.rgb, discard.
struct ShaderTarget {
  std::size_t offset = 0;
  std::string_view text{};
  ShaderFile file = ShaderFile::discard;
  int index = 0;
  bool rgb = true;
  bool alpha = true;
};

enum class ShaderOp : std::uint8_t {
  mov,
  add,
  sub,
  mul,
  mad,
  lrp,
  dp3,
  dp4,
  cnd,
  cmp,
  bem,
  nop,
  def,
  phase,
  texture,
  xmma,
  xmmc,
  xdm,
  xdd,
  xfc
};

// The language's rules for an instruction.
struct ShaderOpRow {
  std::string_view name;
  ShaderOp op;
  int targets;
  int operands;     // of texture instructions: at most
  int first_minor;  // the first of ps.1.x that has it
  int last_minor;   // and the last; 0: only xps.1.1 has it
};
[[nodiscard]] std::span<const ShaderOpRow> shader_ops();
// The row of a name in lower case, or nullptr; the names that a version has.
[[nodiscard]] const ShaderOpRow* shader_op_named(std::string_view name);
[[nodiscard]] std::vector<std::string_view> shader_op_names(const ShaderVersion& version);
// The version that a header names; empty: an unknown one.
[[nodiscard]] std::optional<ShaderVersion> shader_version_of(std::string_view header);

struct ShaderInstruction {
  std::size_t offset = 0;
  std::string_view text{};  // the word as written
  const ShaderOpRow* row = nullptr;
  Scale scale = Scale::none;
  Bias bias = Bias::none;
  bool saturate = false;
  bool paired = false;  // +: runs with the instruction before
  std::vector<ShaderTarget> targets{};
  std::vector<ShaderOperand> operands{};

  [[nodiscard]] ShaderOp op() const { return row->op; }
  // Whether it is one for general combiners.
  [[nodiscard]] bool is_arithmetic() const;
  [[nodiscard]] bool writes(bool alpha) const {
    for (const ShaderTarget& target : targets) {
      if (target.file != ShaderFile::discard && (alpha ? target.alpha : target.rgb)) return true;
    }
    return false;
  }
};

inline constexpr std::size_t kShaderConstants = 16;  // c0 to c7; xps.1.1: to c15

// The value of a constant that the text defines.
struct ShaderConstant {
  bool defined = false;
  std::size_t offset = 0;
  std::array<float, 4> color{};
};

// Whether it has components above 0 and others below. A stage then subtracts two constants of the combiners, and a
// register has the difference.
[[nodiscard]] bool is_mixed(const ShaderConstant& constant);

struct ShaderText {
  ShaderVersion version{};
  std::vector<ShaderInstruction> instructions{};  // without def and nop
  std::array<ShaderConstant, kShaderConstants> constants{};
  bool complete = true;  // whether no instruction was left out

  // How many constants of the combiners the shader reads.
  [[nodiscard]] std::size_t constants_read() const;
};

}  // namespace ninebit::detail
