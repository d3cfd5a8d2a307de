#include "src/study/datapath/program_inputs.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string_view>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/combiner/given_registers.h"
#include "src/study/datapath/color_inputs.h"

namespace ninebit {
namespace {

constexpr std::size_t kMostCombinations = std::size_t{1} << 26;

constexpr RegisterComponent kOwnAlpha{Register::spare0, kAlpha};  // else texture 0's

std::size_t index_of(int component) {
  return static_cast<std::size_t>(component);
}

std::string names_of(const std::vector<RegisterComponent>& components) {
  std::string names;
  for (const RegisterComponent& one : components) names += (names.empty() ? "" : ", ") + one.name();
  return names;
}

// The name of the first component that is among those before it.
std::optional<std::string> first_repeated(const std::vector<RegisterComponent>& components) {
  for (auto one = components.begin(); one != components.end(); ++one) {
    if (std::find(components.begin(), one, *one) != one) return one->name();
  }
  return std::nullopt;
}

// The lowest value of a component among all combinations.
int lowest_of(Register reg, int lowest) {
  return reg == Register::spare0 || reg == Register::spare1 ? lowest : 0;
}

Diagnostic too_many_combinations(const std::vector<RegisterComponent>& components, const std::string& why) {
  return {.message = fmt::format("{} register components ({}) have more than {} combinations of values, the maximum{}; "
                                 "name fewer, set constants in the program, or give a table of inputs",
                                 components.size(), names_of(components), kMostCombinations, why)};
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
  const std::vector<RegisterComponent>& components = out.components();
  if (!out.all()) {
    if (components.empty()) return Diagnostic{.message = "no register component given; expected at least one"};
    out.count_ = out.inputs_.codes->size() / components.size();
    if (out.count_ == 0) return Diagnostic{.message = "no fragment given; expected at least one"};
    return out;
  }
  if (too_many(profile, components)) return too_many_combinations(components, "");
  out.count_ = 1;
  for (std::size_t i = 0; i < components.size(); ++i) out.count_ *= out.values(i);
  return out;
}

bool Fragments::too_many(const HardwareProfile& profile, const std::vector<RegisterComponent>& components) {
  std::size_t count = 1;
  for (const RegisterComponent& one : components) {
    count *= static_cast<std::size_t>(profile.one - lowest_of(one.reg, profile.lowest) + 1);
    if (count > kMostCombinations) return true;
  }
  return false;
}

int Fragments::lowest(std::size_t component) const {
  return lowest_of(inputs_.components[component].reg, lowest_);
}

std::string Fragments::names() const {
  return components().empty() ? "none" : names_of(components());
}

s9 Fragments::code(std::size_t fragment, std::size_t component) const {
  const std::size_t columns = components().size();
  if (!all()) return (*inputs_.codes)[fragment * columns + component];
  for (std::size_t i = columns - 1; i > component; --i) fragment /= values(i);
  return static_cast<s9>(lowest(component) + static_cast<int>(fragment % values(component)));
}

std::string Fragments::text(std::size_t fragment) const {
  if (components().empty()) return "any inputs";
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

std::vector<std::size_t> MeasuredColor::measured() const {
  std::vector<std::size_t> out;
  for (std::size_t c = 0; c < components.size(); ++c) {
    if (components[c]) out.push_back(c);
  }
  return out;
}

Result<std::vector<MeasuredColor>> measured_colors(const HardwareProfile& profile, const Program& program,
                                                   const ProgramInputs& inputs) {
  if (inputs.components.empty()) return Diagnostic{.message = "no register component given; expected at least one"};
  if (const auto twice = first_repeated(inputs.components)) {
    return Diagnostic{.message = fmt::format("{} is varied twice; expected each register component once", *twice)};
  }
  std::vector<RegisterComponent> given;
  for (const auto& fixed : inputs.fixed) given.push_back(fixed.first);
  if (const auto twice = first_repeated(given)) {
    return Diagnostic{.message = fmt::format("{} is fixed twice; expected each register component once", *twice)};
  }
  for (const auto& fixed : inputs.fixed) {
    if (std::find(inputs.components.begin(), inputs.components.end(), fixed.first) == inputs.components.end()) continue;
    return Diagnostic{.message = fmt::format("{} is fixed and varied; expected one of them", fixed.first.name())};
  }
  if (inputs.codes || !Fragments::too_many(profile, inputs.components)) {
    auto fragments = Fragments::of(profile, inputs);
    if (!fragments) return fragments.error();
    return std::vector{MeasuredColor{.fragments = *std::move(fragments), .components = {true, true, true, true}}};
  }
  const auto is_own = [](const auto& fixed) { return fixed.first == kOwnAlpha; };
  const bool own_alpha =
      std::find(inputs.components.begin(), inputs.components.end(), kOwnAlpha) != inputs.components.end() ||
      std::any_of(inputs.fixed.begin(), inputs.fixed.end(), is_own);
  const std::array<InputSet, 4> read = inputs_of_color(program, own_alpha);
  std::vector<MeasuredColor> out;
  for (std::size_t c = 0; c < 4; ++c) {
    ProgramInputs own{.components = {}, .fixed = inputs.fixed};
    for (const RegisterComponent& one : inputs.components) {
      if (read[c].test(input_bit(one.reg, one.component))) own.components.push_back(one);
    }
    if (Fragments::too_many(profile, own.components)) {
      const std::string_view name = std::array{"red", "green", "blue", "alpha"}[c];
      return too_many_combinations(inputs.components,
                                   fmt::format(", and {} depends on {} together", name, names_of(own.components)));
    }
    const auto same = std::find_if(
        out.begin(), out.end(), [&](const MeasuredColor& one) { return one.fragments.components() == own.components; });
    if (same != out.end()) {
      same->components[c] = true;
      continue;
    }
    auto fragments = Fragments::of(profile, std::move(own));
    if (!fragments) return fragments.error();
    out.push_back({.fragments = *std::move(fragments), .components = {}});
    out.back().components[c] = true;
  }
  return out;
}

}  // namespace ninebit
