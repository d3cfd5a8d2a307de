// Pages of `ninebit trace -o` and `ninebit explain -o`.
#include <gtest/gtest.h>

#include <filesystem>

#include "combiner_tests/tools/program_support.h"

namespace tools_test {
namespace {

class Pages : public testing::Test {
 protected:
  // The page that the arguments write.
  std::string page_of(Words arguments) {
    const std::string file = folder_ / "page.html";
    const Outcome outcome = ninebit(arguments + Words{"-o", file});
    EXPECT_EQ(outcome.code, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "wrote " + file + "\n");
    return read_bytes(file);
  }
  TempFolder folder_;
};

std::size_t occurrences(const std::string& text, const std::string& word) {
  std::size_t count = 0;
  for (std::size_t at = 0; (at = text.find(word, at)) != std::string::npos; at += word.size()) ++count;
  return count;
}

// The JSON of a data element.
Json data_of(const std::string& page, const std::string& id) {
  const std::string start = "<script type=\"application/json\" id=\"" + id + "\">";
  const std::size_t begin = page.find(start);
  if (begin == std::string::npos) return {};
  const std::size_t from = begin + start.size();
  return Json::parse(page.substr(from, page.find("</script>", from) - from));
}

const Words kArticleFragment{"trace", kArticle, "--set", "primary=102,0,0,0", "--set", "tex0=100,0,0,255"};

TEST_F(Pages, ATraceHasItsJsonAndItsText) {
  const std::string page = page_of(kArticleFragment);
  const Json pass = data_of(page, "passes")["passes"].at(0);
  EXPECT_EQ(pass["trace"], json_of(ninebit(kArticleFragment + Words{"--json"})));
  EXPECT_EQ(pass["explanation"]["rows"], json_of(ninebit({"explain", kArticle, "--json"}))["rows"]);
  expect_parts(page, {"<dt>Out</dt><dd>bytes 0, 0, 0, 1</dd>"});
  ::unsetenv("COLUMNS");
  const std::string text = ninebit(kArticleFragment).out;
  EXPECT_NE(page.find(text.substr(0, text.find('<'))), std::string::npos);
  EXPECT_EQ(occurrences(page, "\npassSwitch("), 1U);
}

TEST_F(Pages, AnExplanationHasTheProgram) {
  const std::string page = page_of({"explain", kArticle});
  EXPECT_EQ(data_of(page, "program"), json_of(ninebit({"convert", kArticle, "--to", "json"})));
  EXPECT_EQ(data_of(page, "explanation"), json_of(ninebit({"explain", kArticle, "--json"})));
  EXPECT_EQ(occurrences(page, "\nprogramDiagram("), 1U);
  expect_parts(page, {"spare0 = 4·(primary − tex0)"});
}

// The modules became one script; nothing is loaded from elsewhere.
TEST_F(Pages, StandAlone) {
  for (const std::string& page : {page_of(kArticleFragment), page_of({"explain", kArticle})}) {
    EXPECT_EQ(occurrences(page, "\nimport "), 0U);
    EXPECT_EQ(occurrences(page, "\nexport "), 0U);
    EXPECT_EQ(occurrences(page, " src="), 0U);
    EXPECT_EQ(occurrences(page, "href="), 1U) << "the empty icon";
    EXPECT_EQ(occurrences(page, "http://"), 1U) << "SVG's name space";
    EXPECT_EQ(occurrences(page, "https://"), 0U);
    EXPECT_EQ(occurrences(page, "innerHTML"), 0U);
    EXPECT_EQ(occurrences(page, "default-src 'none'"), 1U);
  }
}

TEST_F(Pages, HostileNamesAreShownAndNotRun) {
  const std::string outer = folder_ / "a<", inner = outer + "/script><img src=x onerror=alert(1)>&'\"";
  std::filesystem::create_directories(inner);
  const std::string program = inner + "/<b>.gl";
  write_bytes(program, read_bytes(kArticle));
  for (const std::string verb : {"trace", "explain"}) {
    const std::string page = page_of({verb, program});
    const std::size_t scripts = verb == "trace" ? 2 : 3;  // with one element of data, or two
    EXPECT_EQ(occurrences(page, "<script"), scripts);
    EXPECT_EQ(occurrences(page, "</script"), scripts);
    EXPECT_EQ(occurrences(page, "<img"), 0U);
    EXPECT_EQ(occurrences(page, "<b>"), 0U);
    EXPECT_GE(occurrences(page, "a&lt;/script&gt;&lt;img src=x onerror=alert(1)&gt;&amp;'&quot;/&lt;b&gt;.gl"), 2U);
  }
  const Json passes = data_of(page_of({"trace", program}), "passes")["passes"];
  EXPECT_EQ(passes.at(0)["trace"]["program"], program);
}

TEST_F(Pages, JsonNamesTheFile) {
  const std::string file = folder_ / "page.html";
  for (const char* verb : {"trace", "explain"}) {
    const Json plain = json_of(ninebit({verb, kArticle, "--json"}));
    const Outcome outcome = ninebit({verb, kArticle, "--json", "--quiet", "-o", file});
    EXPECT_EQ(outcome.err, "");
    Json object = json_of(outcome);
    EXPECT_EQ(object["files"], Json::array({file}));
    object.erase("files");
    EXPECT_EQ(object, plain);
    EXPECT_EQ(files_in(std::string(folder_ / "")).size(), 1U);
  }
}

TEST_F(Pages, WhatCannotBeWrittenLeavesTheOlderFile) {
  const std::string older = write_bytes(folder_ / "page.html", "older");
  for (const char* verb : {"trace", "explain"}) {
    expect_error(ninebit({verb, kArticle, "-o", older + "/page.html"}), 4, {"page.html", "File exists"});
  }
  const Outcome outcome = ninebit({"explain", kArticle, "-o", older}, {.file_size_limit = 4096});
  EXPECT_EQ(outcome.code, 4);
  EXPECT_EQ(read_bytes(older), "older");
  EXPECT_EQ(files_in(std::string(folder_ / "")).size(), 1U) << "no temporary file stays";
}

TEST_F(Pages, APixelAndAPixelWithoutFragment) {
  const std::string effect = NINEBIT_SOURCE_DIR "/scenes/effects/dot3_specular.json";
  const std::string drawn = page_of({"trace", "--effect", effect, "--pixel", "128,80"});
  expect_parts(drawn, {"<h1>Pixel 128,80 of "});
  EXPECT_EQ(data_of(drawn, "passes")["passes"].at(0)["trace"]["effect"]["pixel"], Json({128, 80}));
  const std::string sky = page_of({"trace", "--scene", kRoom, "--pixel", "3,4", "--size", "20x20", "--light", "0,1,0",
                                   "--camera", "0,50,0", "--look-at", "0,90,1", "--floor", "none"});
  EXPECT_EQ(occurrences(sky, "<script"), 0U);
  expect_parts(sky, {"no fragment to trace"});
}

// Each pass that drew here has its own trace, whose colour is that of its fragment.
TEST_F(Pages, EveryPassThatDrewAtAPixel) {
  const Words room{"trace", "--scene", kRoom, "--size", "80x60", "--pixel", "40,50"};
  const Words effect{"trace", "--effect", NINEBIT_SOURCE_DIR "/scenes/effects/index_cube.json", "--pixel", "300,240"};
  for (const auto& arguments : {room, effect}) {
    const Json object = json_of(ninebit(arguments + Words{"--json", "--quiet"}));
    const Json& pixel = object[object.contains("scene") ? "scene" : "effect"];
    const Json drawn = data_of(page_of(arguments), "passes");
    EXPECT_EQ(drawn["passes"].at(drawn["first"].get<std::size_t>())["trace"], object) << "shown first";
    std::size_t number = 0, traced = 0;
    for (const Json& pass : pixel["passes"]) {
      if (pass["fragments"].empty()) continue;
      ASSERT_LT(number, drawn["passes"].size());
      const Json& shown = drawn["passes"][number++];
      EXPECT_EQ(shown["name"], pass["name"]);
      const bool has_program = pass["has_program"];
      EXPECT_EQ(shown["notes"].size(), pass["fragments"].size() + (has_program ? 0 : 1));
      ASSERT_EQ(shown.contains("trace"), has_program);
      if (!has_program) continue;
      ++traced;
      const Json& trace = shown["trace"];
      const Json& of = trace[object.contains("scene") ? "scene" : "effect"];
      EXPECT_EQ(of["pass"], pass["name"]);
      EXPECT_EQ(trace["out"]["bytes"], pass["fragments"].at(of["fragment"].get<std::size_t>())["color"]);
    }
    EXPECT_EQ(number, drawn["passes"].size());
    EXPECT_GE(number, 2U);
    EXPECT_GE(traced, 1U);
  }
}

}  // namespace
}  // namespace tools_test
