// `ninebit vectors --texture-shader`, its runner with right and broken stages, and `ninebit verify` of its results.
#include "ninebit/study/stage_vectors.h"

#include <gtest/gtest.h>

#include <sstream>

#include "combiner_tests/tools/support.h"
#include "combiner_tests/tools/vector_runner.h"
#include "ninebit/language/json.h"

namespace tools_test {
namespace {

const std::string kStages = NINEBIT_SOURCE_DIR "/docs/tutorials/stages.c";

Words make_stage_pack(const std::string& folder) {
  return {"vectors", "--texture-shader", "-o",  folder,        "--profile", "nv2a",
          "--quiet", "--programs",       "300", "--fragments", "6"};
}

// The pack that the tests read, made once.
const std::string& stage_pack() {
  static const TempFolder folder;
  static const std::string made = [] {
    EXPECT_EQ(ninebit(make_stage_pack(folder / "pack")).code, 0);
    return folder / "pack";
  }();
  return made;
}

class StageVectors : public testing::Test {
 protected:
  TempFolder folder_;
};

TEST_F(StageVectors, RightStagesPassAndVerifyAgrees) {
  const Checked& right = check_emulator(stage_pack(), kStages, "");
  EXPECT_EQ(right.status, 0);
  EXPECT_EQ(right.text, "profile nv2a: 1800 fragments, 0 differ; 30 of 30 groups pass\n");
  EXPECT_EQ(out_of(ninebit({"verify", right.results, "--vectors", stage_pack()})),
            "1800 fragments of 300 programs: 1800 agree, 0 differ\n");
  const std::string text = read_bytes(right.results);
  const std::string cut = write_bytes(folder_ / "results.txt", text.substr(0, text.find("\n300 ") + 1));
  EXPECT_EQ(ninebit({"verify", cut, "--vectors", stage_pack()}).out,
            cut +
                ":301: program 300 is missing; 299 of 300 programs have results\n"
                "1794 fragments of 299 programs: 1794 agree, 0 differ\n");
}

TEST_F(StageVectors, EachMistakeIsFoundInItsGroupAndNamed) {
  struct Case {
    const char *flag, *group, *mistake;
  };
  for (const Case& c :
       {Case{"-DTRANSPOSED=1", "offset-2d", "the offset matrix is transposed"},
        Case{"-DHILO_BITS=8", "dot-mapping-hilo-1", "HILO words have 8 bits instead of 16"},
        Case{"-DEYE=0", "dot-product-reflect-cube-map", "the eye is not used: the normal is looked up"}}) {
    SCOPED_TRACE(c.flag);
    const Checked& wrong = check_emulator(stage_pack(), kStages, c.flag);
    EXPECT_EQ(wrong.status, 1);
    EXPECT_TRUE(wrong.text.starts_with(std::string("first failing group: ") + c.group + " (rule 3")) << wrong.text;
    expect_parts(wrong.text, {"\n  PSTextureModes = 0x", "\n  expected "});
    expect_parts(out_of(ninebit({"verify", wrong.results, "--vectors", stage_pack(), "--most", "1"}), 1),
                 {std::string("\nOne mistake explains all of them: ") + c.mistake + " (rule", "): shows tex0 "});
    const Json object = json_of(ninebit({"verify", wrong.results, "--vectors", stage_pack(), "--json"}), 1);
    EXPECT_EQ(object["mistakes"][0]["mistake"], c.mistake);
    EXPECT_EQ(object["rows"][0]["group"], c.group);
    EXPECT_EQ(keys_of(object["rows"][0]["shown"]), (Words{"culled", "texture", "depth"}));
    EXPECT_EQ(object["rows"][0]["expected"]["texture"].size(), 4U);
  }
}

TEST_F(StageVectors, AnswersAndProgramsAreThoseOfThePack) {
  const std::string folder = folder_ / "a";
  const Json object =
      json_of(ninebit({"vectors", "--texture-shader", "-o", folder, "--profile", "nv2a", "--seed", "9", "--json"}));
  EXPECT_EQ(keys_of(object),
            (Words{"command", "version", "profile", "chip", "seed", "programs", "fragments", "id", "rows", "files"}));
  EXPECT_EQ(object["programs"], 1000);
  EXPECT_EQ(object["rows"].size(), 30U);
  const auto read =
      ninebit::read_stage_vector_pack(read_bytes(folder + "/vectors.txt"), "v.txt", ninebit::profiles::nv2a);
  ASSERT_TRUE(read.ok()) << read.error().text();
  std::istringstream lines(shell("gzip -dc '" + folder + "/programs.jsonl.gz'").first);
  std::size_t program = 0;
  for (std::string line; std::getline(lines, line); ++program) {
    ninebit::TextureShaderState stages;
    const auto parsed = ninebit::parse_json_program({line, "p"}, ninebit::profiles::nv2a, nullptr, &stages);
    ASSERT_TRUE(parsed) << parsed.faults().front().text();
    ASSERT_LT(program, read->programs.size());
    EXPECT_EQ(stages, read->programs[program].state) << line;
  }
  EXPECT_EQ(program, 1000U);
}

TEST_F(StageVectors, WhatCannotBeMadeOrJudged) {
  expect_error(ninebit({"vectors", "--texture-shader", "-o", folder_ / "b"}), 2,
               {"--texture-shader", "profile geforce2 has no texture shaders"});
  expect_error(ninebit({"vectors", "--texture-shader", "-o", folder_ / "b", "--profile", "nv2a", "--programs", "24"}),
               2, {"--programs", "24 is too few; expected at least 30"});
  const std::string folder = folder_ / "damaged";
  std::filesystem::copy(stage_pack(), folder);
  std::string text = read_bytes(folder + "/vectors.txt");
  text.replace(text.find("\no "), 4, "\no q");
  write_bytes(folder + "/vectors.txt", text);
  expect_error(ninebit({"verify", check_emulator(stage_pack(), kStages, "").results, "--vectors", folder}), 3,
               {"vectors.txt:", "the pack differs"});
}

}  // namespace
}  // namespace tools_test
