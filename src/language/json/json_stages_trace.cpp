// Values of texture-shader stages, as text and as JSON.
#include <algorithm>
#include <array>
#include <cstdio>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

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

// The stages whose dot products stage i turns into a place or a depth.
std::vector<int> stages_of_dots(TextureOperation operation, int i) {
  std::vector<int> stages;
  // The diffuse look-up reads the dot product of the next stage, too.
  const int last = operation == TextureOperation::dot_product_diffuse_cube_map ? i + 1 : i;
  for (int k = i - info_of(operation).dots_before; k <= last; ++k) stages.push_back(k);
  return stages;
}

}  // namespace

std::string stage_text(const StageValues& stage) {
  const TextureOperationInfo& info = info_of(stage.operation);
  std::string text(info.name);
  if (info.input != StageInput::none) text += " by stage " + std::to_string(stage.previous);
  if (!stage.is_consistent) text += ", which is inconsistent";
  const auto add = [&](const std::string& part) { text += ", " + part; };
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
  for (int i = 0; i < kTextureStages; ++i) {
    const StageValues& stage = result.stage[static_cast<std::size_t>(i)];
    const TextureOperationInfo& info = info_of(stage.operation);
    OrderedJson one{{"text", stage_text(stage)}, {"operation", info.name}};
    if (!stage.is_consistent) one["inconsistent"] = true;
    if (info.input != StageInput::none) one["previous"] = stage.previous;
    if (info.dots_before > 0) one["dot_products"] = stages_of_dots(stage.operation, i);
    one["coordinates"] = stage.coordinates;
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
