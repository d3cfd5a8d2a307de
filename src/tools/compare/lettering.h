// Text in pictures: letters of 5 × 9 cells, whose cells are joined to smooth strokes of any size.
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

#include "ninebit/image/image_io.h"

namespace ninebit::tools {

inline constexpr int kLetterCells = 6;  // of width, with the gap to the next letter
inline constexpr int kLineCells = 12;   // of height, with the gap to the next line

// A colour and a size of letters.
struct Lettering {
  double cell = 2.0;                  // pixels
  std::array<std::uint8_t, 3> ink{};  // red, green, blue
  bool is_bold = false;               // thicker strokes
};

// Draws one line of UTF-8 text into an RGB picture; (x, y) is its upper left corner. What lies outside is left out.
// ASCII and × … – · have letters; any other character is a box.
void draw_text(Image8& picture, double x, double y, std::string_view text, const Lettering& lettering);

// The letters, embedded in the program at build time: blocks of nine lines, in which letters of five characters stand
// side by side, from ' ' to '~' and then × … – · and the box.
extern const std::string_view kLetters;  // letters.txt beside this file

}  // namespace ninebit::tools
