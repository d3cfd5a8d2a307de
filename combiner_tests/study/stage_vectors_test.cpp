// Packs of texture-shader stages: the oracle judges them, and every mistake fails its own group first.
#include "ninebit/study/stage_vectors.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <sstream>

#include "combiner_tests/oracle/stage_oracle.h"
#include "combiner_tests/study/support.h"
#include "combiner_tests/support/slow_build.h"
#include "ninebit/raster/sampler.h"
#include "ninebit/raster/texture.h"
#include "src/language/xbox/stage_words.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit {
namespace {

StageVectorPack stage_pack(int programs, int fragments, std::uint64_t seed = 1) {
  auto pack = make_stage_vector_pack(profiles::nv2a, {programs, fragments, seed});
  EXPECT_TRUE(pack.ok());
  (void)print_stage_vector_pack(*pack);
  return *std::move(pack);
}

std::array<int, 4> ints(const Bytes4& bytes) {
  return {bytes[0], bytes[1], bytes[2], bytes[3]};
}

StageOutput judged_by_oracle(const StageVectorPack& pack, const StageVectorProgram& program, std::size_t fragment) {
  oracle::StageQuestion question{program.state, {}, pack.profile, program.at[fragment], {}};
  for (std::size_t i = 0; i < 4; ++i) {
    if (!program.picture[i]) continue;
    question.textures[i] =
        StageTexture{.target = pack.pictures[*program.picture[i]].target, .is_signed = program.is_signed[i]};
  }
  question.fetch = [&](int unit, std::array<float, 3> at) {
    return ints(pack.pictures[*program.picture[static_cast<std::size_t>(unit)]].at(at));
  };
  const oracle::StageAnswer answer = oracle::run_stages(question);
  StageOutput output;
  output.is_culled = answer.culled;
  if (answer.culled) return output;
  for (std::size_t i = 0; i < 4; ++i) {
    for (std::size_t k = 0; k < 4; ++k) output.texture[i][k] = static_cast<s9>(answer.code[i][k]);
  }
  if (answer.depth) {
    output.depth = static_cast<std::uint32_t>(*answer.depth > 65535.0F ? 65535.0F : *answer.depth);
  }
  return output;
}

TEST(StageVectors, TheOracleGivesTheSame) {
  const StageVectorPack pack = stage_pack(1000, 8, 3);
  std::size_t culled = 0, replaced = 0, alike = 0;
  for (const StageVectorProgram& program : pack.programs) {
    SCOPED_TRACE(pack.groups[program.group].name);
    for (std::size_t i = 0; i < pack.fragments; ++i) {
      ASSERT_EQ(program.expected[i], judged_by_oracle(pack, program, i));
      culled += program.expected[i].is_culled ? 1U : 0U;
      replaced += program.expected[i].depth ? 1U : 0U;
    }
    alike += std::count(program.expected.begin(), program.expected.end(), program.expected[0]) ==
                     static_cast<std::ptrdiff_t>(pack.fragments)
                 ? 1U
                 : 0U;
  }
  EXPECT_GT(culled, 200U);
  EXPECT_GT(replaced, 200U);
  EXPECT_LT(alike, 20U) << "programs whose fragments are alike test little";
}

TEST(StageVectors, WordsAreThoseOfTheStages) {
  const StageVectorPack pack = stage_pack(500, 1, 5);
  for (const StageVectorProgram& program : pack.programs) {
    std::vector<RegisterWord> words;
    for (std::size_t i = 0; i < program.words.size(); ++i) words.push_back({pack.word_names[i], program.words[i], {}});
    const xbox::StageWords decoded = xbox::decode_stage_words(words);
    EXPECT_EQ(decoded.why, "");
    EXPECT_EQ(decoded.missing, "");
    EXPECT_EQ(only_used(decoded.state), xbox::without_kinds(program.state));
  }
}

// The raster's sampler reads the same texels.
TEST(StageVectors, TexturesAreReadAsTheRasterizerReadsThem) {
  const StageVectorPack pack = stage_pack(30, 1);
  std::uint64_t state = 7;
  const auto next = [&] {
    state = state * 6364136223846793005U + 1442695040888963407U;
    return static_cast<float>(state >> 40) / static_cast<float>(1 << 24) * 3.0F - 1.5F;
  };
  for (const StagePicture& picture : pack.pictures) {
    const bool is_cube = picture.target == StageTarget::cube_map;
    std::vector<std::vector<TextureSamples>> faces;
    const auto size = static_cast<std::size_t>(picture.width) * static_cast<std::size_t>(picture.height);
    const std::size_t images = is_cube ? 6 : 1, layers = is_cube ? 1 : static_cast<std::size_t>(picture.depth);
    for (std::size_t face = 0; face < images; ++face) {
      std::vector<std::uint8_t> samples;
      for (std::size_t k = 0; k < 4; ++k) {
        for (std::size_t n = 0; n < size * layers; ++n) samples.push_back(picture.texels[face * size + n][k]);
      }
      faces.push_back({{picture.width, picture.height, std::move(samples), static_cast<int>(layers)}});
    }
    constexpr std::array kTargets{TextureTarget::texture_2d, TextureTarget::texture_1d, TextureTarget::texture_2d,
                                  TextureTarget::rectangle,  TextureTarget::texture_3d, TextureTarget::cube_map};
    const TextureTarget target = kTargets[static_cast<std::size_t>(picture.target)];
    const float side = target == TextureTarget::rectangle ? 40.0F : 1.0F;
    const Texture texture = make_texture(target, InternalFormat::rgba8, std::move(faces)).value();
    Sampler sampler = kNearestSampler;
    sampler.wrap_r = Wrap::clamp_to_edge;
    const auto reads = TextureSampler::make(pack.profile, texture, sampler, TexelUse::stages);
    ASSERT_TRUE(reads);
    for (int i = 0; i < 20000; ++i) {
      const std::array<float, 3> at{side * next(), side * next(), i % 50 == 0 ? 0.0F : next()};
      TextureCoordinates coordinates;
      for (std::size_t k = 0; k < 3; ++k) coordinates.value[k] = &at[k];
      ASSERT_EQ(picture.at(at), reads->bytes(coordinates, 0)) << at[0] << ' ' << at[1] << ' ' << at[2];
    }
  }
}

TEST(StageVectors, AreTheSameOnAnyNumberOfThreadsAndForASeed) {
  StageVectorPack pack = stage_pack(100, 4, 5), other = stage_pack(100, 4, 6);
  EXPECT_NE(other.id, pack.id);
  const ScopedThreadLimit one(1);
  StageVectorPack again = stage_pack(100, 4, 5);
  EXPECT_EQ(print_stage_vector_pack(again), print_stage_vector_pack(pack));
}

TEST(StageVectors, ReadingGivesThePackBackAndNamesTheLineThatDiffers) {
  StageVectorPack pack = stage_pack(60, 3);
  const std::string text = print_stage_vector_pack(pack);
  EXPECT_TRUE(is_stage_vector_pack(text));
  EXPECT_EQ(vector_pack_profile(text), "nv2a");
  const auto read = read_stage_vector_pack(text, "v.txt", profiles::nv2a);
  ASSERT_TRUE(read.ok()) << read.error().text();
  EXPECT_EQ(read->id, pack.id);
  test::expect_each_damage_reported(
      text,
      {
          {"ninebit-stage-vectors 1", "ninebit-stage-vectors 2", "v.txt:1: expected the first line of a pack"},
          {"profile nv2a", "profile nv2b", "v.txt:2: expected 'profile nv2a'"},
          {"seed 1", "seed x", "v.txt:4: expected seed and a whole number"},
          {"programs 60", "programs 6", "a pack for nv2a has at least 30 programs"},
          {"fragments 3", "fragments 0", "a program has 1 to 256 fragments"},
          {"one 255", "one 254", "v.txt:3: the pack differs from what profile nv2a gives"},
          {"word 0 PSCompareMode", "word 0 PSCompareModf", "v.txt:8: the pack differs"},
          {"\nend\n", "\n", "the pack differs"},
          {"\nend\n", "\nend\nmore\n", "the pack differs"},
      },
      [](const std::string& damaged) { return read_stage_vector_pack(damaged, "v.txt", profiles::nv2a); });
  const auto refused = make_stage_vector_pack(profiles::geforce2, {100, 2, 1});
  ASSERT_FALSE(refused.ok());
  EXPECT_EQ(refused.error().message,
            "profile geforce2 has no texture shaders (NV_texture_shader); expected a profile that has, such as nv2a");
}

std::string results_text(const StageVectorPack& pack, const std::vector<std::vector<StageOutput>>& outputs) {
  std::ostringstream text;
  text << "ninebit-results 1 " << pack.id << '\n';
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (outputs[i].empty()) continue;
    text << i + 1;
    for (const StageOutput& output : outputs[i]) text << ' ' << stage_output_text(output);
    text << '\n';
  }
  return text.str();
}

// Each mistake alone fails its own group before all others, and is named; fields that no picture decides change nothing
// in the groups of one operation.
TEST(StageVectors, EveryMistakeFailsItsGroupAndIsNamed) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  const StageVectorPack pack = stage_pack(700, 10);
  const std::vector<StageVectorMistake> mistakes = stage_vector_mistakes(pack.profile);
  EXPECT_GE(mistakes.size(), 45U);
  const std::size_t combined = pack.groups.size() - 1;
  std::set<std::string> open;
  for (std::size_t m = 0; m < mistakes.size(); m += ninebit::test::kSlowBuild ? 8 : 1) {
    SCOPED_TRACE(mistakes[m].name);
    std::vector<std::vector<StageOutput>> outputs(pack.programs.size());
    parallel_for(outputs.size(), [&](std::size_t i) { outputs[i] = mistaken_outputs(pack, m, pack.programs[i]); });
    std::size_t first = pack.groups.size();
    for (std::size_t i = outputs.size(); i-- > 0;) {
      if (outputs[i] != pack.programs[i].expected) first = pack.programs[i].group;
    }
    if (mistakes[m].group.empty()) {
      open.insert(mistakes[m].name);
      EXPECT_GE(first, combined);
      continue;
    }
    ASSERT_LT(first, pack.groups.size()) << "no group fails";
    EXPECT_EQ(pack.groups[first].name, mistakes[m].group);
    // Every mistake runs on each program that is judged: that group's, and some of the others.
    for (std::size_t i = 0; i < outputs.size(); ++i) {
      if (pack.programs[i].group != first && i % 8 != 0) outputs[i].clear();
    }
    const auto results = read_stage_vector_results(results_text(pack, outputs), "r.txt", pack);
    ASSERT_TRUE(results.ok()) << results.error().text();
    const auto verdict = judge_stage_vectors(pack, *results, 1);
    ASSERT_TRUE(verdict.ok());
    EXPECT_GT(verdict->groups[first].differ, 0U);
    EXPECT_TRUE(std::any_of(verdict->mistakes.begin(), verdict->mistakes.end(), [&](const VectorMistake& x) {
      return x.name == mistakes[m].name && x.agree == verdict->fragments && x.explains == verdict->differ;
    }));
    EXPECT_EQ(verdict->mistakes.front().agree, verdict->fragments);
  }
  if (ninebit::test::kSlowBuild) return;
  EXPECT_EQ(open, (std::set<std::string>{"negative_stage_number = size", "cull_zero = by-sign", "dot_divisors = even",
                                         "dependent_divisor = 256", "ahead_mapping = of-diffuse"}));
}

TEST(StageVectors, WrongResults) {
  const StageVectorPack pack = stage_pack(30, 2);
  const std::string title = "ninebit-results 1 " + pack.id + "\n", output(32, '0');
  const std::string expected = "2 results: culled, or 32 digits and perhaps /DEPTH";
  const auto fault = [&](const std::string& text) {
    const auto results = read_stage_vector_results(text, "r.txt", pack);
    return results.ok() ? "none" : results.error().text();
  };
  EXPECT_EQ(fault(title + "3 culled " + output + "/65535\n"), "none");
  EXPECT_EQ(fault(title), "r.txt:2: the results have no program");
  EXPECT_EQ(fault(title + "31 culled culled\n"), "r.txt:2: expected a program from 1 to 30 and " + expected);
  for (const std::string& wrong : {std::string("cul"), output + "/", output + "/-1", output + "1", output.substr(1),
                                   output + "/4294967296", std::string(32, '!')}) {
    EXPECT_EQ(fault(title + "1 culled " + wrong + "\n"), "r.txt:2: expected " + expected) << wrong;
  }
}

}  // namespace
}  // namespace ninebit
