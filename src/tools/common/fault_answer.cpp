#include "src/tools/common/fault_answer.h"

#include <algorithm>
#include <span>
#include <string_view>

#include "src/tools/input/fault_log.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

using Arguments = std::span<char* const>;

// Arguments after -- belong to another program.
bool asks_for_json(Arguments arguments) {
  const auto end =
      std::find_if(arguments.begin(), arguments.end(), [](const char* one) { return std::string_view(one) == "--"; });
  return std::any_of(arguments.begin(), end, [](const char* one) { return std::string_view(one) == "--json"; });
}

// The verb as it was given; empty: none.
std::string verb_in(Arguments arguments) {
  return arguments.size() > 1 && arguments[1][0] != '-' ? arguments[1] : "";
}

Json fault_json(const LoggedFault& fault) {
  Json out{{"message", fault.message}};
  if (!fault.file.empty()) out["file"] = fault.file;
  if (fault.line > 0) out["line"] = fault.line;
  if (fault.column > 0) out["column"] = fault.column;
  return out;
}

}  // namespace

void answer_with_faults(int argc, char** argv, int exit_code) {
  const Arguments arguments(argv, static_cast<std::size_t>(argc));
  if (exit_code == kDone || answer_is_logged() || !asks_for_json(arguments) || logged_faults().empty()) return;
  Json faults = Json::array();
  for (const LoggedFault& fault : logged_faults()) faults.push_back(fault_json(fault));
  const Json out{{"command", verb_in(arguments)},
                 {"version", NINEBIT_VERSION},
                 {"exit_code", exit_code},
                 {"error", faults.front()},
                 {"errors", faults}};
  (void)answer(out);
}

}  // namespace ninebit::tools
