// Values of texture-shader stages, as text and as JSON.
#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <utility>

#include "ninebit/language/trace_json.h"

namespace ninebit {
namespace {

using OrderedJson = nlohmann::ordered_json;

std::string text_of(float number) {
  std::array<char, 32> digits{};
  (void)std::snprintf(digits.data(), digits.size(), "%.6g", static_cast<double>(number));
  return digits.data();
}

// "(1, 2, 3)".
template <class T, std::size_t N>
std::string listed(const std::array<T, N>& numbers) {
  std::string text;
  for (const T number : numbers) text += (text.empty() ? "(" : ", ") + text_of(static_cast<float>(number));
  return text + ')';
}

}  // namespace

std::string stage_text(const StageValues& stage) {
  std::string text;
  const auto add = [&](const std::string& part) { text += (text.empty() ? "" : ", ") + part; };
  if (stage.coordinates != std::array<float, 4>{}) add("s, t, r, q = " + listed(stage.coordinates));
  if (stage.dot) add("dot product " + text_of(*stage.dot) + " with " + listed(*stage.normal));
  if (stage.at) add("texture read at " + listed(*stage.at));
  if (stage.at && stage.fetched != stage.texel)
    add("texel " + listed(stage.fetched) + " becomes " + listed(stage.texel));
  if (!stage.at || stage.fetched == stage.texel) add("texel " + listed(stage.texel));
  const bool same = std::equal(stage.codes.begin(), stage.codes.end(), stage.texel.begin());
  return same ? text : text + ", codes " + listed(stage.codes);
}

std::string print_json_stages(const TextureShaderResult& result) {
  OrderedJson stages = OrderedJson::array();
  for (const StageValues& stage : result.stage) {
    OrderedJson one{{"text", stage_text(stage)}, {"coordinates", stage.coordinates}};
    if (stage.normal) one["normal"] = *stage.normal;
    if (stage.dot) one["dot"] = *stage.dot;
    if (stage.at) {
      one["at"] = *stage.at;
      one["fetched"] = stage.fetched;
    }
    one["texel"] = stage.texel;
    one["codes"] = stage.codes;
    stages.push_back(std::move(one));
  }
  const OrderedJson json{{"culled", result.is_culled},
                         {"depth", result.depth ? OrderedJson(*result.depth) : OrderedJson()},
                         {"stages", std::move(stages)}};
  return json.dump(2);
}

}  // namespace ninebit
