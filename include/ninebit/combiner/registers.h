// The words of NV_register_combiners: registers, input mappings, component usages, scales and biases.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The registers that hold a value in a stage come first; their count is the size of a register file.
enum class Register : std::uint8_t {
  zero,
  constant0,
  constant1,
  fog,
  primary,
  secondary,
  spare0,
  spare1,
  texture0,
  texture1,
  texture2,
  texture3,
  e_times_f,              // final combiner only
  spare0_plus_secondary,  // final combiner only
  discard                 // output only
};
// Registers that hold a value: zero to texture3.
inline constexpr std::size_t kRegisterCount = 12;

// Whether `r` is one of the four texture registers.
[[nodiscard]] constexpr bool is_texture(Register r) {
  return r >= Register::texture0 && r <= Register::texture3;
}
// Whether `r` is one of the two constants.
[[nodiscard]] constexpr bool is_constant(Register r) {
  return r == Register::constant0 || r == Register::constant1;
}
// Returns the unit, 0 to 3, of a texture register.
[[nodiscard]] constexpr int texture_unit_of(Register r) {
  return static_cast<int>(r) - static_cast<int>(Register::texture0);
}
// Returns the register of texture unit 0 to 3.
[[nodiscard]] constexpr Register texture_register(int unit) {
  return static_cast<Register>(static_cast<int>(Register::texture0) + unit);
}

// NV_register_combiners, table NV_register_combiners.3; e is the register component.
enum class InputMapping : std::uint8_t {
  unsigned_identity,  // max(0, e)
  unsigned_invert,    // 1 - min(max(0, e), 1)
  expand_normal,      // 2 max(0, e) - 1
  expand_negate,      // 1 - 2 max(0, e)
  half_bias_normal,   // max(0, e) - 1/2
  half_bias_negate,   // 1/2 - max(0, e)
  signed_identity,    // e
  signed_negate       // -e
};

// Which components of a register an input reads: red, green and blue; alpha for all channels; blue, in alpha portions
// only.
enum class ComponentUsage : std::uint8_t { rgb, alpha, blue };
// The factor of a portion's outputs, applied after the bias.
enum class Scale : std::uint8_t { none, by_two, by_four, by_one_half };
// The term added to a portion's outputs: nothing or -1/2.
enum class Bias : std::uint8_t { none, by_negative_one_half };
// The two portions of a general combiner.
enum class PortionName : std::uint8_t { rgb, alpha };
// An input: A to D of a general combiner, A to G of the final combiner.
enum class Variable : std::uint8_t { a, b, c, d, e, f, g };

// All input mappings, in the order of their numbers.
inline constexpr std::array kInputMappings{InputMapping::unsigned_identity, InputMapping::unsigned_invert,
                                           InputMapping::expand_normal,     InputMapping::expand_negate,
                                           InputMapping::half_bias_normal,  InputMapping::half_bias_negate,
                                           InputMapping::signed_identity,   InputMapping::signed_negate};

// The extension's name without its GL_ prefix and _NV suffix, in lower case: "primary_color", "expand_normal", …;
// "unknown" for a number that is not an enumerator.
[[nodiscard]] std::string_view name_of(Register r);
[[nodiscard]] std::string_view name_of(InputMapping mapping);
[[nodiscard]] std::string_view name_of(ComponentUsage usage);
[[nodiscard]] std::string_view name_of(Scale scale);
[[nodiscard]] std::string_view name_of(Bias bias);

// Returns a register's name in tables, equations and traces: "tex0", "const1", "primary"; name_of() for the others.
[[nodiscard]] std::string_view short_name(Register r);

// The register of a short name, or of its name in a language: "col0" and "col1" of !!RC1.0 are the two colours, as are
// "v0" and "v1" of pixel shaders, whose "t0" to "t3" are textures, "r0" and "r1" spare0 and spare1, "c0" and "c1" the
// constants. One of the first kRegisterCount but zero; nothing for other names.
[[nodiscard]] std::optional<Register> register_named(std::string_view name);

}  // namespace ninebit
