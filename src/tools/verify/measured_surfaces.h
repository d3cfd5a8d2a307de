// A profile's results for the rows of measured tables of surfaces, stipple, point sprites and samples: the values of
// the picture, in the order of their columns.
#pragma once

#include <string>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::tools {

class MeasuredRow;

// Up to four colours, blended one after the other into a surface, as a texture shows it.
[[nodiscard]] std::vector<int> blend_into_surface(const MeasuredRow& row, const HardwareProfile& profile);

// The word in memory of a colour that was written, or blended over 0.
[[nodiscard]] std::vector<int> store_in_surface(const MeasuredRow& row, const HardwareProfile& profile);

// A pixel of a stippled polygon: 1 where it is drawn, else 0.
[[nodiscard]] std::vector<int> draw_stippled(const MeasuredRow& row, const HardwareProfile& profile);

// A pixel of a textured point over grey.
[[nodiscard]] std::vector<int> draw_sprite(const MeasuredRow& row, const HardwareProfile& profile);

// The alpha of a pixel of a smoothed triangle, blended over 255.
[[nodiscard]] std::vector<int> draw_smoothed(const MeasuredRow& row, const HardwareProfile& profile);

// The first and the last pixel of a row whose sample a quad covers; -1: none.
[[nodiscard]] std::vector<int> draw_samples(const MeasuredRow& row, const HardwareProfile& profile);

// A sample of a triangle on a surface with four for each pixel: 1 where it is covered, else 0.
[[nodiscard]] std::vector<int> draw_square(const MeasuredRow& row, const HardwareProfile& profile);

// The fault of a row's words or numbers, for a profile; empty: none.
[[nodiscard]] std::string wrong_surface_blend(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_surface_store(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_stipple(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_sprite(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_smoothed(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_samples(const MeasuredRow& row, const HardwareProfile& profile);
[[nodiscard]] std::string wrong_square(const MeasuredRow& row, const HardwareProfile& profile);

}  // namespace ninebit::tools
