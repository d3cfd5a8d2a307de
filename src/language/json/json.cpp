// Parses a program.
#include "ninebit/language/json.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <utility>

#include "ninebit/combiner/validate.h"
#include "src/language/json/json_reader.h"
#include "src/language/json/json_texture_shader.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/system/digits.h"
#include "src/system/nearest_name.h"

namespace ninebit {
namespace {

using json::Reader;
using json::Type;
using json::Value;

constexpr std::array kInputs{Register::zero,      Register::constant0,
                             Register::constant1, Register::fog,
                             Register::primary,   Register::secondary,
                             Register::spare0,    Register::spare1,
                             Register::texture0,  Register::texture1,
                             Register::texture2,  Register::texture3,
                             Register::e_times_f, Register::spare0_plus_secondary};
constexpr std::array kOutputs{Register::discard,  Register::primary,  Register::secondary,
                              Register::spare0,   Register::spare1,   Register::texture0,
                              Register::texture1, Register::texture2, Register::texture3};
constexpr std::array kUsages{ComponentUsage::rgb, ComponentUsage::alpha, ComponentUsage::blue};
constexpr std::array kScales{Scale::none, Scale::by_two, Scale::by_four, Scale::by_one_half};
constexpr std::array kBiases{Bias::none, Bias::by_negative_one_half};

class ProgramReader {
 public:
  ProgramReader(std::string_view text, TextFaults& faults) : read_(text, faults) {}

  CombinerState read(const Value& root) {
    if (!read_.object(root,
                      {"ninebit", "version", "num_general_combiners", "color_sum_clamp", "per_stage_constants",
                       "mux_by_lowest_bit", "color_sum_invert_spare0", "color_sum_invert_secondary", "constant_color0",
                       "constant_color1", "general_combiners", "final_combiner", "other_words", "texture_shader"})) {
      return state_;
    }
    read_.heading(root, "program", true);
    Reader::with(root, "num_general_combiners", [&](const Value& value) {
      count_ = value.offset;
      read_.integer(value, 1, kMaxGeneralCombiners, state_.num_general_combiners, GlError::invalid_value);
    });
    Reader::with(root, "color_sum_clamp", [&](const Value& value) { read_.boolean(value, state_.color_sum_clamp); });
    Reader::with(root, "per_stage_constants", [&](const Value& value) {
      per_stage_ = value.offset;
      read_.boolean(value, state_.per_stage_constants);
    });
    Reader::with(root, "mux_by_lowest_bit", [&](const Value& value) {
      mux_ = value.offset;
      read_.boolean(value, state_.mux_by_lowest_bit);
    });
    Reader::with(root, "color_sum_invert_spare0", [&](const Value& value) {
      inverts_ = value.offset;
      read_.boolean(value, state_.color_sum_invert_spare0);
    });
    Reader::with(root, "color_sum_invert_secondary", [&](const Value& value) {
      if (inverts_ == 0) inverts_ = value.offset;
      read_.boolean(value, state_.color_sum_invert_secondary);
    });
    constants(root, state_.constant0, state_.constant1, given_[kFinalConstants]);
    Reader::with(root, "general_combiners", [&](const Value& value) { stages(value); });
    Reader::with(root, "final_combiner", [&](const Value& value) { final_combiner(value); });
    Reader::with(root, "other_words", [&](const Value& value) { other_words(value); });
    Reader::with(root, "texture_shader",
                 [&](const Value& value) { stages_ = json::read_texture_shader(value, read_); });
    mark_unset_constants(state_, given_);
    return state_;
  }

  [[nodiscard]] std::vector<RegisterWord> take_other_words() { return std::move(other_words_); }
  [[nodiscard]] const json::PlacedTextureShader& texture_shader() const { return stages_; }
  void check_texture_shader(const HardwareProfile& profile) { json::check_texture_shader(stages_, profile, read_); }

  // The place in the text that a diagnostic refers to.
  [[nodiscard]] TextPlace place_of(const StateDiagnostic& found) const {
    if (found.stage && found.portion) {
      const auto stage = static_cast<std::size_t>(*found.stage);
      const auto portion = static_cast<std::size_t>(*found.portion);
      const std::size_t part = found.variable ? static_cast<std::size_t>(*found.variable) : kOutputPart;
      return read_.place(general_[stage][portion][part]);
    }
    if (found.variable) return read_.place(final_[static_cast<std::size_t>(*found.variable)]);
    switch (found.parameter.value_or(StateParameter::num_general_combiners)) {
      case StateParameter::num_general_combiners:
        return read_.place(count_);
      case StateParameter::per_stage_constants:
        return read_.place(per_stage_);
      case StateParameter::mux_by_lowest_bit:
        return read_.place(mux_);
      case StateParameter::color_sum_inverts:
        return read_.place(inverts_);
    }
    return {};
  }

 private:
  static constexpr std::size_t kOutputPart = 4;

  void constants(const Value& object, ColorF& constant0, ColorF& constant1, std::array<bool, 2>& given) {
    const auto read = [&](std::string_view key, ColorF& into, bool& is_given) {
      Reader::with(object, key, [&](const Value& value) {
        color(value, into);
        is_given = true;
      });
    };
    read("constant_color0", constant0, given[0]);
    read("constant_color1", constant1, given[1]);
  }

  void color(const Value& value, ColorF& into) {
    if (value.type != Type::array || value.children.size() != 4) {
      return read_.fault(value.offset, value.key + " must be an array of 4 numbers: red, green, blue, alpha");
    }
    for (std::size_t i = 0; i < 4; ++i) read_.fraction(value.children[i], into[i]);
  }

  void stages(const Value& value) {
    if (value.type != Type::array) return read_.wrong_type(value, "an array");
    for (std::size_t i = 0; i < value.children.size(); ++i) {
      if (i >= state_.general.size()) {
        return read_.fault(value.children[i].offset, "there are at most 8 general combiners", GlError::invalid_value);
      }
      stage(value.children[i], i);
    }
  }

  void stage(const Value& value, std::size_t index) {
    GeneralCombiner& into = state_.general[index];
    if (!read_.object(value, {"rgb", "alpha", "constant_color0", "constant_color1"})) return;
    Reader::with(value, "rgb", [&](const Value& part) { portion(part, into.rgb, general_[index][0]); });
    Reader::with(value, "alpha", [&](const Value& part) { portion(part, into.alpha, general_[index][1]); });
    constants(value, into.constant0, into.constant1, given_[index]);
  }

  void portion(const Value& value, Portion& into, std::array<std::size_t, 5>& offsets) {
    if (!read_.object(value, {"a", "b", "c", "d", "output"})) return;
    const std::pair<std::string_view, CombinerInput*> inputs[] = {
        {"a", &into.a}, {"b", &into.b}, {"c", &into.c}, {"d", &into.d}};
    for (std::size_t i = 0; i < 4; ++i) {
      Reader::with(value, inputs[i].first, [&](const Value& part) {
        offsets[i] = part.offset;
        input(part, *inputs[i].second);
      });
    }
    Reader::with(value, "output", [&](const Value& part) {
      offsets[kOutputPart] = part.offset;
      output(part, into.out);
    });
  }

  void input(const Value& value, CombinerInput& into) {
    if (!read_.object(value, {"input", "mapping", "usage"})) return;
    Reader::with(value, "input",
                 [&](const Value& part) { name<Register>(part, kInputs, "input", into.reg, kOutputs); });
    Reader::with(value, "mapping",
                 [&](const Value& part) { name<InputMapping>(part, kInputMappings, "input mapping", into.mapping); });
    Reader::with(value, "usage",
                 [&](const Value& part) { name<ComponentUsage>(part, kUsages, "component usage", into.usage); });
  }

  void output(const Value& value, PortionOutput& into) {
    if (!read_.object(value, {"ab", "cd", "sum", "scale", "bias", "ab_dot_product", "cd_dot_product", "mux_sum",
                              "ab_blue_to_alpha", "cd_blue_to_alpha"}))
      return;
    Reader::with(value, "ab", [&](const Value& part) { name<Register>(part, kOutputs, "output", into.ab, kInputs); });
    Reader::with(value, "cd", [&](const Value& part) { name<Register>(part, kOutputs, "output", into.cd, kInputs); });
    Reader::with(value, "sum", [&](const Value& part) { name<Register>(part, kOutputs, "output", into.sum, kInputs); });
    Reader::with(value, "scale", [&](const Value& part) { name<Scale>(part, kScales, "scale", into.scale); });
    Reader::with(value, "bias", [&](const Value& part) { name<Bias>(part, kBiases, "bias", into.bias); });
    Reader::with(value, "ab_dot_product", [&](const Value& part) { read_.boolean(part, into.ab_dot_product); });
    Reader::with(value, "cd_dot_product", [&](const Value& part) { read_.boolean(part, into.cd_dot_product); });
    Reader::with(value, "mux_sum", [&](const Value& part) { read_.boolean(part, into.mux_sum); });
    Reader::with(value, "ab_blue_to_alpha", [&](const Value& part) { read_.boolean(part, into.ab_blue_to_alpha); });
    Reader::with(value, "cd_blue_to_alpha", [&](const Value& part) { read_.boolean(part, into.cd_blue_to_alpha); });
  }

  void final_combiner(const Value& value) {
    if (!read_.object(value, {"a", "b", "c", "d", "e", "f", "g"})) return;
    FinalCombiner& f = state_.final_combiner;
    const std::pair<std::string_view, CombinerInput*> inputs[] = {{"a", &f.a}, {"b", &f.b}, {"c", &f.c}, {"d", &f.d},
                                                                  {"e", &f.e}, {"f", &f.f}, {"g", &f.g}};
    for (std::size_t i = 0; i < 7; ++i) {
      Reader::with(value, inputs[i].first, [&](const Value& part) {
        final_[i] = part.offset;
        input(part, *inputs[i].second);
      });
    }
  }

  void other_words(const Value& value) {
    if (value.type != Type::object) return read_.wrong_type(value, "an object");
    for (const Value& child : value.children) {
      const std::optional<std::uint32_t> word = json::word_of(child);
      if (std::find(kOtherWordNames.begin(), kOtherWordNames.end(), child.key) == kOtherWordNames.end()) {
        read_.fault(child.key_offset, "unknown word " + json::in_quotes(child.key) + "; expected PSTextureModes, …" +
                                          did_you_mean(child.key, kOtherWordNames));
      } else if (!word) {
        read_.fault(child.offset, child.key + " must be a string such as \"0x00000021\" or a whole number below 2^32");
      } else {
        other_words_.push_back({child.key, *word, read_.place(child.key_offset)});
      }
    }
  }

  template <class Enum>
  void name(const Value& value, std::span<const Enum> allowed, std::string_view what, Enum& into,
            std::span<const Enum> refused = {}) {
    read_.name<Enum>(value, allowed, what, into, refused);
  }

  Reader read_;
  CombinerState state_{};
  ByConstant<bool> given_{};  // constants
  std::size_t count_ = 0, per_stage_ = 0, mux_ = 0, inverts_ = 0;
  std::array<std::array<std::array<std::size_t, 5>, 2>, kMaxGeneralCombiners> general_{};
  std::array<std::size_t, 7> final_{};
  std::vector<RegisterWord> other_words_;
  json::PlacedTextureShader stages_;
};

}  // namespace

Parsed<CombinerState> parse_json_program(const SourceText& source, const HardwareProfile& profile,
                                         std::vector<RegisterWord>* other_words, TextureShaderState* texture_shader) {
  TextFaults faults(source.file);
  if (too_long(source.text, faults)) return faults.take();
  const std::optional<Value> root = json::read_tree(source.text, faults);
  if (!root) return faults.take();
  ProgramReader reader(source.text, faults);
  const CombinerState state = reader.read(*root);
  for (const StateDiagnostic& found : validate(state, profile)) {
    faults.add(reader.place_of(found), found.message, found.gl_error);
  }
  reader.check_texture_shader(profile);
  if (!faults.empty()) return faults.take();
  if (other_words != nullptr) *other_words = reader.take_other_words();
  if (texture_shader != nullptr) *texture_shader = reader.texture_shader().state;
  return state;
}

// Prints a program. Each input and each output is on one line, which is easier to read.
namespace {

std::string number(float value) {
  if (!(value > 0.0F)) return "0";
  if (value >= 1.0F) return "1";
  return digits_of(value);
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

std::string print_json_program(const CombinerState& state, std::span<const RegisterWord> other_words,
                               const TextureShaderState& texture_shader) {
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
  text += "  }";
  if (!other_words.empty()) text += ",\n  \"other_words\": {\n";
  for (const RegisterWord& word : other_words) {
    text += "    " + member(word.name, words::hex_text(word.value)) + (&word == &other_words.back() ? "\n  }" : ",\n");
  }
  if (texture_shader.enabled) text += ",\n  \"texture_shader\": " + json::texture_shader_text(texture_shader, "  ");
  return text + "\n}\n";
}

// Register words as a JSON object.

using json::Type;
using json::Value;

std::optional<std::uint32_t> json::word_of(const Value& value) {
  if (value.type != Type::string && value.type != Type::number) return std::nullopt;
  std::string_view digits = value.text;
  int base = 10;
  if (value.type == Type::string) {
    if (!digits.starts_with("0x") && !digits.starts_with("0X")) return std::nullopt;
    digits.remove_prefix(2);
    base = 16;
  }
  std::uint32_t word = 0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), word, base);
  if (digits.empty() || error != std::errc{} || end != digits.data() + digits.size()) return std::nullopt;
  return word;
}

Parsed<CombinerState> parse_json_register_words(const SourceText& source, ChipClass chip,
                                                const HardwareProfile& profile,
                                                std::vector<RegisterWord>* other_words) {
  TextFaults faults(source.file);
  if (too_long(source.text, faults)) return faults.take();
  const std::optional<Value> root = json::read_tree(source.text, faults);
  if (!root) return faults.take();
  json::Reader reader(source.text, faults);
  std::vector<RegisterWord> found;
  if (root->type != Type::object) {
    reader.wrong_type(*root, "an object");
    return faults.take();
  }
  reader.heading(*root, "register_words", false);
  for (const Value& child : root->children) {
    if (child.key == "ninebit" || child.key == "version") continue;
    if (child.key == "chip") {
      if (child.type != Type::string || child.text != name_of(chip)) {
        reader.fault(child.offset, "\"chip\" must be " + json::in_quotes(name_of(chip)) + " here");
      }
      continue;
    }
    const bool name_is_text = json::in_quotes(child.key) == '"' + child.key + '"';
    const std::optional<std::uint32_t> word = json::word_of(child);
    if (!name_is_text) {
      reader.fault(child.key_offset, json::in_quotes(child.key) + " is not a register word");
    } else if (!word) {
      reader.fault(child.offset, child.key + " must be a string such as \"0x08040000\" or a whole number below 2^32");
    } else {
      found.push_back({child.key, *word, reader.place(child.key_offset)});
    }
  }
  Parsed<CombinerState> decoded = decode_register_words(found, source.file, chip, profile, other_words);
  if (faults.empty()) return decoded;
  faults.add(decoded.faults());
  return faults.take();
}

Result<std::string> print_json_register_words(const CombinerState& state, ChipClass chip,
                                              const HardwareProfile& profile,
                                              std::span<const RegisterWord> other_words) {
  const auto words = encode_register_words(state, chip, profile);
  if (!words) return words.error();
  std::string text = "{\n  \"ninebit\": \"register_words\",\n  \"version\": 1,\n  \"chip\": \"";
  text += std::string(name_of(chip)) + '"';
  const auto add = [&](const RegisterWord& word) {
    text += ",\n  \"" + word.name + "\": \"" + words::hex_text(word.value) + '"';
  };
  std::for_each(words->begin(), words->end(), add);
  if (chip == ChipClass::nv20) std::for_each(other_words.begin(), other_words.end(), add);
  return text + "\n}\n";
}

}  // namespace ninebit
