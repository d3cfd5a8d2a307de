#include "src/language/pixel_shader/shader_parser.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <string>
#include <utility>

#include "src/language/pixel_shader/shader_operands.h"
#include "src/system/find_row.h"
#include "src/system/nearest_name.h"

namespace ninebit::detail {
namespace {

using TokenKind = ShaderToken::Kind;

constexpr std::size_t kMostInstructions = 1000;  // far beyond what any version has

struct ResultModifier {
  std::string_view name;
  Scale scale;
  Bias bias;
  bool saturate;
  bool expressible;
};
constexpr std::array kResultModifiers{ResultModifier{"x2", Scale::by_two, Bias::none, false, true},
                                      ResultModifier{"x4", Scale::by_four, Bias::none, false, true},
                                      ResultModifier{"d2", Scale::by_one_half, Bias::none, false, true},
                                      ResultModifier{"sat", Scale::none, Bias::none, true, true},
                                      ResultModifier{"bias", Scale::none, Bias::by_negative_one_half, false, true},
                                      ResultModifier{"bx2", Scale::by_two, Bias::by_negative_one_half, false, true},
                                      ResultModifier{"x8", Scale::none, Bias::none, false, false},
                                      ResultModifier{"d4", Scale::none, Bias::none, false, false},
                                      ResultModifier{"d8", Scale::none, Bias::none, false, false}};

class ShaderParser {
 public:
  ShaderParser(const ShaderTokens& tokens, SourceFaults& faults)
      : in_(tokens.tokens), includes_(tokens.includes), faults_(faults) {}

  ShaderText parse() {
    if (!version()) return std::move(out_);
    while (!in_.at_end() && !faults_.full()) {
      if (in_.at_line_end()) {
        in_.take();
      } else if (!statement()) {
        out_.complete = false;
        while (!in_.at_line_end()) in_.take();
      }
    }
    return std::move(out_);
  }

 private:
  [[nodiscard]] ShaderOperandReader reader() { return {in_, out_.version, includes_, faults_}; }

  bool version() {
    while (in_.at_line_end() && !in_.at_end()) in_.take();
    bool found = false;
    // nvparse's header may stand before Direct3D's.
    while (in_.peek().kind == TokenKind::version && (!found || out_.version.name.empty() || is_heading_)) {
      const ShaderToken& token = in_.take();
      const auto version = shader_version_of(token.text);
      if (!version) {
        faults_.add(token.offset, "unknown version " + quoted(token.text) + "; expected ps.1.0 to ps.1.4, or xps.1.1");
        return false;
      }
      const bool nvparse = out_.version.is_nvparse || version->is_nvparse;
      out_.version = *version;
      out_.version.is_nvparse = nvparse;
      is_heading_ = token.text.starts_with('!');
      found = true;
      while (is_heading_ && in_.at_line_end() && !in_.at_end()) in_.take();
    }
    if (!found) reader().expected("a version such as ps.1.1 or xps.1.1");
    return found;
  }

  // Reads one instruction; false: the rest of its line must be skipped.
  bool statement() {
    const bool paired = in_.take_if('+');
    while (paired && in_.at_line_end() && !in_.at_end()) in_.take();
    const ShaderToken& word = in_.peek();
    if (word.kind != TokenKind::word) {
      reader().expected(word.kind == TokenKind::version ? "one version" : "an instruction");
      return false;
    }
    in_.take();
    ShaderInstruction instruction{.offset = word.offset, .text = word.text, .paired = paired};
    if (!name(instruction)) return false;
    if (instruction.op() == ShaderOp::def) return definition(paired, word.offset);
    if (!arguments(instruction)) return false;
    if (!ends()) return after(instruction.row->targets + instruction.row->operands, instruction.row->name);
    keep(std::move(instruction));
    return true;
  }

  // An instruction ends where another one may begin, in the same line, too.
  [[nodiscard]] bool ends() const {
    return in_.at_line_end() || in_.peek().kind == TokenKind::word || in_.peek().is('+');
  }
  bool after(int count, std::string_view name) {
    reader().expected("the next instruction after the " + std::to_string(count) +
                      (count == 1 ? " argument" : " arguments") + " of " + std::string(name));
    return false;
  }

  void keep(ShaderInstruction instruction) {
    if (instruction.op() == ShaderOp::nop) return;
    if (out_.instructions.size() == kMostInstructions) {
      if (!too_many_) {
        faults_.add(instruction.offset, "more than " + std::to_string(kMostInstructions) + " instructions");
      }
      too_many_ = true;
      return;
    }
    if (instruction.paired && out_.version.is_xbox) leave_alpha_to(instruction);
    out_.instructions.push_back(std::move(instruction));
  }

  // Cxbx prints no mask before an instruction that writes alpha: the first of the pair writes only the colour, then.
  void leave_alpha_to(const ShaderInstruction& second) {
    if (out_.instructions.empty() || second.writes(false) || !second.writes(true)) return;
    if (out_.instructions.back().op() < ShaderOp::xmma) return;
    for (ShaderTarget& target : out_.instructions.back().targets) {
      if (target.rgb) target.alpha = false;
    }
  }

  // The name of an instruction with the modifiers of its result.
  bool name(ShaderInstruction& out) {
    const std::string written = lower_case(out.text);
    const std::size_t underscore = std::min(written.find('_'), written.size());
    const std::string base = written.substr(0, underscore);
    const ShaderVersion& version = out_.version;
    out.row = shader_op_named(base);
    if (out.row == nullptr) {
      faults_.add(out.offset, quoted(out.text) + " is not an instruction of " + version.name +
                                  did_you_mean(base, shader_op_names(version)) + reader().may_be_included());
      return false;
    }
    const bool has = out.row->first_minor <= version.minor && version.minor <= out.row->last_minor;
    if (!has && !version.is_xbox) {
      const ShaderOpRow& row = *out.row;
      const std::string where = row.last_minor == 0 ? "only xps.1.1 has it"
                                : version.minor < row.first_minor
                                    ? "it begins with ps.1." + std::to_string(row.first_minor)
                                    : "its last version is ps.1." + std::to_string(row.last_minor);
      faults_.add(out.offset, version.name + " has no instruction " + quoted(base) + "; " + where);
      return false;
    }
    return result_modifiers(out, written.substr(underscore));
  }

  bool result_modifiers(ShaderInstruction& out, const std::string& modifiers) {
    if (!modifiers.empty() && (out.row->targets == 0 || out.op() == ShaderOp::texture)) {
      faults_.add(out.offset, quoted(out.row->name) + " takes no modifier, found " + quoted(modifiers));
      return false;
    }
    bool scaled = false;
    for (std::size_t at = 0; at < modifiers.size();) {
      const std::size_t end = std::min(modifiers.find('_', at + 1), modifiers.size());
      const std::string one = modifiers.substr(at + 1, end - at - 1);
      at = end;
      const ResultModifier* const found = find_row(kResultModifiers, &ResultModifier::name, one);
      if (found == nullptr) {
        faults_.add(out.offset,
                    quoted("_" + one) + " is not a modifier of an instruction; expected _x2, _x4, _d2 or _sat");
        return false;
      }
      if (!may_have(out, *found)) return false;
      if (found->saturate ? out.saturate : scaled) {
        faults_.add(out.offset, quoted(out.text) + " has two modifiers of one kind");
        return false;
      }
      out.saturate = out.saturate || found->saturate;
      if (found->saturate) continue;
      scaled = true;
      out.scale = found->scale;
      out.bias = found->bias;
    }
    return true;
  }

  bool may_have(const ShaderInstruction& out, const ResultModifier& modifier) {
    const ShaderVersion& version = out_.version;
    const std::string name = "_" + std::string(modifier.name);
    if (modifier.bias != Bias::none && !version.is_xbox) {
      faults_.add(out.offset, version.name + " has no modifier " + name + " of an instruction; only xps.1.1 has it");
      return false;
    }
    if (modifier.expressible) return true;
    const bool has = version.minor == 4;
    faults_.add(out.offset, has ? "combiners cannot scale by " + name + "; they have _x2, _x4 and _d2"
                                : version.name + " has no modifier " + name + "; it has _x2, _x4, _d2 and _sat");
    return false;
  }

  // A comma, after which the next register may stand in another line.
  bool comma() {
    if (!in_.take_if(',')) {
      reader().expected("','");
      return false;
    }
    while (in_.at_line_end() && !in_.at_end()) in_.take();
    return true;
  }

  bool arguments(ShaderInstruction& out) {
    const bool fetches = out.op() == ShaderOp::texture;
    for (int i = 0; i < out.row->targets; ++i) {
      if (i > 0 && !comma()) return false;
      const auto target = reader().target();
      if (!target) return false;
      out.targets.push_back(*target);
    }
    for (int i = 0; i < out.row->operands; ++i) {
      if (fetches && !in_.peek().is(',')) return true;
      if ((i > 0 || out.row->targets > 0) && !comma()) return false;
      const auto operand = fetches ? reader().coordinates() : reader().operand();
      if (!operand) return false;
      out.operands.push_back(*operand);
    }
    return true;
  }

  // def c0, r, g, b, a
  bool definition(bool paired, std::size_t offset) {
    const auto constant = reader().operand();
    if (!constant) return false;
    const bool plain = constant->modifier == ShaderModifier::none && constant->selector == ShaderSelector::none &&
                       !constant->negate && !constant->invert && !paired;
    if (constant->file != ShaderFile::constant || !plain) {
      faults_.add(offset, "expected a constant such as c0 after def, found " + quoted(constant->text));
      return false;
    }
    ShaderConstant& out = out_.constants.at(static_cast<std::size_t>(constant->index));
    ShaderConstant value{.defined = true, .offset = constant->offset};
    for (float& component : value.color) {
      if (!comma() || !number(component)) return false;
    }
    if (!ends()) return after(5, "def");
    if (out.defined) {
      faults_.add(constant->offset, quoted(constant->text) + " is defined twice");
      return false;
    }
    out = value;
    return true;
  }

  bool number(float& out) {
    bool minus = false;
    while (in_.peek().is('-') || in_.peek().is('+')) minus ^= in_.take().is('-');
    const ShaderToken& token = in_.peek();
    if (token.kind != TokenKind::number) {
      reader().expected("a number");
      return false;
    }
    std::string_view digits = token.text;
    if (digits.ends_with('f') || digits.ends_with('F')) digits.remove_suffix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (end != digits.data() + digits.size() || error == std::errc::invalid_argument) {
      faults_.add(token.offset, quoted(token.text) + " is not a number");
      return false;
    }
    if (error == std::errc::result_out_of_range) value = digits.find("e-") == std::string_view::npos ? 1e9 : 0;
    in_.take();
    out = static_cast<float>(std::clamp(minus ? -value : value, -1e9, 1e9));
    return true;
  }

  ShaderCursor in_;
  bool includes_;
  SourceFaults& faults_;
  ShaderText out_;
  bool is_heading_ = false;
  bool too_many_ = false;
};

}  // namespace

ShaderText parse_shader(const ShaderTokens& tokens, SourceFaults& faults) {
  return ShaderParser(tokens, faults).parse();
}

}  // namespace ninebit::detail
