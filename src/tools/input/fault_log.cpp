#include "src/tools/input/fault_log.h"

#include <utility>

namespace ninebit::tools {
namespace {

std::vector<LoggedFault>& fault_list() {
  static std::vector<LoggedFault> faults;
  return faults;
}

bool answer_has_begun = false;

}  // namespace

void log_fault(LoggedFault fault) {
  constexpr std::size_t kMostFaults = 1'000;
  if (fault_list().size() < kMostFaults) fault_list().push_back(std::move(fault));
}

const std::vector<LoggedFault>& logged_faults() {
  return fault_list();
}

void clear_faults() {
  fault_list().clear();
}

void log_answer() noexcept {
  answer_has_begun = true;
}

bool answer_is_logged() noexcept {
  return answer_has_begun;
}

}  // namespace ninebit::tools
