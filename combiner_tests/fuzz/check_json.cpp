// The JSON forms, and whatever form a text has.
#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "combiner_tests/support/random.h"
#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/json.h"
#include "ninebit/language/program_text.h"

namespace ninebit::fuzz {
namespace {

std::string wrong_with_program(std::string_view text, const HardwareProfile& profile) {
  TextureShaderState stages, stages_back;
  const auto parsed = parse_json_program({text, kFile}, profile, nullptr, &stages);
  std::string wrong = wrong_with_answer(parsed, text);
  if (!wrong.empty() || !parsed) return wrong;
  const std::string printed = print_json_program(*parsed, {}, stages);
  const auto back = parse_json_program({printed, kFile}, profile, nullptr, &stages_back);
  if (!back) return "JSON that ninebit printed is refused: " + back.faults().front().text() + "\n" + printed;
  if (stages_back != stages) return "JSON gives other stages:\n" + printed;
  wrong = wrong_with_stages(stages, profile);
  if (!wrong.empty()) return wrong;
  if (*back != *parsed) return "JSON gives another state:\n" + printed;
  if (print_json_program(*back, {}, stages_back) != printed) return "JSON is printed in another way again:\n" + printed;
  return wrong_with_state(*parsed, profile);
}

std::string wrong_with_words(std::string_view text, ChipClass chip, const HardwareProfile& profile) {
  const auto parsed = parse_json_register_words({text, kFile}, chip, profile);
  std::string wrong = wrong_with_answer(parsed, text);
  if (!wrong.empty() || !parsed) return wrong;
  const auto printed = print_json_register_words(*parsed, chip, profile);
  if (!printed) return "what the words held they cannot hold: " + printed.error().message;
  const auto back = parse_json_register_words({*printed, kFile}, chip, profile);
  if (!back) return "words that ninebit printed are refused: " + back.faults().front().text() + "\n" + *printed;
  if (normalize(*back, profile) != normalize(*parsed, profile)) {
    return "words give another program:\n" + *printed;
  }
  return wrong_with_state(*parsed, profile);
}

// Whether two programs give a few random fragments the same colours.
bool same_colors(const CombinerState& one, const CombinerState& other, const HardwareProfile& profile) {
  const Program first = normalize(one, profile), second = normalize(other, profile);
  test::Random random(1);
  const auto fill = [&](auto& bytes) {
    for (std::uint8_t& byte : bytes) byte = random.byte();
  };
  for (int i = 0; i < 16; ++i) {
    FragmentInputs inputs{.fog_factor = random.byte()};
    fill(inputs.primary);
    fill(inputs.secondary);
    fill(inputs.fog_color);
    for (auto& texture : inputs.texture) fill(texture.emplace().value);
    const RegisterFile registers = initial_registers(profile, inputs);
    if (evaluate(first, registers) != evaluate(second, registers)) return false;
  }
  return true;
}

// What is wrong with the forms that print a program and read it again. It need not be the same state: a pixel shader
// has no register that is zero, and takes a constant.
std::string wrong_with_forms(const TextProgram& program, const HardwareProfile& profile) {
  const ChipClass chip = chip_of(profile);
  for (const Form& form : forms()) {
    if (form.print == nullptr) continue;
    const auto text = form.print(program, chip, profile);
    if (!text || form.parse == nullptr) continue;
    const auto back = parse_program({*text, kFile}, form_id(form), profile);
    if (!back) {
      return "what " + std::string(form.name) + " printed it refuses: " + back.faults().front().text() + "\n" + *text;
    }
    if (!validate(*back, profile).empty()) return "an invalid program in " + std::string(form.name) + ":\n" + *text;
    if (!same_colors(program.state, back->state, profile)) {
      return "another program in " + std::string(form.name) + ":\n" + *text;
    }
  }
  return "";
}

}  // namespace

std::string check_form(std::string_view bytes) {
  for (const HardwareProfile* const profile : kProfiles) {
    const auto parsed = parse_program({bytes, kFile}, form_of(bytes), *profile);
    std::string wrong = wrong_with_answer(parsed, bytes);
    if (wrong.empty() && parsed && validate(*parsed, *profile).empty()) wrong = wrong_with_forms(*parsed, *profile);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

std::string check_json(std::string_view bytes) {
  for (const HardwareProfile* const profile : kProfiles) {
    std::string wrong = first_of(
        wrong_with_program(bytes, *profile), [&] { return wrong_with_words(bytes, ChipClass::nv10, *profile); },
        [&] { return wrong_with_words(bytes, ChipClass::nv20, *profile); });
    if (!wrong.empty()) return wrong;
  }
  return {};
}

}  // namespace ninebit::fuzz
