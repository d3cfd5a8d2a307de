#include "src/language/register_words/register_words_layout.h"

#include <algorithm>
#include <charconv>

#include "src/system/find_row.h"

namespace ninebit {

std::string_view name_of(ChipClass chip) {
  return chip == ChipClass::nv10 ? "nv10" : "nv20";
}

namespace words {
namespace {

enum Chips : std::uint8_t { both, nv10_only, nv20_only };

// A name without prefix and index, in lower case. `index` from 0: the name is that of this one word; kFirst: of the
// first of a row, to which an index may be added.
constexpr int kFirst = -2;
struct Alias {
  std::string_view name;
  Kind kind;
  int index = -1;
  Chips chips = both;
};

// Names from envytools rnndb, envytools hwtest, the method names of class NV097, the fields of the Xbox's pixel shader
// definition, xemu's names of PGRAPH's registers and the members of its PshState.
constexpr std::array kAliases{
    Alias{"rc_in_alpha", Kind::in_alpha},
    Alias{"combiner_alpha_icw", Kind::in_alpha},
    Alias{"psalphainputs", Kind::in_alpha},
    Alias{"rc_in_rgb", Kind::in_rgb},
    Alias{"rc_in_color", Kind::in_rgb},
    Alias{"combiner_color_icw", Kind::in_rgb},
    Alias{"psrgbinputs", Kind::in_rgb},
    Alias{"rc_out_alpha", Kind::out_alpha},
    Alias{"combiner_alpha_ocw", Kind::out_alpha},
    Alias{"psalphaoutputs", Kind::out_alpha},
    Alias{"rc_out_rgb", Kind::out_rgb},
    Alias{"rc_out_color", Kind::out_rgb},
    Alias{"combiner_color_ocw", Kind::out_rgb},
    Alias{"psrgboutputs", Kind::out_rgb},
    Alias{"rc_color", Kind::color},
    Alias{"rc_factor", Kind::color, -1, nv10_only},
    Alias{"combiner_factor", Kind::color, -1, nv10_only},
    Alias{"rc_final_factor", Kind::color, -1, nv20_only},
    Alias{"specular_fog_factor", Kind::color, -1, nv20_only},
    Alias{"psfinalcombinerconstant", Kind::color, -1, nv20_only},
    Alias{"rc_constant_color0", Kind::stage_color0, -1, nv20_only},
    Alias{"rc_factor_0", Kind::stage_color0, -1, nv20_only},
    Alias{"rc_factor0", Kind::stage_color0, -1, nv20_only},
    Alias{"combiner_factor0", Kind::stage_color0, -1, nv20_only},
    Alias{"psconstant0", Kind::stage_color0, -1, nv20_only},
    Alias{"rc_constant_color1", Kind::stage_color1, -1, nv20_only},
    Alias{"rc_factor_1", Kind::stage_color1, -1, nv20_only},
    Alias{"rc_factor1", Kind::stage_color1, -1, nv20_only},
    Alias{"combiner_factor1", Kind::stage_color1, -1, nv20_only},
    Alias{"psconstant1", Kind::stage_color1, -1, nv20_only},
    Alias{"rc_final0", Kind::final0, 0},
    Alias{"rc_final_0", Kind::final0, 0},
    Alias{"rc_final_a", Kind::final0, 0},
    Alias{"combiner_specular_fog_cw0", Kind::final0, 0},
    Alias{"psfinalcombinerinputsabcd", Kind::final0, 0},
    Alias{"rc_final1", Kind::final1, 0},
    Alias{"rc_final_1", Kind::final1, 0},
    Alias{"rc_final_b", Kind::final1, 0},
    Alias{"combiner_specular_fog_cw1", Kind::final1, 0},
    Alias{"psfinalcombinerinputsefg", Kind::final1, 0},
    Alias{"rc_enable", Kind::enable, 0, nv20_only},
    Alias{"rc_config", Kind::enable, 0, nv20_only},
    Alias{"combiner_control", Kind::enable, 0, nv20_only},
    Alias{"pscombinercount", Kind::enable, 0, nv20_only},
    Alias{"combinealphai", Kind::in_alpha, -1, nv20_only},
    Alias{"combinealphai0", Kind::in_alpha, kFirst, nv20_only},
    Alias{"combinecolori", Kind::in_rgb, -1, nv20_only},
    Alias{"combinecolori0", Kind::in_rgb, kFirst, nv20_only},
    Alias{"combinealphao", Kind::out_alpha, -1, nv20_only},
    Alias{"combinealphao0", Kind::out_alpha, kFirst, nv20_only},
    Alias{"combinecoloro", Kind::out_rgb, -1, nv20_only},
    Alias{"combinecoloro0", Kind::out_rgb, kFirst, nv20_only},
    Alias{"combinefactor0", Kind::stage_color0, kFirst, nv20_only},
    Alias{"combinefactor1", Kind::stage_color1, kFirst, nv20_only},
    Alias{"specfogfactor", Kind::color, -1, nv20_only},
    Alias{"combinespecfog0", Kind::final0, 0, nv20_only},
    Alias{"combinespecfog1", Kind::final1, 0, nv20_only},
    Alias{"combinectl", Kind::enable, 0, nv20_only},
    Alias{"alpha_inputs", Kind::in_alpha, -1, nv20_only},
    Alias{"rgb_inputs", Kind::in_rgb, -1, nv20_only},
    Alias{"alpha_outputs", Kind::out_alpha, -1, nv20_only},
    Alias{"rgb_outputs", Kind::out_rgb, -1, nv20_only},
    Alias{"final_inputs_0", Kind::final0, 0, nv20_only},
    Alias{"final_inputs_1", Kind::final1, 0, nv20_only},
};

constexpr std::array<std::string_view, 14> kPrefixes{"nv10_3d_", "nv15_3d_", "nv17_3d_", "nv20_3d_",  "nv25_3d_",
                                                     "nv10tcl_", "nv20tcl_", "nv056_",   "nv096_",    "nv097_",
                                                     "celsius_", "kelvin_",  "bundle_",  "nv_pgraph_"};

// The NV2A's registers by their addresses: rows of words, each 4 after the one before.
struct RegisterRow {
  std::uint32_t address;
  std::string_view name;
  std::uint32_t words;
};
constexpr std::array kRegisterRows{
    RegisterRow{0x401880, "combinefactor0", 8},  RegisterRow{0x4018a0, "combinefactor1", 8},
    RegisterRow{0x4018c0, "combinealphai0", 8},  RegisterRow{0x4018e0, "combinealphao0", 8},
    RegisterRow{0x401900, "combinecolori0", 8},  RegisterRow{0x401920, "combinecoloro0", 8},
    RegisterRow{0x401940, "combinectl", 1},      RegisterRow{0x401944, "combinespecfog0", 1},
    RegisterRow{0x401948, "combinespecfog1", 1}, RegisterRow{0x401994, "shaderclipmode", 1},
    RegisterRow{0x401998, "shaderctl", 1},       RegisterRow{0x40199c, "shaderprog", 1},
    RegisterRow{0x4019ac, "specfogfactor0", 1},  RegisterRow{0x4019b0, "specfogfactor1", 1},
};

// The bare name of the register at an address such as "0x401940"; empty: none of these.
std::string name_at_address(std::string_view text) {
  std::uint32_t address = 0;
  const auto [end, error] = std::from_chars(text.data() + 2, text.data() + text.size(), address, 16);
  if (error != std::errc() || end != text.data() + text.size() || address % 4 != 0) return {};
  for (const RegisterRow& row : kRegisterRows) {
    const std::uint32_t index = (address - row.address) / 4;
    if (address < row.address || index >= row.words) continue;
    return std::string(row.name) + (row.words > 1 ? "[" + std::to_string(index) + "]" : "");
  }
  return {};
}

// "[3]", "(3)", "3" and "_3" as 3.
std::optional<int> parse_index(std::string_view text) {
  if (text.size() >= 3 &&
      ((text.front() == '[' && text.back() == ']') || (text.front() == '(' && text.back() == ')'))) {
    text = text.substr(1, text.size() - 2);
  } else if (text.size() >= 2 && text.front() == '_') {
    text.remove_prefix(1);
  }
  if (text.empty() || text.size() > 4) return std::nullopt;
  int value = 0;
  for (const char c : text) {
    if (c < '0' || c > '9') return std::nullopt;
    value = value * 10 + (c - '0');
  }
  return value;
}

bool has(const Alias& alias, ChipClass chip) {
  return alias.chips == both || (alias.chips == nv10_only) == (chip == ChipClass::nv10);
}

std::string chip_text(ChipClass chip) {
  return chip == ChipClass::nv10 ? "NV10" : "NV20";
}

// find_slot() for one chip; `name` is in lower case and without prefix.
FoundSlot find_bare(std::string_view name, std::string_view spelled, ChipClass chip) {
  const Alias* best = nullptr;
  std::optional<int> best_index;
  for (const Alias& alias : kAliases) {
    if (!has(alias, chip) || !name.starts_with(alias.name)) continue;
    const std::string_view rest = name.substr(alias.name.size());
    const std::optional<int> index = alias.index < 0 ? parse_index(rest) : std::nullopt;
    if (!rest.empty() && !index) continue;
    if (best != nullptr && best->name.size() > alias.name.size()) continue;
    best = &alias;
    best_index = alias.index == kFirst ? index.value_or(0) : alias.index < 0 ? index : alias.index;
  }
  if (best == nullptr) return {};
  const int count = count_of(best->kind, chip);
  const std::string range = "an index from 0 to " + std::to_string(count - 1);
  if (!best_index)
    return {{}, std::string(spelled) + " needs " + range + ", as in " + canonical_name({best->kind, 0}, chip)};
  if (*best_index >= count) {
    return {{}, std::string(spelled) + " is out of range for " + chip_text(chip) + "; expected " + range};
  }
  return {Slot{best->kind, *best_index}, {}};
}

}  // namespace

int count_of(Kind kind, ChipClass chip) {
  switch (kind) {
    case Kind::in_alpha:
    case Kind::in_rgb:
    case Kind::out_alpha:
    case Kind::out_rgb:
      return stages_of(chip);
    case Kind::color:
      return 2;
    case Kind::stage_color0:
    case Kind::stage_color1:
      return chip == ChipClass::nv10 ? 0 : stages_of(chip);
    case Kind::final0:
    case Kind::final1:
      return 1;
    case Kind::enable:
      return chip == ChipClass::nv10 ? 0 : 1;
  }
  return 0;
}

std::string canonical_name(Slot slot, ChipClass chip) {
  constexpr std::array<std::string_view, kKinds> kNames{
      "RC_IN_ALPHA",        "RC_IN_RGB",          "RC_OUT_ALPHA", "RC_OUT_RGB", "RC_COLOR",
      "RC_CONSTANT_COLOR0", "RC_CONSTANT_COLOR1", "RC_FINAL0",    "RC_FINAL1",  "RC_ENABLE"};
  std::string name(kNames[static_cast<std::size_t>(slot.kind)]);
  if (slot.kind == Kind::color && chip == ChipClass::nv20) return name + std::to_string(slot.index);
  if (count_of(slot.kind, chip) > 1) name += '[' + std::to_string(slot.index) + ']';
  return name;
}

std::string bare_name(std::string_view name) {
  const std::string lower = detail::lower_case(name);
  if (lower.starts_with("0x")) return name_at_address(lower);
  std::string_view bare = lower;
  for (const std::string_view prefix : kPrefixes) {
    if (!bare.starts_with(prefix)) continue;
    bare.remove_prefix(prefix.size());
    break;
  }
  if (bare.starts_with("set_")) bare.remove_prefix(4);
  return std::string(bare);
}

FoundSlot find_slot(std::string_view name, ChipClass chip) {
  const std::string bare = bare_name(name);
  FoundSlot found = find_bare(bare, name, chip);
  if (found.slot || !found.fault.empty()) return found;
  const ChipClass other = chip == ChipClass::nv10 ? ChipClass::nv20 : ChipClass::nv10;
  const FoundSlot elsewhere = find_bare(bare, name, other);
  if (elsewhere.slot || !elsewhere.fault.empty()) {
    return {{}, std::string(name) + " is a word of " + chip_text(other) + ", not of " + chip_text(chip)};
  }
  if (bare.empty()) {
    return {{}, std::string(name) + " is not the address of a combiner register, such as 0x401940"};
  }
  return {{},
          std::string(name) + " is not a register word of " + chip_text(chip) + "; expected " +
              canonical_name({Kind::in_rgb, 0}, chip) + ", RC_FINAL0, …"};
}

std::string hex_text(std::uint32_t value, int digits) {
  std::string text = "0x";
  for (int i = digits - 1; i >= 0; --i) text += "0123456789abcdef"[bits(value, 4 * i, 4)];
  return text;
}

std::string bits_text(std::uint32_t mask) {
  std::vector<int> set;
  for (int bit = 31; bit >= 0; --bit) {
    if (bits(mask, bit, 1) != 0) set.push_back(bit);
  }
  std::string text = set.size() == 1 ? "bit " : "bits ";
  for (std::size_t i = 0; i < set.size(); ++i) {
    if (i > 0) text += i + 1 == set.size() ? " and " : ", ";
    text += std::to_string(set[i]);
  }
  return text;
}

std::uint32_t mask_of(Slot slot, ChipClass chip) {
  switch (slot.kind) {
    case Kind::out_alpha:
      return 0x0003'cfff;
    case Kind::out_rgb:
      if (chip == ChipClass::nv20) return 0x000f'ffff;
      return slot.index == 0 ? 0x0003'ffff : 0x3803'ffff;
    case Kind::final0:
      return 0x3f3f'3f3f;
    case Kind::final1:
      return 0x3f3f'3fe0;
    case Kind::enable:
      return 0x0001'110f;
    default:
      return 0xffff'ffff;
  }
}

std::optional<Register> register_of(std::uint32_t code) {
  if (code >= kRegisters.size() || kRegisters[code] == kReserved) return std::nullopt;
  return kRegisters[code];
}

std::uint32_t code_of(Register r) {
  if (r == kReserved) return 0;
  const auto found = std::find(kRegisters.begin(), kRegisters.end(), r);
  return found == kRegisters.end() ? 0 : static_cast<std::uint32_t>(found - kRegisters.begin());
}

GlError error_of_misplaced(std::uint32_t code, Kind kind) {
  const std::optional<Register> r = register_of(code);
  if (!r) return GlError::no_error;
  return kind == Kind::final1 && !is_texture(*r) ? GlError::invalid_operation : GlError::invalid_enum;
}

}  // namespace words
}  // namespace ninebit

namespace ninebit::words {
namespace {

// A name in lower case, without prefix and SET_.
struct OtherAlias {
  std::string_view bare, name;
};

// The methods' names are those of nxdk's nv2a_regs.h, then those of envytools rnndb. Direct3D writes these four words
// to the chip; it keeps the others for itself.
constexpr OtherAlias kOtherAliases[] = {
    {"shader_clip_plane_mode", "PSCompareMode"},
    {"tex_shader_cull_mode", "PSCompareMode"},
    {"shader_stage_program", "PSTextureModes"},
    {"tex_shader_op", "PSTextureModes"},
    {"dot_rgbmapping", "PSDotMapping"},
    {"tex_shader_dotmapping", "PSDotMapping"},
    {"shader_other_stage_input", "PSInputTexture"},
    {"tex_shader_previous", "PSInputTexture"},
    {"shaderclipmode", "PSCompareMode"},
    {"shaderprog", "PSTextureModes"},
    {"shaderctl", "PSInputTexture"},
    {"other_stage_input", "PSInputTexture"},
};

}  // namespace

std::string_view find_other_word(std::string_view name) {
  const std::string bare = bare_name(name);
  for (const std::string_view other : kOtherWordNames) {
    if (bare_name(other) == bare) return other;
  }
  for (const OtherAlias& alias : kOtherAliases) {
    if (alias.bare == bare) return alias.name;
  }
  return {};
}

bool OtherWords::take(const RegisterWord& word, ChipClass chip, TextFaults& faults) {
  const std::string_view name = find_other_word(word.name);
  if (name.empty()) return false;
  const std::string bare = bare_name(word.name);
  // SHADERCTL holds two words; xemu's PshState has it as other_stage_input.
  const bool holds_two = bare == "shaderctl" || bare == "other_stage_input";
  const RegisterWord* before = find_row(found, &RegisterWord::name, name);
  if (holds_two && before == nullptr) before = find_row(found, &RegisterWord::name, "PSDotMapping");
  if (chip == ChipClass::nv10) {
    faults.add(word.place, word.name + " is a word of NV20, not of NV10");
  } else if (before != nullptr) {
    faults.add(word.place, before->name + " was given before, in line " + std::to_string(before->place.line));
  } else {
    constexpr std::uint32_t kDotMapping = 0xfff;
    found.push_back({std::string(name), holds_two ? word.value & ~kDotMapping : word.value, word.place});
    if (holds_two) found.push_back({"PSDotMapping", word.value & kDotMapping, word.place});
  }
  return true;
}

}  // namespace ninebit::words
