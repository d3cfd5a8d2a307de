// The verbs and flags as plain data, taken from the CLI11 app that parses them. The manual page and the shell
// completions are generated from it.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace ninebit::tools {

struct FlagText {
  std::vector<std::string> names;    // "-o", "--output"; a positional argument has one name, such as "scene"
  std::string value;                 // "DIR"; empty: the flag takes no value
  std::string description;           // one sentence without its full stop
  std::string default_value;         // empty: none
  std::vector<std::string> choices;  // the allowed values
  bool takes_file = false;           // the value is a file or a folder
  bool takes_profile = false;        // the value is one of the choices, or a .json file
  bool required = false;
};

struct VerbText {
  std::vector<std::string> path;  // {"ninebit", "study", "index-steps"}
  std::string description;
  std::string footer;
  std::vector<FlagText> flags;
  std::vector<FlagText> arguments;  // positional, in order
  std::vector<VerbText> verbs;

  [[nodiscard]] const std::string& name() const { return path.back(); }
  [[nodiscard]] std::string command() const;  // "ninebit study index-steps"
};

// The text of an app and its verbs; hidden verbs and flags are left out.
[[nodiscard]] VerbText describe(const CLI::App& app);

// The manual page, as troff with the `man` macros.
[[nodiscard]] std::string manual_page(const VerbText& program);

// Scripts that complete verbs, flags, choices and file names.
[[nodiscard]] std::string bash_completion(const VerbText& program);
[[nodiscard]] std::string zsh_completion(const VerbText& program);
[[nodiscard]] std::string fish_completion(const VerbText& program);

}  // namespace ninebit::tools
