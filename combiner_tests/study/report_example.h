// A report of every kind of content, made of invented rows.
#pragma once

#include <vector>

#include "ninebit/study/report.h"
#include "ninebit/study/study.h"

namespace report_test {

struct ExampleReport {
  ninebit::StudyQuestion question;
  std::vector<ninebit::StudyRow> rows;
  ninebit::StudyReport report;
};

// Names in it try to break out of HTML, JSON and CSV.
ExampleReport example();

}  // namespace report_test
