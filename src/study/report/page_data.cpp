#include "src/study/report/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/study/report/plot_picture.h"
#include "src/study/report/report_colors.h"
#include "src/system/hashing/base64.h"

namespace ninebit {
namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Plot& plot) {
  // Bars are in named groups; in each group a series has a value or none.
  const std::vector<double> groups = plot.bars ? bar_groups(plot) : std::vector<double>();
  Json labels = Json::array(), all = Json::array();
  for (const double x : groups) labels.push_back(bar_label(plot, x));
  for (const PlotSeries& series : plot.series) {
    Json points = Json::array();
    if (plot.bars) points = Json::array_t(groups.size(), nullptr);
    for (const auto& point : series.points) {
      if (!can_be_shown(plot, point)) continue;
      if (plot.bars) {
        const auto at = std::lower_bound(groups.begin(), groups.end(), point.first) - groups.begin();
        points[static_cast<std::size_t>(at)] = point.second;
      } else {
        points.push_back({{"x", point.first}, {"y", point.second}});
      }
    }
    all.push_back({{"name", series.name}, {"points", std::move(points)}});
  }
  return {{"title", plot.title}, {"x_label", plot.x_label}, {"y_label", plot.y_label}, {"bars", plot.bars},
          {"log_x", plot.log_x}, {"log_y", plot.log_y},     {"labels", labels},        {"series", std::move(all)}};
}

// Appends 32 bits in little-endian byte order on every machine.
void append_bits(std::string& bytes, std::uint32_t bits) {
  for (unsigned shift = 0; shift < 32; shift += 8) bytes += static_cast<char>(bits >> shift & 0xFFU);
}

// If there are few different values, each is stored as a one-byte number.
void put_values(const std::vector<float>& values, Json& out) {
  constexpr std::size_t kMostKnown = 256;
  std::map<std::uint32_t, std::uint8_t> numbers;  // by their bits, which also works for NaN
  Json known = Json::array();
  std::string bytes;
  for (const float value : values) {
    const auto bits = std::bit_cast<std::uint32_t>(value);
    auto found = numbers.find(bits);
    if (found == numbers.end()) {
      if (numbers.size() == kMostKnown) break;
      found = numbers.emplace(bits, static_cast<std::uint8_t>(numbers.size())).first;
      known.push_back(value);
    }
    bytes += static_cast<char>(found->second);
  }
  if (bytes.size() == values.size()) {
    out["known"] = std::move(known);
  } else {
    bytes.clear();
    for (const float value : values) append_bits(bytes, std::bit_cast<std::uint32_t>(value));
  }
  out["values"] = base64(bytes);
}

Json json_of(const HeatMap& map) {
  Json out{{"x_label", map.x_label}, {"y_label", map.y_label}, {"x_first", map.x_first}, {"x_last", map.x_last},
           {"y_first", map.y_first}, {"y_last", map.y_last},   {"width", map.width},     {"height", map.height},
           {"low", map.low},         {"high", map.high}};
  put_values(map.values, out);
  return out;
}

std::string base64_of(const ColorRamp& ramp) {
  std::string bytes;
  for (const Rgb color : ramp) {
    for (const std::uint8_t part : {color.r, color.g, color.b}) bytes += static_cast<char>(part);
  }
  return base64(bytes);
}

}  // namespace

Result<std::string> page_data(const StudyReport& report) {
  Json palette = Json::array();
  for (const Rgb color : kSeriesColors) palette.push_back(css_color(color));
  HeatMap two_sided;
  two_sided.low = -1.0F;
  Json out{{"palette", std::move(palette)},
           {"ramps", {base64_of(color_ramp(HeatMap{})), base64_of(color_ramp(two_sided))}},
           {"plots", Json::array()},
           {"maps", Json::array()}};
  for (const Plot& plot : report.plots) out["plots"].push_back(json_of(plot));
  for (const HeatMap& map : report.heat_maps) {
    if (const Status status = check_size(map); !status) return status.error();
    out["maps"].push_back(json_of(map));
  }
  std::string text;
  for (const char c : out.dump(-1, ' ', false, Json::error_handler_t::replace)) {
    if (c == '<') {
      text += "\\u003c";  // in JSON, '<' occurs only in strings
    } else {
      text += c;
    }
  }
  return text;
}

}  // namespace ninebit
