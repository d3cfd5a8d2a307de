// Studies of several profiles as one, with one report.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "ninebit/study/study.h"

namespace ninebit {

// A study whose rows all name its profile in the field "profile".
struct ProfileStudy {
  std::string profile;
  std::unique_ptr<Study> study;
};

// The studies, at least one, one after the other. Their profiles have different names, which the parts of the report
// and its files start or end with.
[[nodiscard]] std::unique_ptr<Study> joined_study(StudyQuestion question, std::vector<ProfileStudy> studies);

}  // namespace ninebit
