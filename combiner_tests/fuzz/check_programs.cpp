// The forms of a program that need no JSON.
#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_words.h"

namespace ninebit::fuzz {
namespace {

std::string wrong_with(const Parsed<CombinerState>& parsed, std::string_view text, const HardwareProfile& profile) {
  return first_of(wrong_with_answer(parsed, text),
                  [&] { return parsed ? wrong_with_state(*parsed.value, profile) : std::string(); });
}

}  // namespace

std::string check_gl(std::string_view bytes) {
  for (const HardwareProfile* const profile : kProfiles) {
    std::string wrong = wrong_with(parse_gl_calls({bytes, kFile}, *profile), bytes, *profile);
    if (!wrong.empty()) return wrong;
  }
  return {};
}

std::string check_rc10(std::string_view bytes) {
  for (const HardwareProfile* const profile : kProfiles) {
    const auto parsed = parse_rc10({bytes, kFile}, *profile);
    std::string wrong = wrong_with(parsed, bytes, *profile);
    if (!wrong.empty()) return wrong;
    if (!parsed) continue;
    if (const auto printed = print_rc10(*parsed.value, *profile); !printed) {
      return "what the language said it cannot say: " + printed.error().message;
    }
  }
  return {};
}

std::string check_words(std::string_view bytes) {
  for (const HardwareProfile* const profile : kProfiles) {
    for (const ChipClass chip : {ChipClass::nv10, ChipClass::nv20}) {
      const auto parsed = parse_register_words({bytes, kFile}, chip, *profile);
      std::string wrong = wrong_with(parsed, bytes, *profile);
      if (!wrong.empty()) return wrong;
      if (!parsed) continue;
      if (const auto printed = print_register_words(*parsed.value, chip, *profile); !printed) {
        return "what the words held they cannot hold: " + printed.error().message;
      }
    }
  }
  return {};
}

}  // namespace ninebit::fuzz
