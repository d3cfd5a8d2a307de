// The values of flags: lists, numbers in a range, pixels, points.
//
// A list has values separated by commas; values that contain commas themselves, by semicolons; a range of whole numbers
// as FIRST-LAST.
#pragma once

#include <CLI/CLI.hpp>
#include <algorithm>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/frame/settings.h"
#include "src/system/number_list.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

// The items of a list.
[[nodiscard]] std::vector<std::string> items_of(std::string_view list, char separator = ',');

// The whole numbers of a list such as 1,2,4-6, in their order; empty if an item is neither a number nor a range, or
// there are more than 4,096.
[[nodiscard]] std::optional<std::vector<int>> whole_numbers_in(std::string_view list);

// A validator from a check that returns an empty string for a valid value, as those below do.
[[nodiscard]] CLI::Validator checked_by(std::string (*check)(const std::string&));

// A validator that requires each item to be one of `known`, at most once.
[[nodiscard]] CLI::Validator list_of(std::vector<std::string> known);

// A validator that checks the list as a whole. `parse` returns something false if the list is not valid; `expected`
// completes "invalid list 'x'; expected a list of …".
template <class Parse>
[[nodiscard]] CLI::Validator list_by(Parse parse, std::string expected) {
  const auto check = [parse, expected = std::move(expected)](const std::string& text) -> std::string {
    return parse(text) ? "" : "invalid list '" + text + "'; expected a list of " + expected;
  };
  return CLI::Validator(check, "");
}

// Range checks of flags that take one number or a list of numbers.

// The largest coordinate or distance of a scene; see scene_io.h.
inline constexpr double kMostDistance = 1e12;
// About ten years; a longer time is a mistake.
inline constexpr double kMostSeconds = 3e8;

// Whether the text is `count` numbers between separators, all finite and in range. A number that the type cannot hold
// is out of range.
template <class T>
[[nodiscard]] bool are_numbers_in(std::string_view text, char separator, std::size_t count, double least,
                                  double greatest) {
  const auto n = numbers<T>(text, separator);
  return n && n->size() == count && std::all_of(n->begin(), n->end(), [&](T value) {
           return static_cast<double>(value) >= least && static_cast<double>(value) <= greatest;  // false for NaN
         });
}

// One real number in range; CLI11's own check accepts NaN.
[[nodiscard]] CLI::Validator real_in_range(double least, double greatest);

// A flag that names a pixel as X,Y, counted from the top left of the picture.

CLI::Option* add_pixel_flag(CLI::App& verb, const std::string& flag, std::string& text, const std::string& help);

// The pixel in window coordinates, y up. The text was checked while the flag was parsed; reports a pixel outside of the
// picture.
[[nodiscard]] Result<glm::ivec2> window_pixel(const std::string& flag, const std::string& text,
                                              const RenderSettings& settings);

// Checks of the scene flags. Each returns an empty string for a valid value, else the reason and what is expected.

// WIDTHxHEIGHT, each a whole number from 1 to kMaxSurfaceSize.
[[nodiscard]] std::string check_size(const std::string& text);
// X,Y,Z, each from -kMostDistance to kMostDistance.
[[nodiscard]] std::string check_point(const std::string& text);
// The point of such a text; nothing if the text is empty.
[[nodiscard]] std::optional<glm::vec3> point_of(const std::string& text);
// auto, none or a height.
[[nodiscard]] std::string check_floor(const std::string& text);
// Degrees from 0.01 to 170.
[[nodiscard]] std::string check_fov(const std::string& text);
[[nodiscard]] std::string check_seconds(const std::string& text);
[[nodiscard]] std::string check_frame(const std::string& text);
// Degrees from 1 to 170.
[[nodiscard]] std::string check_spot_angle(const std::string& text);
// Any text that is not empty.
[[nodiscard]] std::string check_file_name(const std::string& text);

}  // namespace ninebit::tools
