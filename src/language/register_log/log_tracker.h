// Follows the registers through a log, write by write, and keeps the combiners' set-ups and their draws.
#pragma once

#include <array>
#include <string>
#include <unordered_map>
#include <vector>

#include "ninebit/language/register_log.h"
#include "src/language/register_log/log_methods.h"

namespace ninebit::reglog {

class LogTracker {
 public:
  LogTracker(ChipClass chip, std::optional<std::uint32_t> frame);

  // A write of the 3D object in this line. No data: the word's value is unknown from then on.
  void write(const Method& method, std::optional<std::uint32_t> data, std::uint32_t count, std::uint64_t line);
  // The frame, where a column has it; flips end no frame then.
  void set_frame(std::uint32_t frame);

  [[nodiscard]] const Method& method(std::uint32_t number) const;
  [[nodiscard]] ChipClass chip() const { return chip_; }

  // Whether there are more set-ups than are kept; nothing is followed then.
  [[nodiscard]] bool overflowed() const { return overflowed_; }
  // The line of the first draw that had no end before the next one or the end of the log; 0: none.
  [[nodiscard]] std::uint64_t unended_line() const { return unended_line_; }
  // How many draws were counted but not kept.
  [[nodiscard]] std::uint64_t unkept_draws() const { return unkept_draws_; }

  // Ends the log.
  [[nodiscard]] RegisterLog finish();

 private:
  struct Word {
    std::uint32_t value = 0;
    std::uint64_t line = 0;  // 0: not written
    bool unknown = false;    // written without data
  };
  using Slots = std::array<std::array<Word, kMaxGeneralCombiners>, words::kKinds>;

  [[nodiscard]] const Word& at(words::Kind kind, int index = 0) const {
    return words_[static_cast<std::size_t>(kind)][static_cast<std::size_t>(index)];
  }
  void begin(std::uint32_t primitive, std::uint64_t line);
  void end(bool ended);
  void add_vertices(const Method& method, std::uint32_t data, std::uint32_t count);
  [[nodiscard]] std::optional<std::uint64_t> vertices() const;
  // The set-up that the words are now; the number of set-ups if there is no room for another.
  std::size_t current_setup();
  // The words that the program depends on.
  [[nodiscard]] std::vector<words::Slot> used_words() const;
  [[nodiscard]] std::uint32_t normalized(words::Slot slot) const;
  [[nodiscard]] LogSetup new_setup(const std::vector<words::Slot>& used) const;
  [[nodiscard]] std::vector<RegisterWord> other_words() const;
  [[nodiscard]] std::vector<RegisterWord> stage_registers() const;
  // The effect of the stages' words as a key; empty: units read their textures as without stages.
  [[nodiscard]] std::string stage_key() const;
  [[nodiscard]] int stages() const;
  [[nodiscard]] bool stage_reads(int stage, std::uint32_t code) const;
  [[nodiscard]] bool final_reads(std::uint32_t code) const;
  [[nodiscard]] bool has_mux() const;

  ChipClass chip_;
  std::optional<std::uint32_t> only_frame_;
  std::array<Method, 0x800> methods_{};
  Slots words_{};
  std::array<Word, 4> others_{};
  std::array<Word, kStageRegisters> stage_registers_{};
  std::array<std::optional<std::uint32_t>, 16> formats_{};  // of vertex attributes
  bool changed_ = true;                                     // words were written since the last draw
  std::size_t last_setup_ = 0;

  bool drawing_ = false, shows_vertices_ = false;
  std::size_t setup_ = 0;            // of the draw
  std::optional<std::size_t> kept_;  // its place in draw_calls
  std::uint64_t draw_line_ = 0, vertices_ = 0, inline_words_ = 0;

  std::uint32_t frame_ = 1;
  bool frames_given_ = false, drawn_in_frame_ = false, overflowed_ = false;
  std::uint64_t unended_line_ = 0, unkept_draws_ = 0, kept_draws_ = 0;
  RegisterLog log_{};
  std::unordered_map<std::string, std::size_t> by_words_{};
};

}  // namespace ninebit::reglog
