#include "src/study/report/map_values.h"

#include <bit>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <unordered_map>
#include <vector>

#include "src/system/hashing/base64.h"

namespace ninebit {
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
