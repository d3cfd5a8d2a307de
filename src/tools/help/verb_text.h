// The program's verbs and flags as plain data, taken from the CLI11 app that parses them: what the manual page and the
// completions of shells are written from.
#pragma once

#include <CLI/CLI.hpp>
#include <string>
#include <vector>

namespace ninebit::tools {

struct FlagText {
  std::vector<std::string> names;    // "-o", "--output"; of an argument without a flag its one name, "scene"
  std::string value;                 // "DIR"; empty: the flag takes none
  std::string description;           // one sentence without its point
  std::string default_value;         // empty: none, or not told
  std::vector<std::string> choices;  // that a value may be
  bool takes_file = false;           // or a folder
  bool required = false;
};

struct VerbText {
  std::vector<std::string> path;  // {"ninebit", "study", "index-steps"}
  std::string description;
  std::string footer;
  std::vector<FlagText> flags;
  std::vector<FlagText> arguments;  // without a flag, in their order
  std::vector<VerbText> verbs;

  [[nodiscard]] const std::string& name() const { return path.back(); }
  [[nodiscard]] std::string command() const;  // "ninebit study index-steps"
};

// What is hidden from the help is left out.
[[nodiscard]] VerbText describe(const CLI::App& app);

// The whole as a page of the manual, for troff with its macros `man`.
[[nodiscard]] std::string manual_page(const VerbText& program);

// Scripts that complete verbs, flags, choices and file names.
[[nodiscard]] std::string bash_completion(const VerbText& program);
[[nodiscard]] std::string zsh_completion(const VerbText& program);
[[nodiscard]] std::string fish_completion(const VerbText& program);

}  // namespace ninebit::tools
