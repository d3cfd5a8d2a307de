// Random texts of the Xbox's dialect against the words that its assembler makes of them, by rules of their own: sources
// fill A to D in their order, mov and mul are A·B, add and mad are sums with 1, sub is C · -1, lrp has its weight in A
// and 1 - it in D, cnd is a mux with 1 in B and D, and a dot product that is written to alpha sets blue to alpha.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <optional>
#include <string>
#include <vector>

#include "combiner_tests/language/all_faults.h"
#include "combiner_tests/support/random.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/pixel_shader.h"
#include "ninebit/language/xbox_pixel_shader.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit {
namespace {

using test::Random;

std::string hex_word(std::uint32_t word) {
  std::array<char, 11> text{};
  std::snprintf(text.data(), text.size(), "0x%08x", word);
  return text.data();
}

std::uint32_t argb_of(std::uint32_t i) {
  return (128 + i) << 24 | (i * 16) << 16 | (255 - i * 15) << 8 | i * 7;
}

std::string definition_of(std::uint32_t i) {
  std::string text = "def c" + std::to_string(i);
  for (const int shift : {16, 8, 0, 24})
    text += ", " + std::to_string(static_cast<double>(argb_of(i) >> shift & 255) / 255);
  return text + "\n";
}

// A source in both portions' words.
struct WordSource {
  std::string text;
  std::uint32_t rgb = 0, alpha = 0;
};
constexpr WordSource one_word() {
  return {"", 0x20, 0x30};
}

// The constants of a stage, in the order in which they are read.
struct WordConstants {
  std::vector<std::uint32_t> used;

  std::uint32_t slot(std::uint32_t index) {
    for (std::size_t i = 0; i < used.size(); ++i) {
      if (used[i] == index) return static_cast<std::uint32_t>(i + 1);
    }
    used.push_back(index);
    return static_cast<std::uint32_t>(used.size());
  }
};

class WordMaker {
 public:
  explicit WordMaker(Random& random) : random_(random) {}

  void make() {
    text_ = "xps.1.1\n";
    for (std::uint32_t i = 0; i < 16; ++i) text_ += definition_of(i);
    const int count = random_.between(1, 8);
    for (int i = 0; i < count; ++i) stage(i);
    words_ += "PSCombinerCount = " + hex_word(0x00011100U | static_cast<std::uint32_t>(count)) + "\n";
    if (random_.one_in(2)) final_combiner();
  }
  [[nodiscard]] const std::string& text() const { return text_; }
  [[nodiscard]] const std::string& words() const { return words_; }

 private:
  enum Channels { rgb = 1, alpha = 2, both = 3 };

  struct NamedCode {
    const char* name;
    std::uint32_t code;
  };

  WordSource source(WordConstants& constants, bool weight) {
    const NamedCode reg = random_.pick({NamedCode{"zero", 0},
                                        {"v0", 4},
                                        {"v1", 5},
                                        {"t0", 8},
                                        {"t1", 9},
                                        {"t2", 10},
                                        {"t3", 11},
                                        {"r0", 12},
                                        {"r1", 13},
                                        {"fog", 3},
                                        {"c", 1},
                                        {"c", 1}});
    std::string name = reg.name;
    std::uint32_t code = reg.code;
    if (name == "c") {
      const std::uint32_t fresh = static_cast<std::uint32_t>(random_.below(16));
      const std::uint32_t index =
          constants.used.size() == 2 ? constants.used[static_cast<std::size_t>(random_.below(2))] : fresh;
      code = constants.slot(index);
      name += std::to_string(index);
    }
    const int mapping = weight ? random_.below(2) : random_.below(8);
    const std::array<std::array<const char*, 2>, 8> around{
        {{"", "_sat"}, {"1-", ""}, {"", "_bx2"}, {"-", "_bx2"}, {"", "_bias"}, {"-", "_bias"}, {"", ""}, {"-", ""}}};
    const auto& [before, behind] = around.at(static_cast<std::size_t>(mapping));
    const std::string channel = std::string(reg.name) == "fog" ? ".rgb" : random_.pick<std::string>({"", ".rgb", ".a"});
    const std::uint32_t mapped = code | static_cast<std::uint32_t>(mapping) << 5;
    return {before + name + behind + channel, mapped | (channel == ".a" ? 0x10U : 0U),
            mapped | (channel == ".rgb" ? 0U : 0x10U)};
  }

  void stage(int i) {
    WordConstants constants;
    const Channels first = random_.pick({rgb, alpha, both});
    instruction(i, first, "", constants);
    if (first != both && random_.one_in(2)) instruction(i, first == rgb ? alpha : rgb, "+", constants);
    for (std::size_t k = 0; k < constants.used.size(); ++k) {
      words_ += "PSConstant" + std::to_string(k) + "[" + std::to_string(i) +
                "] = " + hex_word(argb_of(constants.used[k])) + "\n";
    }
  }

  void instruction(int i, Channels channels, const std::string& joined, WordConstants& constants) {
    struct Form {
      const char* name;
      std::size_t targets, sources;
    };
    Form form = random_.pick({Form{"mov", 1, 1},
                              {"add", 1, 2},
                              {"sub", 1, 2},
                              {"mul", 1, 2},
                              {"mad", 1, 3},
                              {"lrp", 1, 3},
                              {"cnd", 1, 2},
                              {"xmma", 3, 4},
                              {"xmmc", 3, 4},
                              {"xdm", 2, 4},
                              {"xdd", 2, 4},
                              {"dp3", 1, 2}});
    const std::string name = form.name;
    const bool dot = name == "xdm" || name == "xdd" || name == "dp3";
    if (dot && channels == alpha) return instruction(i, channels, joined, constants);
    const NamedCode scale = random_.pick({NamedCode{"", 0},
                                          {"", 0},
                                          {"_bias", 0x8000},
                                          {"_x2", 0x10000},
                                          {"_bx2", 0x18000},
                                          {"_x4", 0x20000},
                                          {"_d2", 0x30000}});
    const std::string mask = channels == rgb ? ".rgb" : channels == alpha ? ".a" : "";
    text_ += joined + name + scale.name;
    std::vector<std::uint32_t> targets;
    for (std::size_t k = 0; k < form.targets; ++k) {
      NamedCode to{};
      do {
        to = random_.pick(
            {NamedCode{"discard", 0}, {"v0", 4}, {"v1", 5}, {"t0", 8}, {"t3", 11}, {"r0", 12}, {"r1", 13}});
      } while (to.code != 0 && std::find(targets.begin(), targets.end(), to.code) != targets.end());
      targets.push_back(to.code);
      text_ += std::string(k == 0 ? " " : ", ") + to.name + mask;
    }
    if (name == "cnd") text_ += ", r0.a";
    std::vector<WordSource> sources;
    for (std::size_t k = 0; k < form.sources; ++k) {
      sources.push_back(source(constants, name == "lrp" && k == 0));
      text_ += ", " + sources.back().text;
    }
    text_ += "\n";
    write(i, channels, name, targets, sources, scale.code);
  }

  // The words of an instruction.
  void write(int i, Channels channels, const std::string& name, std::vector<std::uint32_t> to,
             std::vector<WordSource> s, std::uint32_t flags) {
    const WordSource one = one_word(), minus_one{"", 0x40, 0x50};
    std::uint32_t ab = 0, cd = 0, sum = 0;
    if (name == "mov" || name == "mul" || name == "dp3") {
      ab = to[0];
      if (name == "mov") s.push_back(one);
      s.resize(4);
    } else if (to.size() == 1) {
      sum = to[0];
      if (name == "add" || name == "sub") s = {s[0], one, s[1], name == "sub" ? minus_one : one};
      if (name == "mad") s = {s[0], s[1], one, s[2]};
      if (name == "lrp") s = {s[0], s[1], s[2], {"", s[0].rgb ^ 0x20U, s[0].alpha ^ 0x20U}};
      if (name == "cnd") s = {s[1], one, s[0], one};
    } else {
      ab = to[0];
      cd = to[1];
      sum = to.size() > 2 ? to[2] : 0;
    }
    if (name == "cnd" || name == "xmmc") flags |= 0x4000;
    const bool dot_ab = name == "dp3" || name == "xdm" || name == "xdd", dot_cd = name == "xdd";
    const std::string index = "[" + std::to_string(i) + "] = ";
    if ((channels & rgb) != 0) {
      std::uint32_t rgb_flags = flags | (dot_ab ? 0x2000U : 0U) | (dot_cd ? 0x1000U : 0U);
      if (dot_ab && channels == both) rgb_flags |= 0x80000U;
      if (dot_cd && channels == both) rgb_flags |= 0x40000U;
      words_ += "PSRGBInputs" + index + hex_word(s[0].rgb << 24 | s[1].rgb << 16 | s[2].rgb << 8 | s[3].rgb) + "\n";
      words_ += "PSRGBOutputs" + index + hex_word(cd | ab << 4 | sum << 8 | rgb_flags) + "\n";
    }
    if ((channels & alpha) == 0 || name == "dp3" || name == "xdd") return;
    if (dot_ab) ab = 0;
    words_ +=
        "PSAlphaInputs" + index + hex_word(s[0].alpha << 24 | s[1].alpha << 16 | s[2].alpha << 8 | s[3].alpha) + "\n";
    words_ += "PSAlphaOutputs" + index + hex_word(cd | ab << 4 | sum << 8 | flags) + "\n";
  }

  void final_combiner() {
    WordConstants constants;
    std::array<std::uint32_t, 7> inputs{};
    text_ += "xfc ";
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      NamedCode reg = random_.pick({NamedCode{"zero", 0},
                                    {"fog", 3},
                                    {"v0", 4},
                                    {"v1", 5},
                                    {"t1", 9},
                                    {"r0", 12},
                                    {"r1", 13},
                                    {"sum", 14},
                                    {"prod", 15},
                                    {"c", 1}});
      const bool made = reg.code >= 14;
      if (made && (i >= 4 || (i == 0 && reg.code == 14))) reg = {"r0", 12};
      std::string name = reg.name;
      if (name == "c") {
        const std::uint32_t index =
            constants.used.size() == 2 ? constants.used[1] : static_cast<std::uint32_t>(random_.below(16));
        reg.code = constants.slot(index);
        name += std::to_string(index);
      }
      const bool inverts = random_.one_in(3);
      const std::string channel =
          reg.code >= 14 ? random_.pick<std::string>({"", ".rgb"}) : random_.pick<std::string>({"", ".rgb", ".a"});
      text_ += (i == 0 ? "" : ", ") + std::string(inverts ? "1 - " : "") + name +
               (!inverts && random_.one_in(4) ? "_sat" : "") + channel;
      inputs.at(i) = reg.code | (inverts ? 0x20U : 0U) | (channel == ".a" ? 0x10U : 0U);
    }
    text_ += "\n";
    words_ +=
        "PSFinalCombinerInputsABCD = " + hex_word(inputs[0] << 24 | inputs[1] << 16 | inputs[2] << 8 | inputs[3]) +
        "\n";
    words_ +=
        "PSFinalCombinerInputsEFG = " + hex_word(inputs[4] << 24 | inputs[5] << 16 | inputs[6] << 8 | 0x80U) + "\n";
    for (std::size_t k = 0; k < constants.used.size(); ++k) {
      words_ += "PSFinalCombinerConstant" + std::to_string(k) + " = " + hex_word(argb_of(constants.used[k])) + "\n";
    }
  }

  Random& random_;
  std::string text_, words_;
};

TEST(PixelShaderWords, RandomTextsGiveTheAssemblersWords) {
  constexpr std::uint64_t kSeed = 2003;
  for (std::uint64_t i = 0; i < test::cases_here<std::uint64_t>(3000); ++i) {
    Random random(kSeed, i);
    WordMaker maker(random);
    maker.make();
    const auto expected = parse_xbox_pixel_shader({maker.words(), ""}, profiles::nv2a);
    ASSERT_TRUE(expected) << "case " << i << "\n" << maker.words() << test::all_faults(expected);
    const auto found = parse_pixel_shader({maker.text(), ""}, profiles::nv2a);
    ASSERT_TRUE(found) << "case " << i << "\n" << maker.text() << test::all_faults(found);
    ASSERT_TRUE(normalize(*found, profiles::nv2a) == normalize(*expected, profiles::nv2a))
        << "seed " << kSeed << " case " << i << "\n"
        << maker.text() << maker.words();
  }
}

}  // namespace
}  // namespace ninebit
