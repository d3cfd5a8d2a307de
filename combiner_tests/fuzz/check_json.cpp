// The JSON forms.
#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/json.h"

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

}  // namespace

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
