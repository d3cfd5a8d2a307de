// Prints a program. Each input and each output is on one line, which is easier to read.
#include <charconv>

#include "ninebit/language/json.h"
#include "src/language/register_words/register_words_layout.h"

namespace ninebit {
namespace {

std::string number(float value) {
  if (!(value > 0.0F)) return "0";
  if (value >= 1.0F) return "1";
  // The shortest digits that parse to the same float.
  char digits[32];
  const auto [end, error] = std::to_chars(std::begin(digits), std::end(digits), value);
  return std::string(digits, end);
}

std::string array(const ColorF& color) {
  return '[' + number(color[0]) + ", " + number(color[1]) + ", " + number(color[2]) + ", " + number(color[3]) + ']';
}

std::string member(std::string_view key, std::string_view name) {
  return '"' + std::string(key) + "\": \"" + std::string(name) + '"';
}

std::string member(std::string_view key, bool value) {
  return '"' + std::string(key) + "\": " + (value ? "true" : "false");
}

std::string object(const CombinerInput& in) {
  return "{" + member("input", name_of(in.reg)) + ", " + member("mapping", name_of(in.mapping)) + ", " +
         member("usage", name_of(in.usage)) + '}';
}

// Features that GL does not have are printed only if they are set.
std::string if_set(std::string_view key, bool value) {
  return value ? ", " + member(key, true) : "";
}

std::string object(const PortionOutput& out) {
  return "{" + member("ab", name_of(out.ab)) + ", " + member("cd", name_of(out.cd)) + ", " +
         member("sum", name_of(out.sum)) + ", " + member("scale", name_of(out.scale)) + ", " +
         member("bias", name_of(out.bias)) + ", " + member("ab_dot_product", out.ab_dot_product) + ", " +
         member("cd_dot_product", out.cd_dot_product) + ", " + member("mux_sum", out.mux_sum) +
         if_set("ab_blue_to_alpha", out.ab_blue_to_alpha) + if_set("cd_blue_to_alpha", out.cd_blue_to_alpha) + '}';
}

std::string portion_text(std::string_view key, const Portion& p) {
  std::string text = "      \"" + std::string(key) + "\": {\n";
  const std::pair<char, const CombinerInput*> inputs[] = {{'a', &p.a}, {'b', &p.b}, {'c', &p.c}, {'d', &p.d}};
  for (const auto& [letter, input] : inputs)
    text += std::string("        \"") + letter + "\": " + object(*input) + ",\n";
  return text + "        \"output\": " + object(p.out) + "\n      },\n";
}

// Constants that nobody set are left out.
std::string constant_text(std::string_view key, const ColorF& color, bool unset) {
  return unset ? "" : '"' + std::string(key) + "\": " + array(color) + ",\n";
}

std::string stage_text(const CombinerState& state, std::size_t i) {
  const GeneralCombiner& stage = state.general[i];
  std::string text = "    {\n" + portion_text("rgb", stage.rgb) + portion_text("alpha", stage.alpha);
  for (std::size_t which = 0; which < 2; ++which) {
    const std::string constant = constant_text(which == 0 ? "constant_color0" : "constant_color1",
                                               which == 0 ? stage.constant0 : stage.constant1,
                                               state.per_stage_constants && state.origin[i][which].unset);
    if (!constant.empty()) text += "      " + constant;
  }
  text.erase(text.size() - 2);  // the last comma and its line's end
  return text + "\n    }";
}

}  // namespace

std::string print_json_program(const CombinerState& state, std::span<const RegisterWord> other_words) {
  std::string text = "{\n  \"ninebit\": \"program\",\n  \"version\": 1,\n";
  text += "  \"num_general_combiners\": " + std::to_string(state.num_general_combiners) + ",\n";
  text += "  " + member("color_sum_clamp", state.color_sum_clamp) + ",\n";
  text += "  " + member("per_stage_constants", state.per_stage_constants) + ",\n";
  if (state.mux_by_lowest_bit) text += "  " + member("mux_by_lowest_bit", true) + ",\n";
  if (state.color_sum_invert_spare0) text += "  " + member("color_sum_invert_spare0", true) + ",\n";
  if (state.color_sum_invert_secondary) text += "  " + member("color_sum_invert_secondary", true) + ",\n";
  if (!is_shared_constant_unset(state, 0)) text += "  " + constant_text("constant_color0", state.constant0, false);
  if (!is_shared_constant_unset(state, 1)) text += "  " + constant_text("constant_color1", state.constant1, false);
  std::size_t stages = state.general.size();
  while (stages > 0 && static_cast<int>(stages) > state.num_general_combiners &&
         state.general[stages - 1] == GeneralCombiner{}) {
    --stages;
  }
  text += "  \"general_combiners\": [\n";
  for (std::size_t i = 0; i < stages; ++i) text += stage_text(state, i) + (i + 1 < stages ? ",\n" : "\n");
  text += "  ],\n  \"final_combiner\": {\n";
  const FinalCombiner& f = state.final_combiner;
  const CombinerInput* const inputs[] = {&f.a, &f.b, &f.c, &f.d, &f.e, &f.f, &f.g};
  for (std::size_t i = 0; i < 7; ++i) {
    text += std::string("    \"") + static_cast<char>('a' + i) + "\": " + object(*inputs[i]) + (i < 6 ? ",\n" : "\n");
  }
  if (other_words.empty()) return text + "  }\n}\n";
  text += "  },\n  \"other_words\": {\n";
  for (const RegisterWord& word : other_words) {
    text += "    " + member(word.name, words::hex_text(word.value)) + (&word == &other_words.back() ? "\n" : ",\n");
  }
  return text + "  }\n}\n";
}

}  // namespace ninebit
