// `ninebit eval`: what it computes, against the library's evaluator and against itself.
#include <gtest/gtest.h>

#include "combiner_tests/combiner/random_state.h"
#include "combiner_tests/support/slow_build.h"
#include "combiner_tests/tools/program_support.h"
#include "ninebit/combiner/normalize.h"

namespace tools_test {
namespace {

using namespace ninebit;  // NOLINT(google-build-using-namespace): states are spelled in its words

struct Column {
  const char* reg;
  Register value;
};
constexpr std::array<Column, 11> kRegisters{{{"const0", Register::constant0},
                                             {"const1", Register::constant1},
                                             {"fog", Register::fog},
                                             {"primary", Register::primary},
                                             {"secondary", Register::secondary},
                                             {"spare0", Register::spare0},
                                             {"spare1", Register::spare1},
                                             {"tex0", Register::texture0},
                                             {"tex1", Register::texture1},
                                             {"tex2", Register::texture2},
                                             {"tex3", Register::texture3}}};
constexpr std::string_view kComponents = "rgba";

class Eval : public testing::Test {
 protected:
  Outcome eval(const std::string& program, const std::string& table, Words more = {}) {
    return ninebit(Words{"eval", program, "--inputs", write_bytes(folder_ / "in.csv", table)} + more);
  }
  TempFolder folder_;
  std::string article_ = write_program(folder_, "article.json", article_state());
};

TEST_F(Eval, TheArticle) {
  const std::string table = "primary.r,tex0.r\n10,10\n10,11\n10,12\n12,10\n255,0\n";
  for (const char* engine : {"reference", "simd"}) {
    const Outcome outcome = eval(article_, table, {"--engine", engine});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "out.r,out.g,out.b,out.a\n0,0,0,0\n0,0,0,0\n0,0,0,1\n0,0,0,1\n0,0,0,255\n");
    EXPECT_EQ(outcome.err, "");
  }
  // The same calls as text, and from standard input.
  const std::string& calls = kArticle;
  EXPECT_EQ(eval(calls, table).out, eval(article_, table).out);
  EXPECT_EQ(ninebit({"eval", "-", "--inputs", folder_ / "in.csv"}, {.in = calls}).out, eval(article_, table).out);
  EXPECT_EQ(ninebit({"eval", calls, "--inputs", "-"}, {.in = folder_ / "in.csv"}).out, eval(article_, table).out);
}

// The registers of the default program that no stage writes show what missing columns read.
TEST_F(Eval, MissingColumns) {
  const std::string program = write_program(folder_, "default.json", CombinerState{});
  const auto registers = [&](const std::string& table) {
    const Words lines = lines_of(eval(program, table, {"--registers"}).out);
    EXPECT_EQ(lines.size(), 2U);
    EXPECT_EQ(lines.at(0),
              "out.r,out.g,out.b,out.a,const0.r,const0.g,const0.b,const0.a,const1.r,const1.g,const1.b,const1.a,"
              "fog.r,fog.g,fog.b,fog.a,primary.r,primary.g,primary.b,primary.a,"
              "secondary.r,secondary.g,secondary.b,secondary.a,spare0.r,spare0.g,spare0.b,spare0.a,"
              "spare1.r,spare1.g,spare1.b,spare1.a,tex0.r,tex0.g,tex0.b,tex0.a,tex1.r,tex1.g,tex1.b,tex1.a");
    return lines.at(1);
  };
  EXPECT_EQ(registers("primary.g\n7\n"),
            "0,7,0,0,0,0,0,0,0,0,0,0,0,0,0,255,0,7,0,0,0,0,0,255,0,7,0,0,0,0,0,0,0,0,0,255,0,0,0,255");
  CombinerState state = article_state();  // leaves spare0's alpha alone
  const std::string quiet = write_program(folder_, "quiet.json", state);
  const auto spare0_alpha = [&](const std::string& table) {
    const std::string out = eval(quiet, table, {"--registers", "--json"}).out;
    return Json::parse(out).at("rows").at(0).at("spare0.a").get<int>();
  };
  EXPECT_EQ(spare0_alpha("primary.r\n1\n"), 255);
  EXPECT_EQ(spare0_alpha("tex0.a\n31\n"), 31);
  EXPECT_EQ(spare0_alpha("tex0.a,spare0.a\n31,-77\n"), -77);
}

// eval, trace, verify and the study of a program take missing components from the profile.
TEST_F(Eval, MissingComponentsAreTheProfiles) {
  const std::string profile = write_bytes(folder_ / "own.json",
                                          R"({"base": "geforce2", "name": "own", "disabled_texture_alpha": 17,
                                              "fog_alpha_without_fog": 9, "secondary_alpha": "as-given"})");
  const std::vector<std::pair<std::string, std::array<std::string, 2>>> expected{
      {"col1.a", {"255", "0"}}, {"fog.a", {"255", "9"}}, {"tex1.a", {"255", "17"}}, {"spare0.a", {"255", "17"}}};
  const std::string table = write_bytes(folder_ / "one.csv", "primary.r\n1\n");
  for (const auto& [source, codes] : expected) {
    const std::string program =
        write_bytes(folder_ / "alpha.rc1", "!!RC1.0\nout.rgb = " + source + ";\nout.a = zero;\n");
    for (std::size_t i = 0; i < 2; ++i) {
      const std::string named = i == 0 ? "geforce2" : profile;
      SCOPED_TRACE(source + ' ' + named);
      const Outcome row = ninebit({"eval", program, "--inputs", table, "--profile", named});
      EXPECT_EQ(lines_of(row.out).at(1).substr(0, codes[i].size() + 1), codes[i] + ',') << row.err;
      const Json traced = Json::parse(ninebit({"trace", program, "--profile", named, "--json"}).out);
      EXPECT_EQ(traced["out"]["bytes"][0].dump(), codes[i]);
      const std::string rows = write_bytes(folder_ / "rows.csv", "out.r\n" + codes[i] + "\n");
      EXPECT_EQ(ninebit({"verify", rows, "--program", program, "--profile", named}).code, 0);
      const Json study = Json::parse(
          ninebit({"study", "datapath", "--program", program, "--inputs", table, "--profile", named, "--json"}).out);
      EXPECT_EQ(study["rows"][0]["worst_code"].dump(), codes[i]);
    }
  }
}

// Random programs and tables: both engines, and the library's evaluator called here.
TEST_F(Eval, EnginesAgreeWithTheLibrary) {
  if (ninebit::test::kSanitized) GTEST_SKIP() << "too long, and other tests reach the same lines";
  constexpr std::uint64_t kSeed = 1999;
  int distinct = 0;
  for (std::uint64_t index = 0; index < 12; ++index) {
    SCOPED_TRACE("program " + std::to_string(index));
    test::Random random(kSeed, index);
    const std::span<const HardwareProfile> all = hardware_profiles();
    const HardwareProfile& profile = all[index % all.size()];
    const CombinerState state = test::random_state(random, profile);
    const std::string program = write_program(folder_, "random.json", state);

    std::vector<std::pair<Register, std::size_t>> columns;
    std::string table;
    for (const Column& reg : kRegisters) {
      if (is_texture(reg.value) && texture_unit_of(reg.value) >= profile.texture_units) continue;
      const bool constant = reg.value == Register::constant0 || reg.value == Register::constant1;
      for (std::size_t c = 0; c < 4; ++c) {
        if (constant ? index % 3 != 0 : random.one_in(3)) continue;
        table += std::string(columns.empty() ? "" : ",") + reg.reg + '.' + kComponents[c];
        columns.emplace_back(reg.value, c);
      }
    }
    table += '\n';
    const Program compiled = normalize(state, profile);
    Words expected{"out.r,out.g,out.b,out.a"};
    for (int row = 0; row < 600; ++row) {
      RegisterFile registers;
      for (const Register reg : {Register::fog, Register::texture0, Register::texture1, Register::texture2,
                                 Register::texture3, Register::spare0}) {
        registers[reg][kAlpha] = static_cast<s9>(profile.one);
      }
      if (profile.secondary_alpha == SecondaryAlpha::one) {
        registers[Register::secondary][kAlpha] = static_cast<s9>(profile.one);
      }
      Program own = compiled;
      bool spare0_alpha_given = false;
      for (std::size_t k = 0; k < columns.size(); ++k) {
        const auto [reg, c] = columns[k];
        // Constants stay for a few rows, so that there are runs of equal ones.
        const bool constant = reg == Register::constant0 || reg == Register::constant1;
        test::Random fixed(kSeed + k, static_cast<std::uint64_t>(row / 5));
        const int code = test::random_code(constant ? fixed : random, profile);
        table += (k > 0 ? "," : "") + std::to_string(code);
        registers[reg][c] = static_cast<s9>(code);
        spare0_alpha_given = spare0_alpha_given || (reg == Register::spare0 && c == kAlpha);
        if (!constant) continue;
        const bool first = reg == Register::constant0;
        for (ProgramStage& stage : own.general) (first ? stage.constant0 : stage.constant1)[c] = static_cast<s9>(code);
        (first ? own.constant0 : own.constant1)[c] = static_cast<s9>(code);
      }
      table += '\n';
      if (!spare0_alpha_given) registers[Register::spare0][kAlpha] = registers[Register::texture0][kAlpha];
      const Rgba9 out = evaluate(own, registers);
      std::string line;
      for (std::size_t c = 0; c < 4; ++c) line += (c > 0 ? "," : "") + std::to_string(out[c]);
      distinct += line != expected.back() ? 1 : 0;
      expected.push_back(line);
    }
    const Words flags{"--profile", std::string(profile.name), "--registers", "--engine"};
    const Words reference = lines_of(out_of(eval(program, table, flags + Words{"reference"})));
    ASSERT_EQ(reference.size(), expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_TRUE(reference[i].starts_with(expected[i] + ',')) << i;
    EXPECT_EQ(lines_of(out_of(eval(program, table, flags + Words{"simd"}))), reference);
  }
  EXPECT_GT(distinct, 1000);
}

TEST_F(Eval, ConstantColumns) {
  CombinerState state;
  state.general[0].rgb.a = {Register::constant0, InputMapping::unsigned_identity, ComponentUsage::rgb};
  state.final_combiner.a = state.final_combiner.b = state.final_combiner.c = CombinerInput{};
  state.final_combiner.d = {Register::spare0, InputMapping::unsigned_identity, ComponentUsage::rgb};
  state.final_combiner.g = {Register::constant0, InputMapping::unsigned_identity, ComponentUsage::alpha};
  state.constant0 = {0.2F, 0.4F, 0.6F, 0.8F};
  const std::string program = write_program(folder_, "constants.json", state);
  for (const char* engine : {"reference", "simd"}) {
    EXPECT_EQ(eval(program, "primary.r\n0\n", {"--engine", engine}).out, "out.r,out.g,out.b,out.a\n51,102,153,204\n");
    EXPECT_EQ(eval(program, "const0.g,const0.a\n7,8\n7,8\n9,10\n", {"--engine", engine}).out,
              "out.r,out.g,out.b,out.a\n51,7,153,8\n51,7,153,8\n51,9,153,10\n");
  }
}

TEST_F(Eval, TablesAsTheyCome) {
  const std::string expected = "out.r,out.g,out.b,out.a\n0,0,0,1\n0,0,0,255\n";
  for (const std::string table :
       {"primary.r,tex0.r\n10,12\n255,0\n", "primary.r,tex0.r\r\n10,12\r\n255,0\r\n", "primary.r,tex0.r\n10,12\n255,0",
        "\xEF\xBB\xBFprimary.r,tex0.r\n10,12\n255,0\n", "\n\n primary.r , tex0.r \n\n 10 ,\t12\n  \r\n255,0 \n\n"}) {
    const Outcome outcome = eval(article_, table);
    EXPECT_EQ(outcome.out, expected) << testing::PrintToString(table) << outcome.err;
  }
  EXPECT_EQ(eval(article_, "primary.r\n").out, "out.r,out.g,out.b,out.a\n");
  // A byte order mark stands before the first line alone, and once.
  const std::string mark = "\xEF\xBB\xBF";
  expect_error(eval(article_, "primary.r\n" + mark + "10\n"), 3, {":2:1"});
  expect_error(eval(article_, "\n" + mark + "primary.r\n10\n"), 3, {":2:1"});
  expect_error(eval(article_, mark + mark + "primary.r\n10\n"), 3, {":1:"});
}

TEST_F(Eval, JsonRows) {
  const Json object = json_of(eval(article_, "primary.r,tex0.r\n10,12\n10,10\n", {"--json", "--profile", "nv2a"}));
  EXPECT_EQ(keys_of(object), (Words{"command", "version", "profile", "rows"}));
  EXPECT_EQ(object["command"], "eval");
  EXPECT_EQ(object["profile"], "nv2a");
  EXPECT_EQ(object["rows"], Json::parse(R"([{"out.r":0,"out.g":0,"out.b":0,"out.a":1},
                                            {"out.r":0,"out.g":0,"out.b":0,"out.a":0}])"));
  EXPECT_EQ(json_of(eval(article_, "primary.r\n", {"--json"})).at("rows"), Json::array());
  const Outcome filed = eval(article_, "primary.r\n1\n2\n", {"--json", "-o", folder_ / "out.csv"});
  EXPECT_EQ(json_of(filed).at("files"), Json::array({folder_ / "out.csv"}));
  EXPECT_EQ(json_of(filed).at("fragments"), 2);
  EXPECT_EQ(lines_of(read_bytes(folder_ / "out.csv")).size(), 3U);
}

}  // namespace
}  // namespace tools_test
