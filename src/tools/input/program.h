// Shared by all verbs: common flags, exit codes, messages, progress.
#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"

namespace ninebit {

struct OwnedProfile;

}  // namespace ninebit

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

struct CommonFlags {
  bool json = false;
  bool quiet = false;
  std::string profile = "geforce2";                 // the name of the profile
  std::shared_ptr<const OwnedProfile> own_profile;  // if it came from a file
  std::string profile_file;                         // that file
  int threads = 0;                                  // 0: all
};

// A file named by a flag is unreadable or invalid. Ends the program with kInvalidInput.
class InvalidInput : public std::runtime_error {
 public:
  explicit InvalidInput(Diagnostic fault);
  explicit InvalidInput(std::vector<TextFault> faults);

  // Prints what is wrong, as report() does; returns kInvalidInput.
  [[nodiscard]] int report() const;

 private:
  Diagnostic fault_;               // if there are no faults of a text
  std::vector<TextFault> faults_;  // of a text
};

// Adds the common flags to a verb: --json, --quiet, --profile and, for a verb that uses threads, --threads. A verb
// refuses the others, whose values would not matter. An unknown profile or a thread count out of range is wrong usage;
// parsing the command line throws InvalidInput for a profile file that is unreadable or invalid.
void add_common_flags(CLI::App& verb, CommonFlags& flags);
// --json and --quiet alone.
void add_answer_flags(CLI::App& verb, CommonFlags& flags);
// One whole number in range; CLI11's own check calls 2.5 out of range.
[[nodiscard]] CLI::Validator whole_in_range(std::int64_t least, std::int64_t greatest);

// --threads alone.
void add_threads_flag(CLI::App& verb, CommonFlags& flags);
// --profile alone; with `list` also several names of shipped profiles, which it holds then, while flags.profile is
// their text and names no profile.
void add_profile_flag(CLI::App& verb, CommonFlags& flags, std::vector<std::string>* list = nullptr);

// A profile beside that of --profile.
struct ProfileChoice {
  std::string name;                                 // empty: not given
  std::shared_ptr<const OwnedProfile> own_profile;  // if it came from a file
};

// Adds an option or, without dashes, an argument, whose value is checked and read as that of --profile. With `word`,
// that word is a value, too.
CLI::Option* add_profile_option(CLI::App& verb, const std::string& option, ProfileChoice& choice,
                                const std::string& help, const std::string& word = {});
// The profile that was given. Valid as long as the choice.
[[nodiscard]] const HardwareProfile& profile_of(const ProfileChoice& choice);

// The profile of the parsed flags. Valid as long as the flags.
[[nodiscard]] const HardwareProfile& profile_of(const CommonFlags& flags);

// Whether to colour text for the stream of this number: it is a terminal, NO_COLOR is not set,
// and TERM is not "dumb".
[[nodiscard]] bool wants_colors(int stream);

// The command that runs, as a shell takes it, for the pages that it writes. Empty in a host's process, whose words are
// not a command of its user.
[[nodiscard]] const std::string& given_command();
void set_given_command(int argc, const char* const* argv);

// Writes lines to stderr, with "ninebit: error:" in red if it wants colours, and control characters escaped as in
// printable.h. Write errors are ignored: the results do not depend on stderr.
void say(std::string_view text) noexcept;

// Prints "ninebit: error: MESSAGE", "ninebit: warning: MESSAGE" or "wrote FILE" to stderr, always on one line.
void say_error(std::string_view message);
// The same of wrong usage, with the help of the verb to read; returns kWrongUsage.
int wrong_usage(std::string_view verb, std::string_view message);
void say_warning(std::string_view message);
void say_written(const std::filesystem::path& file);

// Writes the answer of a verb to stdout: lines for people, with control characters escaped as in printable.h, or a JSON
// object. Returns kDone, or kCannotWrite after printing the reason.
[[nodiscard]] int answer(const std::string& text);
[[nodiscard]] int answer(const Json& object);

// The same for a text in which every foreign name is already escaped.
[[nodiscard]] int answer_exactly(const std::string& text);

// The text of a JSON answer. Invalid UTF-8 is replaced with U+FFFD.
[[nodiscard]] std::string json_text(const Json& object);

// Prints "ninebit: error: TEXT" to stderr and returns the exit code of the fault.
[[nodiscard]] int report(const Diagnostic& diagnostic);
// The same for a fault of a text.
[[nodiscard]] int report_fault(const TextFault& fault);

// A progress bar on stderr, if that is a terminal that can clear a line and `quiet` is false. After the first SIGINT,
// SIGTERM or SIGHUP, step() returns false.
class ProgressLine {
 public:
  explicit ProgressLine(bool quiet);
  ~ProgressLine();
  ProgressLine(const ProgressLine&) = delete;
  ProgressLine& operator=(const ProgressLine&) = delete;

  bool step(std::string_view what, double done);
  // Whether step() would return false.
  [[nodiscard]] static bool stopped();

 private:
  bool visible_;
};

// Each verb adds itself; running it sets `exit_code`.
void add_render(CLI::App& app, int& exit_code);
void add_draw(CLI::App& app, int& exit_code);
void add_compare(CLI::App& app, int& exit_code);
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
void add_prove(CLI::App& app, int& exit_code);
void add_vectors(CLI::App& app, int& exit_code);
void add_gl_run(CLI::App& app, int& exit_code);
void add_help(CLI::App& app, int& exit_code);
void add_generate(CLI::App& app, int& exit_code);  // hidden from the help

// The errors of a run, kept beside the lines on stderr: with --json, the program answers with them.

struct LoggedFault {
  std::string message{};  // one sentence, without its place
  std::string file{};     // empty: none
  int line = 0;           // from 1; 0: none
  int column = 0;         // from 1; 0: none
};

// From now on, errors and warnings name the files of a folder as those of `shown`: that of an unpacked archive is gone
// when somebody reads them.
void show_folder_as(const std::string& folder, const std::string& shown);
// A message with such names.
[[nodiscard]] std::string with_shown_names(std::string message);

// Adds an error; say_error() and report() do. Only the first thousand are kept.
void log_fault(LoggedFault fault);
[[nodiscard]] const std::vector<LoggedFault>& logged_faults();
// Forgets the errors of an earlier run.
void clear_faults();

// Records that standard output has an answer, or a part of one.
void log_answer() noexcept;
[[nodiscard]] bool answer_is_logged() noexcept;

}  // namespace ninebit::tools
