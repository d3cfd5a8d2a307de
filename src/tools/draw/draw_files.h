// How `ninebit draw` reads the files of an effect.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/effect/effect_renderer.h"
#include "src/tools/draw/draw_flags.h"
#include "src/tools/input/archive.h"

namespace ninebit::tools {

// A file that `draw` was given: an effect, or a program that the flags draw.
struct DrawnFile {
  EffectFile file{};               // of an effect; unpacked as long as this lives
  std::optional<Effect> effect{};  // empty: the file was not an effect
  int exit_code = kDone;           // of the faults that were printed
};

// Reads the file if its content is an effect, or an archive with one. Prints its faults.
[[nodiscard]] DrawnFile read_effect_file(const std::string& file, const EffectReadOptions& options);

// Readers in isolated child processes that can be interrupted. They add what is worth a warning to `warnings`, which
// must outlive them, and print the faults of programs, of which they then report only the first. They read a program,
// and a rectangle, once: the profile must be the same in all calls.
// `defines`: as ProgramFlags::defines, of all programs that take definitions.
[[nodiscard]] EffectReaders effect_readers(bool allow_outside, const std::vector<std::string>& defines,
                                           std::vector<std::string>& warnings);

// "FILE: 37 x 11 is resampled to powers of two": how the warning about a picture begins. The readers leave it out where
// `warnings` has one that begins so.
[[nodiscard]] std::string resampled_text(const std::filesystem::path& file, int width, int height);

// The profile to draw an effect with: `given` (of --profile) if there is one, else that of the effect; nullptr: neither
// says one. Reports an unknown name, with the effect's file.
[[nodiscard]] Result<const HardwareProfile*> effect_profile(const Effect& effect, const std::string& file,
                                                            const HardwareProfile* given);

}  // namespace ninebit::tools
