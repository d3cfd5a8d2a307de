// The colours of plots and heat maps, the same in PNG files and on the page.
#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "ninebit/image/image_io.h"
#include "ninebit/study/report.h"

namespace ninebit {

struct Rgb {
  std::uint8_t r = 0, g = 0, b = 0;
  friend bool operator==(const Rgb&, const Rgb&) = default;
};

// "#4477aa".
[[nodiscard]] std::string css_color(Rgb color);

// Series use these in turn. They are Paul Tol's "bright" scheme, whose colours stay distinguishable with each of the
// common colour vision deficiencies (https://personal.sron.nl/~pault/).
inline constexpr std::array kSeriesColors{Rgb{0x44, 0x77, 0xaa}, Rgb{0xee, 0x66, 0x77}, Rgb{0x22, 0x88, 0x33},
                                          Rgb{0xcc, 0xbb, 0x44}, Rgb{0xaa, 0x33, 0x77}, Rgb{0x66, 0xcc, 0xee},
                                          Rgb{0x99, 0x99, 0x99}};

// The colours of a heat map's values, which are divided by the end of the scale on their side: entry 0 is for -1 and
// below, 255 for 0, 510 for 1 and above. Without negative values only the upper half is used.
inline constexpr std::size_t kRampSize = 511;
inline constexpr Rgb kNoValue{0x80, 0x80, 0x80};  // for NaN
using ColorRamp = std::array<Rgb, kRampSize>;

// The ramp for a map whose values begin below 0 (blue, white, red), or at 0 and above (white to brown). Lightness falls
// steadily from 0 to either end, so the order is visible without hues.
[[nodiscard]] const ColorRamp& color_ramp(const HeatMap& map);
[[nodiscard]] Rgb color_of(const HeatMap& map, float value);

// Reports a map whose number of values or coordinates does not match its size, and a side outside 1 to 4096.
[[nodiscard]] Status check_size(const HeatMap& map);

// The map as a picture, one pixel per value. A map smaller than `least_side` on both sides is enlarged by a whole
// factor. Reports the errors of check_size.
[[nodiscard]] Result<Image8> picture_of(const HeatMap& map, int least_side);

}  // namespace ninebit
