#include "src/language/rc10/rc10_parser.h"

#include <algorithm>
#include <array>
#include <vector>

#include "src/language/source/nearest_name.h"

namespace ninebit::detail {
namespace {

// Everything that a statement may begin with or name, for suggestions.
constexpr std::array kKeywords{"rgb",
                               "alpha",
                               "expand",
                               "half_bias",
                               "unsigned",
                               "unsigned_invert",
                               "mux",
                               "sum",
                               "lerp",
                               "clamp_color_sum",
                               "out.rgb",
                               "out.a",
                               "bias_by_negative_one_half_scale_by_two",
                               "bias_by_negative_one_half",
                               "scale_by_one_half",
                               "scale_by_two",
                               "scale_by_four"};

// "; did you mean 'spare0'?" A suffix is kept: for 'spar0.a', 'spare0.a'.
std::string suggestion(std::string_view word) {
  std::vector<std::string> names(kKeywords.begin(), kKeywords.end());
  const std::size_t dot = std::min(word.find('.'), word.size());
  std::string_view suffix = word.substr(dot);
  if (suffix == ".alpha") suffix = ".a";
  if (suffix == ".blue") suffix = ".b";
  const bool has_suffix = suffix == ".rgb" || suffix == ".a" || suffix == ".b";
  for (const Rc10Name& name : kRc10Names) {
    if (name.reg == Register::spare0_plus_secondary || name.reg == Register::e_times_f || !has_suffix) {
      names.emplace_back(name.name);
    } else {
      names.push_back(std::string(name.name) + std::string(suffix));
    }
  }
  const std::string meant = std::string(word.substr(0, dot)) + std::string(suffix);
  if (meant != word && std::find(names.begin(), names.end(), meant) != names.end()) {
    return "; did you mean '" + meant + "'?";
  }
  return did_you_mean(word, names);
}

}  // namespace

std::optional<Rc10Register> rc10_register(const Rc10Token& token) {
  if (token.kind != Rc10Token::Kind::word) return std::nullopt;
  Rc10Register out{.offset = token.offset, .text = token.text};
  const std::size_t dot = std::min(token.text.find('.'), token.text.size());
  const std::string_view name = token.text.substr(0, dot), suffix = token.text.substr(dot);
  const std::optional<Register> reg = rc10_name(name);
  if (!reg) return std::nullopt;
  out.reg = *reg;
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
    const bool known =
        rc10_register(token) || std::find(kKeywords.begin(), kKeywords.end(), token.text) != kKeywords.end();
    const bool misspelled = token.kind == Rc10Token::Kind::word && !known;
    faults.add(token.offset, "expected " + what + ", found " + quoted(token.text) +
                                 (misspelled ? suggestion(token.text) : std::string()));
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
