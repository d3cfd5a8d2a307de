// Prints a definition as a C initializer.

#include "ninebit/language/xbox_pixel_shader.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/language/xbox/xbox_expression.h"
#include "src/language/xbox/xbox_fields.h"
#include "src/system/find_row.h"

namespace ninebit {
namespace xbox {
namespace {

using words::bits;

std::string call(std::string_view macro, std::initializer_list<std::string> arguments) {
  std::string text(macro);
  char before = '(';
  for (const std::string& argument : arguments) {
    text += before;
    if (before == ',') text += ' ';
    text += argument;
    before = ',';
  }
  return text + ')';
}

// Names joined by |; "0" if there are none.
class Flags {
 public:
  void add(std::string_view beginning, std::string_view name) {
    text_ += (text_.empty() ? "" : " | ") + std::string(beginning) + std::string(name);
  }
  void add_if(bool set, std::string_view name) {
    if (set) add(name, "");
  }
  [[nodiscard]] std::string take() const { return text_.empty() ? "0" : text_; }

 private:
  std::string text_;
};

// A variable of a portion or of the final combiner. `scalar`: bit 4 selects between blue and alpha.
std::string input(std::uint32_t byte, bool scalar) {
  const std::string_view name = kRegisterNames[bits(byte, 0, 4)];
  if (name.empty()) return words::hex_text(byte, 2);
  if (byte == 0) return "PS_REGISTER_ZERO";
  Flags flags;
  flags.add("PS_REGISTER_", name);
  flags.add("PS_CHANNEL_", bits(byte, words::kUsageBit, 1) != 0 ? "ALPHA" : scalar ? "BLUE" : "RGB");
  const std::uint32_t mapping = bits(byte, words::kMappingShift, 3);
  if (mapping != 0) flags.add("PS_INPUTMAPPING_", kInputMappingNames[mapping]);
  return flags.take();
}

std::string inputs(std::uint32_t word, bool scalar) {
  return call("PS_COMBINERINPUTS", {input(bits(word, 24, 8), scalar), input(bits(word, 16, 8), scalar),
                                    input(bits(word, 8, 8), scalar), input(bits(word, 0, 8), scalar)});
}

std::string final_inputs(std::uint32_t word) {
  Flags settings;
  settings.add_if(bits(word, words::kColorSumClampBit, 1) != 0, "PS_FINALCOMBINERSETTING_CLAMP_SUM");
  settings.add_if(bits(word, words::kSumInvertSecondaryBit, 1) != 0, "PS_FINALCOMBINERSETTING_COMPLEMENT_V1");
  settings.add_if(bits(word, words::kSumInvertSpare0Bit, 1) != 0, "PS_FINALCOMBINERSETTING_COMPLEMENT_R0");
  return call("PS_COMBINERINPUTS", {input(bits(word, 24, 8), false), input(bits(word, 16, 8), false),
                                    input(bits(word, 8, 8), true), settings.take()});
}

std::string output(std::uint32_t code) {
  return "PS_REGISTER_" + std::string(code == 0 ? "DISCARD" : kRegisterNames[code]);
}

std::string outputs(std::uint32_t word) {
  Flags flags;
  const std::string_view mapping = kOutputMappingNames[bits(word, words::kBiasBit, 3)];
  if (bits(word, words::kBiasBit, 3) != 0) flags.add("PS_COMBINEROUTPUT_", mapping);
  flags.add_if(bits(word, words::kAbDotBit, 1) != 0, "PS_COMBINEROUTPUT_AB_DOT_PRODUCT");
  flags.add_if(bits(word, words::kCdDotBit, 1) != 0, "PS_COMBINEROUTPUT_CD_DOT_PRODUCT");
  flags.add_if(bits(word, words::kMuxBit, 1) != 0, "PS_COMBINEROUTPUT_AB_CD_MUX");
  flags.add_if(bits(word, words::kAbBlueToAlphaBit, 1) != 0, "PS_COMBINEROUTPUT_AB_BLUE_TO_ALPHA");
  flags.add_if(bits(word, words::kCdBlueToAlphaBit, 1) != 0, "PS_COMBINEROUTPUT_CD_BLUE_TO_ALPHA");
  return call("PS_COMBINEROUTPUTS", {output(bits(word, words::kAbShift, 4)), output(bits(word, words::kCdShift, 4)),
                                     output(bits(word, words::kSumShift, 4)), flags.take()});
}

std::string count(std::uint32_t word) {
  const bool msb = bits(word, words::kNv20MuxMsbBit, 1) != 0;
  Flags flags;
  flags.add("PS_COMBINERCOUNT_MUX_", msb ? "MSB" : "LSB");
  flags.add_if(bits(word, words::kNv20Unique0Bit, 1) != 0, "PS_COMBINERCOUNT_UNIQUE_C0");
  flags.add_if(bits(word, words::kNv20Unique1Bit, 1) != 0, "PS_COMBINERCOUNT_UNIQUE_C1");
  return call("PS_COMBINERCOUNT", {std::to_string(bits(word, words::kNv20CountShift, 4)), flags.take()});
}

std::string compare_mode(std::uint32_t nibble) {
  constexpr std::string_view kNames[] = {"PS_COMPAREMODE_S_GE", "PS_COMPAREMODE_T_GE", "PS_COMPAREMODE_R_GE",
                                         "PS_COMPAREMODE_Q_GE"};
  Flags flags;
  for (int i = 0; i < 4; ++i) flags.add_if(bits(nibble, i, 1) != 0, kNames[i]);
  return flags.take();
}

// The macro that gives a word that combiners do not read; empty if none does.
std::string other(std::string_view name, std::uint32_t word) {
  const auto nibble = [&](int i) { return std::to_string(bits(word, 4 * i, 4)); };
  if (name == "PSTextureModes" && word <= 0xfffff) {
    std::string mode[4];
    for (int i = 0; i < 4; ++i) {
      const std::uint32_t value = bits(word, 5 * i, 5);
      if (value >= kTextureModes.size()) return "";
      mode[i] = "PS_TEXTUREMODES_" + std::string(kTextureModes[value]);
    }
    return call("PS_TEXTUREMODES", {mode[0], mode[1], mode[2], mode[3]});
  }
  if (name == "PSDotMapping" && (word & ~0x777U) == 0) {
    const auto mapping = [&](int i) { return "PS_DOTMAPPING_" + std::string(kDotMappings[bits(word, 4 * i, 3)]); };
    return call("PS_DOTMAPPING", {"0", mapping(0), mapping(1), mapping(2)});
  }
  if (name == "PSCompareMode" && word <= 0xffff) {
    return call("PS_COMPAREMODE", {compare_mode(bits(word, 0, 4)), compare_mode(bits(word, 4, 4)),
                                   compare_mode(bits(word, 8, 4)), compare_mode(bits(word, 12, 4))});
  }
  if (name == "PSInputTexture" && (word & ~0x310000U) == 0 && bits(word, 20, 4) < 3) {
    return call("PS_INPUTTEXTURE", {"0", "0", nibble(4), nibble(5)});
  }
  if (name == "PSC0Mapping" || name == "PSC1Mapping") {
    return call("PS_CONSTANTMAPPING",
                {nibble(0), nibble(1), nibble(2), nibble(3), nibble(4), nibble(5), nibble(6), nibble(7)});
  }
  if (name == "PSFinalCombinerConstants" && word <= 0x1ff) {
    return call("PS_FINALCOMBINERCONSTANTS",
                {nibble(0), nibble(1),
                 bits(word, 8, 1) != 0 ? "PS_GLOBALFLAGS_TEXMODE_ADJUST" : "PS_GLOBALFLAGS_NO_TEXMODE_ADJUST"});
  }
  return "";
}

// A word as an expression that has its value.
std::string expression(const Field& field, std::uint32_t word) {
  if (field.name == "PSAlphaInputs" && word != 0) return inputs(word, true);
  if ((field.name == "PSRGBInputs" || field.name == "PSFinalCombinerInputsABCD") && word != 0)
    return inputs(word, false);
  if (field.name == "PSFinalCombinerInputsEFG" && word != 0) return final_inputs(word);
  if ((field.name == "PSAlphaOutputs" || field.name == "PSRGBOutputs") && word != 0) return outputs(word);
  if (field.name == "PSCombinerCount") return count(word);
  const std::string macro = other(field.name, word);
  return !macro.empty() ? macro : word == 0 ? "0" : words::hex_text(word);
}

// A word on a line of its own, with its value behind it.
std::string word_line(std::string_view indent, const Field& field, std::uint32_t word, bool comma) {
  const std::string value = words::hex_text(word), text = expression(field, word);
  return std::string(indent) + text + (comma ? "," : "") + (word == 0 || text == value ? "" : "  // " + value) + '\n';
}

// Words at the end of an array that are 0 are left out, as C does.
std::string printed(const Definition& definition) {
  std::string text = "D3DPIXELSHADERDEF psd = {\n";
  for (const Field& field : fields()) {
    const bool last = &field == &fields().back();
    text += "  // " + std::string(field.name) + '\n';
    if (field.count == 1) {
      text += word_line("  ", field, definition.words[field.first], !last);
      continue;
    }
    std::size_t count = field.count;
    while (count > 0 && definition.words[field.first + count - 1] == 0) --count;
    if (count == 0) {
      text += "  {0},\n";
      continue;
    }
    text += "  {\n";
    for (std::size_t i = 0; i < count; ++i) {
      text += word_line("    ", field, definition.words[field.first + i], i + 1 < count);
    }
    text += "  },\n";
  }
  return text + "};\n";
}

}  // namespace
}  // namespace xbox

Result<std::string> print_xbox_pixel_shader(const CombinerState& state, const HardwareProfile& profile,
                                            std::span<const RegisterWord> other_words) {
  const auto encoded = encode_register_words(state, ChipClass::nv20, profile);
  if (!encoded) return encoded.error();
  xbox::Definition definition;
  for (std::size_t i = 0; i < kXboxDefinitionWords; ++i) {
    const std::string name = xbox::word_name(i);
    const words::FoundSlot slot = words::find_slot(name, ChipClass::nv20);
    const std::string canonical = slot.slot ? words::canonical_name(*slot.slot, ChipClass::nv20) : name;
    for (const std::span<const RegisterWord> words : {std::span<const RegisterWord>(*encoded), other_words}) {
      if (const auto* const found = find_row(words, &RegisterWord::name, canonical)) definition.words[i] = found->value;
    }
  }
  return xbox::printed(definition);
}

}  // namespace ninebit
