#include "src/tools/compare/lettering.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace ninebit::tools {
namespace {

constexpr int kColumns = 5, kRows = 9;
constexpr std::size_t kLettersInBlock = 20, kLineLength = kLettersInBlock * (kColumns + 1);  // with space or line end
constexpr std::size_t kAsciiLetters = '~' - ' ' + 1;
constexpr std::array<std::string_view, 4> kFurther{"×", "…", "–", "·"};
constexpr std::size_t kBox = kAsciiLetters + kFurther.size();
static_assert((kBox + 1) % kLettersInBlock == 0);  // all blocks are full

// Takes one character off the text and returns the number of its letter.
std::size_t take_letter(std::string_view& text) {
  const char first = text[0];
  if (first >= ' ' && first <= '~') {
    text.remove_prefix(1);
    return static_cast<std::size_t>(first - ' ');
  }
  for (std::size_t i = 0; i < kFurther.size(); ++i) {
    if (!text.starts_with(kFurther[i])) continue;
    text.remove_prefix(kFurther[i].size());
    return kAsciiLetters + i;
  }
  const auto continues = [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) == 0x80U; };
  do {
    text.remove_prefix(1);
  } while (!text.empty() && continues(text[0]));
  return kBox;
}

bool is_set(std::size_t letter, int column, int row) {
  if (column < 0 || column >= kColumns || row < 0 || row >= kRows) return false;
  const std::size_t block = letter / kLettersInBlock, place = letter % kLettersInBlock;
  const std::size_t line = block * kRows + static_cast<std::size_t>(row);
  return kLetters[line * kLineLength + place * (kColumns + 1) + static_cast<std::size_t>(column)] == '#';
}

// From the middle of a cell to that of a neighbour, or to itself, in cells.
struct Stroke {
  double x = 0.0, y = 0.0;
  int dx = 0, dy = 0;
};

// Neighbours are joined; across a corner only where neither cell beside it is set.
std::vector<Stroke> strokes_of(std::size_t letter) {
  std::vector<Stroke> strokes;
  for (int y = 0; y < kRows; ++y) {
    for (int x = 0; x < kColumns; ++x) {
      if (!is_set(letter, x, y)) continue;
      const double at_x = x + 0.5, at_y = y + 0.5;
      const bool right = is_set(letter, x + 1, y), left = is_set(letter, x - 1, y), below = is_set(letter, x, y + 1);
      strokes.push_back({at_x, at_y, 0, 0});
      if (right) strokes.push_back({at_x, at_y, 1, 0});
      if (below) strokes.push_back({at_x, at_y, 0, 1});
      if (!right && !below && is_set(letter, x + 1, y + 1)) strokes.push_back({at_x, at_y, 1, 1});
      if (!left && !below && is_set(letter, x - 1, y + 1)) strokes.push_back({at_x, at_y, -1, 1});
    }
  }
  return strokes;
}

double distance(const Stroke& stroke, double x, double y) {
  const double px = x - stroke.x, py = y - stroke.y;
  const int length = stroke.dx * stroke.dx + stroke.dy * stroke.dy;
  const double t = length == 0 ? 0.0 : std::clamp((px * stroke.dx + py * stroke.dy) / length, 0.0, 1.0);
  return std::hypot(px - t * stroke.dx, py - t * stroke.dy);
}

void draw_letter(Image8& picture, double left, double top, std::size_t letter, const Lettering& lettering) {
  const std::vector<Stroke> strokes = strokes_of(letter);
  if (strokes.empty()) return;
  const double cell = lettering.cell, radius = (lettering.is_bold ? 0.68 : 0.48) * cell;
  const auto first = [](double edge) { return std::max(0, static_cast<int>(std::floor(edge)) - 1); };
  const auto last = [](double edge, int side) { return std::min(side, static_cast<int>(std::ceil(edge)) + 1); };
  const int end_y = last(top + kRows * cell, picture.height), end_x = last(left + kColumns * cell, picture.width);
  for (int y = first(top); y < end_y; ++y) {
    for (int x = first(left); x < end_x; ++x) {
      const double at_x = (x + 0.5 - left) / cell, at_y = (y + 0.5 - top) / cell;
      double nearest = kRows;
      for (const Stroke& stroke : strokes) nearest = std::min(nearest, distance(stroke, at_x, at_y));
      const double cover = std::clamp(radius - nearest * cell + 0.5, 0.0, 1.0);
      if (cover == 0.0) continue;
      const auto width = static_cast<std::size_t>(picture.width);
      std::uint8_t* const pixel =
          &picture.pixels[(static_cast<std::size_t>(y) * width + static_cast<std::size_t>(x)) * 3];
      for (std::size_t c = 0; c < 3; ++c) {
        pixel[c] = static_cast<std::uint8_t>(pixel[c] + (lettering.ink[c] - pixel[c]) * cover + 0.5);
      }
    }
  }
}

}  // namespace

void draw_text(Image8& picture, double x, double y, std::string_view text, const Lettering& lettering) {
  for (; !text.empty(); x += kLetterCells * lettering.cell) {
    draw_letter(picture, x, y, take_letter(text), lettering);
  }
}

}  // namespace ninebit::tools
