// A heat map's values as a page holds them come back bit for bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "combiner_tests/support/random.h"
#include "src/study/report/page_data.h"

namespace {

using namespace ninebit;
using Json = nlohmann::ordered_json;

std::string bytes_of_base64(const std::string& text) {
  const std::string letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    if (c == '=') break;
    bits = bits << 6U | static_cast<std::uint32_t>(letters.find(c));
    count += 6;
    if (count < 8) continue;
    count -= 8;
    bytes += static_cast<char>(bits >> count & 0xFFU);
  }
  return bytes;
}

// Reads the object as the page's script does.
std::vector<float> restored(const HeatMap& map, const Json& stored) {
  const std::string bytes = bytes_of_base64(stored["values"]);
  const auto number = [&](std::size_t i, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t k = size; k-- > 0;) value = value << 8U | static_cast<std::uint8_t>(bytes[i * size + k]);
    return value;
  };
  std::vector<float> list;
  if (stored.contains("known")) {
    const std::size_t size = stored["known"].size() <= 256 ? 1 : 2;
    for (std::size_t i = 0; i < bytes.size() / size; ++i) {
      const Json& value = stored["known"].at(number(i, size));
      list.push_back(value.is_null() ? std::numeric_limits<float>::quiet_NaN() : value.get<float>());
    }
  } else {
    for (std::size_t i = 0; i < bytes.size() / 4; ++i) list.push_back(std::bit_cast<float>(number(i, 4)));
  }
  if (!stored.contains("by")) return list;
  const auto key_at = [&](int i) {
    const int x = static_cast<int>(map.x_first) + (map.x_last < map.x_first ? -1 : 1) * (i % map.width);
    const int y = static_cast<int>(map.y_first) + (map.y_last < map.y_first ? -1 : 1) * (i / map.width);
    return stored["by"] == "product" ? x * y : x + y;
  };
  std::set<int> keys;
  for (int i = 0; i < map.width * map.height; ++i) keys.insert(key_at(i));
  EXPECT_EQ(keys.size(), list.size());
  std::vector<float> values;
  const std::vector<int> ascending(keys.begin(), keys.end());
  for (int i = 0; i < map.width * map.height; ++i) {
    const auto at = std::lower_bound(ascending.begin(), ascending.end(), key_at(i)) - ascending.begin();
    values.push_back(list.at(static_cast<std::size_t>(at)));
  }
  return values;
}

// A map of x from `first` to `last` and y from `last` down to `first`.
HeatMap map_of(int first, int last, const std::function<double(int x, int y)>& value) {
  HeatMap map{.file = "a", .title = "a", .x_label = "x", .y_label = "y", .values = {}};
  map.x_first = map.y_last = first;
  map.x_last = map.y_first = last;
  map.width = map.height = last - first + 1;
  for (int y = last; y >= first; --y) {
    for (int x = first; x <= last; ++x) map.values.push_back(static_cast<float>(value(x, y)));
  }
  return map;
}

Json stored_form(const HeatMap& map) {
  Json out;
  put_map_values(map, out);
  return out;
}

void expect_same_bits(const HeatMap& map, const Json& stored) {
  const std::vector<float> back = restored(map, stored);
  ASSERT_EQ(back.size(), map.values.size());
  for (std::size_t i = 0; i < back.size(); ++i) {
    if (std::isnan(map.values[i])) {
      ASSERT_TRUE(std::isnan(back[i])) << i;
    } else {
      ASSERT_EQ(std::bit_cast<std::uint32_t>(back[i]), std::bit_cast<std::uint32_t>(map.values[i])) << i;
    }
  }
}

TEST(MapValues, AFunctionOfProductsIsStoredByProduct) {
  const HeatMap map = map_of(-255, 255, [](int x, int y) { return std::trunc(x * y / 255.0) - x * y / 255.0; });
  const Json stored = stored_form(map);
  EXPECT_EQ(stored["by"], "product");
  EXPECT_LT(stored["values"].get<std::string>().size(), 100000U);  // of 511 x 511 values
  expect_same_bits(map, stored);
}

TEST(MapValues, AFunctionOfSumsIsStoredBySum) {
  const HeatMap map = map_of(-100, 100, [](int x, int y) { return std::sin(x + y); });
  const Json stored = stored_form(map);
  EXPECT_EQ(stored["by"], "sum");
  expect_same_bits(map, stored);
}

TEST(MapValues, OneOtherValueIsNotLost) {
  for (const bool product : {false, true}) {
    HeatMap map = map_of(0, 99, [&](int x, int y) { return product ? x * y % 7 : (x + y) % 7; });
    map.values[4321] = 8.0F;
    const Json stored = stored_form(map);
    EXPECT_FALSE(stored.contains("by"));
    EXPECT_EQ(stored["known"].size(), 8U);
    expect_same_bits(map, stored);
  }
}

TEST(MapValues, AnyMapComesBack) {
  test::Random random(41);
  for (const int values : {1, 2, 255, 256, 257, 3000, 1000000}) {
    HeatMap map = map_of(-120, 120, [&](int, int) { return random.below(values) / 3.0; });
    map.values[17] = std::numeric_limits<float>::quiet_NaN();
    map.values[18] = -0.0F;
    const Json stored = stored_form(map);
    EXPECT_EQ(stored.contains("known"), values <= 3000) << values;
    expect_same_bits(map, stored);
  }
}

TEST(MapValues, CoordinatesThatAreNotWholeNumbersAreNotMultiplied) {
  HeatMap map = map_of(0, 99, [](int x, int y) { return x * y; });
  map.x_last = 49.5;
  EXPECT_FALSE(stored_form(map).contains("by"));
  map.x_last = 99.0;
  EXPECT_TRUE(stored_form(map).contains("by"));
  map.y_values.resize(100);
  EXPECT_FALSE(stored_form(map).contains("by"));
}

}  // namespace
