// The parts of a program that ps.1.1 can express: constants, sources and the instruction of a portion.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "ninebit/combiner/program.h"
#include "ninebit/combiner/state.h"

namespace ninebit::detail {

// The constants of a printed text.
class PrintedConstants {
 public:
  explicit PrintedConstants(const Program& program);

  // The name of a constant in one of two registers. Equal constants share a name, but not two that one scope (a stage,
  // or all of them) has in different registers. Empty: 8 others are in use.
  std::optional<std::string> name(Register reg, const ColorF& color);
  // The name of one that is not set: its own. Empty: ps.1.1 has no such constant.
  [[nodiscard]] static std::optional<std::string> name_of_unset(ConstantName name);
  // Begins another scope.
  void next_scope() { in_scope_ = {}; }
  // The definitions.
  [[nodiscard]] std::string text() const;

 private:
  static constexpr std::size_t kMost = 8;

  std::vector<ColorF> all_;            // that are defined
  std::vector<std::size_t> unused_{};  // numbers of constants for them, in their order
  std::array<std::optional<std::size_t>, 2> in_scope_{};
};

// An instruction for one portion.
struct PrintedPortion {
  struct Source {
    std::string text{};      // with its modifiers
    std::string selector{};  // as the portion needs it: "", ".a", ".b"
  };
  std::string name{};  // mul_x2_sat
  Register to = Register::discard;
  bool blue_to_alpha = false;  // of a dot product
  std::vector<Source> sources{};
};

// The context in which a portion is printed.
struct PortionPlace {
  PortionName which = PortionName::rgb;
  bool saturates = false;                           // its result is read as unsigned
  std::array<bool, kRegisterCount> unsigned_rgb{};  // the registers of which reads are unsigned, or cannot be negative
  std::array<bool, kRegisterCount> unsigned_alpha{};
  std::array<std::optional<ColorF>, 2> constants{};    // that the stage reads
  std::array<std::optional<ConstantName>, 2> unset{};  // of them, those that are not set
};

// Makes the instruction of a normalized portion; `why` receives what ps.1.1 does not have, if anything.
[[nodiscard]] std::optional<PrintedPortion> words_of(const Portion& portion, const PortionPlace& place,
                                                     PrintedConstants& constants, std::string& why);

// Whether an input has the value 0, or 1 (-1 with `minus`), whatever the registers hold.
[[nodiscard]] bool is_nothing(const CombinerInput& in);
[[nodiscard]] bool is_unit(const CombinerInput& in, bool minus = false);

}  // namespace ninebit::detail
