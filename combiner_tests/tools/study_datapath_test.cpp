// `ninebit study datapath`: operations, whole programs and AB + CD as users ask for them, and what is refused.
#include <gtest/gtest.h>

#include <sstream>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

class StudyDatapath : public testing::Test {
 protected:
  static Outcome study(const Words& more) { return ninebit(Words{"study", "datapath"} + more); }
  TempFolder folder_;
};

constexpr std::size_t kOperations = 8 + 4 * 6 + 1 + 2 + 1 + 1;

TEST_F(StudyDatapath, OperationsOfOneProfile) {
  const Json json = json_of(study({"--profile", "geforce256-8bit", "--json"}));
  EXPECT_EQ(json["command"], "study datapath");
  EXPECT_EQ(json["profile"], "geforce256-8bit");
  ASSERT_EQ(json["rows"].size(), kOperations);
  EXPECT_EQ(keys_of(json["rows"][0]),
            (Words{"profile", "operation", "form", "cases", "exact", "distinct", "max_error_codes", "mean_error_codes",
                   "mean_bias_codes", "worst", "worst_code", "worst_exact_codes"}));
  expect_parts(out_of(study({"--profile", "geforce256-8bit"})), {"geforce256-8bit: a product"});
}

// The same fragments as all combinations and as a table: the same rows.
TEST_F(StudyDatapath, ProgramsOverCombinationsAndTables) {
  std::string table = "tex0.g\n";
  for (int code = 0; code <= 255; ++code) table += std::to_string(code) + "\n";
  const std::string file = write_bytes(folder_ / "codes.csv", table);
  const Json over = json_of(study({"--program", kArticle, "--over", "tex0.g", "--json"}));
  const Json inputs = json_of(study({"--program", kArticle, "--inputs", file, "--json"}));
  EXPECT_EQ(over["profile"], "geforce2");
  ASSERT_EQ(over["rows"].size(), 4U);
  ASSERT_EQ(over["stages"].size(), 12U);
  EXPECT_EQ(over["rows"][3]["component"], "a");
  EXPECT_EQ(over["rows"][3]["fragments"], 256);
  EXPECT_GT(over["rows"][3]["max_error_codes"], 0.0);
  EXPECT_EQ(over["rows"], inputs["rows"]);
  EXPECT_EQ(over["stages"], inputs["stages"]);
}

// --set gives other inputs one value: the row is that of a table with these columns. The folder has all errors.
TEST_F(StudyDatapath, ProgramsWithFixedInputs) {
  std::string table = "tex0.r,primary.r,primary.a\n";
  for (int code = 0; code <= 255; ++code) table += std::to_string(code) + ",102,7\n";
  const std::string file = write_bytes(folder_ / "codes.csv", table);
  const Words over{"--program", kArticle, "--over", "t0.r", "--set", "col0=102,0,0,7", "--json"};
  const Json set = json_of(study(over + Words{"-o", folder_ / "out", "--quiet"}));
  const Json inputs = json_of(study({"--program", kArticle, "--inputs", file, "--json"}));
  for (const char* key : {"max_error_codes", "mean_error_codes", "exact", "misrounded", "fragments"}) {
    EXPECT_EQ(set["rows"][3][key], inputs["rows"][3][key]) << key;
  }
  EXPECT_NE(set["question"].get<std::string>().find("--set col0=102,0,0,7"), std::string::npos) << set["question"];
  EXPECT_GT(set["rows"][3]["misrounded"], 0);
  EXPECT_EQ(set["histogram"].size(), 4U * 17U);
  const Files files = files_in(folder_ / "out");
  EXPECT_TRUE(files.at("error.csv").starts_with("tex0.r,error.r,error.g,error.b,error.a\n0,"));
  expect_parts(files.at("error.npy"), {"(256, 4)"});
  expect_error(study({"--program", kArticle, "--over", "tex0.r", "--set", "tex0=1,2,3,4"}), 2,
               {"--set and --over both name tex0.r"});
  expect_error(study({"--program", kArticle, "--over", "tex0.r", "--set", "tex9=1,2,3,4"}), 2, {"tex9"});
  expect_error(study({"--set", "tex0=1,2,3,4"}), 2, {"--program"});
}

// Several profiles in one report: the rows are those of each alone.
TEST_F(StudyDatapath, ProgramsUnderSeveralProfiles) {
  const Words asked{"--program", kArticle, "--over", "tex0.r", "--set", "primary=90,0,0,0"};
  const auto of = [&](const std::string& profiles, const Words& more) {
    return study(asked + Words{"--profile", profiles} + more);
  };
  const Json both = json_of(of("nv2a,geforce256-8bit", {"--json", "--quiet", "-o", folder_ / "out"}));
  EXPECT_EQ(both["profile"], "nv2a,geforce256-8bit");
  Json rows = json_of(of("nv2a", {"--json"}))["rows"];
  const Json second = json_of(of("geforce256-8bit", {"--json"}));
  for (const Json& row : second["rows"]) rows.push_back(row);
  EXPECT_EQ(both["rows"], rows);
  const Files files = files_in(folder_ / "out");
  EXPECT_TRUE(files.contains("nv2a-error.csv") && files.contains("geforce256-8bit-error.npy"));
  // One plot for a slide has the series of both, but for those that are 0 everywhere.
  const std::string& slide = files.at("added-by-stage.svg");
  expect_parts(slide, {"nv2a, alpha", "geforce256-8bit, alpha"});
  EXPECT_EQ(slide.find("nv2a, red"), std::string::npos);
  const Outcome said = of("nv2a,geforce256-8bit", {});
  expect_parts(said.out, {"\ngeforce256-8bit, alpha: exact for "});
  // Its parts are merged as those of any study.
  for (const char* part : {"1/2", "2/2"}) {
    EXPECT_EQ(of("nv2a,geforce256-8bit", {"--shard", part, "-o", folder_ / "parts", "--quiet"}).code, 0) << part;
  }
  const Json merged =
      json_of(ninebit({"study", "merge", folder_ / "parts/part-1-of-2.jsonl", folder_ / "parts/part-2-of-2.jsonl", "-o",
                       folder_ / "merged", "--allow-outside", "--json", "--quiet"}));
  EXPECT_EQ(merged["rows"], rows);
  expect_error(of("nv2a,nv2b", {}), 2, {"nv2b", "did you mean 'nv2a'"});
  expect_error(of("nv2a,nv2a", {}), 2, {"given twice"});
  expect_error(of("nv2a,ideal", {}), 2, {"ideal", "real numbers"});
  expect_error(of("nv2a,mine.json", {}), 2, {"mine.json", "names"});
  expect_error(study({"--exhaustive-sum", "--profile", "nv2a,geforce2"}), 2, {"one profile"});
}

// The page has each column of each CSV file, and errors have their unit in the column's head.
TEST_F(StudyDatapath, ColumnsAreDocumented) {
  const std::string page = read_bytes(NINEBIT_SOURCE_DIR "/docs/study/datapath.md");
  const std::string columns = page.substr(page.find("## Columns"));
  EXPECT_EQ(study({"--program", kArticle, "--over", "tex0.r", "-o", folder_ / "program", "--quiet"}).code, 0);
  const Json operations =
      json_of(study({"--profile", "geforce2,nv2a", "-o", folder_ / "operations", "--quiet", "--json"}));
  EXPECT_EQ(operations["rows"].size(), 2 * kOperations) << "those of both profiles";
  std::size_t seen = 0;
  for (const char* folder : {"program", "operations"}) {
    for (const auto& [name, bytes] : files_in(folder_ / folder)) {
      if (!name.ends_with(".csv") || name == "error.csv") continue;
      std::istringstream head(bytes.substr(0, bytes.find("\r\n")));
      for (std::string column; std::getline(head, column, ','); ++seen) {
        EXPECT_NE(columns.find('`' + column + '`'), std::string::npos) << name << ": " << column;
        const bool error = column.find("error") != std::string::npos || column.find("bias") != std::string::npos ||
                           column.starts_with("added_") || column.starts_with("remaining_");
        EXPECT_EQ(error || column == "worst_exact_codes", column.ends_with("_codes")) << name << ": " << column;
      }
    }
  }
  EXPECT_EQ(seen, 13U + 14U + 7U + 12U + 6U);
}

// 2^32 combinations of four inputs, of which red and green read two each: each is measured over its own.
TEST_F(StudyDatapath, ChannelsThatSeparate) {
  const std::string program = write_bytes(
      folder_ / "product.rc1", "!!RC1.0\n{\n  rgb {\n    spare0 = col0 * tex0;\n  }\n}\nout.rgb = spare0.rgb;\n");
  const std::string over = "primary.r,tex0.r,primary.g,tex0.g";
  const Json json = json_of(study({"--program", program, "--over", over, "-o", folder_ / "out", "--quiet", "--json"}));
  ASSERT_EQ(json["rows"].size(), 4U);
  EXPECT_EQ(json["rows"][0]["over"], "primary.r, tex0.r");
  EXPECT_EQ(json["rows"][1]["over"], "primary.g, tex0.g");
  EXPECT_EQ(json["rows"][2]["over"], "none");
  EXPECT_EQ(json["rows"][1]["fragments"], 65536);
  const Files files = files_in(folder_ / "out");
  EXPECT_TRUE(files.at("error-g.csv").starts_with("primary.g,tex0.g,error.g\n"));
  EXPECT_TRUE(files.contains("error-r.npy") && files.contains("error-green.png"));
  const Outcome said = study({"--program", program, "--over", over});
  expect_parts(said.out, {"green over primary.g, tex0.g: exact for "});

  // A report on some of the units has no maps and files of the errors, which would show fragments that were not
  // measured.
  const Words part{"--program", program, "--over", over, "-o", folder_ / "part", "--budget", "0.005"};
  EXPECT_TRUE(study(part).out.starts_with("Only "));
  const Files some = files_in(folder_ / "part");
  EXPECT_TRUE(some.contains("histogram.svg"));
  EXPECT_FALSE(some.contains("error-r.csv") || some.contains("error-red.png"));
  EXPECT_TRUE(study({"--program", program, "--over", over, "-o", folder_ / "part"}).out.starts_with("red over "));
  EXPECT_EQ(files_in(folder_ / "part").at("error-red.png"), files.at("error-red.png"));
}

TEST_F(StudyDatapath, EveryCaseOfTheSum) {
  const std::string profile = write_bytes(folder_ / "small.json", R"({"base": "geforce2", "name": "small",
      "byte_shift": 4, "one": 15, "lowest": -15, "lowest_output": -15, "half": 8, "expand_offset": 15})");
  const Json json = json_of(study({"--exhaustive-sum", "--forms", "x4,biased-x2", "--profile", profile, "--json"}));
  ASSERT_EQ(json["rows"].size(), 62U);
  EXPECT_EQ(json["rows"][0]["form"], "x4");
  EXPECT_EQ(json["rows"][31]["form"], "-1/2, x2");
  EXPECT_EQ(json["rows"][31]["a"], -15);
  EXPECT_EQ(json["rows"][31]["cases"], 31 * 31 * 31);
}

TEST_F(StudyDatapath, Refusals) {
  const std::string table = write_bytes(folder_ / "codes.csv", "tex0.g\n12\n900\n");
  expect_error(study({"--program", kArticle}), 2, {"--inputs", "--over"});
  expect_error(study({"--over", "tex0.r"}), 2, {"--program"});
  expect_error(study({"--program", kArticle, "--over", "tex0.r", "--inputs", table}), 2, {"--inputs", "--over"});
  expect_error(study({"--exhaustive-sum", "--program", kArticle, "--over", "tex0.r"}), 2, {"--program"});
  expect_error(study({"--exhaustive-sum", "--forms", "x3"}), 2, {"x3", "biased-x2"});
  expect_error(study({"--forms", "x1"}), 2, {"--exhaustive-sum"});
  expect_error(study({"--program", kArticle, "--over", "tex0.x"}), 2, {"--over", "tex0.x"});
  expect_error(study({"--program", kArticle, "--over", "tex0.r,tex0.g,tex0.b,primary.r"}), 3,
               {"combinations", "alpha depends on tex0.r, tex0.g, tex0.b, primary.r together"});
  expect_error(study({"--program", kArticle, "--inputs", table}), 3, {"codes.csv:3:1", "900"});
  expect_error(study({"--program", kArticle, "--inputs", write_bytes(folder_ / "none.csv", "tex0.g\n")}), 3,
               {"no rows"});
  expect_error(study({"--program", folder_ / "none.gl", "--over", "tex0.r"}), 3, {"none.gl"});
  expect_error(study({"--program", write_bytes(folder_ / "bad.gl", "glNothing();\n"), "--over", "tex0.r"}), 3,
               {"bad.gl:1"});
  expect_error(study({"--profile", "ideal"}), 2, {"ideal"});
}

}  // namespace
}  // namespace tools_test
