// The files of a kit for a real Xbox.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/study/chip_kit.h"
#include "ninebit/study/vectors.h"

namespace ninebit::tools {

// The programs of a pack that a kit has: of each group that tests one thing the first so many.
inline constexpr int kXboxProgramsOfGroup = 4;

// One C file for nxdk, the free SDK, which runs the kit's programs and the pack's first ones and writes two tables.
// `pack` has an id.
[[nodiscard]] Result<std::string> xbox_source(const ChipKit& kit, const VectorPack& pack);

// The Makefile beside it.
[[nodiscard]] std::string xbox_makefile();

// The page that says what to do, in Markdown.
[[nodiscard]] std::string xbox_page(const ChipKit& kit, const VectorPack& pack);

// xbox_kit.c beside this file. A line that begins with the comment "ROWS" stands for the programs and their inputs.
extern const std::string_view kXboxKitText;

}  // namespace ninebit::tools
