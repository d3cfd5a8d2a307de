// What every verb of the program shares: common flags, exit codes, messages, progress.
#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/profile_json.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"

namespace ninebit::tools {

using Json = nlohmann::ordered_json;

enum ExitCode : int {
  kDone = 0,
  kDifference = 1,
  kWrongUsage = 2,
  kInvalidInput = 3,
  kCannotWrite = 4,
  kOutOfMemory = 5,
  kInterrupted = 128  // plus the signal's number, as shells report it: 130 for SIGINT
};

// The flags that every verb has.
struct CommonFlags {
  bool json = false;
  bool quiet = false;
  std::string profile = "geforce2";         // the profile's name
  std::optional<OwnedProfile> own_profile;  // if it came from a file
  std::string profile_file;                 // that file
  int threads = 0;                          // 0: all
};

// A file that a flag names is unreadable or wrong. Ends the program with kInvalidInput; what() is the first fault.
class InvalidInput : public std::runtime_error {
 public:
  explicit InvalidInput(const std::string& fault) : InvalidInput(std::vector{fault}) {}
  explicit InvalidInput(const std::vector<std::string>& faults);

  // One sentence each, without "ninebit: error: ".
  [[nodiscard]] const std::vector<std::string>& faults() const { return faults_; }

 private:
  std::vector<std::string> faults_;
};

// Adds the common flags to a verb. A wrong profile name or thread count is a usage error; a profile's file that is
// unreadable or wrong is thrown as InvalidInput while the command line is parsed.
void add_common_flags(CLI::App& verb, CommonFlags& flags);

// The profile that add_common_flags has checked. Valid as long as the flags.
[[nodiscard]] const HardwareProfile& profile_of(const CommonFlags& flags);

// Whether text that goes to the stream of this number is to be coloured: it is a terminal, and NO_COLOR is not set.
[[nodiscard]] bool wants_colors(int stream);

// Writes lines to stderr, "error:" in red where it wants colours, and control characters as printable.h has them. A
// stream that is full or that nobody reads is not an error: the results do not depend on it.
void say(std::string_view text) noexcept;

// Says "ninebit: error: MESSAGE", or "wrote FILE", on one line, whatever stands in the message or in the name.
void say_error(std::string_view message);
void say_written(const std::filesystem::path& file);

// Writes what a verb answers to stdout: lines for people, in which control characters are as printable.h has them, or
// an object. Gives kDone, or kCannotWrite after saying why.
[[nodiscard]] int answer(const std::string& text);
[[nodiscard]] int answer(const Json& object);

// The same for a text in which every foreign name was made printable or escaped before.
[[nodiscard]] int answer_exactly(const std::string& text);

// An object as it is answered. Names that are not UTF-8 have U+FFFD in their places.
[[nodiscard]] std::string text_of(const Json& object);

// Prints "ninebit: error: TEXT" to stderr and gives the exit code of the fault.
[[nodiscard]] int report(const Diagnostic& diagnostic);

// Progress on one line of stderr while that is a terminal and nobody asked for quiet; from the first SIGINT,
// SIGTERM or SIGHUP on, step() answers false.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool step(std::string_view what, double done);
  // Whether step() would answer false.
  [[nodiscard]] static bool stopped();

 private:
  bool visible_;
};

// Each verb adds itself and returns through `exit_code` what its run ends with.
void add_render(CLI::App& app, int& exit_code);
void add_profiles(CLI::App& app, int& exit_code);
void add_info(CLI::App& app, int& exit_code);
void add_eval(CLI::App& app, int& exit_code);
void add_validate(CLI::App& app, int& exit_code);
void add_convert(CLI::App& app, int& exit_code);
void add_explain(CLI::App& app, int& exit_code);
void add_trace(CLI::App& app, int& exit_code);
void add_bench(CLI::App& app, int& exit_code);
void add_study(CLI::App& app, int& exit_code);
void add_verify(CLI::App& app, int& exit_code);
void add_generate(CLI::App& app, int& exit_code);  // not shown by the help

}  // namespace ninebit::tools
