// The general combiners and constants of !!RC1.0.
#include <algorithm>
#include <array>
#include <charconv>
#include <system_error>
#include <vector>

#include "src/language/gl_nv/gl_nv_access.h"
#include "src/language/rc10/rc10_parser.h"

namespace ninebit::detail {
namespace {

// Converts a number without exponent to a colour component as GL stores it. The absolute value of a number that a float
// cannot hold is above 1 or nearly 0.
float color_component(std::string_view number) {
  const bool negative = number.front() == '-';
  if (negative || number.front() == '+') number.remove_prefix(1);
  float value = 0;
  if (std::from_chars(number.data(), number.data() + number.size(), value).ec == std::errc::result_out_of_range) {
    value = number.substr(0, number.find('.')).find_first_not_of('0') == std::string_view::npos ? 0.0F : 1.0F;
  }
  return gl::detail::clamped_color(negative ? -value : value);
}

// The statements of a portion that were read so far.
struct Statements {
  int count = 0;  // products read
  bool has_dot = false, has_third = false, has_scale = false;
  std::vector<Rc10Register> written;  // without discard
};

class PortionReader {
 public:
  PortionReader(Rc10Reader& in, PortionName name) : in_(in), name_(name) {
    const ComponentUsage usage = plain_usage();
    portion_.a = portion_.b = portion_.c = portion_.d = rc10_zero(usage);
    portion_.out.sum = Register::discard;
  }

  // Called after the opening brace.
  Portion read() {
    if (in_.lexer.peek().is('}')) in_.expected("a statement");
    while (in_.lexer.peek().kind != Rc10Token::Kind::end && !in_.lexer.peek().is('}') && !in_.faults.full()) {
      if (!statement()) in_.skip_statement();
    }
    in_.expect('}');
    return portion_;
  }

 private:
  [[nodiscard]] ComponentUsage plain_usage() const {
    return name_ == PortionName::rgb ? ComponentUsage::rgb : ComponentUsage::alpha;
  }

  bool statement() {
    const Rc10Token token = in_.lexer.peek();
    if (statements_.has_scale) {
      in_.faults.add(token.offset, "scale and bias must be the last statement of a portion, and there can be only one");
      return false;
    }
    if (scale_and_bias(token)) {
      in_.lexer.take();
      statements_.has_scale = true;
      return in_.expect({'(', ')'}) && in_.end_of_statement();
    }
    const auto to = rc10_register(token);
    if (!to) return in_.expected("a register to write, or a scale");
    in_.lexer.take();
    check_destination(*to);
    if (!in_.expect('=')) return false;
    const bool third = in_.lexer.peek().is("sum") || in_.lexer.peek().is("mux");
    if (!(third ? read_third(*to) : read_product(*to))) return false;
    return in_.end_of_statement();
  }

  bool scale_and_bias(const Rc10Token& token) {
    PortionOutput& out = portion_.out;
    const auto set = [&](std::string_view name, Scale scale, Bias bias) {
      if (!token.is(name)) return false;
      out.scale = scale;
      out.bias = bias;
      return true;
    };
    return set("scale_by_two", Scale::by_two, Bias::none) || set("scale_by_four", Scale::by_four, Bias::none) ||
           set("scale_by_one_half", Scale::by_one_half, Bias::none) ||
           set("bias_by_negative_one_half", Scale::none, Bias::by_negative_one_half) ||
           set("bias_by_negative_one_half_scale_by_two", Scale::by_two, Bias::by_negative_one_half);
  }

  static bool is_final_only(Register reg) {
    return reg == Register::e_times_f || reg == Register::spare0_plus_secondary;
  }

  // Checks suffixes and fog's alpha, which have the same rules for reading and writing. GL receives the suffix only of
  // registers that are read, so only those raise a GL error.
  void check_register(const Rc10Register& reg, bool is_read) {
    const GlError error = is_read ? GlError::invalid_operation : GlError::no_error;
    in_.check_exists(reg);
    if (name_ == PortionName::rgb && reg.suffix == Rc10Suffix::blue) {
      in_.faults.add(reg.offset, quoted(reg.text) + " cannot be used in an rgb portion; expected .rgb or .a", error);
    }
    if (name_ == PortionName::alpha && reg.suffix == Rc10Suffix::rgb) {
      in_.faults.add(reg.offset, quoted(reg.text) + " cannot be used in an alpha portion; expected .a or .b", error);
    }
    if (reg.reg == Register::fog && usage_of(reg.suffix, plain_usage()) == ComponentUsage::alpha) {
      in_.faults.add(reg.offset, "fog's alpha can be read by the final combiner alone", error);
    }
  }

  void check_destination(const Rc10Register& to) {
    const bool writable = to.reg == Register::discard || to.reg == Register::primary || to.reg == Register::secondary ||
                          to.reg == Register::spare0 || to.reg == Register::spare1 || is_texture(to.reg);
    if (!writable) {
      in_.faults.add(to.offset,
                     quoted(to.text) + (is_final_only(to.reg) ? " belongs to the final combiner" : " is read-only"),
                     GlError::invalid_enum);
      return;
    }
    check_register(to, false);
    if (to.reg == Register::discard) return;
    const auto same = [&](const Rc10Register& other) { return other.reg == to.reg; };
    if (std::any_of(statements_.written.begin(), statements_.written.end(), same)) {
      in_.faults.add(to.offset, quoted(to.text) + " is written twice in one portion", GlError::invalid_operation);
    } else {
      statements_.written.push_back(to);
    }
  }

  // "sum()" or "mux()".
  bool read_third(const Rc10Register& to) {
    const Rc10Token token = in_.lexer.take();
    if (statements_.has_third) {
      in_.faults.add(token.offset, "a portion has at most one sum() or mux()");
    } else if (statements_.count != 2) {
      in_.faults.add(token.offset, quoted(token.text) + " must come after two products; 'discard = zero;' can be one");
    } else if (statements_.has_dot) {
      in_.faults.add(token.offset, "!!RC1.0 does not allow " + std::string(token.text) + "() after a dot product");
    }
    statements_.has_third = true;
    portion_.out.sum = to.reg;
    portion_.out.mux_sum = token.text == "mux";
    return in_.expect({'(', ')'});
  }

  // "x * y", "x . y", or "x", which is x * 1.
  bool read_product(const Rc10Register& to) {
    const std::size_t offset = in_.lexer.peek().offset;
    CombinerInput x, y = rc10_one(plain_usage());
    if (!read_input(x)) return false;
    const bool dot = in_.lexer.peek().is('.');
    if (dot && name_ == PortionName::alpha) {
      in_.faults.add(in_.lexer.peek().offset, "an alpha portion has no dot product", GlError::invalid_value);
    }
    if (dot || in_.lexer.peek().is('*')) {
      in_.lexer.take();
      if (!read_input(y)) return false;
    }
    if (statements_.has_third) {
      in_.faults.add(offset, "sum() or mux() must be the last output of a portion");
    } else if (statements_.count == 2) {
      in_.faults.add(offset, "a portion has at most two products, then sum() or mux()");
    } else {
      const bool first = statements_.count++ == 0;
      statements_.has_dot = statements_.has_dot || dot;
      (first ? portion_.a : portion_.c) = x;
      (first ? portion_.b : portion_.d) = y;
      (first ? portion_.out.ab : portion_.out.cd) = to.reg;
      (first ? portion_.out.ab_dot_product : portion_.out.cd_dot_product) = dot;
    }
    return true;
  }

  struct Mapped {
    std::string_view word;
    InputMapping plain, negated;
  };

  // A register with its mapping: x, -x, expand(x), -expand(x), half_bias(x), -half_bias(x), unsigned(x),
  // unsigned_invert(x).
  bool read_input(CombinerInput& out) {
    constexpr std::array kMapped{
        Mapped{"expand", InputMapping::expand_normal, InputMapping::expand_negate},
        Mapped{"half_bias", InputMapping::half_bias_normal, InputMapping::half_bias_negate},
        Mapped{"unsigned", InputMapping::unsigned_identity, InputMapping::unsigned_identity},
        Mapped{"unsigned_invert", InputMapping::unsigned_invert, InputMapping::unsigned_invert}};
    const bool negative = in_.lexer.peek().is('-');
    if (negative) in_.lexer.take();
    const Rc10Token word = in_.lexer.peek();
    const auto* const mapped =
        std::find_if(kMapped.begin(), kMapped.end(), [&](const Mapped& m) { return word.is(m.word); });
    if (mapped == kMapped.end()) {
      return read_register(out, negative ? InputMapping::signed_negate : InputMapping::signed_identity);
    }
    if (negative && mapped->plain == mapped->negated) {
      in_.faults.add(word.offset, quoted(word.text) + " cannot be negated; expand, half_bias and plain registers can");
      return false;
    }
    in_.lexer.take();
    return in_.expect('(') && read_register(out, negative ? mapped->negated : mapped->plain) && in_.expect(')');
  }

  bool read_register(CombinerInput& out, InputMapping mapping) {
    const auto reg = rc10_register(in_.lexer.peek());
    if (!reg) return in_.expected("a register to read");
    in_.lexer.take();
    if (reg->reg == Register::discard || is_final_only(reg->reg)) {
      in_.faults.add(reg->offset,
                     reg->reg == Register::discard ? "discard cannot be read"
                                                   : quoted(reg->text) + " can be read by the final combiner alone",
                     GlError::invalid_enum);
      return true;
    }
    check_register(*reg, true);
    out = {reg->reg, reg->is_one ? map_one(mapping) : mapping, usage_of(reg->suffix, plain_usage())};
    return true;
  }

  Rc10Reader& in_;
  PortionName name_;
  Portion portion_;
  Statements statements_;
};

// The state of a missing portion. nvparse sets its inputs with component usage blue. GL refuses that in an RGB portion,
// which kept its old inputs; nothing reads them.
Portion missing_portion(PortionName name) {
  Portion portion;
  portion.a = portion.b = portion.c = portion.d =
      rc10_zero(name == PortionName::rgb ? ComponentUsage::rgb : ComponentUsage::blue);
  portion.out.sum = Register::discard;
  return portion;
}

bool is_constant(const Rc10Token& token) {
  return token.is("const0") || token.is("const1");
}

}  // namespace

bool read_rc10_constant(Rc10Reader& in, Rc10Constants& constants, const char* where) {
  const Rc10Token name = in.lexer.take();
  const std::size_t which = name.text == "const0" ? 0 : 1;
  if (constants.color[which]) {
    in.faults.add(name.offset, "the " + std::string(where) + " constant " + quoted(name.text) + " is set twice");
  }
  if (!in.expect({'=', '('})) return false;
  ColorF color{};
  for (std::size_t i = 0; i < color.size(); ++i) {
    if (i > 0 && !in.expect(',')) return false;
    if (in.lexer.peek().kind != Rc10Token::Kind::number) return in.expected("a number without exponent");
    color[i] = color_component(in.lexer.take().text);
  }
  constants.color[which] = color;
  return in.expect(')') && in.end_of_statement();
}

void clear_rc10_stage(GeneralCombiner& stage) {
  stage.rgb = missing_portion(PortionName::rgb);
  stage.alpha = missing_portion(PortionName::alpha);
}

void read_rc10_stage(Rc10Reader& in, GeneralCombiner& stage, Rc10Constants& constants) {
  in.lexer.take();
  bool seen[2] = {};
  clear_rc10_stage(stage);
  while (in.lexer.peek().kind != Rc10Token::Kind::end && !in.lexer.peek().is('}') && !in.faults.full()) {
    const Rc10Token token = in.lexer.peek();
    if (is_constant(token)) {
      if (seen[0] || seen[1])
        in.faults.add(token.offset, "a general combiner's constants must come before its portions");
      if (!in.profile.per_stage_constants) {
        in.faults.add(
            token.offset,
            "profile " + std::string(in.profile.name) + " has no per-stage constants (NV_register_combiners2)",
            GlError::invalid_enum);
      }
      if (!read_rc10_constant(in, constants, "local")) in.skip_statement();
    } else if (token.is("rgb") || token.is("alpha")) {
      in.lexer.take();
      const bool alpha = token.text == "alpha";
      if (seen[alpha ? 1 : 0]) {
        in.faults.add(token.offset, "the general combiner already has an " + std::string(token.text) + " portion");
      }
      seen[alpha ? 1 : 0] = true;
      if (!in.expect('{')) {
        in.skip_statement();
        continue;
      }
      (alpha ? stage.alpha : stage.rgb) = PortionReader(in, alpha ? PortionName::alpha : PortionName::rgb).read();
    } else {
      in.expected("rgb, alpha or a constant");
      in.skip_statement();
    }
  }
  if (in.lexer.peek().is('}') && !seen[0] && !seen[1]) in.expected("an rgb or alpha portion");
  in.expect('}');
}

}  // namespace ninebit::detail
