#include <gtest/gtest.h>
#include <ninebit/study/report_files.h>

#include <string>
#include <vector>

TEST(Examples, ReportFiles) {
  using namespace ninebit;
  const std::vector<StudyRow> rows{{.fields = {{"step", std::uint64_t{1}}, {"share", 0.5}}}};
  EXPECT_EQ(report_csv(rows)[0].second, "step,share\r\n1,0.5\r\n");
  const StudyQuestion question{.study = "index-steps", .profile = "geforce2"};
  EXPECT_NE(report_json(question, "0.1.0", rows).find("\"rows\""), std::string::npos);
  StudyReport report;
  report.title = "Index steps";
  const Result<std::string> page = report_html(question, "0.1.0", report, rows);
  EXPECT_EQ(page->substr(0, 15), "<!doctype html>");
}
