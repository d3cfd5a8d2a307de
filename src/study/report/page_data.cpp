#include "src/study/report/page_data.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "ninebit/image/image_io.h"
#include "ninebit/shadow/ground_truth.h"
#include "src/study/report/report_colors.h"
#include "src/study/report/report_text.h"
#include "src/system/hashing/openssl.h"
#include "src/system/quoting.h"

namespace ninebit {

namespace {

using Json = nlohmann::ordered_json;

Json json_of(const Plot& plot) {
  // At each of the even positions a series has a value or none.
  const bool even = is_even(plot);
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

Result<Json> json_of(const ReportPicture& picture) {
  if (picture.causes.pixels.empty()) return Json::object();
  const auto png = encode_png(picture.causes);
  if (!png) return png.error();
  return Json{{"wrong", picture_url(*png)}, {"causes", cause_names()}, {"traces", traces_json(picture.traces)}};
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
           {"maps", Json::array()},
           {"pictures", Json::array()}};
  for (const Plot& plot : report.plots) out["plots"].push_back(json_of(plot));
  for (const HeatMap& map : report.heat_maps) {
    if (const Status status = check_size(map); !status) return status.error();
    out["maps"].push_back(json_of(map));
  }
  for (const ReportPicture& picture : report.pictures) {
    auto object = json_of(picture);
    if (!object) return object.error();
    out["pictures"].push_back(std::move(*object));
  }
  return script_text(out);
}

std::string picture_url(const std::string& png) {
  return "data:image/png;base64," + base64(png);
}

nlohmann::ordered_json cause_names() {
  Json names = Json::array();
  for (std::size_t cause = 0; cause < kErrorCauses; ++cause) names.push_back(name_of(static_cast<ErrorCause>(cause)));
  return names;
}

nlohmann::ordered_json traces_json(std::span<const PictureTrace> traces) {
  Json out = Json::array();
  for (const PictureTrace& one : traces) {
    out.push_back({{"x", one.x}, {"y", one.y}, {"command", one.command}, {"text", one.text}});
  }
  return out;
}

std::string script_text(const nlohmann::ordered_json& object) {
  return script_json(object.dump(-1, ' ', false, Json::error_handler_t::replace));
}

namespace {

constexpr int kFarthest = 1024;            // coordinates beyond are not tried: their products are too many
constexpr std::size_t kMostKnown = 65536;  // numbers of two bytes
constexpr std::size_t kSmallMap = 4096;    // values; fewer are stored as they are

using ValueBits = std::vector<std::uint32_t>;

// Appends a number of `size` bytes in little-endian byte order on every machine.
void append_bytes(std::string& bytes, std::uint32_t number, unsigned size) {
  for (unsigned i = 0; i < size; ++i) bytes += static_cast<char>(number >> (8 * i) & 0xFFU);
}

// The coordinates first, first ± 1, … last; empty if they are not whole numbers at distances of 1, or too far from 0.
std::vector<int> whole_coordinates(double first, double last, int count) {
  if (std::fabs(first) > kFarthest || std::fabs(last) > kFarthest || std::floor(first) != first) return {};
  const int sign = last < first ? -1 : 1;
  if (first + sign * (count - 1) != last) return {};
  std::vector<int> coordinates;
  for (int i = 0; i < count; ++i) coordinates.push_back(static_cast<int>(first) + sign * i);
  return coordinates;
}

int key_of(int x, int y, bool product) {
  return product ? x * y : x + y;
}

// The value of each key that occurs, ascending by key; empty if two values have the same key.
ValueBits values_by_key(const HeatMap& map, const std::vector<int>& xs, const std::vector<int>& ys, bool product) {
  struct Slot {
    bool filled = false;
    std::uint32_t bits = 0;
  };
  const int reach = product ? kFarthest * kFarthest : 2 * kFarthest;
  std::vector<Slot> slots(static_cast<std::size_t>(2 * reach + 1));
  std::size_t i = 0;
  for (const int y : ys) {
    for (const int x : xs) {
      Slot& slot = slots[static_cast<std::size_t>(key_of(x, y, product) + reach)];
      const auto bits = std::bit_cast<std::uint32_t>(map.values[i++]);
      if (slot.filled && slot.bits != bits) return {};
      slot = {true, bits};
    }
  }
  ValueBits list;
  for (const Slot& slot : slots) {
    if (slot.filled) list.push_back(slot.bits);
  }
  return list;
}

// The list of values that the page stores, and the rule that restores the map from it, if there is one.
ValueBits stored_values(const HeatMap& map, std::string& rule) {
  if (map.values.size() > kSmallMap && map.x_values.empty() && map.y_values.empty()) {
    const auto xs = whole_coordinates(map.x_first, map.x_last, map.width);
    const auto ys = whole_coordinates(map.y_first, map.y_last, map.height);
    if (!xs.empty() && !ys.empty()) {
      for (const bool product : {false, true}) {
        ValueBits list = values_by_key(map, xs, ys, product);
        if (list.empty()) continue;
        rule = product ? "product" : "sum";
        return list;
      }
    }
  }
  ValueBits list;
  list.reserve(map.values.size());
  for (const float value : map.values) list.push_back(std::bit_cast<std::uint32_t>(value));
  return list;
}

}  // namespace

void put_map_values(const HeatMap& map, nlohmann::ordered_json& out) {
  std::string rule;
  const ValueBits list = stored_values(map, rule);
  if (!rule.empty()) out["by"] = rule;
  std::unordered_map<std::uint32_t, std::uint32_t> numbers;  // by their bits, which also works for NaN
  std::vector<std::uint32_t> numbered;
  nlohmann::ordered_json known = nlohmann::ordered_json::array();
  for (const std::uint32_t bits : list) {
    const auto [found, is_new] = numbers.try_emplace(bits, static_cast<std::uint32_t>(numbers.size()));
    if (is_new) known.push_back(std::bit_cast<float>(bits));
    numbered.push_back(found->second);
    if (numbers.size() > kMostKnown) break;
  }
  // A known value takes about 24 characters, and a number of two bytes saves less than three.
  const bool is_small = numbers.size() <= 256;
  const bool saves = is_small || (numbers.size() <= kMostKnown && numbers.size() * 9 < list.size());
  std::string bytes;
  if (saves) {
    for (const std::uint32_t number : numbered) append_bytes(bytes, number, is_small ? 1 : 2);
    out["known"] = std::move(known);
  } else {
    for (const std::uint32_t bits : list) append_bytes(bytes, bits, 4);
  }
  out["values"] = base64(bytes);
}

}  // namespace ninebit
