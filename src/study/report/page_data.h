// The data for the page's script: plots, heat maps and what is wrong in pictures, as JSON.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>

#include "ninebit/study/report.h"

namespace ninebit {

// {"palette": […], "ramps": […], "plots": […], "maps": […], "pictures": […]} without the character '<', so that nothing
// in it can end a <script> element. Points that a plot cannot show are left out. Reports a heat map whose size does not
// match its number of values, and a picture that cannot be encoded.
[[nodiscard]] Result<std::string> page_data(const StudyReport& report);

// What a page says of wrong pixels, also that of `ninebit compare`.

// A PNG file as the address of a picture.
[[nodiscard]] std::string picture_url(const std::string& png);
// ["none", "truncation", …]: what the numbers in cause_plane() stand for.
[[nodiscard]] nlohmann::ordered_json cause_names();
// [{"x", "y", "command", "text"}]
[[nodiscard]] nlohmann::ordered_json traces_json(std::span<const PictureTrace> traces);
// An object as the content of a script element. Bytes that are not UTF-8 are replaced.
[[nodiscard]] std::string script_text(const nlohmann::ordered_json& object);

// A heat map's values as a page holds them: as few bytes as they can be restored from, bit for bit.

// Adds to `out`, the map's JSON object:
//  "by"      "product" or "sum" if the value depends on x · y or x + y alone, for whole coordinates of evenly spaced
//            columns and rows; the list then has one value for each product or sum that occurs, ascending
//  "known"   the different values, if there are at most 65,536 and numbering them saves bytes; NaN is null
//  "values"  the list in base64: numbers of "known" values, of one byte if there are at most 256, else of two, or
//            floats; little-endian
void put_map_values(const HeatMap& map, nlohmann::ordered_json& out);

}  // namespace ninebit
