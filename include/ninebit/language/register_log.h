// Logs of register writes, as tracers of the NV2A and its kin print them: the combiners' set-ups in them, with the
// draws that use each. docs/languages.md lists what is read.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/state.h"
#include "ninebit/language/register_words.h"
#include "ninebit/language/source_text.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// Choices that the log alone does not decide.
struct RegisterLogOptions {
  std::optional<ChipClass> chip{};       // the chip whose methods are read; empty: that of the objects in the log
  ChipClass fallback = ChipClass::nv20;  // for a log that does not name its objects
  std::optional<std::uint32_t> frame{};  // count and keep the draws of this frame alone; set-ups have the same numbers
};

// A draw: what stands between a begin and its end.
struct LogDraw {
  std::uint64_t line = 0;                   // of the begin, from 1
  std::uint32_t frame = 1;                  // from 1, or as a column of the log says
  std::uint32_t primitive = 0;              // as the chip counts: 1 points, 5 triangles, …
  std::optional<std::uint64_t> vertices{};  // empty: the log does not show how many
};

// "points", "triangle strip", …; "primitive N" for numbers that the chip does not have.
[[nodiscard]] std::string primitive_name(std::uint32_t primitive);

// One set-up of the combiners.
struct LogSetup {
  // The words that the program depends on, with the line of their last write before the first draw (1:1: none). Words
  // of stages that do not run and constants that nothing reads are left out.
  std::vector<RegisterWord> words{};
  std::vector<std::string> unwritten{};     // words among them that no line writes before the first draw; they are 0
  std::vector<std::string> unknown{};       // words whose last write has no data in the log
  std::vector<RegisterWord> other_words{};  // those of kOtherWordNames at the first draw that the log writes before
  // The same of the stages' registers: BUMP_ENV_MAT[1][0], BUMP_ENV_SCALE[1], BUMP_ENV_OFFSET[1], EYE_VECTOR[0],
  // CONTROL0.
  std::vector<RegisterWord> stage_registers{};
  bool other_words_change = false;                // either differ between draws, without an effect on the program
  std::uint64_t draws = 0;                        // that use it
  std::uint64_t first_line = 0;                   // of the first of them; 0: none
  std::uint32_t first_frame = 0, last_frame = 0;  // of its draws; 0: none
  std::vector<LogDraw> draw_calls{};              // the first of them; kMaxLogDraws together in all set-ups
};

// The most that is kept of a log.
inline constexpr std::size_t kMaxLogSetups = 10'000;    // distinct set-ups; one more is a fault
inline constexpr std::size_t kMaxLogDraws = 1'000'000;  // draws that are kept; others are only counted

// The content of a log.
struct RegisterLog {
  ChipClass chip = ChipClass::nv20;     // whose methods were read
  std::vector<LogSetup> setups{};       // in the order of their first draw
  std::uint32_t frames = 0;             // the last frame with a draw
  std::uint64_t draws = 0;              // of all set-ups
  std::uint64_t lines = 0, writes = 0;  // of the log; register writes among them
};

// Whether a text begins like a log of register writes that this reader knows or can guess.
[[nodiscard]] bool is_register_log(std::string_view beginning);

// Reads a log of any length in pieces, in constant memory beside the set-ups and draws that it keeps.
class RegisterLogReader {
 public:
  // `file` appears in messages.
  RegisterLogReader(std::string file, const RegisterLogOptions& options);
  ~RegisterLogReader();
  RegisterLogReader(RegisterLogReader&& other) noexcept;             // the other can only be destroyed or assigned to
  RegisterLogReader& operator=(RegisterLogReader&& other) noexcept;  // likewise

  // The next bytes of the log, which need not end with a line.
  void read(std::string_view piece);

  // The log. No register writes, rows that do not fit the header, and too many set-ups are faults; guessed columns and
  // skipped lines are notes. A log without draws has one set-up: the words at its end. Call it once, at the end.
  [[nodiscard]] Parsed<RegisterLog> finish();

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

// The same for a text, of any length.
[[nodiscard]] Parsed<RegisterLog> parse_register_log(const SourceText& source, const RegisterLogOptions& options = {});

// The program of a set-up, with the faults of decode_register_words at the lines of the words, and notes about words
// that the log does not write. `number` counts from 1; 0 stands for the only one. A number that the log does not have
// is a fault, and so is 0 if there are several.
[[nodiscard]] Parsed<CombinerState> program_of(const RegisterLog& log, std::size_t number, std::string_view file,
                                               const HardwareProfile& profile,
                                               std::vector<RegisterWord>* other_words = nullptr);

}  // namespace ninebit
