#include <gtest/gtest.h>
#include <ninebit/study/report_files.h>

#include <string>
#include <vector>

TEST(Examples, ReportFiles) {
  using namespace ninebit;
  const std::vector<StudyRow> rows{{.fields = {{"step", std::uint64_t{1}}, {"share", 0.5}}}};
  StudyReport report;
  report.title = "Index steps";
  EXPECT_EQ(report_csv(report, rows)[0].second, "step,share\r\n1,0.5\r\n");
  const StudyQuestion question{.study = "index-steps", .profile = "geforce2"};
  EXPECT_NE(report_json(question, "0.1.0", report, rows).find("\"rows\""), std::string::npos);
  const Result<std::string> page = report_html(question, "0.1.0", report, rows);
  EXPECT_EQ(page->substr(0, 15), "<!doctype html>");
}
