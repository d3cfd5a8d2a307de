#include "src/language/rc10/rc10_parser.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "src/system/nearest_name.h"

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

// The final combiner of !!RC1.0.

bool Rc10Final::begins(const Rc10Token& token) {
  return token.is("clamp_color_sum") || token.is("final_product") || token.is("out.rgb") || token.is("out.a");
}

bool Rc10Final::read_statement(Rc10Reader& in) {
  const Rc10Token name = in.lexer.take();
  const bool is_output = name.text.starts_with("out");
  bool& seen = name.is("clamp_color_sum") ? clamp_
               : name.is("final_product") ? product_
               : name.is("out.rgb")       ? rgb_
                                          : alpha_;
  if (seen) {
    in.faults.add(name.offset, quoted(name.text) + " appears twice");
  } else if (!is_output && (rgb_ || alpha_)) {
    in.faults.add(name.offset, quoted(name.text) + " must come before out.rgb and out.a");
  }
  seen = true;
  return (name.is("clamp_color_sum") ? in.expect({'(', ')'}) : read_assigned(in, name)) && in.end_of_statement();
}

bool Rc10Final::read_assigned(Rc10Reader& in, const Rc10Token& name) {
  if (!in.expect('=')) return false;
  if (name.is("out.rgb")) return read_rgb(in);
  if (name.is("out.a")) return read_operand(in, g_, Of::alpha);
  return read_operand(in, e_, Of::product) && in.expect('*') && read_operand(in, f_, Of::product);
}

bool Rc10Final::read_operand(Rc10Reader& in, Operand& out, Of of) {
  const Rc10Token token = in.lexer.peek();
  if (token.is('-') || token.is("expand") || token.is("half_bias")) {
    in.faults.add(token.offset,
                  "the final combiner has only the mappings unsigned and unsigned_invert, not " + quoted(token.text),
                  GlError::invalid_enum);
    return false;
  }
  const bool invert = token.is("unsigned_invert");
  if (!invert && !token.is("unsigned")) return read_register(in, out, of, InputMapping::unsigned_identity);
  in.lexer.take();
  return in.expect('(') &&
         read_register(in, out, of, invert ? InputMapping::unsigned_invert : InputMapping::unsigned_identity) &&
         in.expect(')');
}

bool Rc10Final::read_register(Rc10Reader& in, Operand& out, Of of, InputMapping mapping) {
  const auto reg = rc10_register(in.lexer.peek());
  if (!reg) return in.expected("a register to read");
  in.lexer.take();
  const bool computed = reg->reg == Register::spare0_plus_secondary || reg->reg == Register::e_times_f;
  const auto refuse = [&](const char* why, GlError error = GlError::invalid_operation) {
    in.faults.add(reg->offset, quoted(reg->text) + why, error);
  };
  if (reg->reg == Register::discard) {
    refuse(" cannot be read", GlError::invalid_enum);
  } else if (computed && of != Of::rgb) {
    refuse(of == Of::alpha ? " has no alpha, which out.a needs" : " is not a valid input of final_product");
  } else if (of == Of::alpha && reg->suffix == Rc10Suffix::rgb) {
    refuse(" cannot be used in out.a; expected .a or .b");
  } else if (of != Of::alpha && reg->suffix == Rc10Suffix::blue) {
    refuse(of == Of::rgb ? " cannot be used in out.rgb; expected .rgb or .a"
                         : " cannot be used in final_product; expected .rgb or .a");
  }
  in.check_exists(*reg);
  out.written = *reg;
  out.input = {reg->reg, reg->is_one ? map_one(mapping) : mapping,
               usage_of(reg->suffix, of == Of::alpha ? ComponentUsage::alpha : ComponentUsage::rgb)};
  return true;
}

// "lerp(a, b, c)": a * b + (1 - a) * c.
bool Rc10Final::read_lerp(Rc10Reader& in) {
  in.lexer.take();
  return in.expect('(') && read_operand(in, a_, Of::rgb) && in.expect(',') && read_operand(in, b_, Of::rgb) &&
         in.expect(',') && read_operand(in, c_, Of::rgb) && in.expect(')');
}

// x, x * y, x + y, x * y + z, or lerp(…), which may have a register added on either side.
bool Rc10Final::read_rgb(Rc10Reader& in) {
  const auto next = [&](char c) {
    if (!in.lexer.peek().is(c)) return false;
    in.lexer.take();
    return true;
  };
  a_ = b_ = c_ = d_ = {};
  if (in.lexer.peek().is("lerp")) return read_lerp(in) && (!next('+') || read_operand(in, d_, Of::rgb));
  Operand x;
  if (!read_operand(in, x, Of::rgb)) return false;
  if (next('*')) {
    a_ = x;
    return read_operand(in, b_, Of::rgb) && (!next('+') || read_operand(in, d_, Of::rgb));
  }
  if (!next('+')) {
    d_ = x;
    return true;
  }
  if (in.lexer.peek().is("lerp")) {
    d_ = x;
    return read_lerp(in);
  }
  a_ = x;
  b_.input = rc10_one(ComponentUsage::rgb);
  return read_operand(in, d_, Of::rgb);
}

// GL refuses the colour sum in variable A, so the factors of a product are swapped. (nvparse also swaps A and D if B is
// one, but that never happens: A and B are swapped first.)
void Rc10Final::move_color_sum(Rc10Reader& in) {
  if (a_.input.reg != Register::spare0_plus_secondary) return;
  const bool c_is_zero = c_.input.reg == Register::zero && c_.input.mapping == InputMapping::unsigned_identity;
  if (b_.input.reg != Register::spare0_plus_secondary && c_is_zero) {
    std::swap(a_, b_);
  } else {
    in.faults.add(a_.written.offset, "color_sum can be neither the weight of lerp nor both factors of a product",
                  GlError::invalid_operation);
  }
}

void Rc10Final::finish(Rc10Reader& in, CombinerState& state) {
  if (!rgb_ && !alpha_) in.expected("out.rgb or out.a");
  for (const Operand* const x : {&a_, &b_, &c_, &d_}) {
    if (x->input.reg == Register::e_times_f && !product_) {
      in.faults.add(x->written.offset, "final_product is used but not set");
    }
  }
  move_color_sum(in);
  state.color_sum_clamp = clamp_;
  state.final_combiner = {a_.input, b_.input, c_.input, d_.input, e_.input, f_.input, g_.input};
}

}  // namespace ninebit::detail
