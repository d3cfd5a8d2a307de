#include "ninebit/combiner/registers.h"

namespace ninebit {
namespace {

// A state is plain data: an enumeration in it may hold a number that is not an enumerator.
template <std::size_t N, class Enum>
std::string_view name_in(const std::array<std::string_view, N>& names, Enum value) {
  const auto i = static_cast<std::size_t>(value);
  return i < N ? names[i] : std::string_view("unknown");
}

}  // namespace

std::string_view name_of(Register r) {
  constexpr std::array<std::string_view, 15> names{"zero",
                                                   "constant_color0",
                                                   "constant_color1",
                                                   "fog",
                                                   "primary_color",
                                                   "secondary_color",
                                                   "spare0",
                                                   "spare1",
                                                   "texture0",
                                                   "texture1",
                                                   "texture2",
                                                   "texture3",
                                                   "e_times_f",
                                                   "spare0_plus_secondary_color",
                                                   "discard"};
  return name_in(names, r);
}

std::string_view name_of(InputMapping mapping) {
  constexpr std::array<std::string_view, 8> names{"unsigned_identity", "unsigned_invert",  "expand_normal",
                                                  "expand_negate",     "half_bias_normal", "half_bias_negate",
                                                  "signed_identity",   "signed_negate"};
  return name_in(names, mapping);
}

std::string_view name_of(ComponentUsage usage) {
  constexpr std::array<std::string_view, 3> names{"rgb", "alpha", "blue"};
  return name_in(names, usage);
}

std::string_view name_of(Scale scale) {
  constexpr std::array<std::string_view, 4> names{"none", "scale_by_two", "scale_by_four", "scale_by_one_half"};
  return name_in(names, scale);
}

std::string_view name_of(Bias bias) {
  constexpr std::array<std::string_view, 2> names{"none", "bias_by_negative_one_half"};
  return name_in(names, bias);
}

std::string_view short_name(Register r) {
  constexpr std::array<std::string_view, 4> textures{"tex0", "tex1", "tex2", "tex3"};
  switch (r) {
    case Register::constant0:
      return "const0";
    case Register::constant1:
      return "const1";
    case Register::primary:
      return "primary";
    case Register::secondary:
      return "secondary";
    default:
      return is_texture(r) ? textures[static_cast<std::size_t>(texture_unit_of(r))] : name_of(r);
  }
}

std::optional<Register> register_named(std::string_view name) {
  struct Name {
    std::string_view name;
    Register reg;
  };
  constexpr std::array names{
      Name{"col0", Register::primary}, Name{"col1", Register::secondary}, Name{"v0", Register::primary},
      Name{"v1", Register::secondary}, Name{"t0", Register::texture0},    Name{"t1", Register::texture1},
      Name{"t2", Register::texture2},  Name{"t3", Register::texture3},    Name{"r0", Register::spare0},
      Name{"r1", Register::spare1},    Name{"c0", Register::constant0},   Name{"c1", Register::constant1}};
  for (std::size_t r = static_cast<std::size_t>(Register::constant0); r < kRegisterCount; ++r) {
    if (short_name(static_cast<Register>(r)) == name) return static_cast<Register>(r);
  }
  for (const Name& known : names) {
    if (known.name == name) return known.reg;
  }
  return std::nullopt;
}

}  // namespace ninebit
