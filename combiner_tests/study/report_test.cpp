// A report's files: what they hold, and that they appear together or not at all.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <set>

#include "combiner_tests/study/report_example.h"
#include "combiner_tests/support/temp_folder.h"
#include "ninebit/study/report_files.h"
#include "src/study/report/page_data.h"
#include "src/study/report/report_colors.h"
#include "src/study/report/report_svg.h"
#include "src/system/hashing/openssl.h"

namespace {

using namespace ninebit;
using report_test::example;
using report_test::ExampleReport;
using test::read_bytes;
using test::TempFolder;
namespace fs = std::filesystem;

std::string html_of(const ExampleReport& made) {
  const auto html = report_html(made.question, "1.2.3", made.report, made.rows);
  return html ? *html : html.error().text();
}

std::size_t times(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

TEST(StudyRow, ValuesByName) {
  const StudyRow row{"rows",
                     {{"whole", std::int64_t{-3}},
                      {"large", std::numeric_limits<std::uint64_t>::max()},
                      {"real", 0.1},
                      {"text", std::string("nine")},
                      {"nothing", StudyValue{}}}};
  EXPECT_EQ(row["whole"], StudyValue(std::int64_t{-3}));
  EXPECT_EQ(row["unknown"], StudyValue());
  EXPECT_EQ(row.number("whole"), -3.0);
  EXPECT_EQ(row.number("real"), 0.1);
  EXPECT_EQ(row.number("text"), 0.0);
  EXPECT_EQ(row.count("large"), std::numeric_limits<std::uint64_t>::max());
  EXPECT_EQ(row.count("whole"), 0U);
  EXPECT_EQ(row.count("real"), 0U);
  EXPECT_EQ(row.text("large"), "18446744073709551615");
  EXPECT_EQ(row.text("whole"), "-3");
  EXPECT_EQ(row.text("text"), "nine");
  EXPECT_EQ(row.text("nothing"), "");
}

TEST(StudyRow, RealsComeBackTheSame) {
  for (const double value : {0.1, 1.0 / 3.0, 1e-300, 5e-324, 123456789.123456789, 1e22, -0.0}) {
    const std::string text = text_of(value);
    EXPECT_EQ(std::signbit(std::strtod(text.c_str(), nullptr)), std::signbit(value)) << text;
    EXPECT_EQ(std::strtod(text.c_str(), nullptr), value) << text;
  }
  EXPECT_EQ(text_of(0.5), "0.5");
}

TEST(Report, JsonHoldsEveryRowExactly) {
  const ExampleReport made = example();
  const auto json = nlohmann::json::parse(report_json(made.question, "1.2.3", made.report, made.rows));
  EXPECT_EQ(json["command"], "study index-steps");
  EXPECT_EQ(json["version"], "1.2.3");
  EXPECT_EQ(json["profile"], "all");
  EXPECT_EQ(json["question"], made.question.command());
  ASSERT_EQ(json["rows"].size(), made.rows.size() - 1);
  for (std::size_t i = 0; i < json["rows"].size(); ++i) {
    EXPECT_EQ(json["rows"][i]["profile"], made.rows[i].text("profile"));
    EXPECT_EQ(json["rows"][i]["step"], made.rows[i].number("step"));
    EXPECT_EQ(json["rows"][i]["false_matches"].get<std::uint64_t>(), made.rows[i].count("false_matches"));
    EXPECT_EQ(json["rows"][i]["share"].get<double>(), made.rows[i].number("share"));
  }
  EXPECT_EQ(json["rows"][0]["note"], "a \"quote\", a comma\nand </script>");
  EXPECT_TRUE(json["rows"][1]["note"].is_null());
  ASSERT_EQ(json["worst"].size(), 2U);
  EXPECT_EQ(json["worst"][0]["error"].get<double>(), 1.0 / 3.0);
  EXPECT_EQ(json["worst"][1]["operation"], "of the report");  // its rows come behind
  // No row: still an object with rows.
  EXPECT_EQ(nlohmann::json::parse(report_json(made.question, "1", {}, {}))["rows"].size(), 0U);
}

TEST(Report, JsonTakesNamesThatAreNoUtf8) {
  const std::vector<StudyRow> rows{{"rows", {{"file", std::string("\xff\xfe.gl")}}}};
  const auto json = nlohmann::json::parse(report_json(example().question, "1", {}, rows));
  EXPECT_EQ(json["rows"][0]["file"], "\uFFFD\uFFFD.gl");
}

TEST(Report, CsvIsThatOfRfc4180) {
  const std::vector<StudyRow> rows{{"rows", {{"name", std::string("plain")}, {"n", std::int64_t{-1}}}},
                                   {"other", {{"a,b", 0.1}}},
                                   {"rows", {{"name", std::string("a \"b\", c\r\nd")}, {"n", StudyValue{}}}}};
  StudyReport report;
  report.rows = {{"other", {{"a,b", 0.2}}}};
  const auto tables = report_csv(report, rows);
  ASSERT_EQ(tables.size(), 2U);
  EXPECT_EQ(tables[0].first, "rows");
  EXPECT_EQ(tables[0].second, "name,n\r\nplain,-1\r\n\"a \"\"b\"\", c\r\nd\",\r\n");
  EXPECT_EQ(tables[1].first, "other");
  EXPECT_EQ(tables[1].second, "\"a,b\"\r\n0.1\r\n0.2\r\n");
}

TEST(Report, PageTellsHowItWasMade) {
  const ExampleReport made = example();
  const std::string html = html_of(made);
  EXPECT_NE(html.find("<h1>Index steps &lt;example&gt;</h1>"), std::string::npos);
  EXPECT_NE(html.find("ninebit study index-steps &#39;a&lt;/script&gt;&lt;b&gt;.gl&#39; --steps 1-16"),
            std::string::npos);
  EXPECT_NE(html.find("ninebit 1.2.3"), std::string::npos);
  EXPECT_NE(html.find("0123abcd"), std::string::npos);
  for (const auto& [table, text] : report_csv(made.report, made.rows)) {
    EXPECT_NE(html.find(sha256(text)), std::string::npos) << table;
  }
  EXPECT_NE(html.find("<dt>worst.csv</dt><dd>2 rows"), std::string::npos);
  // Answers come first.
  EXPECT_LT(html.find("step 2 is the smallest"), html.find("How it was made"));
  EXPECT_LT(html.find("How it was made"), html.find("False matches by step"));
}

TEST(Report, PageStandsAlone) {
  const std::string html = html_of(example());
  // Only data: URLs and places in the page.
  for (const char* attribute : {"src=\"", "href=\""}) {
    for (std::size_t at = html.find(attribute); at != std::string::npos; at = html.find(attribute, at + 1)) {
      const std::string target = html.substr(at + std::string(attribute).size(), 5);
      EXPECT_TRUE(target == "data:" || target[0] == '#') << html.substr(at, 80);
    }
  }
  EXPECT_EQ(times(html, "@import"), 0U);
  EXPECT_EQ(times(html, "url("), 0U);
  EXPECT_NE(html.find("Chart.js v3"), std::string::npos);
  EXPECT_NE(html.find("default-src 'none'"), std::string::npos);
}

TEST(Report, NothingBreaksOutOfThePage) {
  ExampleReport made = example();
  const std::string evil = "\"></script><script>alert('1')</script><b title='&";
  made.report.title = made.report.answers[0] = made.question.profile = made.question.study = evil;
  made.question.options = {{evil, evil}, {"--program", evil}};
  made.report.tables[0].title = made.report.tables[0].caption = made.report.tables[0].columns[0] = evil;
  made.report.tables[0].rows[0][0] = evil;
  made.report.plots[0].title = made.report.plots[0].caption = made.report.plots[0].x_label = evil;
  made.report.plots[0].series[0].name = made.report.plots[0].y_label = made.report.plots[0].file = evil;
  made.report.heat_maps[0].title = made.report.heat_maps[0].caption = made.report.heat_maps[0].x_label = evil;
  made.report.heat_maps[0].y_label = made.report.heat_maps[0].file = evil;
  made.report.pictures[0].title = made.report.pictures[0].caption = made.report.pictures[0].file = evil;
  made.report.heat_maps[0].none = evil;
  made.report.summary = made.report.tables;
  made.rows[0].table = evil;
  const std::string html = html_of(made);
  EXPECT_EQ(times(html, "<script>alert"), 0U);
  EXPECT_EQ(times(html, "<b title"), 0U);
  EXPECT_EQ(times(html, "</script>"), 3U);  // the data, Chart.js and the page's own
  EXPECT_EQ(times(html, "<script"), 3U);
  EXPECT_GT(times(html, "&quot;&gt;&lt;/script&gt;&lt;script&gt;alert(&#39;1&#39;)"), 15U);
}

TEST(Report, TablesSortByKeyboardToo) {
  const ExampleReport made = example();
  const std::string html = html_of(made);
  const std::size_t columns = made.report.tables[0].columns.size();
  EXPECT_EQ(times(html, "<th scope=\"col\""), columns);
  EXPECT_EQ(times(html, "aria-sort=\"none\"><button type=\"button\">"), columns);
  EXPECT_EQ(times(html, "<tr>"), made.report.tables[0].rows.size() + 1);
  // Numbers keep their exact values beside those that people read.
  EXPECT_NE(html.find("data-v=\"12000\" title=\"12000\">12\u202f000</td>"), std::string::npos);
  EXPECT_NE(html.find("data-v=\"0.18382352941176472\" title=\"0.18382352941176472\">0.183824</td>"), std::string::npos);
}

TEST(Report, DataOfPlotsAndMaps) {
  const ExampleReport made = example();
  const auto text = page_data(made.report);
  ASSERT_TRUE(text.ok());
  const auto data = nlohmann::json::parse(*text);
  ASSERT_EQ(data["plots"].size(), 2U);
  // Zeros have no place on a logarithmic axis.
  EXPECT_EQ(data["plots"][0]["series"][0]["points"].size(), 8U);
  EXPECT_EQ(data["plots"][0]["series"][0]["points"][0]["y"], 12000.0);
  EXPECT_EQ(data["plots"][1]["labels"], nlohmann::json({"1", "2", "3"}));
  EXPECT_EQ(data["plots"][1]["series"][1]["points"], nlohmann::json({-0.5, nullptr, 1.0}));
  // Values that are few are listed.
  EXPECT_EQ(data["maps"][1]["known"].size(), 32U);
  EXPECT_TRUE(data["maps"][1]["known"][5].is_null());
  EXPECT_EQ(data["maps"][1]["values"], base64(std::string("\0\1\2\3\4\5\6\7", 8) + "\x08\x09\x0a\x0b\x0c\x0d\x0e\x0f" +
                                              "\x10\x11\x12\x13\x14\x15\x16\x17\x18\x19\x1a\x1b\x1c\x1d\x1e\x1f"));
  EXPECT_EQ(data["maps"][0]["by"], "product");
  EXPECT_EQ(base64("Man"), "TWFu");
  EXPECT_EQ(base64(""), "");
}

// Left-out points break a line; the beginning and the end of a line need no mark.
TEST(Report, LinesDoNotCrossPointsThatAreLeftOut) {
  StudyReport report{.title = "a", .answers = {}};
  report.plots.push_back({.file = "a",
                          .title = "a",
                          .x_label = "",
                          .y_label = "",
                          .log_y = true,
                          .series = {{"a", {{1, 0}, {2, 3}, {3, 0}, {4, 0}, {5, 7}, {6, 1e300}}}}});
  report.plots.push_back(report.plots[0]);
  report.plots[1].even_x = true;
  const auto text = page_data(report);
  ASSERT_TRUE(text.ok());
  const auto plots = nlohmann::json::parse(*text)["plots"];
  EXPECT_EQ(plots[0]["series"][0]["points"],
            nlohmann::json::parse(R"([{"x":2.0,"y":3.0},{"x":5.0,"y":null},{"x":5.0,"y":7.0}])"));
  EXPECT_EQ(plots[1]["labels"], nlohmann::json({"2", "5"}));
  EXPECT_EQ(plots[1]["series"][0]["points"], nlohmann::json({3.0, 7.0}));
}

TEST(Report, HeadlinesAndTheirTablesStandForTheAnswers) {
  ExampleReport made = example();
  made.report.headlines = {"One sentence."};
  made.report.summary = {{.title = "Figures", .columns = {"step", "lost"}, .rows = {{std::int64_t{1}, 0.5}}}};
  const std::string html = html_of(made);
  EXPECT_NE(html.find("<li>One sentence.</li>"), std::string::npos);
  EXPECT_EQ(html.find("step 2 is the smallest"), std::string::npos);
  EXPECT_LT(html.find("<h3>Figures</h3>"), html.find("How it was made"));
}

TEST(Report, OneColumnOfATableStaysInView) {
  ExampleReport made = example();
  EXPECT_EQ(times(html_of(made), "class=\"n kept\""), 0U);
  made.report.tables[0].kept = "false matches";
  EXPECT_EQ(times(html_of(made), "class=\"n kept\""), made.report.tables[0].rows.size() + 1);
}

TEST(Report, UnevenColumnsOfAMapHaveTheirOwnLabels) {
  ExampleReport made = example();
  HeatMap& map = made.report.heat_maps[1];
  map.x_values = {0, 1, 16, 64, 256, 1024, 4096, 16384};
  EXPECT_NE(html_of(made).find("<span>256</span><span>1024</span><span>4096</span>"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(*page_data(made.report))["maps"][1]["x_values"].size(), 8U);
  map.x_values.pop_back();
  const auto failed = report_html(made.question, "1", made.report, made.rows);
  ASSERT_FALSE(failed.ok());
  EXPECT_NE(failed.error().message.find("7 and 0 coordinates; expected 8 and 4"), std::string::npos);
}

TEST(Report, AMapOfAnotherSizeIsReported) {
  ExampleReport made = example();
  made.report.heat_maps[0].width = 510;
  const auto html = report_html(made.question, "1", made.report, made.rows);
  ASSERT_FALSE(html.ok());
  EXPECT_NE(html.error().message.find("261121 values; expected 510 x 511"), std::string::npos) << html.error().text();
}

TEST(Report, FilesAreTheSameEachTime) {
  const ExampleReport made = example();
  const TempFolder folder;
  const auto first = write_report(folder.path() / "1", made.question, "1.2.3", made.report, made.rows);
  const auto second = write_report(folder.path() / "2", made.question, "1.2.3", made.report, made.rows);
  ASSERT_TRUE(first.ok()) << first.error().text();
  ASSERT_TRUE(second.ok());
  const std::vector<std::string> names{"report.html",        "rows.json",          "rows.csv",
                                       "worst.csv",          "false-matches.svg",  "errors-by-stage.svg",
                                       "product-errors.png", "product-errors.svg", "by-step.png",
                                       "by-step.svg",        "wrong-pixels.png"};
  ASSERT_EQ(first->size(), names.size());
  for (std::size_t i = 0; i < names.size(); ++i) {
    EXPECT_EQ((*first)[i], folder.path() / "1" / names[i]);
    const std::string bytes = read_bytes((*first)[i]);
    EXPECT_FALSE(bytes.empty()) << names[i];
    EXPECT_EQ(bytes, read_bytes((*second)[i])) << names[i];
  }
  EXPECT_EQ(read_bytes(folder.path() / "1/rows.csv"), report_csv(made.report, made.rows)[0].second);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path() / "1"), {}), 11);
}

// The text of the elements <text>, in their order.
std::vector<std::string> texts_in(const std::string& svg) {
  std::vector<std::string> texts;
  for (std::size_t at = svg.find("<text "); at != std::string::npos; at = svg.find("<text ", at + 1)) {
    const std::size_t begin = svg.find('>', at) + 1;
    texts.push_back(svg.substr(begin, svg.find("</text>", begin) - begin));
  }
  return texts;
}

using Texts = std::vector<std::string>;

TEST(ReportSvg, APlotHasItsAxesItsLegendAndItsCaption) {
  const Plot plot{.file = "a",
                  .title = "Lost & <found>\x01",
                  .x_label = "step",
                  .y_label = "pairs",
                  .log_y = true,
                  .series = {{"one", {{1, 1}, {2, 100}, {3, 0}, {4, 5000}}}, {"two", {{1, 10}, {4, 1e6}}}},
                  .caption = "Zeros are left out."};
  const std::string svg = svg_of(plot);
  EXPECT_EQ(texts_in(svg), (Texts{"1", "10", "100", "1000", "10⁴", "10⁵", "10⁶", "pairs", "1", "2", "3", "4", "step",
                                  "one", "two", "Lost &amp; &lt;found&gt;\uFFFD", "Zeros are left out."}));
  EXPECT_EQ(times(svg, "<circle "), 4U);  // three points, and the legend's
  // The gap breaks the line: it begins twice. The axis x ends at the points, y at powers of ten.
  EXPECT_NE(svg.find("d=\"M110.0 456.0L365.3 322.7M876.0 209.4\""), std::string::npos) << svg;
}

TEST(ReportSvg, BarsStandOnZeroAndAreNamed) {
  const Plot plot{.file = "a",
                  .title = "Errors",
                  .x_label = "",
                  .y_label = "codes",
                  .x_names = {"product", "sum"},
                  .bars = true,
                  .series = {{"rgb", {{1, 1.5}, {2, -0.5}}}}};
  const std::string svg = svg_of(plot);
  EXPECT_EQ(texts_in(svg), (Texts{"-0.5", "0", "0.5", "1", "1.5", "codes", "product", "sum", "", "Errors"}));
  EXPECT_NE(svg.find("y=\"56.0\" width=\"275.8\" height=\"300.0\""), std::string::npos) << svg;   // up
  EXPECT_NE(svg.find("y=\"356.0\" width=\"275.8\" height=\"100.0\""), std::string::npos) << svg;  // down
}

TEST(ReportSvg, AMapHasItsAxesAndItsColorsScale) {
  const ExampleReport made = example();
  const auto errors = svg_of(made.report.heat_maps[0]);
  ASSERT_TRUE(errors.ok());
  EXPECT_EQ(texts_in(*errors),
            (Texts{"-200", "-100", "0", "100", "200", "B", "-200", "-100", "0", "100", "200", "A", "-0.5", "0", "0.5",
                   "-1", "1", "Error of a product", "In codes: what comes out less the exact product."}));
  EXPECT_EQ(times(*errors, "<image "), 2U);
  const auto counts = svg_of(made.report.heat_maps[1]);
  ASSERT_TRUE(counts.ok());
  EXPECT_EQ(times(*counts, ">none</text>"), 1U);  // one value is none
  HeatMap uneven = made.report.heat_maps[1];
  uneven.x_values = {0, 1, 16, 64, 256, 1024, 4096, 16384};
  EXPECT_NE(svg_of(uneven)->find(">256</text>"), std::string::npos);
  uneven.width = 3;
  EXPECT_FALSE(svg_of(uneven).ok());
}

TEST(ReportSvg, WhatHasNoPointIsAnEmptyPlot) {
  Plot plot{.file = "a", .title = "a", .x_label = "x", .y_label = "y", .series = {}};
  for (const bool log : {false, true}) {
    for (const bool bars : {false, true}) {
      plot.log_x = plot.log_y = log;
      plot.bars = bars;
      plot.series = {};
      EXPECT_EQ(svg_of(plot).find("nan"), std::string::npos);
      plot.series = {{"one", {{3, 7}}}};
      const std::string one = svg_of(plot);
      EXPECT_EQ(one.find("nan"), std::string::npos) << one;
      EXPECT_EQ(one.find("inf"), std::string::npos) << one;
    }
  }
}

TEST(Report, AllFilesOrNone) {
  ExampleReport made = example();
  const TempFolder folder;
  ASSERT_TRUE(write_report(folder.path(), made.question, "old", made.report, made.rows).ok());
  const std::string old = read_bytes(folder.path() / "report.html");
  // A folder stands where a file should go: nothing changes.
  fs::create_directory(folder.path() / "late.png");
  made.report.pictures[0].file = "late";
  const auto failed = write_report(folder.path(), made.question, "new", made.report, made.rows);
  ASSERT_FALSE(failed.ok());
  EXPECT_EQ(failed.error().fault, Fault::cannot_write);
  EXPECT_NE(failed.error().text().find("late.png"), std::string::npos) << failed.error().text();
  EXPECT_EQ(read_bytes(folder.path() / "report.html"), old);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 12);  // and nothing is left over
  // Two of the same name would be one file.
  made.report.pictures[0].file = made.report.heat_maps[0].file;
  const auto doubled = write_report(folder.path(), made.question, "new", made.report, made.rows);
  ASSERT_FALSE(doubled.ok());
  EXPECT_NE(doubled.error().text().find("product-errors.png: two files"), std::string::npos) << doubled.error().text();
  EXPECT_EQ(read_bytes(folder.path() / "report.html"), old);
}

TEST(Report, AFolderThatCannotBeWrittenIsReported) {
  const ExampleReport made = example();
  for (const char* folder : {"/proc/ninebit", "/dev/null/report"}) {
    const auto failed = write_report(folder, made.question, "1", made.report, made.rows);
    ASSERT_FALSE(failed.ok());
    EXPECT_EQ(failed.error().fault, Fault::cannot_write);
    EXPECT_NE(failed.error().text().find(folder), std::string::npos) << failed.error().text();
  }
}

// report_in_browser.py says where it wants it.
TEST(Report, LeavesTheExampleWhereAsked) {
  const TempFolder folder;
  const char* const asked = std::getenv("NINEBIT_REPORT_EXAMPLE");
  const ExampleReport made = example();
  const auto files = write_report(asked != nullptr ? fs::path(asked) : folder.path() / "example", made.question,
                                  "1.2.3", made.report, made.rows);
  ASSERT_TRUE(files.ok()) << files.error().text();
  EXPECT_TRUE(fs::exists(files->front()));
}

}  // namespace
