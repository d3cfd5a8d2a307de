#include "src/language/pixel_shader/shader_operands.h"

#include <algorithm>
#include <array>

#include "src/system/find_row.h"
#include "src/system/nearest_name.h"

namespace ninebit::detail {
namespace {

struct NamedRegister {
  std::string_view name;
  ShaderFile file;
  int index;
};
// Besides r0, t0, v0 and c0. Only xps.1.1 has these; the last are names of other tools.
constexpr std::array kNamed{
    NamedRegister{"zero", ShaderFile::zero, 0},        NamedRegister{"one", ShaderFile::one, 0},
    NamedRegister{"fog", ShaderFile::fog, 0},          NamedRegister{"sum", ShaderFile::sum, 0},
    NamedRegister{"prod", ShaderFile::product, 0},     NamedRegister{"discard", ShaderFile::discard, 0},
    NamedRegister{"texture0", ShaderFile::texture, 0}, NamedRegister{"texture1", ShaderFile::texture, 1},
    NamedRegister{"texture2", ShaderFile::texture, 2}, NamedRegister{"texture3", ShaderFile::texture, 3},
    NamedRegister{"color", ShaderFile::color, 0},      NamedRegister{"color0", ShaderFile::color, 0},
    NamedRegister{"color1", ShaderFile::color, 1}};

struct NamedModifier {
  std::string_view name;
  ShaderModifier modifier;
};
constexpr std::array kModifiers{
    NamedModifier{"bias", ShaderModifier::bias}, NamedModifier{"bx2", ShaderModifier::expand},
    NamedModifier{"x2", ShaderModifier::by_two}, NamedModifier{"sat", ShaderModifier::saturate},
    NamedModifier{"b", ShaderModifier::bias}};

struct NamedSelector {
  std::string_view name;
  ShaderSelector selector;
};
constexpr std::array kSelectors{
    NamedSelector{"rgba", ShaderSelector::none}, NamedSelector{"xyzw", ShaderSelector::none},
    NamedSelector{"rgb", ShaderSelector::rgb},   NamedSelector{"xyz", ShaderSelector::rgb},
    NamedSelector{"a", ShaderSelector::alpha},   NamedSelector{"w", ShaderSelector::alpha},
    NamedSelector{"b", ShaderSelector::blue},    NamedSelector{"z", ShaderSelector::blue},
    NamedSelector{"r", ShaderSelector::red},     NamedSelector{"x", ShaderSelector::red},
    NamedSelector{"g", ShaderSelector::green},   NamedSelector{"y", ShaderSelector::green}};

// The names with which a misspelled one is compared.
std::vector<std::string> register_names(const ShaderVersion& version) {
  std::vector<std::string> names{"r0", "r1", "t0", "t1", "t2", "t3", "v0", "v1"};
  for (std::size_t i = 0; i < kShaderConstants; ++i) names.push_back("c" + std::to_string(i));
  for (std::size_t i = 0; version.is_xbox && i < kNamed.size(); ++i) names.emplace_back(kNamed[i].name);
  return names;
}

}  // namespace

int registers_of(ShaderFile file, const ShaderVersion& version) {
  const bool last = version.minor == 4;
  switch (file) {
    case ShaderFile::temporary:
      return last ? 6 : 2;
    case ShaderFile::texture:
      return last ? 6 : 4;
    case ShaderFile::color:
      return 2;
    case ShaderFile::constant:
      return version.is_xbox ? static_cast<int>(kShaderConstants) : 8;
    default:
      return 1;
  }
}

std::string ShaderOperandReader::may_be_included() const {
  return includes_ ? "; an included file, which was not read, may define it" : "";
}

void ShaderOperandReader::expected(const std::string& what) {
  const ShaderToken& token = in_.peek();
  const std::string found = in_.at_end()        ? ", but the text ends"
                            : in_.at_line_end() ? ", but the line ends"
                                                : ", found " + quoted(token.text);
  faults_.add(token.offset, "expected " + what + found);
}

bool ShaderOperandReader::read_index(Register& out) {
  const ShaderToken& number = in_.peek();
  if (number.kind != ShaderToken::Kind::number) {
    expected("the number of a register");
    return false;
  }
  out.index = 0;
  for (const char c : number.text) {
    if (!is_digit(c) || out.index > 1000) {
      expected("the number of a register");
      return false;
    }
    out.index = out.index * 10 + (c - '0');
  }
  in_.take();
  if (in_.take_if(']')) return true;
  expected("']'");
  return false;
}

// A register's name without its modifiers: r0, c, zero.
bool ShaderOperandReader::name_register(Register& out, const std::string& name) {
  constexpr std::string_view kLetters = "rtvc";
  constexpr std::array kFiles{ShaderFile::temporary, ShaderFile::texture, ShaderFile::color, ShaderFile::constant};
  const std::size_t letter = name.empty() ? std::string_view::npos : kLetters.find(name.front());
  const std::string digits = name.empty() ? "" : name.substr(1);
  const bool numbered = !digits.empty() && digits.size() < 4 && std::all_of(digits.begin(), digits.end(), is_digit);
  if (letter != std::string_view::npos && digits.empty() && in_.take_if('[')) {
    out.file = kFiles.at(letter);
    return read_index(out) && check_index(out);
  }
  if (letter != std::string_view::npos && numbered) {
    out.file = kFiles.at(letter);
    out.index = std::stoi(digits);
    return check_index(out);
  }
  const NamedRegister* const found = find_row(kNamed, &NamedRegister::name, name);
  if (found == nullptr) {
    faults_.add(out.offset, quoted(out.text) + " is not a register" + did_you_mean(name, register_names(version_)) +
                                may_be_included());
    return false;
  }
  if (!version_.is_xbox) {
    faults_.add(out.offset, version_.name + " has no register " + quoted(name) + "; only xps.1.1 has it");
    return false;
  }
  out.file = found->file;
  out.index = found->index;
  return true;
}

bool ShaderOperandReader::check_index(Register& out) {
  const int count = registers_of(out.file, version_);
  if (out.index < count) return true;
  const std::string letter(1, lower_case(out.text).front());
  faults_.add(out.offset, version_.name + " has only " + letter + "0 to " + letter + std::to_string(count - 1) +
                              ", found " + quoted(out.text));
  return false;
}

std::optional<ShaderOperandReader::Register> ShaderOperandReader::read_register() {
  const ShaderToken& word = in_.peek();
  if (word.kind != ShaderToken::Kind::word) {
    expected("a register");
    return std::nullopt;
  }
  Register out{.offset = word.offset, .text = word.text};
  in_.take();
  std::string name = lower_case(out.text);
  const std::size_t underscore = std::min(name.find('_'), name.size());
  out.modifiers = name.substr(underscore);
  // A longer word with an underscore is more likely a name that nobody defined.
  name.resize(underscore);
  if (!name_register(out, name)) return std::nullopt;
  // c[1]_bx2
  if (in_.peek().kind == ShaderToken::Kind::word && in_.peek().text.starts_with('_')) {
    out.modifiers += lower_case(in_.take().text);
  }
  return read_suffix(out) ? std::optional(out) : std::nullopt;
}

bool ShaderOperandReader::read_suffix(Register& out) {
  if (!in_.take_if('.')) return true;
  const ShaderToken& word = in_.peek();
  if (word.kind != ShaderToken::Kind::word) {
    expected("components such as rgb or a after '.'");
    return false;
  }
  in_.take();
  out.suffix = lower_case(word.text);
  // r0.a_bx2 is r0_bx2.a
  const std::size_t underscore = out.suffix.find('_');
  if (underscore != std::string::npos) {
    out.modifiers += out.suffix.substr(underscore);
    out.suffix.resize(underscore);
  }
  return true;
}

std::optional<ShaderTarget> ShaderOperandReader::target() {
  const auto from = read_register();
  if (!from) return std::nullopt;
  ShaderTarget out{.offset = from->offset, .text = from->text, .file = from->file, .index = from->index};
  const bool writable = out.file == ShaderFile::temporary || out.file == ShaderFile::texture ||
                        (version_.is_xbox && (out.file == ShaderFile::color || out.file == ShaderFile::discard));
  if (!writable) {
    faults_.add(from->offset,
                version_.name + " does not write " + quoted(from->text) +
                    (version_.is_xbox ? "; it writes r, t and v registers" : "; it writes r and t registers"));
    return std::nullopt;
  }
  if (!from->modifiers.empty()) {
    faults_.add(from->offset, "a register that is written has no modifier, found " + quoted(from->modifiers) +
                                  "; modifiers of the result follow the instruction's name, as in add_sat");
    return std::nullopt;
  }
  const std::string& mask = from->suffix;
  out.rgb = mask.empty() || mask == "rgba" || mask == "xyzw" || mask == "rgb" || mask == "xyz";
  out.alpha = mask.empty() || mask == "rgba" || mask == "xyzw" || mask == "a" || mask == "w";
  if (!out.rgb && !out.alpha) {
    faults_.add(from->offset, quoted("." + mask) +
                                  ": combiners write red, green and blue together; expected .rgb, .a "
                                  "or nothing");
    return std::nullopt;
  }
  return out;
}

std::optional<ShaderOperand> ShaderOperandReader::operand() {
  ShaderOperand out;
  const std::size_t begin = in_.peek().offset;
  if (in_.peek().kind == ShaderToken::Kind::number && in_.peek().text == "1") {
    in_.take();
    if (!in_.take_if('-')) {
      expected("'-' after 1, as in 1-r0");
      return std::nullopt;
    }
    out.invert = true;
  } else {
    out.negate = in_.take_if('-');
    if (version_.is_xbox && in_.peek().kind == ShaderToken::Kind::number) return printed_number(out);
  }
  const auto from = read_register();
  if (!from) return std::nullopt;
  out.offset = from->offset;
  out.text = from->text;
  out.file = from->file;
  out.index = from->index;
  if (out.file == ShaderFile::discard) {
    faults_.add(out.offset, "'discard' cannot be read");
    return std::nullopt;
  }
  if (!apply_modifiers(out, *from) || !apply_selector(out, *from)) return std::nullopt;
  if (out.invert && out.modifier != ShaderModifier::none && out.modifier != ShaderModifier::saturate) {
    faults_.add(begin, "1-x takes no other modifier; found " + quoted(from->modifiers));
    return std::nullopt;
  }
  return out;
}

std::optional<ShaderOperand> ShaderOperandReader::coordinates() {
  const auto from = read_register();
  if (!from) return std::nullopt;
  ShaderOperand out{.offset = from->offset, .text = from->text, .file = from->file, .index = from->index};
  if (!from->modifiers.empty()) {
    out.modifier = from->modifiers == "_bx2" ? ShaderModifier::expand : ShaderModifier::other;
  }
  return out;
}

std::optional<ShaderOperand> ShaderOperandReader::printed_number(ShaderOperand out) {
  const ShaderToken& token = in_.peek();
  const std::string_view digits = token.text.substr(0, token.text.find_last_not_of("0f") + 1);
  if (digits != "0." && digits != "." && digits != "1." && digits != "0.5") {
    expected("a register, or one of the numbers 0.0, 0.5 and 1.0");
    return std::nullopt;
  }
  in_.take();
  out.offset = token.offset;
  out.text = token.text;
  if (digits == "1.") out.file = ShaderFile::one;
  if (digits != "0.5") return out;
  out.modifier = ShaderModifier::bias;  // of 0, that is -0.5
  out.negate = !out.negate;
  return out;
}

bool ShaderOperandReader::apply_modifiers(ShaderOperand& out, const Register& from) {
  for (std::size_t at = 0; at < from.modifiers.size();) {
    const std::size_t end = std::min(from.modifiers.find('_', at + 1), from.modifiers.size());
    const std::string name = from.modifiers.substr(at + 1, end - at - 1);
    at = end;
    const NamedModifier* const found = find_row(kModifiers, &NamedModifier::name, name);
    if (found == nullptr) {
      faults_.add(from.offset, quoted("_" + name) + " is not a modifier of a register; expected _bias, _bx2" +
                                   (version_.minor == 4 ? " or _x2"
                                    : version_.is_xbox  ? " or _sat"
                                                        : "") +
                                   may_be_included());
      return false;
    }
    const bool xbox = found->modifier == ShaderModifier::saturate || name == "b";
    const bool last = found->modifier == ShaderModifier::by_two;
    if ((xbox && !version_.is_xbox) || (last && version_.minor != 4 && !version_.is_xbox)) {
      faults_.add(from.offset, version_.name + " has no modifier _" + name + " of a register; only " +
                                   (xbox ? "xps.1.1" : "ps.1.4") + " has it");
      return false;
    }
    if (out.modifier != ShaderModifier::none) {
      faults_.add(from.offset, "a register takes one modifier, found " + quoted(from.modifiers));
      return false;
    }
    out.modifier = found->modifier;
  }
  return true;
}

bool ShaderOperandReader::apply_selector(ShaderOperand& out, const Register& from) {
  if (from.suffix.empty()) return true;
  const NamedSelector* const found = find_row(kSelectors, &NamedSelector::name, from.suffix);
  const bool replicated = from.suffix.size() > 1 && found == nullptr &&
                          from.suffix.find_first_not_of(from.suffix.front()) == std::string::npos;
  const NamedSelector* const one =
      replicated ? find_row(kSelectors, &NamedSelector::name, from.suffix.substr(0, 1)) : found;
  if (one == nullptr) {
    faults_.add(from.offset,
                quoted("." + from.suffix) + " are not components that a combiner reads; expected .rgb, .a or .b");
    return false;
  }
  out.selector = one->selector;
  return true;
}

}  // namespace ninebit::detail
