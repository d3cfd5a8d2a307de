#include <array>
#include <set>

#include "src/language/pixel_shader/shader_instruction.h"
#include "src/language/pixel_shader/shader_macros.h"
#include "src/system/find_row.h"

namespace ninebit::detail {
namespace {

constexpr std::array kShaderOps{
    ShaderOpRow{"mov", ShaderOp::mov, 1, 1, 0, 4},
    ShaderOpRow{"add", ShaderOp::add, 1, 2, 0, 4},
    ShaderOpRow{"sub", ShaderOp::sub, 1, 2, 0, 4},
    ShaderOpRow{"mul", ShaderOp::mul, 1, 2, 0, 4},
    ShaderOpRow{"mad", ShaderOp::mad, 1, 3, 0, 4},
    ShaderOpRow{"lrp", ShaderOp::lrp, 1, 3, 0, 4},
    ShaderOpRow{"dp3", ShaderOp::dp3, 1, 2, 0, 4},
    ShaderOpRow{"dp4", ShaderOp::dp4, 1, 2, 2, 4},
    ShaderOpRow{"cnd", ShaderOp::cnd, 1, 3, 0, 4},
    ShaderOpRow{"cmp", ShaderOp::cmp, 1, 3, 2, 4},
    ShaderOpRow{"bem", ShaderOp::bem, 1, 2, 4, 4},
    ShaderOpRow{"nop", ShaderOp::nop, 0, 0, 0, 4},
    ShaderOpRow{"def", ShaderOp::def, 0, 0, 0, 4},
    ShaderOpRow{"phase", ShaderOp::phase, 0, 0, 4, 4},
    ShaderOpRow{"tex", ShaderOp::texture, 1, 0, 0, 3},
    ShaderOpRow{"texcoord", ShaderOp::texture, 1, 0, 0, 3},
    ShaderOpRow{"texkill", ShaderOp::texture, 1, 0, 0, 4},
    ShaderOpRow{"texbem", ShaderOp::texture, 1, 1, 0, 3},
    ShaderOpRow{"texbeml", ShaderOp::texture, 1, 1, 0, 3},
    ShaderOpRow{"texbrdf", ShaderOp::texture, 1, 1, 9, 0},
    ShaderOpRow{"texreg2ar", ShaderOp::texture, 1, 1, 0, 3},
    ShaderOpRow{"texreg2gb", ShaderOp::texture, 1, 1, 0, 3},
    ShaderOpRow{"texreg2rgb", ShaderOp::texture, 1, 1, 2, 3},
    ShaderOpRow{"texm3x2pad", ShaderOp::texture, 1, 1, 0, 3},
    ShaderOpRow{"texm3x2tex", ShaderOp::texture, 1, 1, 0, 3},
    ShaderOpRow{"texm3x2depth", ShaderOp::texture, 1, 1, 3, 3},
    ShaderOpRow{"texm3x3pad", ShaderOp::texture, 1, 1, 0, 3},
    ShaderOpRow{"texm3x3tex", ShaderOp::texture, 1, 1, 0, 3},
    ShaderOpRow{"texm3x3", ShaderOp::texture, 1, 1, 2, 3},
    ShaderOpRow{"texm3x3diff", ShaderOp::texture, 1, 1, 9, 0},
    ShaderOpRow{"texm3x3spec", ShaderOp::texture, 1, 2, 0, 3},
    ShaderOpRow{"texm3x3vspec", ShaderOp::texture, 1, 1, 0, 3},
    ShaderOpRow{"texdp3", ShaderOp::texture, 1, 1, 2, 3},
    ShaderOpRow{"texdp3tex", ShaderOp::texture, 1, 1, 2, 3},
    ShaderOpRow{"texld", ShaderOp::texture, 1, 1, 4, 4},
    ShaderOpRow{"texcrd", ShaderOp::texture, 1, 1, 4, 4},
    ShaderOpRow{"texdepth", ShaderOp::texture, 1, 0, 4, 4},
    ShaderOpRow{"xmma", ShaderOp::xmma, 3, 4, 9, 0},
    ShaderOpRow{"xmmc", ShaderOp::xmmc, 3, 4, 9, 0},
    ShaderOpRow{"xdm", ShaderOp::xdm, 2, 4, 9, 0},
    ShaderOpRow{"xdd", ShaderOp::xdd, 2, 4, 9, 0},
    ShaderOpRow{"xfc", ShaderOp::xfc, 0, 7, 9, 0},
};

}  // namespace

std::span<const ShaderOpRow> shader_ops() {
  return kShaderOps;
}

const ShaderOpRow* shader_op_named(std::string_view name) {
  return find_row(kShaderOps, &ShaderOpRow::name, name);
}

std::vector<std::string_view> shader_op_names(const ShaderVersion& version) {
  std::vector<std::string_view> names;
  for (const ShaderOpRow& row : shader_ops()) {
    const bool has = row.first_minor <= version.minor && version.minor <= row.last_minor;
    if (has || version.is_xbox) names.push_back(row.name);
  }
  return names;
}

std::optional<ShaderVersion> shader_version_of(std::string_view header) {
  const std::string name = lower_case(header);
  if (name.starts_with("!!")) {
    return ShaderVersion{.minor = name.back() - '0', .is_nvparse = true, .name = "ps.1." + name.substr(6)};
  }
  const bool is_xbox = name.starts_with('x');
  const std::string numbers = name.substr(is_xbox ? 3 : 2);
  if (numbers.size() != 4 || numbers[1] != '1' || numbers[3] < '0' || numbers[3] > '4') return std::nullopt;
  const int minor = numbers[3] - '0';
  if (is_xbox && minor != 1) return std::nullopt;
  return ShaderVersion{.minor = minor, .is_xbox = is_xbox, .name = name};
}

bool ShaderInstruction::is_arithmetic() const {
  switch (op()) {
    case ShaderOp::texture:
    case ShaderOp::phase:
    case ShaderOp::bem:
    case ShaderOp::xfc:
    case ShaderOp::def:
    case ShaderOp::nop:
      return false;
    default:
      return true;
  }
}

std::size_t ShaderText::constants_read() const {
  std::set<int> read;
  for (const ShaderInstruction& one : instructions) {
    for (const ShaderOperand& from : one.operands) {
      if (from.file != ShaderFile::constant || one.op() == ShaderOp::texture) continue;
      read.insert(from.index);
      const bool is_two = !version.is_xbox && is_mixed(constants.at(static_cast<std::size_t>(from.index)));
      if (is_two) read.insert(from.index + static_cast<int>(kShaderConstants));
    }
  }
  return read.size();
}

}  // namespace ninebit::detail
