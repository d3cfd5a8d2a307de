#include "src/tools/input/program.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <system_error>
#include <utility>

#include "ninebit/language/profile_json.h"
#include "ninebit/numerics/hardware_profile.h"
#include "src/system/nearest_name.h"
#include "src/system/process.h"
#include "src/system/quoting.h"
#include "src/system/stream.h"
#include "src/tools/input/file_kind.h"
#include "src/tools/input/host.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

volatile std::sig_atomic_t interrupted = 0;

// Whether the cursor stands behind a progress line.
bool progress_is_shown = false;

// The second signal ends the program at once: outputs that are not complete have temporary names.
extern "C" void on_interrupt(int signal) {
  interrupted = signal;
  std::signal(signal, SIG_DFL);
}

OwnedProfile read_profile(const std::string& path) {
  std::error_code error;
  const std::string text = posix::read_file(path, kMaxSourceBytes + 1, error);
  if (error) throw InvalidInput(Diagnostic{.message = "could not be read: " + error.message(), .file = path});
  auto parsed = parse_json_profile({text, path});
  if (parsed) return std::move(*parsed);
  if (std::string message = wrong_kind(kind_of_file(text), FileRole::profile); !message.empty()) {
    throw InvalidInput(Diagnostic{.message = std::move(message), .file = path});
  }
  throw InvalidInput(parsed.faults());
}

// Accepts the name of a shipped profile or the word, or reads a file into `own` and replaces its path with its
// profile's name.
std::string check_profile(std::string& text, std::shared_ptr<const OwnedProfile>& own, const std::string& word = {}) {
  own.reset();
  if (find_profile(text) != nullptr || (text == word && !word.empty())) return {};
  if (!text.ends_with(".json")) {
    std::vector<std::string> names;
    if (!word.empty()) names.push_back(word);
    for (const HardwareProfile& profile : hardware_profiles()) names.emplace_back(profile.name);
    return fmt::format("unknown profile '{}'; expected {}, or the path of a .json file{}", text, fmt::join(names, ", "),
                       did_you_mean(text, names));
  }
  own = std::make_shared<const OwnedProfile>(read_profile(text));
  text = own->profile.name;
  return {};
}

// The names of shipped profiles in a list, each once.
std::string take_profile_names(const std::string& text, std::vector<std::string>& names) {
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t end = std::min(text.find(',', start), text.size());
    std::string name = text.substr(start, end - start);
    if (std::find(names.begin(), names.end(), name) != names.end()) {
      return fmt::format("'{}' is given twice; expected each profile once", name);
    }
    std::shared_ptr<const OwnedProfile> none;
    if (name.ends_with(".json")) return fmt::format("'{}' in a list; expected names from `ninebit profiles`", name);
    if (std::string fault = check_profile(name, none); !fault.empty()) return fault;
    names.push_back(std::move(name));
    start = end + 1;
  }
  return {};
}

// Whether the stream is a terminal that understands escape sequences.
bool takes_escapes(int stream) {
  const char* const terminal = std::getenv("TERM");
  return posix::is_terminal(stream) && (terminal == nullptr || std::string_view(terminal) != "dumb");
}

// Prints one line, without logging it.
void print_error(std::string_view message) {
  say(fmt::format("ninebit: error: {}\n", printable_briefly(with_shown_names(std::string(message)))));
}

void write_to_stderr(std::string_view text) noexcept {
  std::fwrite(text.data(), 1, text.size(), stderr);
}

// The next step draws it again.
void erase_progress() noexcept {
  if (progress_is_shown) write_to_stderr("\r\x1b[K");
  progress_is_shown = false;
}

// Piece by piece, so that an out-of-memory message needs no allocation.
void say_printable(std::string_view text) noexcept {
  while (!text.empty()) {
    const PrintablePiece piece = first_printable_piece(text, true);
    write_to_stderr(text.substr(0, piece.plain));
    for (const char byte : text.substr(piece.plain, piece.foreign)) {
      const EscapedByte instead = escaped(byte);
      write_to_stderr({instead.text, instead.size});
    }
    text.remove_prefix(piece.plain + piece.foreign);
  }
}

}  // namespace

InvalidInput::InvalidInput(Diagnostic fault) : std::runtime_error("invalid input"), fault_(std::move(fault)) {}

InvalidInput::InvalidInput(std::vector<TextFault> faults)
    : std::runtime_error("invalid input"), faults_(std::move(faults)) {}

int InvalidInput::report() const {
  for (const TextFault& fault : faults_) (void)report_fault(fault);
  return faults_.empty() ? tools::report(fault_) : kInvalidInput;
}

void add_profile_flag(CLI::App& verb, CommonFlags& flags, std::vector<std::string>* list) {
  verb.add_option("--profile", flags.profile,
                  std::string("Hardware profile to emulate: a name from `ninebit profiles`, or a .json file") +
                      (list != nullptr ? "; several names, separated by commas, share a report" : ""))
      ->capture_default_str()
      ->transform(CLI::Validator(
          [&flags, list](std::string& text) {
            if (list != nullptr) list->clear();
            if (list != nullptr && text.find(',') != std::string::npos) return take_profile_names(text, *list);
            const std::string given = text;
            std::string fault = check_profile(text, flags.own_profile);
            flags.profile_file = flags.own_profile ? given : "";
            return fault;
          },
          "NAME|FILE"));
}

void add_answer_flags(CLI::App& verb, CommonFlags& flags) {
  verb.add_flag("--json", flags.json, "Print one JSON object to stdout, and nothing else");
  verb.add_flag("--quiet", flags.quiet, "Do not print progress, notes or the names of written files");
}

void add_common_flags(CLI::App& verb, CommonFlags& flags) {
  add_answer_flags(verb, flags);
  add_profile_flag(verb, flags);
  add_threads_flag(verb, flags);
}

CLI::Validator whole_in_range(std::int64_t least, std::int64_t greatest) {
  const auto check = [=](const std::string& text) -> std::string {
    std::int64_t number = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    if (error == std::errc() && end == text.data() + text.size() && number >= least && number <= greatest) return {};
    return fmt::format("'{}'; expected a whole number from {} to {}", text, least, greatest);
  };
  return CLI::Validator(check, fmt::format("INT in [{} - {}]", least, greatest));
}

void add_threads_flag(CLI::App& verb, CommonFlags& flags) {
  verb.add_option("--threads", flags.threads, "Number of threads, 0 for all; results do not depend on it")
      ->capture_default_str()
      ->check(whole_in_range(0, 1024));
}

CLI::Option* add_profile_option(CLI::App& verb, const std::string& option, ProfileChoice& choice,
                                const std::string& help, const std::string& word) {
  return verb.add_option(option, choice.name, help)
      ->transform(
          CLI::Validator([&choice, word](std::string& text) { return check_profile(text, choice.own_profile, word); },
                         word.empty() ? "NAME|FILE" : word + "|NAME|FILE"));
}

const HardwareProfile& profile_of(const ProfileChoice& choice) {
  return choice.own_profile ? choice.own_profile->profile : *find_profile(choice.name);
}

const HardwareProfile& profile_of(const CommonFlags& flags) {
  return flags.own_profile ? flags.own_profile->profile : *find_profile(flags.profile);
}

bool wants_colors(int stream) {
  const char* const no_color = std::getenv("NO_COLOR");
  return takes_escapes(stream) && (no_color == nullptr || *no_color == '\0');
}

namespace {

std::string& command() {
  static std::string text;
  return text;
}

}  // namespace

const std::string& given_command() {
  return command();
}

void set_given_command(int argc, const char* const* argv) {
  command() = host() == nullptr ? "ninebit" : "";
  for (int i = 1; i < argc && host() == nullptr; ++i) command() += ' ' + shell_word(argv[i]);
}

void say(std::string_view text) noexcept {
  if (host() != nullptr) return host()->say(text);
  constexpr std::string_view kError = "ninebit: error:", kRed = "\x1b[1;31m", kPlain = "\x1b[0m";
  const bool colored = wants_colors(posix::kStandardError);
  erase_progress();
  for (std::string_view rest = text; !rest.empty();) {
    std::string_view line = rest.substr(0, std::min(rest.find('\n'), rest.size() - 1) + 1);
    rest.remove_prefix(line.size());
    if (colored && line.starts_with(kError)) {
      write_to_stderr(kRed);
      write_to_stderr(kError);
      write_to_stderr(kPlain);
      line.remove_prefix(kError.size());
    }
    say_printable(line);
  }
  std::fflush(stderr);
}

void say_error(std::string_view message) {
  log_fault({.message = std::string(message)});
  print_error(message);
}

int wrong_usage(std::string_view verb, std::string_view message) {
  say_error(fmt::format("{} (see: ninebit {} --help)", message, verb));
  return kWrongUsage;
}

void say_warning(std::string_view message) {
  say(fmt::format("ninebit: warning: {}\n", printable_briefly(with_shown_names(std::string(message)))));
}

void say_written(const std::filesystem::path& file) {
  say(fmt::format("wrote {}\n", printable(file.string())));
}

int answer(const std::string& text) {
  return answer_exactly(printable_lines(text));
}

int answer(const Json& object) {
  return answer_exactly(json_text(object));
}

int answer_exactly(const std::string& text) {
  if (host() != nullptr) {
    host()->answer(text);
    return kDone;
  }
  log_answer();
  if (std::fwrite(text.data(), 1, text.size(), stdout) == text.size() && std::fflush(stdout) == 0) return kDone;
  const std::string why = std::generic_category().message(errno);
  return report({.message = "could not be written: " + why, .file = "standard output", .fault = Fault::cannot_write});
}

std::string json_text(const Json& object) {
  return object.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

int report_fault(const TextFault& fault) {
  TextFault placeless = fault;
  placeless.file.clear();
  const std::string place = fmt::format("{}:{}: ", fault.line, fault.column);
  std::string message = placeless.text();
  if (message.starts_with(place)) message.erase(0, place.size());
  log_fault({std::move(message), fault.file, fault.line, fault.column});
  print_error(fault.text());
  return kInvalidInput;
}

int report(const Diagnostic& diagnostic) {
  log_fault({diagnostic.message, diagnostic.file, diagnostic.line, 0});
  print_error(diagnostic.text());
  switch (diagnostic.fault) {
    case Fault::invalid_input:
      return kInvalidInput;
    case Fault::cannot_write:
      return kCannotWrite;
    case Fault::cancelled:
      return kInterrupted + interrupted;
  }
  return kInvalidInput;
}

ProgressLine::ProgressLine(bool quiet) : visible_(host() == nullptr && !quiet && takes_escapes(posix::kStandardError)) {
  if (host() == nullptr) posix::catch_interrupts(on_interrupt);
}

ProgressLine::~ProgressLine() {
  erase_progress();
}

bool ProgressLine::step(std::string_view what, double done) {
  if (visible_) {
    constexpr int kWidth = 30;
    const int filled = static_cast<int>(std::clamp(done, 0.0, 1.0) * kWidth);
    write_to_stderr(fmt::format("\r\x1b[K[{}{}] {}", std::string(static_cast<std::size_t>(filled), '#'),
                                std::string(static_cast<std::size_t>(kWidth - filled), '.'), printable(what)));
    progress_is_shown = true;
    std::fflush(stderr);
  }
  if (host() != nullptr) host()->step(what, done);
  return !stopped();
}

bool ProgressLine::stopped() {
  return host() != nullptr ? host()->stopped() : interrupted != 0;
}

namespace {

std::vector<LoggedFault>& fault_list() {
  static std::vector<LoggedFault> faults;
  return faults;
}

bool answer_has_begun = false;

struct ShownFolder {
  std::string folder{}, shown{};  // each with a slash at its end
};

ShownFolder& shown_folder() {
  static ShownFolder names;
  return names;
}

}  // namespace

void show_folder_as(const std::string& folder, const std::string& shown) {
  shown_folder() = {folder + "/", shown + "/"};
}

std::string with_shown_names(std::string message) {
  const auto& [folder, shown] = shown_folder();
  if (folder.empty()) return message;
  for (std::size_t at = 0; (at = message.find(folder, at)) != std::string::npos; at += shown.size()) {
    message.replace(at, folder.size(), shown);
  }
  return message;
}

void log_fault(LoggedFault fault) {
  constexpr std::size_t kMostFaults = 1'000;
  if (fault_list().size() >= kMostFaults) return;
  fault.message = with_shown_names(std::move(fault.message));
  fault.file = with_shown_names(std::move(fault.file));
  fault_list().push_back(std::move(fault));
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
