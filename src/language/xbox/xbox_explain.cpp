// Explains the words that combiners do not read.
#include <algorithm>

#include "ninebit/language/xbox_pixel_shader.h"
#include "src/language/register_words/register_words_layout.h"
#include "src/language/xbox/xbox_expression.h"

namespace ninebit {
namespace xbox {
namespace {

using words::bits;
using Phrases = std::vector<std::string>;

// By the values of kTextureModes.
constexpr std::string_view kModeMeanings[] = {"no texture",
                                              "2D, projective",
                                              "3D, projective",
                                              "cube map",
                                              "the coordinates as a colour",
                                              "drops fragments by the signs of the coordinates",
                                              "2D, moved by a bump map",
                                              "2D, moved by a bump map with luminance",
                                              "light from a 3D texture",
                                              "2D at two dot products",
                                              "depth from two dot products",
                                              "cube map at three dot products, diffuse",
                                              "cube map at a reflection",
                                              "3D at three dot products",
                                              "cube map at three dot products",
                                              "2D at another texture's alpha and red",
                                              "2D at another texture's green and blue",
                                              "one of several dot products",
                                              "cube map at a reflection of a constant eye vector"};
static_assert(std::size(kModeMeanings) == kTextureModes.size());

// "texture 0: A" and "textures 1 to 3: B", where parts beside each other say the same.
Phrases grouped(const std::string& part, int first, const std::vector<std::string>& texts) {
  Phrases phrases;
  for (std::size_t i = 0; i < texts.size();) {
    std::size_t end = i + 1;
    while (end < texts.size() && texts[end] == texts[i]) ++end;
    const auto number = [&](std::size_t at) { return std::to_string(static_cast<std::size_t>(first) + at); };
    phrases.push_back(part + (end - i > 1 ? "s " + number(i) + " to " + number(end - 1) : " " + number(i)) + ": " +
                      texts[i]);
    i = end;
  }
  return phrases;
}

void add_unknown_bits(std::uint32_t word, std::uint32_t known, Phrases& into) {
  if ((word & ~known) != 0) into.push_back("unknown " + words::bits_text(word & ~known));
}

Phrases texture_modes(std::uint32_t word) {
  std::vector<std::string> texts;
  for (int unit = 0; unit < 4; ++unit) {
    const std::uint32_t mode = bits(word, 5 * unit, 5);
    texts.push_back(mode < kTextureModes.size()
                        ? std::string(kTextureModes[mode]) + " (" + std::string(kModeMeanings[mode]) + ")"
                        : "reserved mode " + words::hex_text(mode, 2));
  }
  Phrases phrases = grouped("texture", 0, texts);
  add_unknown_bits(word, 0xfffff, phrases);
  return phrases;
}

Phrases dot_mappings(std::uint32_t word) {
  std::vector<std::string> texts;
  for (int unit = 1; unit < 4; ++unit) texts.emplace_back(kDotMappings[bits(word, 4 * (unit - 1), 3)]);
  Phrases phrases = grouped("texture", 1, texts);
  add_unknown_bits(word, 0x777, phrases);
  return phrases;
}

Phrases compare_modes(std::uint32_t word) {
  std::vector<std::string> texts;
  for (int unit = 0; unit < 4; ++unit) {
    std::string text = "a clip plane keeps";
    for (int k = 0; k < 4; ++k) {
      text += std::string(k == 0 ? " " : ", ") + "strq"[k] + (bits(word, 4 * unit + k, 1) != 0 ? " ≥ 0" : " < 0");
    }
    texts.push_back(std::move(text));
  }
  Phrases phrases = grouped("texture", 0, texts);
  add_unknown_bits(word, 0xffff, phrases);
  return phrases;
}

Phrases input_textures(std::uint32_t word) {
  Phrases phrases = grouped("texture", 1,
                            {"reads texture 0", "reads texture " + std::to_string(bits(word, 16, 4)),
                             "reads texture " + std::to_string(bits(word, 20, 4))});
  add_unknown_bits(word, 0x00ff0000, phrases);
  return phrases;
}

std::string constant_place(std::uint32_t index) {
  // Tools write 15 where nothing replaces a constant.
  return "Direct3D's c" + std::to_string(index) + (index == 15 ? ", or none" : "");
}

Phrases stage_constants(std::uint32_t word, int constant) {
  std::vector<std::string> texts;
  for (int stage = 0; stage < 8; ++stage) {
    texts.push_back("const" + std::to_string(constant) + " is " + constant_place(bits(word, 4 * stage, 4)));
  }
  return grouped("stage", 0, texts);
}

Phrases final_constants(std::uint32_t word) {
  Phrases phrases;
  for (int constant = 0; constant < 2; ++constant) {
    phrases.push_back("final combiner: const" + std::to_string(constant) + " is " +
                      constant_place(bits(word, 4 * constant, 4)));
  }
  phrases.push_back(bits(word, 8, 1) != 0 ? "texture modes follow the kind of the texture that is set"
                                          : "texture modes stay as they are");
  add_unknown_bits(word, 0x1ff, phrases);
  return phrases;
}

}  // namespace
}  // namespace xbox

std::vector<std::string> explain_other_word(const RegisterWord& word) {
  if (word.name == "PSTextureModes") return xbox::texture_modes(word.value);
  if (word.name == "PSDotMapping") return xbox::dot_mappings(word.value);
  if (word.name == "PSCompareMode") return xbox::compare_modes(word.value);
  if (word.name == "PSInputTexture") return xbox::input_textures(word.value);
  if (word.name == "PSC0Mapping") return xbox::stage_constants(word.value, 0);
  if (word.name == "PSC1Mapping") return xbox::stage_constants(word.value, 1);
  if (word.name == "PSFinalCombinerConstants") return xbox::final_constants(word.value);
  return {};
}

}  // namespace ninebit
