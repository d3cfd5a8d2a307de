// Direct3D's rules for a whole shader: microsoft.com, "ps_1_1__ps_1_2__ps_1_3__ps_1_4 Registers" and "Instructions".
#include <algorithm>
#include <set>
#include <string>

#include "src/language/pixel_shader/shader_parser.h"

namespace ninebit::detail {
namespace {

constexpr int kMostArithmetic = 8;  // instructions, where a pair counts as one; of ps.1.4 in each phase

class ShaderRules {
 public:
  ShaderRules(const ShaderText& text, SourceFaults& faults) : text_(text), version_(text.version), faults_(faults) {}

  void check() {
    const ShaderInstruction* before = nullptr;
    for (const ShaderInstruction& one : text_.instructions) {
      if (one.paired) check_pair(before, one);
      if (!version_.is_xbox) check_one(one);
      if (finals_ > 0 && !reported_final_) {
        faults_.add(one.offset, "xfc must be the last instruction");
        reported_final_ = true;
      }
      if (one.op() == ShaderOp::xfc) ++finals_;
      before = one.paired ? nullptr : &one;
    }
    write_pending_of_last();
    if (version_.is_xbox || text_.instructions.empty() || !text_.complete) return;
    if (!written_rgb_[0] && !written_alpha_[0]) {
      faults_.add(text_.instructions.back().offset,
                  "no instruction writes r0, which is the result of " + version_.name);
    }
  }

 private:
  void check_pair(const ShaderInstruction* before, const ShaderInstruction& one) {
    if (before == nullptr || !before->is_arithmetic() || !one.is_arithmetic()) {
      faults_.add(one.offset, "'+' joins two arithmetic instructions; expected one before it that has no '+'");
      return;
    }
    const bool both_rgb = before->writes(false) && one.writes(false);
    const bool both_alpha = before->writes(true) && one.writes(true);
    if (both_rgb || both_alpha) {
      faults_.add(one.offset, "of two instructions that '+' joins, one writes .rgb and one writes .a; both write " +
                                  std::string(both_rgb ? ".rgb" : ".a"));
    }
  }

  void check_one(const ShaderInstruction& one) {
    if (one.op() == ShaderOp::phase) {
      arithmetic_ = 0;
      return;
    }
    if (one.op() == ShaderOp::texture) {
      check_texture(one);
      return;
    }
    if (!one.paired && ++arithmetic_ == kMostArithmetic + 1) {
      faults_.add(one.offset, version_.name + " has at most " + std::to_string(kMostArithmetic) +
                                  " arithmetic instructions" + (version_.minor == 4 ? " in a phase" : ""));
    }
    check_ports(one);
    check_written(one);
    if (one.paired) return write_pending(one);
    write_pending_of_last();
    pending_ = {&one};
  }

  // Both of a pair read what was there before them.
  void write_pending(const ShaderInstruction& second) {
    pending_.push_back(&second);
    write_pending_of_last();
  }

  void write_pending_of_last() {
    for (const ShaderInstruction* const one : pending_) {
      for (const ShaderTarget& target : one->targets) {
        const auto i = static_cast<std::size_t>(target.index);
        if (target.file == ShaderFile::texture) loaded_.at(i) = true;
        if (target.file != ShaderFile::temporary) continue;
        written_rgb_[i] = written_rgb_[i] || target.rgb;
        written_alpha_[i] = written_alpha_[i] || target.alpha;
      }
    }
    pending_.clear();
  }

  void check_texture(const ShaderInstruction& one) {
    write_pending_of_last();
    const bool last = version_.minor == 4;
    if (!last && arithmetic_ > 0 && !reported_late_) {
      faults_.add(one.offset, "texture instructions come before arithmetic ones in " + version_.name);
      reported_late_ = true;
    }
    if (one.row->name.starts_with("texbem") && !one.operands.empty()) {
      bumps_.at(static_cast<std::size_t>(one.operands[0].index)) = true;
    }
    const ShaderTarget& target = one.targets[0];
    const auto i = static_cast<std::size_t>(target.index);
    if (target.file == ShaderFile::temporary) {
      written_rgb_[i] = written_alpha_[i] = true;
    } else {
      loaded_[i] = true;
    }
  }

  void check_ports(const ShaderInstruction& one) {
    const int textures = version_.minor == 4 ? 1 : version_.minor < 2 ? 2 : 3;
    const int temporaries = version_.minor == 4 ? 3 : 2;
    check_port(one, ShaderFile::constant, 2, "constants");
    check_port(one, ShaderFile::texture, textures, "t registers");
    check_port(one, ShaderFile::temporary, temporaries, "r registers");
  }

  void check_port(const ShaderInstruction& one, ShaderFile file, int most, const char* what) {
    std::set<int> read;
    for (const ShaderOperand& operand : one.operands) {
      if (operand.file == file) read.insert(operand.index);
    }
    if (static_cast<int>(read.size()) <= most) return;
    faults_.add(one.offset, "an instruction of " + version_.name + " reads at most " + std::to_string(most) + " " +
                                what + ", found " + std::to_string(read.size()));
  }

  void check_written(const ShaderInstruction& one) {
    const bool last = version_.minor == 4;
    if (!one.paired) write_pending_of_last();
    if (!text_.complete || version_.is_nvparse) return;
    for (const ShaderOperand& operand : one.operands) {
      const auto i = static_cast<std::size_t>(operand.index);
      if (operand.file == ShaderFile::texture && last) {
        faults_.add(operand.offset, "arithmetic instructions of ps.1.4 do not read t registers; load " +
                                        quoted(operand.text) + " with texld or texcrd");
      } else if (operand.file == ShaderFile::texture && !loaded_[i]) {
        if (!reported_texture_[i]) {
          faults_.add(operand.offset, quoted(operand.text) +
                                          " is read, but no texture instruction before loads it, such as tex t" +
                                          std::to_string(i));
        }
        reported_texture_[i] = true;
      } else if (operand.file == ShaderFile::texture && bumps_.at(i)) {
        faults_.add(operand.offset, quoted(operand.text) + " was read by texbem; " + version_.name +
                                        " lets no other instruction read it");
      } else if (operand.file == ShaderFile::temporary) {
        check_temporary(one, operand);
      }
    }
  }

  void check_temporary(const ShaderInstruction& one, const ShaderOperand& operand) {
    const auto i = static_cast<std::size_t>(operand.index);
    const ShaderSelector selector = operand.selector;
    const bool dot = one.op() == ShaderOp::dp3;
    const bool alpha_only =
        selector == ShaderSelector::alpha || (!one.writes(false) && selector == ShaderSelector::none && !dot);
    const bool rgb_only =
        (selector != ShaderSelector::none && selector != ShaderSelector::alpha) || dot || !one.writes(true);
    const bool reads_rgb = !alpha_only && !(selector == ShaderSelector::alpha);
    const bool reads_alpha = alpha_only || !rgb_only;
    const bool missing = (reads_rgb && !written_rgb_[i]) || (reads_alpha && !written_alpha_[i]);
    if (!missing || reported_temporary_[i]) return;
    const bool some = written_rgb_[i] || written_alpha_[i];
    reported_temporary_[i] = true;
    faults_.add(operand.offset,
                quoted(operand.text) + (some ? " is read where only its " : " is read before it is written") +
                    (some ? (written_rgb_[i] ? "red, green and blue were written" : "alpha was written") : ""));
  }

  const ShaderText& text_;
  const ShaderVersion& version_;
  SourceFaults& faults_;
  int arithmetic_ = 0;
  int finals_ = 0;
  bool reported_final_ = false, reported_late_ = false;
  std::array<bool, 10> bumps_{};  // t registers with offsets for other textures
  std::array<bool, 6> loaded_{}, written_rgb_{}, written_alpha_{}, reported_texture_{}, reported_temporary_{};
  std::vector<const ShaderInstruction*> pending_;
};

}  // namespace

void check_shader_rules(const ShaderText& text, SourceFaults& faults) {
  ShaderRules(text, faults).check();
}

}  // namespace ninebit::detail
