// The forms of a program that need no JSON.
#include <algorithm>

#include "combiner_tests/fuzz/checks.h"
#include "combiner_tests/fuzz/common.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/gl_calls.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/rc10.h"
#include "ninebit/language/register_log.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_code.h"
#include "ninebit/language/xbox_pixel_shader.h"

namespace ninebit::fuzz {
namespace {

std::string wrong_with(const Parsed<CombinerState>& parsed, std::string_view text, const HardwareProfile& profile) {
  return first_of(wrong_with_answer(parsed, text),
                  [&] { return parsed ? wrong_with_state(*parsed, profile) : std::string(); });
}

// The same of a parser that reads texture-shader stages, too.
template <class Parse>
std::string wrong_with_both(const Parse& parse, std::string_view text, const HardwareProfile& profile) {
  TextureShaderState stages;
  const Parsed<CombinerState> parsed = parse(&stages);
  return first_of(wrong_with(parsed, text, profile), [&] { return wrong_with_stages(stages, profile); });
}

}  // namespace

std::string check_gl(std::string_view bytes) {
  for (const HardwareProfile* const profile : kProfiles) {
    std::string wrong = first_of(wrong_with(parse_gl_calls({bytes, kFile}, *profile), bytes, *profile), [&] {
      return wrong_with_both(
          [&](auto* stages) {
            return parse_gl_calls({bytes, kFile}, *profile, stages);
          },
          bytes, *profile);
    });
    if (!wrong.empty()) return wrong;
  }
  return {};
}

std::string check_source(std::string_view bytes) {
  const std::vector<Definition> definitions{{"x", "1"}, {"mode", "MODE_B"}, {"color", "1, 0.5, 0, 1"}};
  for (const HardwareProfile* const profile : kProfiles) {
    std::string wrong = wrong_with(parse_source_code({bytes, kFile}, {{}, definitions}, *profile), bytes, *profile);
    if (!wrong.empty()) return wrong;
  }
  for (const SourceFunction& function : find_source_functions({bytes, kFile}, {}, profiles::nv2a)) {
    if (function.calls_read + function.calls_not_read == 0 && function.faults.empty()) {
      return "a function without calls or faults: " + function.name;
    }
    std::string wrong = wrong_with_place({function.line, 1}, bytes);
    if (!wrong.empty()) return wrong;
  }
  (void)is_source_code(bytes);
  (void)is_gl_source_code(bytes);
  return {};
}

std::string check_rc10(std::string_view bytes) {
  for (const HardwareProfile* const profile : kProfiles) {
    const auto parsed = parse_rc10({bytes, kFile}, *profile);
    std::string wrong = first_of(wrong_with(parsed, bytes, *profile), [&] {
      return wrong_with_both(
          [&](auto* stages) {
            return parse_rc10({bytes, kFile}, *profile, stages);
          },
          bytes, *profile);
    });
    if (!wrong.empty()) return wrong;
    if (!parsed) continue;
    if (const auto printed = print_rc10(*parsed, *profile); !printed) {
      return "what the language said it cannot say: " + printed.error().message;
    }
  }
  return {};
}

std::string check_ps(std::string_view bytes) {
  (void)is_pixel_shader(bytes);
  for (const HardwareProfile* const profile : kProfiles) {
    const bool is_assembled = is_shader_tokens(bytes);
    const auto parse = [&](TextureShaderState* stages) {
      return is_assembled ? parse_shader_tokens({bytes, kFile}, *profile, stages)
                          : parse_pixel_shader({bytes, kFile}, *profile, {}, {}, stages);
    };
    std::string wrong =
        first_of(wrong_with(parse(nullptr), bytes, *profile), [&] { return wrong_with_both(parse, bytes, *profile); });
    if (!wrong.empty()) return wrong;
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
      if (const auto printed = print_register_words(*parsed, chip, *profile); !printed) {
        return "what the words held they cannot hold: " + printed.error().message;
      }
    }
  }
  return {};
}

std::string check_xbox(std::string_view bytes) {
  (void)is_xbox_pixel_shader(bytes);
  for (const HardwareProfile* const profile : kProfiles) {
    std::vector<RegisterWord> words, again;
    const auto parsed = parse_xbox_pixel_shader({bytes, kFile}, *profile, &words);
    std::string wrong = wrong_with(parsed, bytes, *profile);
    if (!wrong.empty()) return wrong;
    if (!parsed) continue;
    const auto printed = print_xbox_pixel_shader(*parsed, *profile, words);
    if (!printed) return "what a definition held it cannot hold: " + printed.error().message;
    const auto back = parse_xbox_pixel_shader({*printed, kFile}, *profile, &again);
    if (!back) return "a printed definition is refused: " + back.faults().front().text() + "\n" + *printed;
    if (normalize(*back, *profile) != normalize(*parsed, *profile)) return "another program:\n" + *printed;
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (again.at(i).value != words[i].value) return "another " + words[i].name + ":\n" + *printed;
      if (explain_other_word(words[i]).empty()) return words[i].name + " says nothing";
    }
  }
  return {};
}

namespace {

// The set-ups of a log, told apart by their words and their first draw.
std::string summary_of(const Parsed<RegisterLog>& log) {
  if (!log) return log.faults().front().text();
  std::string text = std::to_string(log->frames) + ' ' + std::to_string(log->draws) + '\n';
  for (const LogSetup& setup : log->setups) {
    text += std::to_string(setup.first_line) + ':';
    for (const RegisterWord& word : setup.words) text += ' ' + word.name + '=' + std::to_string(word.value);
    text += '\n';
  }
  return text;
}

}  // namespace

std::string check_log(std::string_view bytes) {
  (void)is_register_log(bytes);
  const auto log = parse_register_log({bytes, kFile});
  std::string wrong = wrong_with_answer(log, bytes);
  if (!wrong.empty()) return wrong;
  RegisterLogReader reader{std::string(kFile), {}};
  for (std::size_t at = 0, size = 1; at < bytes.size(); at += size++) reader.read(bytes.substr(at, size));
  if (summary_of(reader.finish()) != summary_of(log)) return "another log in pieces";
  if (!log) return {};
  for (std::size_t i = 1; i <= std::min<std::size_t>(log->setups.size(), 2); ++i) {
    for (const HardwareProfile* const profile : kProfiles) {
      wrong = wrong_with(program_of(*log, i, kFile, *profile), bytes, *profile);
      if (!wrong.empty()) return wrong;
    }
  }
  return {};
}

}  // namespace ninebit::fuzz
