#include "src/language/pixel_shader/shader_words.h"

#include <algorithm>
#include <utility>

#include "src/language/gl_nv/gl_nv_access.h"
#include "src/system/digits.h"

namespace ninebit::detail {
namespace {

using PrintedSource = PrintedPortion::Source;

struct PrintedTerm {
  CombinerInput x, y;
};

class PortionPrinter {
 public:
  PortionPrinter(const Portion& portion, const PortionPlace& place, PrintedConstants& constants, std::string& why)
      : portion_(portion), out_(portion.out), place_(place), constants_(constants), why_(why) {}

  std::optional<PrintedPortion> print() {
    const bool ab = out_.ab != Register::discard, cd = out_.cd != Register::discard,
               sum = out_.sum != Register::discard;
    if ((ab ? 1 : 0) + (cd ? 1 : 0) + (sum ? 1 : 0) > 1) return refuse("several outputs");
    if (out_.bias != Bias::none) return refuse("a bias of -1/2");
    printed_.to = ab ? out_.ab : cd ? out_.cd : out_.sum;
    if (printed_.to == Register::primary || printed_.to == Register::secondary) {
      return refuse(std::string(name_of(printed_.to)) + " is written, and v0 and v1 cannot be");
    }
    if (!instruction(ab, cd)) return std::nullopt;
    constexpr std::array kScales{"", "_x2", "_x4", "_d2"};
    printed_.name += kScales.at(static_cast<std::size_t>(out_.scale));
    if (place_.saturates) printed_.name += "_sat";
    return std::move(printed_);
  }

 private:
  std::nullopt_t refuse(const std::string& what) {
    if (why_.empty()) why_ = what;
    return std::nullopt;
  }

  bool instruction(bool ab, bool cd) {
    const PrintedTerm first{portion_.a, portion_.b}, second{portion_.c, portion_.d};
    if (ab) return product(first, out_.ab_dot_product, out_.ab_blue_to_alpha);
    if (cd) return product(second, out_.cd_dot_product, out_.cd_blue_to_alpha);
    const bool no_first = is_zero(first), no_second = is_zero(second);
    if (out_.mux_sum) return select(first, second);
    if (no_second) return product(first, out_.ab_dot_product, false);
    if (no_first) return product(second, out_.cd_dot_product, false);
    if (out_.ab_dot_product || out_.cd_dot_product) {
      refuse("a sum beside a dot product");
      return false;
    }
    return sum(first, second);
  }

  static bool is_zero(const PrintedTerm& term) { return is_nothing(term.x) || is_nothing(term.y); }

  // The one source of a term that is x * 1 or x * -1.
  static std::optional<std::pair<CombinerInput, bool>> single(const PrintedTerm& term) {
    for (const bool minus : {false, true}) {
      if (is_unit(term.y, minus)) return std::pair(term.x, minus);
      if (is_unit(term.x, minus)) return std::pair(term.y, minus);
    }
    return std::nullopt;
  }

  bool product(const PrintedTerm& term, bool dot, bool blue_to_alpha) {
    printed_.blue_to_alpha = dot && blue_to_alpha;
    if (blue_to_alpha && !dot) {
      refuse("blue to alpha of a product");
      return false;
    }
    const auto one = single(term);
    if (dot) {
      printed_.name = "dp3";
      return add(term.x) && add(term.y);
    }
    if (is_zero(term)) {
      printed_.name = "mov";
      return add_number(0, false);
    }
    printed_.name = one ? "mov" : "mul";
    return one ? add(one->first, one->second) : add(term.x) && add(term.y);
  }

  // Takes C·D where spare0's alpha is one half or more.
  bool select(const PrintedTerm& first, const PrintedTerm& second) {
    printed_.name = "cnd";
    printed_.sources.push_back({"r0", ".a"});
    for (const PrintedTerm& term : {second, first}) {
      const auto one = single(term);
      if (is_zero(term)) {
        if (!add_number(0, false)) return false;
      } else if (!one) {
        refuse("a mux of products");
        return false;
      } else if (!add(one->first, one->second)) {
        return false;
      }
    }
    return true;
  }

  bool sum(const PrintedTerm& first, const PrintedTerm& second) {
    const auto one = single(first), other = single(second);
    if (one && other) {
      // x * -1 is what sub makes of x; -(1 - x) has no modifier.
      const bool swaps = one->second && !other->second && one->first.mapping == InputMapping::unsigned_invert;
      const auto &added = swaps ? *other : *one, &last = swaps ? *one : *other;
      printed_.name = last.second ? "sub" : "add";
      return add(added.first, added.second) && add(last.first);
    }
    const bool has_single = one || other;
    if (interpolates(first, second, has_single) || interpolates(second, first, has_single)) return true;
    if (!one && !other) {
      refuse("the sum of two products");
      return false;
    }
    printed_.name = "mad";
    const PrintedTerm& factors = one ? second : first;
    const auto& added = one ? *one : *other;
    return add(factors.x) && add(factors.y) && add(added.first, added.second);
  }

  // lrp: x·y + (1 - x)·z; not if mad can read the weight without its sign.
  bool interpolates(const PrintedTerm& first, const PrintedTerm& second, bool has_single) {
    for (const bool swap_first : {false, true}) {
      for (const bool swap_second : {false, true}) {
        const CombinerInput& weight = swap_first ? first.y : first.x;
        const CombinerInput& rest = swap_second ? second.y : second.x;
        const bool same = weight.reg == rest.reg && weight.usage == rest.usage && weight.reg != Register::zero;
        const bool inverse =
            weight.mapping == InputMapping::unsigned_identity && rest.mapping == InputMapping::unsigned_invert;
        if (!same || !inverse || (has_single && is_unsigned(weight))) continue;
        printed_.name = "lrp";
        CombinerInput plain = weight;
        plain.mapping = InputMapping::signed_identity;
        return add(plain) && add(swap_first ? first.x : first.y) && add(swap_second ? second.x : second.y);
      }
    }
    return false;
  }

  // 0, 1 or -1, as a constant.
  bool add_number(const CombinerInput& in, bool minus) {
    if (is_nothing(in)) return add_number(0, false);
    if (is_unit(in)) return add_number(1, minus);
    if (is_unit(in, true)) return add_number(1, !minus);
    refuse("a half from the register zero");
    return false;
  }
  bool add_number(float number, bool minus) {
    const auto name = constants_.name(Register::discard, {number, number, number, number});
    if (!name) {
      refuse("more than 8 constants");
      return false;
    }
    printed_.sources.push_back({(minus ? "-" : "") + *name, ""});
    return true;
  }

  // Whether a register is read without its sign, or has none.
  [[nodiscard]] bool is_unsigned(const CombinerInput& in) const {
    const auto& known = in.usage == ComponentUsage::alpha ? place_.unsigned_alpha : place_.unsigned_rgb;
    return known[static_cast<std::size_t>(in.reg)];
  }

  bool add(const CombinerInput& in, bool minus = false) {
    if (in.reg == Register::zero) return add_number(in, minus);
    const auto name = register_name(in.reg);
    if (!name) return false;
    PrintedSource source{*name, selector(in)};
    switch (in.mapping) {
      case InputMapping::unsigned_identity:
        if (!is_unsigned(in)) {
          refuse(std::string(name_of(in.reg)) + " read without its sign, where it may be negative");
          return false;
        }
        break;
      case InputMapping::signed_identity:
        break;
      case InputMapping::signed_negate:
        minus = !minus;
        break;
      case InputMapping::unsigned_invert:
        if (minus) {
          refuse("-(1 - x)");
          return false;
        }
        source.text = "1-" + source.text;
        break;
      case InputMapping::expand_normal:
      case InputMapping::expand_negate:
        source.text += "_bx2";
        minus = minus != (in.mapping == InputMapping::expand_negate);
        break;
      case InputMapping::half_bias_normal:
      case InputMapping::half_bias_negate:
        source.text += "_bias";
        minus = minus != (in.mapping == InputMapping::half_bias_negate);
        break;
    }
    if (minus) source.text = "-" + source.text;
    printed_.sources.push_back(std::move(source));
    return true;
  }

  [[nodiscard]] std::string selector(const CombinerInput& in) const {
    const bool rgb = place_.which == PortionName::rgb;
    if (in.usage == ComponentUsage::blue) return ".b";
    return rgb && in.usage == ComponentUsage::alpha ? ".a" : "";
  }

  std::optional<std::string> register_name(Register reg) {
    switch (reg) {
      case Register::constant0:
      case Register::constant1: {
        const std::size_t which = reg == Register::constant0 ? 0 : 1;
        if (const auto unset = place_.unset.at(which)) {
          const auto own = PrintedConstants::name_of_unset(*unset);
          if (!own) refuse(name_of_constant(*unset) + ", which is not set");
          return own;
        }
        const auto& color = place_.constants.at(which);
        const auto name = constants_.name(reg, color.value_or(ColorF{}));
        if (!name) refuse("more than 8 constants");
        return name;
      }
      case Register::primary:
        return "v0";
      case Register::secondary:
        return "v1";
      case Register::spare0:
        return "r0";
      case Register::spare1:
        return "r1";
      default:
        break;
    }
    if (is_texture(reg)) return "t" + std::to_string(texture_unit_of(reg));
    refuse("the register " + std::string(name_of(reg)));
    return std::nullopt;
  }

  const Portion& portion_;
  const PortionOutput& out_;
  const PortionPlace& place_;
  PrintedConstants& constants_;
  std::string& why_;
  PrintedPortion printed_;
};

}  // namespace

PrintedConstants::PrintedConstants(const Program& program) {
  const std::vector<ConstantName> unset = unset_constants(program);
  for (std::size_t i = 0; i < kMost; ++i) {
    if (std::find(unset.begin(), unset.end(), i) == unset.end()) unused_.push_back(i);
  }
}

std::optional<std::string> PrintedConstants::name_of_unset(ConstantName name) {
  return name < kMost ? std::optional("c" + std::to_string(name)) : std::nullopt;
}

std::optional<std::string> PrintedConstants::name(Register reg, const ColorF& color) {
  ColorF stored = color;
  for (float& component : stored) component = gl::detail::clamped_color(component);
  const std::size_t slot = reg == Register::constant1 ? 1 : 0;
  if (reg != Register::discard && in_scope_.at(slot)) return "c" + std::to_string(unused_[*in_scope_.at(slot)]);
  for (std::size_t i = 0; i < all_.size(); ++i) {
    const bool other = reg != Register::discard && in_scope_.at(1 - slot) == i;
    if (all_[i] != stored || other) continue;
    if (reg != Register::discard) in_scope_.at(slot) = i;
    return "c" + std::to_string(unused_[i]);
  }
  if (all_.size() == unused_.size()) return std::nullopt;
  if (reg != Register::discard) in_scope_.at(slot) = all_.size();
  all_.push_back(stored);
  return "c" + std::to_string(unused_[all_.size() - 1]);
}

std::string PrintedConstants::text() const {
  std::string out;
  for (std::size_t i = 0; i < all_.size(); ++i) {
    out += "def c" + std::to_string(unused_[i]);
    for (const float component : all_[i]) out += ", " + plain_digits_of(component);
    out += "\n";
  }
  return out;
}

std::optional<PrintedPortion> words_of(const Portion& portion, const PortionPlace& place, PrintedConstants& constants,
                                       std::string& why) {
  return PortionPrinter(portion, place, constants, why).print();
}

bool is_nothing(const CombinerInput& in) {
  return in.reg == Register::zero &&
         (in.mapping == InputMapping::unsigned_identity || in.mapping == InputMapping::signed_identity ||
          in.mapping == InputMapping::signed_negate);
}

bool is_unit(const CombinerInput& in, bool minus) {
  if (in.reg != Register::zero) return false;
  if (minus) return in.mapping == InputMapping::expand_normal;
  return in.mapping == InputMapping::unsigned_invert || in.mapping == InputMapping::expand_negate;
}

}  // namespace ninebit::detail
