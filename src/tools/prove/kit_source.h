// The files that a kit consists of.
#pragma once

#include <string>
#include <string_view>

#include "ninebit/numerics/result.h"
#include "ninebit/study/chip_kit.h"

namespace ninebit::tools {

// One C99 file for OpenGL 1.x on GLX or WGL, which runs all programs of the kit on a card and writes results.csv.
[[nodiscard]] Result<std::string> kit_source(const ChipKit& kit);

// The page that tells an owner of a card what to do, in Markdown.
[[nodiscard]] std::string kit_page(const ChipKit& kit);

// The C file of all kits, without the rows.

// kit.c beside this file. A line that begins with the comment "ROWS" stands for the rows.
extern const std::string_view kKitText;

}  // namespace ninebit::tools
