#include "src/tools/draw/fragment_words.h"

#include <fmt/format.h>

#include <string>
#include <vector>

#include "src/effect/effect_words.h"
#include "src/system/number_list.h"

namespace ninebit::tools {
namespace {

std::vector<std::string> comma_words(const std::string& text) {
  std::vector<std::string> words{""};
  for (const char c : text) {
    if (c == ',') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  return words;
}

}  // namespace

Result<Blend> parse_blend(std::string_view text) {
  using namespace effect_detail;
  const auto words = comma_words(std::string(text));
  Blend blend{.enabled = true};
  const auto source = value_of(kBlendFactors, words[0]);
  const auto destination = value_of(kBlendFactors, words.size() > 1 ? words[1] : "");
  const auto equation = value_of(kBlendEquations, words.size() > 2 ? words[2] : "add");
  if (!source || !destination || !equation || words.size() > 3) {
    return Diagnostic{.message = fmt::format("'{}' is not a blend; expected SOURCE,DESTINATION[,EQUATION] with the "
                                             "factors {}, and the equation {}",
                                             text, list_of(kBlendFactors), list_of(kBlendEquations))};
  }
  blend.source = *source;
  blend.destination = *destination;
  blend.equation = *equation;
  return blend;
}

Result<AlphaTest> parse_alpha_test(std::string_view text) {
  using namespace effect_detail;
  const auto words = comma_words(std::string(text));
  const auto function = value_of(kCompareFunctions, words[0]);
  const auto reference = words.size() == 2 ? numbers<int>(words[1], ',') : std::nullopt;
  if (!function || !reference || reference->at(0) < 0 || reference->at(0) > 255) {
    return Diagnostic{.message = fmt::format("'{}' is not an alpha test; expected FUNCTION,REFERENCE with {}, and a "
                                             "reference from 0 to 255",
                                             text, list_of(kCompareFunctions))};
  }
  return AlphaTest{true, *function, static_cast<std::uint8_t>(reference->at(0))};
}

Result<DepthTest> parse_depth(std::string_view text) {
  if (text == "none") return DepthTest{};
  const auto function = effect_detail::value_of(effect_detail::kCompareFunctions, text);
  if (function) return DepthTest{.enabled = true, .function = *function};
  return Diagnostic{.message = fmt::format("'{}' is not a depth test; expected none, {}", text,
                                           effect_detail::list_of(effect_detail::kCompareFunctions))};
}

Result<std::array<bool, 4>> parse_color_mask(std::string_view text) {
  std::array<bool, 4> mask{};
  bool valid = !text.empty();
  for (const char c : text == "none" ? "" : text) {
    const std::size_t component = std::string_view("rgba").find(c);
    valid = valid && component != std::string_view::npos;
    if (valid) mask[component] = true;
  }
  if (valid) return mask;
  return Diagnostic{.message = fmt::format("'{}' is not a colour mask; expected letters of rgba, or none", text)};
}

}  // namespace ninebit::tools
