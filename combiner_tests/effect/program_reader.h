// A reader of effects' programs that knows one.
#pragma once

#include <filesystem>
#include <string>

#include "ninebit/effect/effect_renderer.h"
#include "ninebit/language/rc10.h"

namespace ninebit::test {

// Gives the program of an RC1.0 text, whatever file is asked for.
inline EffectReaders reader_of(const std::string& program) {
  EffectReaders readers;
  readers.program = [program](const std::filesystem::path&, const HardwareProfile& profile) -> Result<TextProgram> {
    const auto parsed = parse_rc10({program, "test"}, profile);
    if (!parsed) return Diagnostic{.message = parsed.faults()[0].text()};
    return TextProgram{.state = *parsed};
  };
  return readers;
}

}  // namespace ninebit::test
