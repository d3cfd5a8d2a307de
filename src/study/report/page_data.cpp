#include "src/study/report/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "src/study/report/map_values.h"
#include "src/study/report/report_colors.h"
#include "src/system/hashing/base64.h"

namespace ninebit {
namespace {

using Json = nlohmann::ordered_json;

bool can_be_shown(const Plot& plot, const std::pair<double, double>& point) {
  constexpr double kGreatest = 1e150;  // keeps the lengths of axes finite
  if (!(std::fabs(point.first) < kGreatest) || !(std::fabs(point.second) < kGreatest)) return false;
  const bool log_x = plot.log_x && !plot.bars && !plot.even_x;
  return (!log_x || point.first > 1.0 / kGreatest) && (!plot.log_y || point.second > 1.0 / kGreatest);
}

// The positions that stand at equal distances: each x of a point, ascending.
std::vector<double> even_positions(const Plot& plot) {
  std::vector<double> positions;
  for (const PlotSeries& series : plot.series) {
    for (const auto& point : series.points) {
      if (can_be_shown(plot, point)) positions.push_back(point.first);
    }
  }
  std::sort(positions.begin(), positions.end());
  positions.erase(std::unique(positions.begin(), positions.end()), positions.end());
  return positions;
}

// The label of a position: its name or number.
std::string position_label(const Plot& plot, double x) {
  const bool named = x >= 1.0 && x <= static_cast<double>(plot.x_names.size());
  return named ? plot.x_names[static_cast<std::size_t>(x) - 1] : text_of(x);
}

Json json_of(const Plot& plot) {
  // At each of the even positions a series has a value or none.
  const bool even = plot.bars || plot.even_x;
  const std::vector<double> groups = even ? even_positions(plot) : std::vector<double>();
  Json labels = Json::array(), all = Json::array();
  for (const double x : groups) labels.push_back(position_label(plot, x));
  for (const PlotSeries& series : plot.series) {
    Json points = Json::array();
    if (even) points = Json::array_t(groups.size(), nullptr);
    bool gap = false;
    for (const auto& point : series.points) {
      if (!can_be_shown(plot, point)) {
        gap = true;
        continue;
      }
      if (even) {
        const auto at = std::lower_bound(groups.begin(), groups.end(), point.first) - groups.begin();
        points[static_cast<std::size_t>(at)] = point.second;
      } else {
        // Breaks the line where a point was left out.
        if (gap && !points.empty()) points.push_back({{"x", point.first}, {"y", nullptr}});
        points.push_back({{"x", point.first}, {"y", point.second}});
      }
      gap = false;
    }
    all.push_back({{"name", series.name}, {"points", std::move(points)}});
  }
  return {{"file", plot.file},
          {"title", plot.title},
          {"x_label", plot.x_label},
          {"y_label", plot.y_label},
          {"bars", plot.bars},
          {"even", even},
          {"log_x", plot.log_x && !even},
          {"log_y", plot.log_y},
          {"labels", labels},
          {"series", std::move(all)}};
}

Json json_of(const HeatMap& map) {
  Json out{{"x_label", map.x_label}, {"y_label", map.y_label}, {"x_first", map.x_first}, {"x_last", map.x_last},
           {"y_first", map.y_first}, {"y_last", map.y_last},   {"width", map.width},     {"height", map.height},
           {"low", map.low},         {"high", map.high},       {"none", map.none}};
  if (!map.x_values.empty()) out["x_values"] = map.x_values;
  if (!map.y_values.empty()) out["y_values"] = map.y_values;
  put_map_values(map, out);
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
