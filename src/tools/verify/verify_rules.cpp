#include "src/tools/verify/verify_rules.h"

#include <optional>
#include <utility>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/numerics/profile_fields.h"
#include "ninebit/study/combiner_fields.h"
#include "src/combiner/given_registers.h"

namespace ninebit::tools {

std::vector<Rival> rivals_of(const HardwareProfile& profile) {
  std::vector<Rival> rivals;
  if (profile.arithmetic != Arithmetic::integer) return rivals;
  for (const CombinerField& field : arithmetic_fields(profile)) {
    for (std::size_t i = 1; i < field.values.size(); ++i) {
      Rival rival{std::string(field.name), field.values[i].word, std::string(field.rules), profile};
      field.values[i].set(rival.profile);
      rivals.push_back(std::move(rival));
    }
  }
  rivals.push_back({"arithmetic", "float32", "", profile});
  rivals.back().profile.arithmetic.value = Arithmetic::float32;
  return rivals;
}

std::vector<Rival> pixel_rivals_of(const HardwareProfile& profile) {
  std::vector<Rival> rivals;
  for (const ProfileField& field : profile_fields()) {
    if (field.group != FieldGroup::rasterizer && field.group != FieldGroup::texture_shader) continue;
    const int own = field.get(profile).value;
    for (int value = 0; value < static_cast<int>(field.words.size()); ++value) {
      if (value == own) continue;
      Rival rival{std::string(field.name), field.word_of(value), std::string(field.rules), profile};
      field.set(rival.profile, {value, field.get(profile).evidence, field.get(profile).source});
      rivals.push_back(std::move(rival));
    }
  }
  return rivals;
}

std::vector<int> computed(const VerifyRow& row, const HardwareProfile& profile) {
  if (row.format != nullptr) return row.format->draw(row.measured, profile);
  Program program = normalize(*row.program, profile);
  for (const auto& [column, code] : row.constants) replace_constant(program, column.reg, column.component, code);
  std::vector<int> codes;
  std::optional<int> ran;  // the general combiner that `fragment` was evaluated up to
  EvaluatedFragment fragment;
  for (const Expectation& expected : row.expected) {
    const auto component = static_cast<std::size_t>(expected.component);
    if (!expected.stage) {
      codes.push_back(evaluate_fragment(program, row.registers).color[component]);
      continue;
    }
    if (ran != expected.stage) {
      Program begin = program;
      begin.num_general_combiners = *expected.stage + 1;
      fragment = evaluate_fragment(begin, row.registers);
      ran = expected.stage;
    }
    codes.push_back(fragment.registers[expected.reg][component]);
  }
  return codes;
}

bool agrees(const VerifyRow& row, const std::vector<int>& codes) {
  for (std::size_t i = 0; i < codes.size(); ++i) {
    if (!row.expected[i].allows(codes[i])) return false;
  }
  return true;
}

}  // namespace ninebit::tools
