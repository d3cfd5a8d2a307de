// Packs of test vectors: the oracle judges their colours and traces, and every mistake is found.
#include "ninebit/study/vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "combiner_tests/oracle/combiner_oracle.h"
#include "combiner_tests/study/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/combiner/validate.h"
#include "ninebit/numerics/fixed9.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

VectorPack pack_of(const HardwareProfile& profile, int programs, int fragments, std::uint64_t seed = 1) {
  auto pack = make_vector_pack(profile, {programs, fragments, seed});
  EXPECT_TRUE(pack.ok());
  return *std::move(pack);
}

oracle::Registers registers_of(const RegisterFile& file) {
  oracle::Registers registers{};
  for (std::size_t r = 0; r < kRegisterCount; ++r) {
    for (std::size_t c = 0; c < 4; ++c) registers[r][c] = file.value[r][c];
  }
  return registers;
}

Bytes4 judged_by_oracle(const VectorPack& pack, const VectorProgram& program, std::size_t fragment) {
  const auto input = registers_of(pack.inputs[program.first_input + fragment]);
  const oracle::Codes color = oracle::run(program.state, pack.profile, input).color;
  Bytes4 bytes{};
  for (std::size_t c = 0; c < 4; ++c) bytes[c] = to_byte(pack.profile, static_cast<s9>(color[c]));
  return bytes;
}

TEST(Vectors, TheOracleGivesTheSameColours) {
  for (const char* name : {"nv2a", "geforce2", "geforce2-early-truncation", "geforce256-8bit"}) {
    SCOPED_TRACE(name);
    const VectorPack pack = pack_of(*find_profile(name), 1500, 5, 7);
    std::size_t of_one_color = 0;
    for (const VectorProgram& program : pack.programs) {
      EXPECT_TRUE(validate(program.state, pack.profile).empty());
      std::set<Bytes4> colors;
      for (std::size_t i = 0; i < pack.fragments; ++i) {
        ASSERT_EQ(program.expected[i], judged_by_oracle(pack, program, i)) << pack.groups[program.group].name;
        colors.insert(program.expected[i]);
      }
      if (colors.size() == 1) ++of_one_color;
    }
    EXPECT_LT(of_one_color, 120U) << "programs that show one colour test little";
  }
}

// A line `s STAGE MASK CODES…` has what the oracle leaves in these registers.
TEST(Vectors, TracesHaveTheOraclesRegisters) {
  VectorPack pack = pack_of(profiles::nv2a, 700, 3);
  std::istringstream text(print_vector_pack(pack));
  std::size_t program = 0, codes = 0;
  for (std::string line; std::getline(text, line);) {
    std::istringstream words(line);
    std::string kind, mask, values;
    std::size_t stage = 0;
    words >> kind;
    if (kind == "p") words >> program;
    if (kind != "s") continue;
    words >> stage >> mask;
    ASSERT_EQ(mask.size(), kVectorRegisters.size());
    CombinerState begin = pack.programs[program - 1].state;
    begin.num_general_combiners = static_cast<int>(stage) + 1;
    for (std::size_t i = 0; i < pack.fragments; ++i) {
      const auto input = registers_of(pack.inputs[pack.programs[program - 1].first_input + i]);
      const oracle::Registers after = oracle::run(begin, pack.profile, input).registers;
      words >> values;
      std::size_t at = 0;
      for (std::size_t r = 0; r < kVectorRegisters.size(); ++r) {
        const int bits = std::stoi(mask.substr(r, 1), nullptr, 16);
        for (int c = 0; c < 4; ++c) {
          if ((bits & 8 >> c) == 0) continue;
          const int code = std::stoi(values.substr(at, 2), nullptr, 36) - 256;
          at += 2;
          ++codes;
          EXPECT_EQ(code, after[static_cast<std::size_t>(kVectorRegisters[r])][static_cast<std::size_t>(c)]) << line;
        }
      }
      EXPECT_EQ(at, values.size());
    }
  }
  EXPECT_GT(codes, 7000U);
}

TEST(Vectors, AreTheSameOnAnyNumberOfThreadsAndForASeed) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "other numbers of threads: the build without sanitizers runs this";
  VectorPack pack = pack_of(profiles::nv2a, 300, 4, 5), other = pack_of(profiles::nv2a, 300, 4, 6);
  const std::string text = print_vector_pack(pack);
  EXPECT_NE(print_vector_pack(other), text);
  EXPECT_NE(other.id, pack.id);
  const ScopedThreadLimit one(1);
  VectorPack again = pack_of(profiles::nv2a, 300, 4, 5);
  EXPECT_EQ(print_vector_pack(again), text);
}

TEST(Vectors, InputsHaveEveryByteAndWhatAChipCanHold) {
  const VectorPack pack = pack_of(profiles::nv2a, 100, 1);
  ASSERT_EQ(pack.inputs.size(), 1024U);
  for (const Register reg : {Register::primary, Register::secondary, Register::texture0, Register::texture3}) {
    for (std::size_t c = 0; c < 4; ++c) {
      std::set<int> bytes, negative;
      for (std::size_t row = 0; row < 512; ++row) bytes.insert(pack.inputs[row][reg][c]);
      for (std::size_t row = 512; row < 1024; ++row) negative.insert(pack.inputs[row][reg][c]);
      EXPECT_EQ(bytes.size(), 256U);
      EXPECT_EQ(*bytes.begin(), 0);
      if (!is_texture(reg)) continue;
      EXPECT_EQ(*negative.begin(), profiles::nv2a.lowest.value);
      EXPECT_EQ(*negative.rbegin(), 254);
    }
  }
  for (const RegisterFile& input : pack.inputs) {
    EXPECT_EQ(input[Register::spare0], (Rgba9{0, 0, 0, input[Register::texture0][kAlpha]}));
    EXPECT_EQ(input[Register::spare1], Rgba9{});
  }
  const VectorPack old = pack_of(profiles::geforce2, 100, 1);
  EXPECT_EQ(old.inputs.size(), 512U) << "this chip has no signed texels";
}

TEST(Vectors, GroupsStandInOrderAndHaveAProgramEach) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    SCOPED_TRACE(profile.name);
    const int least = least_vector_programs(profile);
    const VectorPack pack = pack_of(profile, least, 2);
    ASSERT_EQ(pack.programs.size(), pack.groups.size());
    std::set<std::string> names;
    for (std::size_t i = 0; i < pack.programs.size(); ++i) {
      EXPECT_EQ(pack.programs[i].group, i);
      names.insert(pack.groups[i].name);
    }
    EXPECT_EQ(names.size(), pack.groups.size());
    EXPECT_FALSE(make_vector_pack(profile, {least - 1, 2, 1}).ok());
    EXPECT_FALSE(make_vector_pack(profile, {least, 0, 1}).ok());
    EXPECT_FALSE(make_vector_pack(profile, {least, kMostVectorFragments + 1, 1}).ok());
  }
  EXPECT_FALSE(make_vector_pack(profiles::nv2a, {kMostVectorPrograms, kMostVectorFragments, 1}).ok());
  const auto stopped = make_vector_pack(profiles::nv2a, {1000, 2, 1}, [](double) { return false; });
  ASSERT_FALSE(stopped.ok());
  EXPECT_EQ(stopped.error().fault, Fault::cancelled);
}

TEST(Vectors, ReadingGivesThePackBack) {
  for (const HardwareProfile& profile : hardware_profiles()) {
    SCOPED_TRACE(profile.name);
    VectorPack pack = pack_of(profile, ninebit::test::kSanitized ? 100 : 500, 3);
    const std::string text = print_vector_pack(pack);
    EXPECT_EQ(vector_pack_profile(text), profile.name);
    const auto read = read_vector_pack(text, "v.txt", profile);
    ASSERT_TRUE(read.ok()) << read.error().text();
    EXPECT_EQ(read->id, pack.id);
    EXPECT_EQ(read->inputs, pack.inputs);
    ASSERT_EQ(read->programs.size(), pack.programs.size());
    for (std::size_t i = 0; i < pack.programs.size(); ++i) {
      EXPECT_EQ(read->programs[i].group, pack.programs[i].group);
      EXPECT_EQ(read->programs[i].words, pack.programs[i].words);
      EXPECT_EQ(read->programs[i].expected, pack.programs[i].expected);
      EXPECT_EQ(normalize(read->programs[i].state, profile), normalize(pack.programs[i].state, profile)) << i;
    }
    VectorPack again = *read;
    EXPECT_EQ(print_vector_pack(again), text);
  }
}

TEST(Vectors, ADamagedPackHasOneFaultWithItsLine) {
  VectorPack pack = pack_of(profiles::nv2a, 80, 2);
  const std::string text = print_vector_pack(pack);
  test::expect_each_damage_reported(
      text,
      {
          {"ninebit-vectors 1", "ninebit-vectors 2", "v.txt:1: expected the first line of a pack"},
          {"profile nv2a", "profile nv2b", "v.txt:2: expected 'profile nv2a'"},
          {"one 255", "one 254", "v.txt:3: expected 'one 255'"},
          {"seed 1", "seed x", "v.txt:5: expected seed and a whole number"},
          {"programs 80", "programs 81", ": the pack has 80 programs, not 81"},
          {"fragments 2", "fragments 3", "expected 3 colours of 8 hexadecimal digits"},
          {"word 0 RC_ENABLE", "word 0 RC_ENABLF", "v.txt:9: expected 'word 0 RC_ENABLE'"},
          {"\ni ", "\ni 700 ", "expected i and 36 codes from -256 to 255"},
          {"\nbase ", "\nbase 99=1 ", "expected words as INDEX=HEX, not '99=1'"},
          {"\np 2 ", "\np 3 ", "expected program 2"},
          {"\no ", "\no g", "expected 2 colours of 8 hexadecimal digits"},
          {"\nend\n", "\n", "expected 'end'"},
          {"seed 1", "seed 2", "v.txt:1: the pack was changed"},
      },
      [](const std::string& damaged) { return read_vector_pack(damaged, "v.txt", profiles::nv2a); });
  for (std::size_t size = 0; size < text.size(); size += 997) {
    EXPECT_FALSE(read_vector_pack(text.substr(0, size), "v.txt", profiles::nv2a).ok()) << size;
  }
}

// Another version's rules give other colours: the pack says so, and does not judge by them.
TEST(Vectors, APackOfOtherRulesIsRefused) {
  HardwareProfile other = profiles::nv2a;
  other.half.value = 127;
  VectorPack pack = pack_of(other, 200, 2);
  const auto read = read_vector_pack(print_vector_pack(pack), "v.txt", profiles::nv2a);
  ASSERT_FALSE(read.ok());
  EXPECT_NE(read.error().text().find("profile nv2a gives other colours"), std::string::npos) << read.error().text();
}

std::string results_text(const VectorPack& pack, const std::vector<std::vector<Bytes4>>& colors) {
  std::ostringstream text;
  text << "ninebit-results 1 " << pack.id << '\n' << std::hex;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    text << std::dec << i + 1 << std::hex;
    for (const Bytes4& color : colors[i]) {
      text << ' ';
      for (const std::uint8_t byte : color) text << (byte < 16 ? "0" : "") << static_cast<int>(byte);
    }
    text << '\n';
  }
  return text.str();
}

// The group of the first program that differs; empty: none does.
std::string first_group(const VectorPack& pack, const std::vector<std::vector<Bytes4>>& colors) {
  for (std::size_t p = 0; p < colors.size(); ++p) {
    if (colors[p] != pack.programs[p].expected) return pack.groups[pack.programs[p].group].name;
  }
  return {};
}

// The values of a field of words: bits [low, low + count) of every word whose name begins so, in words that are not 0.
std::set<std::uint32_t> values_of(const VectorPack& pack, const std::string& name, int low, int count) {
  std::set<std::uint32_t> values;
  for (const VectorProgram& program : pack.programs) {
    for (std::size_t i = 0; i < pack.word_names.size(); ++i) {
      if (!pack.word_names[i].starts_with(name)) continue;
      values.insert(program.words[i] >> low & ((1U << count) - 1));
    }
  }
  return values;
}

// Every pattern that a field of the words may have occurs, in small packs, too; so do words of 0.
TEST(Vectors, EveryPatternOfEveryFieldOfTheWordsOccurs) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "what the pack holds; other tests reach the same lines";
  const VectorPack pack = pack_of(profiles::nv2a, kQuickVectorPrograms, 16);
  const std::set<std::uint32_t> readable{0, 1, 2, 3, 4, 5, 8, 9, 10, 11, 12, 13};
  const std::set<std::uint32_t> writable{0, 4, 5, 8, 9, 10, 11, 12, 13}, bit{0, 1};
  const std::set<std::uint32_t> mappings{0, 1, 2, 3, 4, 5, 6, 7}, final_mappings{0, 1};
  for (const char* name : {"RC_IN_RGB", "RC_IN_ALPHA"}) {
    for (int low = 0; low < 32; low += 8) {
      SCOPED_TRACE(std::string(name) + " from bit " + std::to_string(low));
      EXPECT_EQ(values_of(pack, name, low, 4), readable);
      EXPECT_EQ(values_of(pack, name, low + 4, 1), bit);
      EXPECT_EQ(values_of(pack, name, low + 5, 3), mappings);
    }
  }
  for (const char* name : {"RC_OUT_RGB", "RC_OUT_ALPHA"}) {
    SCOPED_TRACE(name);
    for (int low = 0; low < 12; low += 4) EXPECT_EQ(values_of(pack, name, low, 4), writable) << low;
    EXPECT_EQ(values_of(pack, name, 14, 1), bit);
    // Bias and scale: GL allows no bias with a scale of four or one half.
    EXPECT_EQ(values_of(pack, name, 15, 3), (std::set<std::uint32_t>{0, 1, 2, 3, 4, 6}));
  }
  for (const int low : {12, 13, 18, 19}) EXPECT_EQ(values_of(pack, "RC_OUT_RGB", low, 1), bit) << low;
  for (int low = 0; low < 32; low += 8) {
    SCOPED_TRACE("final combiner, from bit " + std::to_string(low));
    std::set<std::uint32_t> of_final0 = readable;
    of_final0.insert(15);
    if (low != 24) of_final0.insert(14);
    EXPECT_EQ(values_of(pack, "RC_FINAL0", low, 4), of_final0);
    EXPECT_EQ(values_of(pack, "RC_FINAL0", low + 4, 1), bit);
    EXPECT_EQ(values_of(pack, "RC_FINAL0", low + 5, 3), final_mappings);
    if (low == 0) continue;
    EXPECT_EQ(values_of(pack, "RC_FINAL1", low, 4), readable);
    EXPECT_EQ(values_of(pack, "RC_FINAL1", low + 4, 1), bit);
    EXPECT_EQ(values_of(pack, "RC_FINAL1", low + 5, 3), final_mappings);
  }
  EXPECT_EQ(values_of(pack, "RC_FINAL1", 5, 3), mappings) << "inversions and clamp of the colour sum";
  EXPECT_EQ(values_of(pack, "RC_ENABLE", 0, 8), (std::set<std::uint32_t>{1, 2, 3, 4, 5, 6, 7, 8}));
  for (const int low : {8, 12, 16}) EXPECT_EQ(values_of(pack, "RC_ENABLE", low, 1), bit) << low;
  for (const char* name : {"RC_COLOR0", "RC_COLOR1", "RC_CONSTANT_COLOR0", "RC_CONSTANT_COLOR1"}) {
    for (int low = 0; low < 32; low += 8) EXPECT_GT(values_of(pack, name, low, 8).size(), 64U) << name;
  }
}

// Words of 0 that do something: a stage writes though its input words are 0, a final combiner has none.
TEST(Vectors, ZeroWordsOccur) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "what the pack holds; other tests reach the same lines";
  const VectorPack pack = pack_of(profiles::nv2a, kQuickVectorPrograms, 4);
  const auto place = [&](const std::string& name) {
    return static_cast<std::size_t>(std::find(pack.word_names.begin(), pack.word_names.end(), name) -
                                    pack.word_names.begin());
  };
  std::size_t stages = 0, final_combiners = 0;
  for (const VectorProgram& program : pack.programs) {
    const auto word = [&](const std::string& name) { return program.words.at(place(name)); };
    for (int s = 0; s < program.state.num_general_combiners; ++s) {
      const std::string at = "[" + std::to_string(s) + "]";
      const bool writes = word("RC_OUT_RGB" + at) != 0 && word("RC_OUT_ALPHA" + at) != 0;
      if (writes && word("RC_IN_RGB" + at) == 0 && word("RC_IN_ALPHA" + at) == 0) ++stages;
    }
    if (word("RC_FINAL0") == 0 && word("RC_FINAL1") == 0) ++final_combiners;
  }
  EXPECT_GE(stages, 3U);
  EXPECT_GE(final_combiners, 2U);
}

VectorVerdict judged(const VectorPack& pack, const std::vector<std::vector<Bytes4>>& colors) {
  const auto results = read_vector_results(results_text(pack, colors), "r.txt", pack);
  EXPECT_TRUE(results.ok());
  auto verdict = judge_vectors(pack, *results, 1);
  EXPECT_TRUE(verdict.ok());
  return *std::move(verdict);
}

// Mistakes that show nothing alone: no program can show a register's lowest code; D is whole unless E times F is not
// rounded, too.
const std::set<std::string> kUnseen{"lowest = -255", "AB + (1 - A)C is not rounded before D is added"};

// A group fails only for its own faults: each known mistake fails first in the group that is its own.
TEST(Vectors, EveryMistakeFailsItsOwnGroupFirst) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "what the pack holds; other tests reach the same lines";
  for (const char* name : {"nv2a", "geforce2"}) {
    SCOPED_TRACE(name);
    VectorPack made = pack_of(*find_profile(name), kQuickVectorPrograms, 16);
    const auto pack = read_vector_pack(print_vector_pack(made), "v.txt", made.profile);
    ASSERT_TRUE(pack.ok());
    const std::vector<VectorMistake> mistakes = vector_mistakes(pack->profile);
    std::set<std::string> unseen;
    for (std::size_t m = 0; m < mistakes.size(); ++m) {
      const std::string first = first_group(*pack, mistaken_colors(*pack, {m}));
      if (first.empty()) {
        unseen.insert(mistakes[m].name);
      } else {
        EXPECT_EQ(first, mistakes[m].group) << mistakes[m].name;
      }
    }
    if (std::string(name) == "nv2a") {
      EXPECT_EQ(unseen, kUnseen);
    } else {  // of what this chip does not have, nothing can be seen
      EXPECT_LE(unseen.size(), 14U);
    }
  }
}

// Alone, it is the whole plan.
TEST(Vectors, EveryMistakeIsNamed) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  VectorPack pack = pack_of(profiles::nv2a, 640, 5);
  (void)print_vector_pack(pack);
  const std::vector<VectorMistake> mistakes = vector_mistakes(pack.profile);
  std::size_t seen = 0;
  constexpr std::size_t kStep = ninebit::test::kSanitized ? 12 : 1;
  for (std::size_t m = 0; m < mistakes.size(); m += kStep) {
    SCOPED_TRACE(mistakes[m].name);
    const VectorVerdict verdict = judged(pack, mistaken_colors(pack, {m}));
    EXPECT_EQ(verdict.fragments, pack.programs.size() * pack.fragments);
    if (verdict.differ == 0) continue;
    ++seen;
    ASSERT_EQ(verdict.plan.size(), 1U);
    const VectorVerdict::Step& step = verdict.plan.front();
    EXPECT_EQ(step.mistake.explains, verdict.differ);
    EXPECT_EQ(step.mistake.agree, verdict.fragments);
    EXPECT_EQ(step.breaks, 0U);
    EXPECT_EQ(verdict.unexplained, 0U);
    EXPECT_TRUE(step.mistake.name == mistakes[m].name ||
                std::find(step.same.begin(), step.same.end(), mistakes[m].name) != step.same.end())
        << step.mistake.name;
  }
  EXPECT_GT(seen, mistakes.size() / kStep - 5);
}

TEST(Vectors, WrongResults) {
  VectorPack pack = pack_of(profiles::nv2a, 70, 2);
  (void)print_vector_pack(pack);
  const std::string title = "ninebit-results 1 " + pack.id + "\n";
  const auto fault = [&](const std::string& text) {
    const auto results = read_vector_results(text, "r.txt", pack);
    return results.ok() ? "none" : results.error().text();
  };
  EXPECT_EQ(fault(title + "3 00000000 00000000\n"), "none");
  EXPECT_EQ(fault(""), "r.txt:1: expected the first line of results, 'ninebit-results 1 HASH'");
  EXPECT_EQ(fault("ninebit-results 1 0123456789abcdef\n"),
            "r.txt:1: these are results of pack 0123456789abcdef, not of pack " + pack.id);
  EXPECT_EQ(fault(title), "r.txt:2: the results have no program");
  EXPECT_EQ(fault(title + "0 00000000 00000000\n"),
            "r.txt:2: expected a program from 1 to 70 and 2 colours of 8 hexadecimal digits");
  EXPECT_EQ(fault(title + "71 00000000 00000000\n"),
            "r.txt:2: expected a program from 1 to 70 and 2 colours of 8 hexadecimal digits");
  EXPECT_EQ(fault(title + "1 00000000 0000000\n"), "r.txt:2: expected 2 colours of 8 hexadecimal digits");
  EXPECT_EQ(fault(title + "1 00000000\n"), "r.txt:2: expected 2 colours of 8 hexadecimal digits");
  EXPECT_EQ(fault(title + "1 00000000 00000000 00000000\n"),
            "r.txt:2: expected 2 colours of 8 hexadecimal digits, found more");
  EXPECT_EQ(fault(title + "1 00000000 00000000\n\n1 00000000 00000000\n"), "r.txt:4: program 1 is in line 2, too");
}

}  // namespace
}  // namespace ninebit
