#include "src/study/datapath/program_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/combiner/given_registers.h"

namespace ninebit {
namespace {

constexpr std::size_t kMostCombinations = std::size_t{1} << 26;

constexpr RegisterComponent kOwnAlpha{Register::spare0, kAlpha};  // else texture 0's

bool is_constant(Register reg) {
  return reg == Register::constant0 || reg == Register::constant1;
}

std::size_t index_of(int component) {
  return static_cast<std::size_t>(component);
}

}  // namespace

std::string RegisterComponent::name() const {
  const std::string short_name = reg == Register::constant0   ? "const0"
                                 : reg == Register::constant1 ? "const1"
                                 : reg == Register::primary   ? "primary"
                                 : reg == Register::secondary ? "secondary"
                                 : is_texture(reg)            ? fmt::format("tex{}", texture_unit_of(reg))
                                                              : std::string(name_of(reg));
  return short_name + '.' + "rgba"[component];
}

Fragments::Fragments(const HardwareProfile& profile, ProgramInputs inputs)
    : inputs_(std::move(inputs)), lowest_(profile.lowest), one_(profile.one), defaults_(default_registers(profile)) {
  for (const auto& [to, code] : inputs_.fixed) {
    if (!is_constant(to.reg)) defaults_[to.reg][index_of(to.component)] = code;
    has_own_alpha_ = has_own_alpha_ || to == kOwnAlpha;
  }
}

Result<Fragments> Fragments::of(const HardwareProfile& profile, ProgramInputs inputs) {
  Fragments out(profile, std::move(inputs));
  const std::size_t columns = out.components().size();
  for (const auto& [to, code] : out.inputs_.fixed) {
    if (std::find(out.components().begin(), out.components().end(), to) == out.components().end()) continue;
    return Diagnostic{.message = fmt::format("{} is fixed and varied; expected one of them", to.name())};
  }
  if (columns == 0) return Diagnostic{.message = "no register component given; expected at least one"};
  if (!out.all()) {
    out.count_ = out.inputs_.codes->size() / columns;
    if (out.count_ == 0) return Diagnostic{.message = "no fragment given; expected at least one"};
    return out;
  }
  out.count_ = 1;
  for (std::size_t i = 0; i < columns; ++i) {
    out.count_ *= out.values(i);
    if (out.count_ > kMostCombinations) {
      std::string names;
      for (const RegisterComponent& one : out.components()) names += (names.empty() ? "" : ", ") + one.name();
      return Diagnostic{.message = fmt::format("{} register components ({}) have more than {} combinations of values, "
                                               "the maximum; name fewer, set constants in the program, or give a table "
                                               "of inputs",
                                               columns, names, kMostCombinations)};
    }
  }
  return out;
}

int Fragments::lowest(std::size_t component) const {
  const Register reg = inputs_.components[component].reg;
  return reg == Register::spare0 || reg == Register::spare1 ? lowest_ : 0;
}

s9 Fragments::code(std::size_t fragment, std::size_t component) const {
  const std::size_t columns = components().size();
  if (!all()) return (*inputs_.codes)[fragment * columns + component];
  for (std::size_t i = columns - 1; i > component; --i) fragment /= values(i);
  return static_cast<s9>(lowest(component) + static_cast<int>(fragment % values(component)));
}

std::string Fragments::text(std::size_t fragment) const {
  std::string out;
  for (std::size_t i = 0; i < components().size(); ++i) {
    out += fmt::format("{}{} {}", i == 0 ? "" : ", ", components()[i].name(), code(fragment, i));
  }
  return out;
}

RegisterFile Fragments::registers(std::size_t fragment) const {
  RegisterFile out = defaults_;
  bool own_alpha = has_own_alpha_;
  for (std::size_t i = 0; i < components().size(); ++i) {
    const RegisterComponent& to = components()[i];
    out[to.reg][index_of(to.component)] = code(fragment, i);
    if (to == kOwnAlpha) own_alpha = true;
  }
  if (!own_alpha) out[Register::spare0][kAlpha] = out[Register::texture0][kAlpha];
  return out;
}

bool Fragments::have_constants() const {
  return std::any_of(components().begin(), components().end(),
                     [](const RegisterComponent& c) { return is_constant(c.reg); });
}

void Fragments::put_fixed_constants(Program& program) const {
  for (const auto& [to, code] : inputs_.fixed) {
    if (is_constant(to.reg)) replace_constant(program, to.reg, to.component, code);
  }
}

void Fragments::put_constants(std::size_t fragment, Program& program) const {
  for (std::size_t i = 0; i < components().size(); ++i) {
    const RegisterComponent& to = components()[i];
    if (!is_constant(to.reg)) continue;
    replace_constant(program, to.reg, to.component, code(fragment, i));
  }
}

}  // namespace ninebit
