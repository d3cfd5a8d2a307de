// Running the program as its users do: as a process of its own.
#pragma once

#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace tools_test {

// The program of the build, or the one that NINEBIT_TESTED_PROGRAM names.
inline const std::string kProgram = std::getenv("NINEBIT_TESTED_PROGRAM") != nullptr
                                        ? std::getenv("NINEBIT_TESTED_PROGRAM")
                                        : NINEBIT_BINARY_DIR "/ninebit";

using Words = std::vector<std::string>;

// How a process ended. `code` is what a shell would tell: the exit code, or 128 + the signal that killed it.
struct Outcome {
  int code = -1;
  std::string out;
  std::string err;
  long peak_kib = 0;  // the most memory that was resident
};

struct ChildSettings {
  std::string folder{};                            // to run in; empty: the caller's
  std::optional<std::uint64_t> file_size_limit{};  // bytes that any file may have, as RLIMIT_FSIZE
  std::optional<std::uint64_t> address_space{};    // bytes that it may map, as RLIMIT_AS; then it dumps no core, too
  std::string in{};                                // what stdin reads; empty: nothing
  std::string out{};                               // where stdout goes instead of into the Outcome
  std::string err{};                               // the same for stderr
  std::vector<int> ignored{};                      // signals that it is started to ignore, as nohup does
  bool traced = false;                             // for run_to(); where that is not allowed it ends with code 126
};

// A running `ninebit ARGUMENTS...`. The destructor kills it if nobody has waited for it.
class Child {
 public:
  explicit Child(const Words& arguments, const ChildSettings& settings = {});
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;
  ~Child();

  [[nodiscard]] bool ended() const;
  // Waits until this has come or the program has ended; whether it has come.
  bool until(const std::function<bool()>& come) const;
  void send(int signal) const;  // does nothing to a program that has ended
  Outcome wait();

  // Lets a traced program go on until its main thread enters a system call to whose number (SYS_...) `stops_at` says
  // yes, and holds it there; false where it ended before.
  bool run_to(const std::function<bool(std::uint64_t call)>& stops_at) const;
  void let_go() const;  // of a program that run_to() holds

 private:
  using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  File out_, err_;
  int process_ = -1;
};

// A terminal that programs write to.
class Terminal {
 public:
  explicit Terminal(unsigned short columns = 0);  // 0: its width is not known
  Terminal(const Terminal&) = delete;
  Terminal& operator=(const Terminal&) = delete;
  ~Terminal();

  [[nodiscard]] std::string name() const;  // of its file
  // What was written to it since the last call until this text came, with it; less if nothing comes for ten seconds.
  [[nodiscard]] std::string seen_until(const std::string& text) const;
  // All that is written to it until the program ends.
  [[nodiscard]] std::string seen_of(const Child& child) const;

 private:
  // Adds what comes within this time; false if nothing does.
  bool read_more(std::string& seen, int milliseconds) const;

  int terminal_ = -1, held_ = -1;
};

// Runs `ninebit ARGUMENTS...` to its end.
Outcome ninebit(const Words& arguments, const ChildSettings& settings = {});

}  // namespace tools_test
