// Assembled pixel shaders: the tokens of 32 bits that Direct3D 8 runs. Their layout: Microsoft, "Direct3D Shader Codes"
// of the Windows driver kit; the encoding is that of d3d8types.h.
#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "ninebit/language/pixel_shader.h"
#include "src/language/c_like/c_lexer.h"
#include "src/language/pixel_shader/shader_macros.h"
#include "src/language/pixel_shader/shader_operands.h"
#include "src/language/pixel_shader/shader_parser.h"
#include "src/language/source/source_faults.h"
#include "src/system/find_row.h"
#include "src/system/lines.h"

namespace ninebit::detail {
namespace {

// The tokens as a text has them: bytes of a file, numbers, or a C array.

constexpr std::uint32_t kPixelShader = 0xffff, kVertexShader = 0xfffe;  // the upper half of a version

struct PlacedToken {
  std::uint32_t value = 0;
  std::size_t offset = 0;  // in the text
};

// hex_list: all of eight hexadecimal digits, without 0x but where it is written.
enum class TokenForm : std::uint8_t { bytes_of_file, array, list, hex_list };

// The tokens that a text begins with.
struct TokenList {
  TokenForm form = TokenForm::list;
  std::vector<PlacedToken> tokens{};  // empty: the first is not a version
  std::size_t end = 0;                // in the text, behind them
};

constexpr std::size_t kHexDigits = 8;  // of a token without 0x

bool is_version(std::uint32_t token) {
  const std::uint32_t kind = token >> 16, major = token >> 8 & 0xff, minor = token & 0xff;
  return (kind == kPixelShader || kind == kVertexShader) && major >= 1 && major <= 3 && minor <= 4;
}

// Moves to the next token of C, behind comments from # on, too, but not behind a directive. False: the text ends.
bool next_at(std::string_view text, std::size_t& at) {
  SourceFaults none({text, {}});
  while (skip_blanks(text, at, {.hash_comments = false, .heading = {}}, none) && at < text.size()) {
    if (text[at] != '#' || code::begins_directive(text, at)) return true;
    at = std::min(text.find('\n', at), text.size());
  }
  return false;
}

// Moves behind the brace of "static const DWORD ps[] = {".
bool skip_array_head(std::string_view text, std::size_t& at) {
  constexpr std::string_view kMarks = "[]=:*()";
  bool has_brackets = false;
  while (next_at(text, at)) {
    const char c = text[at];
    if (c == '{') {
      ++at;
      return has_brackets;
    }
    if (!is_word(c) && kMarks.find(c) == std::string_view::npos) return false;
    has_brackets = has_brackets || c == '[';
    do {
      ++at;
    } while (at < text.size() && is_word(c) && is_word(text[at]));
  }
  return false;
}

// Takes a number and the comma behind it.
std::optional<PlacedToken> take_number(std::string_view text, std::size_t& at, TokenForm form) {
  if (!next_at(text, at)) return std::nullopt;
  PlacedToken out{.offset = at};
  std::size_t end = at;
  while (end < text.size() && is_word(text[end])) ++end;
  std::string_view digits = text.substr(at, end - at);
  const bool prefixed = digits.starts_with("0x") || digits.starts_with("0X");
  const bool hex = prefixed || form == TokenForm::hex_list;
  if (hex && !prefixed && digits.size() != kHexDigits) return std::nullopt;
  if (prefixed) digits.remove_prefix(2);
  while ((prefixed || !hex) && !digits.empty() &&
         std::string_view("uUlL").find(digits.back()) != std::string_view::npos) {
    digits.remove_suffix(1);
  }
  const int base = hex ? 16 : digits.size() > 1 && digits[0] == '0' ? 8 : 10;
  const auto [last, error] = std::from_chars(digits.data(), digits.data() + digits.size(), out.value, base);
  if (digits.empty() || error != std::errc() || last != digits.data() + digits.size()) return std::nullopt;
  at = end;
  if (next_at(text, at) && text[at] == ',') ++at;
  return out;
}

// The form of numbers without braces by the first of them.
TokenForm form_of_list(std::string_view text, std::size_t at) {
  if (!next_at(text, at)) return TokenForm::list;
  std::size_t end = at;
  while (end < text.size() && is_word(text[end])) ++end;
  const std::string_view first = text.substr(at, end - at);
  const bool prefixed = first.starts_with("0x") || first.starts_with("0X");
  return !prefixed && first.size() == kHexDigits ? TokenForm::hex_list : TokenForm::list;
}

// Every four bytes as a word in little endian.
std::vector<PlacedToken> words_of_bytes(const std::vector<PlacedToken>& bytes, SourceFaults& faults) {
  std::vector<PlacedToken> words;
  for (std::size_t i = 0; i < bytes.size(); ++i) {
    if (bytes[i].value > 0xff) faults.add(bytes[i].offset, "the value does not fit in 8 bits");
    if (i % 4 == 0) words.push_back({.offset = bytes[i].offset});
    words.back().value |= (bytes[i].value & 0xff) << (8 * (i % 4));
  }
  if (bytes.size() % 4 == 0) return words;
  faults.add(words.back().offset, "the last token has " + std::to_string(bytes.size() % 4) + " of 4 bytes");
  words.pop_back();
  return words;
}

std::vector<PlacedToken> bytes_of_file(std::string_view text) {
  std::vector<PlacedToken> bytes;
  for (std::size_t i = 0; i < text.size(); ++i) bytes.push_back({static_cast<unsigned char>(text[i]), i});
  return bytes;
}

// Behind a byte order mark and the text that the compiler writes before an array, between #if 0 and #endif.
std::size_t begin_of_tokens(std::string_view text) {
  std::size_t at = mark_size(text);
  SourceFaults none({text, {}});
  const bool skips = skip_blanks(text, at, {}, none) && text.substr(at).starts_with("#if 0");
  const std::size_t end = skips ? text.find("\n#endif", at) : std::string_view::npos;
  return end == std::string_view::npos ? at : std::min(text.find('\n', end + 1), text.size());
}

// Reads at most `most` tokens. Reports what is wrong with bytes.
TokenList tokens_in(std::string_view text, std::size_t most, SourceFaults& faults) {
  SourceFaults none({text, {}});
  const std::vector<PlacedToken> first = words_of_bytes(bytes_of_file(text.substr(0, 4)), none);
  if (!first.empty() && is_version(first[0].value)) {
    return {TokenForm::bytes_of_file, words_of_bytes(bytes_of_file(text.substr(0, 4 * most)), faults), text.size()};
  }
  TokenList list{.end = begin_of_tokens(text)};
  std::size_t& at = list.end;
  const std::size_t begin = at;
  const bool is_array = skip_array_head(text, at);
  if (!is_array) at = begin;
  list.form = is_array ? TokenForm::array : form_of_list(text, at);
  std::vector<PlacedToken>& numbers = list.tokens;
  bool are_bytes = false;
  while (numbers.size() < (are_bytes ? 4 * most : most)) {
    const auto number = take_number(text, at, list.form);
    if (!number) break;
    numbers.push_back(*number);
    if (numbers.size() > 1) continue;
    are_bytes = is_array && number->value <= 0xff;
    if (!are_bytes && !is_version(number->value)) return {};
  }
  if (are_bytes) {
    const bool is_shader =
        numbers.size() >= 4 && is_version(words_of_bytes({numbers.begin(), numbers.begin() + 4}, none)[0].value);
    numbers = is_shader ? words_of_bytes(numbers, faults) : std::vector<PlacedToken>{};
  }
  return list;
}

// Whether a list was read up to its end, behind which `rest` goes on then; reports what else stands there.
bool is_list_closed(code::TokenReader& rest, TokenForm form, SourceFaults& faults) {
  const bool is_array = form == TokenForm::array;
  if (form == TokenForm::bytes_of_file || (is_array && rest.takes("}"))) return true;
  if (!is_array && (rest.at_end() || rest.peek().is(";"))) return true;
  faults.add(rest.peek().offset, std::string("expected a number of 32 bits or ") +
                                     (is_array ? "'}'" : "the end of the text") + "; found " + shown(rest.peek()));
  return false;
}

constexpr std::uint32_t kComment = 0xfffe, kEnd = 0xffff;
constexpr std::uint32_t kParameter = 0x8000'0000, kPaired = 0x4000'0000;

struct Opcode {
  std::uint32_t code;
  std::string_view name, name14{};  // in ps.1.4, if it differs
};
constexpr std::array kOpcodes{Opcode{0x00, "nop"},          Opcode{0x01, "mov"},
                              Opcode{0x02, "add"},          Opcode{0x03, "sub"},
                              Opcode{0x04, "mad"},          Opcode{0x05, "mul"},
                              Opcode{0x08, "dp3"},          Opcode{0x09, "dp4"},
                              Opcode{0x12, "lrp"},          Opcode{0x40, "texcoord", "texcrd"},
                              Opcode{0x41, "texkill"},      Opcode{0x42, "tex", "texld"},
                              Opcode{0x43, "texbem"},       Opcode{0x44, "texbeml"},
                              Opcode{0x45, "texreg2ar"},    Opcode{0x46, "texreg2gb"},
                              Opcode{0x47, "texm3x2pad"},   Opcode{0x48, "texm3x2tex"},
                              Opcode{0x49, "texm3x3pad"},   Opcode{0x4a, "texm3x3tex"},
                              Opcode{0x4c, "texm3x3spec"},  Opcode{0x4d, "texm3x3vspec"},
                              Opcode{0x50, "cnd"},          Opcode{0x51, "def"},
                              Opcode{0x52, "texreg2rgb"},   Opcode{0x53, "texdp3tex"},
                              Opcode{0x54, "texm3x2depth"}, Opcode{0x55, "texdp3"},
                              Opcode{0x56, "texm3x3"},      Opcode{0x57, "texdepth"},
                              Opcode{0x58, "cmp"},          Opcode{0x59, "bem"},
                              Opcode{0xfffd, "phase"}};

constexpr std::array kFiles{ShaderFile::temporary, ShaderFile::color, ShaderFile::constant, ShaderFile::texture};

// The modifiers of sources, in the order of their codes.
struct SourceModifier {
  ShaderModifier modifier;
  bool negate, invert;
};
constexpr std::array kSourceModifiers{
    SourceModifier{ShaderModifier::none, false, false},   SourceModifier{ShaderModifier::none, true, false},
    SourceModifier{ShaderModifier::bias, false, false},   SourceModifier{ShaderModifier::bias, true, false},
    SourceModifier{ShaderModifier::expand, false, false}, SourceModifier{ShaderModifier::expand, true, false},
    SourceModifier{ShaderModifier::none, false, true},    SourceModifier{ShaderModifier::by_two, false, false},
    SourceModifier{ShaderModifier::by_two, true, false}};

struct Swizzle {
  std::uint32_t code;
  ShaderSelector selector;
};
constexpr std::array kSwizzles{Swizzle{0xe4, ShaderSelector::none}, Swizzle{0xff, ShaderSelector::alpha},
                               Swizzle{0xaa, ShaderSelector::blue}, Swizzle{0x00, ShaderSelector::red},
                               Swizzle{0x55, ShaderSelector::green}};

// The shift of a result by its code of four bits; empty: combiners do not have it.
constexpr std::uint32_t kByTwo = 1, kByFour = 2, kByOneHalf = 15;

std::string_view register_name(ShaderFile file, int index) {
  constexpr std::string_view kTokenRegisters =
      "r0r1r2r3r4r5r6r7r8r9v0v1v2v3v4v5v6v7v8v9c0c1c2c3c4c5c6c7c8c9t0t1t2t3t4t5t6t7t8t9";
  const auto row = static_cast<std::size_t>(std::find(kFiles.begin(), kFiles.end(), file) - kFiles.begin());
  return kTokenRegisters.substr(20 * row + 2 * static_cast<std::size_t>(index), 2);
}

class TokenReader {
 public:
  TokenReader(const std::vector<PlacedToken>& tokens, SourceFaults& faults) : tokens_(tokens), faults_(faults) {}

  ShaderText read() {
    const std::uint32_t version = tokens_[0].value, minor = version & 0xff;
    const std::string number = std::to_string(version >> 8 & 0xff) + "." + std::to_string(minor);
    if (version >> 16 != kPixelShader || (version >> 8 & 0xff) != 1) {
      const char* const kind = version >> 16 == kPixelShader ? "pixel shader (ps." : "vertex shader (vs.";
      faults_.add(tokens_[0].offset, std::string("these are the tokens of an assembled ") + kind + number +
                                         "), which register combiners cannot run");
      return {};
    }
    out_.version = {.minor = static_cast<int>(minor), .name = "ps." + number};
    for (at_ = 1; at_ < tokens_.size(); ++at_) {
      const PlacedToken& token = tokens_[at_];
      const std::uint32_t code = token.value & 0xffff;
      if (code == kEnd) {
        if (at_ + 1 < tokens_.size()) fault(tokens_[at_ + 1], "stands behind the end of the shader");
        return std::move(out_);
      }
      if (code == kComment) {
        at_ += token.value >> 16 & 0x7fff;
      } else if (!instruction(token, code)) {
        return {};
      }
    }
    faults_.add(tokens_.back().offset, "the tokens have no end; expected 0x0000ffff");
    return {};
  }

 private:
  bool fault(const PlacedToken& token, const std::string& what) {
    std::array<char, 8> digits{};
    const auto end = std::to_chars(digits.data(), digits.data() + digits.size(), token.value, 16);
    const std::string hex(digits.data(), end.ptr);
    faults_.add(token.offset, "the token 0x" + std::string(8 - hex.size(), '0') + hex + " " + what);
    return false;
  }

  bool instruction(const PlacedToken& token, std::uint32_t code) {
    const Opcode* const found = find_row(kOpcodes, &Opcode::code, code);
    if (found == nullptr || (token.value & kParameter) != 0) {
      return fault(token, "is not an instruction of " + out_.version.name);
    }
    const bool last = out_.version.minor == 4;
    ShaderInstruction one{.offset = token.offset, .paired = (token.value & kPaired) != 0};
    one.row = shader_op_named(last && !found->name14.empty() ? found->name14 : found->name);
    one.text = one.row->name;
    const ShaderOpRow& row = *one.row;
    if (out_.version.minor < row.first_minor || out_.version.minor > row.last_minor) {
      return fault(token, "is '" + std::string(row.name) + "', which " + out_.version.name + " does not have");
    }
    if (row.op == ShaderOp::def) return definition(token);
    std::vector<PlacedToken> parameters;
    while (at_ + 1 < tokens_.size() && (tokens_[at_ + 1].value & kParameter) != 0) {
      parameters.push_back(tokens_[++at_]);
    }
    const auto targets = static_cast<std::size_t>(row.targets), operands = static_cast<std::size_t>(row.operands);
    const std::size_t least = row.op == ShaderOp::texture ? targets : targets + operands;
    if (parameters.size() < least || parameters.size() > targets + operands) {
      return fault(token, "is '" + std::string(row.name) + "', which has " + std::to_string(targets + operands) +
                              " parameters; found " + std::to_string(parameters.size()));
    }
    for (std::size_t i = 0; i < parameters.size(); ++i) {
      if (!(i < targets ? target(parameters[i], one) : operand(parameters[i], one))) return false;
    }
    if (row.op != ShaderOp::nop) out_.instructions.push_back(std::move(one));
    return true;
  }

  // The register of a parameter; -1: the version has none.
  int register_of(const PlacedToken& token, ShaderFile& file) {
    const std::uint32_t type = token.value >> 28 & 7, index = token.value & 0x7ff;
    if (type < kFiles.size()) {
      file = kFiles[type];
      if (index < static_cast<std::uint32_t>(registers_of(file, out_.version))) return static_cast<int>(index);
    }
    fault(token, "names a register that " + out_.version.name + " does not have");
    return -1;
  }

  bool target(const PlacedToken& token, ShaderInstruction& one) {
    ShaderTarget out{.offset = token.offset};
    out.index = register_of(token, out.file);
    if (out.index < 0) return false;
    out.text = register_name(out.file, out.index);
    const std::uint32_t mask = token.value >> 16 & 15, shift = token.value >> 24 & 15, flags = token.value >> 20 & 15;
    const bool fetches = one.op() == ShaderOp::texture;
    out.rgb = fetches || mask == 7 || mask == 15;
    out.alpha = fetches || mask == 8 || mask == 15;
    const bool writable = out.file == ShaderFile::temporary || out.file == ShaderFile::texture;
    if (!writable) return fault(token, "writes " + std::string(out.text) + "; expected an r or t register");
    if (!out.rgb && !out.alpha) return fault(token, "writes single components; combiners write .rgb, .a or both");
    if (flags > 1) return fault(token, "has an unknown modifier of the result");
    if (shift != 0 && shift != kByTwo && shift != kByFour && shift != kByOneHalf) {
      return fault(token, "scales the result by a factor that combiners do not have; they have _x2, _x4 and _d2");
    }
    one.saturate = flags == 1;
    one.scale = shift == kByTwo       ? Scale::by_two
                : shift == kByFour    ? Scale::by_four
                : shift == kByOneHalf ? Scale::by_one_half
                                      : Scale::none;
    one.targets.push_back(out);
    return true;
  }

  bool operand(const PlacedToken& token, ShaderInstruction& one) {
    ShaderOperand out{.offset = token.offset};
    out.index = register_of(token, out.file);
    if (out.index < 0) return false;
    out.text = register_name(out.file, out.index);
    const std::uint32_t swizzle = token.value >> 16 & 0xff, modifier = token.value >> 24 & 15;
    constexpr std::uint32_t kExpand = 4;
    if (one.op() == ShaderOp::texture) {  // its operands are not the combiners'
      if (modifier != 0) out.modifier = modifier == kExpand ? ShaderModifier::expand : ShaderModifier::other;
    } else {
      const Swizzle* const found = find_row(kSwizzles, &Swizzle::code, swizzle);
      if (found == nullptr) return fault(token, "reads components in an order that combiners do not have");
      if (modifier >= kSourceModifiers.size()) return fault(token, "has an unknown modifier of a source");
      const SourceModifier& as = kSourceModifiers[modifier];
      if (as.modifier == ShaderModifier::by_two && out_.version.minor != 4) {
        return fault(token, "has the modifier _x2 of a source, which " + out_.version.name + " does not have");
      }
      out.selector = found->selector;
      out.modifier = as.modifier;
      out.negate = as.negate;
      out.invert = as.invert;
    }
    one.operands.push_back(out);
    return true;
  }

  bool definition(const PlacedToken& token) {
    constexpr std::size_t kParameters = 5;
    if (at_ + kParameters >= tokens_.size()) return fault(token, "is 'def', which needs a constant and four numbers");
    ShaderFile file = ShaderFile::zero;
    const PlacedToken& to = tokens_[at_ + 1];
    const int index = register_of(to, file);
    if (index < 0) return false;
    if (file != ShaderFile::constant) return fault(to, "is not a constant");
    ShaderConstant& out = out_.constants.at(static_cast<std::size_t>(index));
    if (out.defined) return fault(to, "defines c" + std::to_string(index) + " a second time");
    out = {.defined = true, .offset = to.offset};
    for (std::size_t i = 0; i < 4; ++i) {
      const PlacedToken& number = tokens_[at_ + 2 + i];
      const auto value = std::bit_cast<float>(number.value);
      if (!(value >= -1e9F && value <= 1e9F)) return fault(number, "is not a number from -1e9 to 1e9");
      out.color[i] = value;
    }
    at_ += kParameters;
    return true;
  }

  const std::vector<PlacedToken>& tokens_;
  SourceFaults& faults_;
  std::size_t at_ = 0;
  ShaderText out_;
};

std::uint32_t register_bits(ShaderFile file, int index) {
  const auto type = static_cast<std::uint32_t>(std::find(kFiles.begin(), kFiles.end(), file) - kFiles.begin());
  return kParameter | type << 28 | static_cast<std::uint32_t>(index);
}

// The tokens of an instruction of a printed ps.1.1 text.
std::vector<std::uint32_t> assembled(const ShaderInstruction& one) {
  const Opcode* const opcode = find_row(kOpcodes, &Opcode::name, one.row->name);
  std::vector<std::uint32_t> out{opcode->code | (one.paired ? kPaired : 0)};
  constexpr std::array<std::uint32_t, 4> kShifts{0, kByTwo, kByFour, kByOneHalf};
  for (const ShaderTarget& to : one.targets) {
    out.push_back(register_bits(to.file, to.index) | kShifts.at(static_cast<std::size_t>(one.scale)) << 24 |
                  (one.saturate ? 1U << 20 : 0) | (to.rgb ? 7U << 16 : 0) | (to.alpha ? 8U << 16 : 0));
  }
  for (const ShaderOperand& from : one.operands) {
    const auto* const modifier =
        std::find_if(kSourceModifiers.begin(), kSourceModifiers.end(), [&](const SourceModifier& m) {
          return m.modifier == from.modifier && m.negate == from.negate && m.invert == from.invert;
        });
    const Swizzle* const swizzle = find_row(kSwizzles, &Swizzle::selector, from.selector);
    out.push_back(register_bits(from.file, from.index) | swizzle->code << 16 |
                  static_cast<std::uint32_t>(modifier - kSourceModifiers.begin()) << 24);
  }
  return out;
}

void add_line(std::string& text, const std::vector<std::uint32_t>& tokens) {
  constexpr std::string_view kHex = "0123456789abcdef";
  text += ' ';
  for (const std::uint32_t token : tokens) {
    text += " 0x";
    for (int low = 28; low >= 0; low -= 4) text += kHex[token >> low & 15];
    text += ',';
  }
  text += '\n';
}

}  // namespace
}  // namespace ninebit::detail

namespace ninebit {

bool is_shader_tokens(std::string_view text) {
  constexpr std::size_t kLookedAt = std::size_t{1} << 16;
  detail::SourceFaults none({text, {}});
  return !detail::tokens_in(text.substr(0, kLookedAt), 1, none).tokens.empty();
}

Parsed<CombinerState> parse_shader_tokens(const SourceText& source, const HardwareProfile& profile,
                                          TextureShaderState* texture_shader) {
  constexpr std::size_t kMostTokens = std::size_t{1} << 16;
  detail::SourceFaults faults(source), notes(source);
  if (detail::too_long(source, faults)) return faults.take();
  const detail::TokenList list = detail::tokens_in(source.text, kMostTokens + 1, faults);
  if (list.tokens.empty()) {
    faults.add(0, "expected the tokens of an assembled pixel shader, which begin with 0xffff0101");
  } else if (list.tokens.size() > kMostTokens) {
    faults.add(list.tokens.back().offset, "expected at most " + std::to_string(kMostTokens) + " tokens");
  }
  code::TokenReader rest(source.text);
  rest.move_to(list.end);
  if (!faults.empty() || !detail::is_list_closed(rest, list.form, faults)) return faults.take();
  const detail::ShaderText text = detail::TokenReader(list.tokens, faults).read();
  if (const auto other = faults.empty() ? rest.skip_behind_array() : std::nullopt) {
    faults.add(other->offset, "more text stands behind the tokens; expected one shader and nothing else");
  }
  if (const auto comment = rest.unterminated()) faults.add(*comment, "unterminated comment; expected */");
  if (!faults.empty()) return faults.take();
  return detail::program_of_shader(text, profile, faults, notes, texture_shader);
}

Result<std::string> print_shader_tokens(const CombinerState& state, const HardwareProfile& profile,
                                        const TextureShaderState& texture_shader) {
  const auto assembly = print_pixel_shader(state, profile, texture_shader);
  if (!assembly) return assembly.error();
  detail::SourceFaults none({*assembly, {}});
  const auto tokens = detail::preprocess_shader(*assembly, {}, {}, none, none);
  const detail::ShaderText shader = detail::parse_shader(tokens, none);
  std::string text = "static const DWORD shader[] = {\n";
  detail::add_line(text, {0xffff'0101});
  for (std::size_t i = 0; i < shader.constants.size(); ++i) {
    const detail::ShaderConstant& one = shader.constants[i];
    if (!one.defined) continue;
    constexpr std::uint32_t kDef = 0x51, kAll = 0x000f'0000;
    std::vector<std::uint32_t> line{kDef,
                                    detail::register_bits(detail::ShaderFile::constant, static_cast<int>(i)) | kAll};
    for (const float component : one.color) line.push_back(std::bit_cast<std::uint32_t>(component));
    detail::add_line(text, line);
  }
  for (const detail::ShaderInstruction& one : shader.instructions) detail::add_line(text, detail::assembled(one));
  detail::add_line(text, {detail::kEnd});
  return text + "};\n";
}

}  // namespace ninebit
