#include "src/language/rc10/rc10_parser.h"

#include <algorithm>
#include <array>

namespace ninebit::detail {
namespace {

struct Name {
  std::string_view name;
  Register reg;
};
constexpr std::array kNames{Name{"fog", Register::fog},
                            Name{"col0", Register::primary},
                            Name{"col1", Register::secondary},
                            Name{"spare0", Register::spare0},
                            Name{"spare1", Register::spare1},
                            Name{"tex0", Register::texture0},
                            Name{"tex1", Register::texture1},
                            Name{"tex2", Register::texture2},
                            Name{"tex3", Register::texture3},
                            Name{"const0", Register::constant0},
                            Name{"const1", Register::constant1},
                            Name{"zero", Register::zero},
                            Name{"one", Register::zero},
                            Name{"discard", Register::discard},
                            Name{"color_sum", Register::spare0_plus_secondary},
                            Name{"final_product", Register::e_times_f}};

}  // namespace

std::optional<Rc10Register> rc10_register(const Rc10Token& token) {
  if (token.kind != Rc10Token::Kind::word) return std::nullopt;
  Rc10Register out{.offset = token.offset, .text = token.text};
  const std::size_t dot = std::min(token.text.find('.'), token.text.size());
  const std::string_view name = token.text.substr(0, dot), suffix = token.text.substr(dot);
  const auto* const found = std::find_if(kNames.begin(), kNames.end(), [&](const Name& n) { return n.name == name; });
  if (found == kNames.end()) return std::nullopt;
  out.reg = found->reg;
  out.is_one = name == "one";
  if (suffix == ".rgb") {
    out.suffix = Rc10Suffix::rgb;
  } else if (suffix == ".a") {
    out.suffix = Rc10Suffix::alpha;
  } else if (suffix == ".b") {
    out.suffix = Rc10Suffix::blue;
  } else if (!suffix.empty()) {
    return std::nullopt;
  }
  return out;
}

InputMapping map_one(InputMapping mapping) {
  switch (mapping) {
    case InputMapping::unsigned_identity:
    case InputMapping::expand_normal:
    case InputMapping::signed_identity:
      return InputMapping::unsigned_invert;
    case InputMapping::unsigned_invert:
      return InputMapping::unsigned_identity;
    case InputMapping::expand_negate:
    case InputMapping::signed_negate:
      return InputMapping::expand_normal;
    case InputMapping::half_bias_normal:
      return InputMapping::half_bias_negate;
    case InputMapping::half_bias_negate:
      return InputMapping::half_bias_normal;
  }
  return mapping;
}

ComponentUsage usage_of(Rc10Suffix suffix, ComponentUsage plain) {
  switch (suffix) {
    case Rc10Suffix::none:
      return plain;
    case Rc10Suffix::rgb:
      return ComponentUsage::rgb;
    case Rc10Suffix::alpha:
      return ComponentUsage::alpha;
    case Rc10Suffix::blue:
      return ComponentUsage::blue;
  }
  return plain;
}

bool Rc10Reader::expect(char c) {
  if (!lexer.peek().is(c)) return expected(quoted({&c, 1}));
  lexer.take();
  return true;
}

bool Rc10Reader::expect(std::initializer_list<char> all) {
  return std::all_of(all.begin(), all.end(), [&](char c) { return expect(c); });
}

bool Rc10Reader::expected(const std::string& what) {
  const Rc10Token& token = lexer.peek();
  if (token.kind != Rc10Token::Kind::end) {
    faults.add(token.offset, "expected " + what + ", found " + quoted(token.text));
  } else if (!lexer.cut_short()) {
    faults.add(token.offset, "expected " + what + ", but the text ends");
  }
  return false;
}

bool Rc10Reader::end_of_statement() {
  if (expect(';')) return true;
  return lexer.peek().kind == Rc10Token::Kind::word || lexer.peek().is('}');
}

void Rc10Reader::check_exists(const Rc10Register& reg) {
  if (!is_texture(reg.reg) || texture_unit_of(reg.reg) < profile.texture_units) return;
  faults.add(reg.offset,
             quoted(reg.text) + " is beyond the " + std::to_string(profile.texture_units.value) +
                 " texture units of profile " + std::string(profile.name),
             GlError::invalid_enum);
}

void Rc10Reader::skip_statement() {
  while (lexer.peek().kind != Rc10Token::Kind::end && !lexer.peek().is('}')) {
    if (lexer.peek().is('{')) {
      skip_block();
    } else if (lexer.take().is(';')) {
      return;
    }
  }
}

void Rc10Reader::skip_block() {
  std::size_t depth = 0;
  do {
    const Rc10Token token = lexer.take();
    if (token.is('{')) ++depth;
    if (token.is('}')) --depth;
  } while (depth > 0 && lexer.peek().kind != Rc10Token::Kind::end);
}

}  // namespace ninebit::detail
