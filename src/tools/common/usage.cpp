#include "src/tools/common/usage.h"

#include <fmt/ranges.h>

#include <algorithm>
#include <regex>
#include <span>
#include <string_view>
#include <vector>

#include "src/system/nearest_name.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {

namespace {

// The verb whose arguments were being parsed.
const CLI::App& verb_of(const CLI::App& app) {
  const CLI::App* at = &app;
  while (!at->get_subcommands().empty()) at = at->get_subcommands()[0];
  return *at;
}

std::vector<std::string> flags_of(const CLI::App& verb) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

std::vector<std::string> verbs_of(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* verb : app.get_subcommands([](const CLI::App* one) { return !one->get_group().empty(); })) {
    names.push_back(verb->get_name());
  }
  return names;
}

// Why this verb does not have a flag that most verbs have; empty: no such flag was given.
std::string refused_flag(const CLI::App& verb, const std::string& command) {
  for (const std::string& word : verb.remaining()) {
    const std::string flag = word.substr(0, word.find('='));
    if (flag == "--threads") return fmt::format("--threads: `{}` uses one thread; leave the flag out", command);
    if (flag == "--profile") return fmt::format("--profile: `{}` does not depend on it; leave the flag out", command);
  }
  return "";
}

// A suggestion for the first unknown flag.
std::string meant_flag(const CLI::App& verb) {
  for (const std::string& word : verb.remaining()) {
    if (word.starts_with("--")) return did_you_mean(word.substr(0, word.find('=')), flags_of(verb));
  }
  return "";
}

// A suggestion for an unknown choice. CLI11's message is "--technique: shadow-mop not in {index-cube,shadow-map}".
std::string meant_choice(const std::string& message) {
  static const std::regex choice(R"(^[^:]*: (.*) not in \{([^}]*)\}[^}]*$)");
  std::smatch found;
  if (!std::regex_match(message, found, choice)) return "";
  std::vector<std::string> known;
  std::string list = found[2].str() + ',';
  for (std::size_t end = 0; (end = list.find(',')) != std::string::npos; list.erase(0, end + 1)) {
    known.push_back(list.substr(0, end));
  }
  return did_you_mean(found[1].str(), known);
}

}  // namespace

std::string usage_message(const CLI::App& app, const CLI::ParseError& error) {
  const CLI::App& at = verb_of(app);
  std::string command = at.get_name();
  for (const CLI::App* above = at.get_parent(); above != nullptr; above = above->get_parent()) {
    command.insert(0, above->get_name() + ' ');
  }
  std::string message = error.what();
  const std::string unmet = " missing";
  if (error.get_name() == "ArgumentMismatch" && message.ends_with(unmet)) {
    message.resize(std::min(message.find(':'), message.size()));
    message += " requires a value";
  } else if (const auto verbs = verbs_of(at); error.get_name() == "RequiredError" && !verbs.empty()) {
    const std::vector<std::string> unknown = at.remaining();
    const std::string list = fmt::format("{}", fmt::join(verbs, ", "));
    if (unknown.empty()) {
      message = "a command is required; expected one of " + list;
    } else {
      message = fmt::format("unknown {} '{}'; expected one of {}{}{}", unknown[0].starts_with('-') ? "flag" : "command",
                            unknown[0], list, did_you_mean(unknown[0], verbs), meant_flag(at));
    }
  } else if (const std::string refused = refused_flag(at, command); !refused.empty()) {
    message = refused;
  } else if (error.get_name() == "RequiredError" ||  // CLI11 checks for missing arguments first
             error.get_exit_code() ==
                 static_cast<int>(CLI::ExitCodes::ExtrasError)) {  // the error's name is that of the verb
    message += meant_flag(at);
  } else if (error.get_name() == "ValidationError") {
    message += meant_choice(message);
  }
  return fmt::format("{} (see: {} --help)", message, command);
}

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
