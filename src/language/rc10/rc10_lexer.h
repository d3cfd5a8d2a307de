// The tokens of !!RC1.0.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string_view>

#include "ninebit/combiner/registers.h"
#include "src/language/source/source_faults.h"
#include "src/system/lines.h"

namespace ninebit::detail {

inline constexpr std::string_view kRc10Header = "!!RC1.0", kTs10Header = "!!TS1.0";

struct Rc10Token {
  enum class Kind {
    end,
    word,         // registers with their component suffix, and keywords, including out.rgb and out.a
    number,       // with its sign
    punctuation,  // one of { } ( ) = ; , . * + -
    unknown
  };
  Kind kind = Kind::end;
  std::size_t offset = 0;
  std::string_view text;

  [[nodiscard]] bool is(char c) const { return kind == Kind::punctuation && text.front() == c; }
  [[nodiscard]] bool is(std::string_view word) const { return kind == Kind::word && text == word; }
};

// The names of registers. The last seven are those of the Xbox's tools.
struct Rc10Name {
  std::string_view name;
  Register reg;
};
inline constexpr std::array kRc10Names{Rc10Name{"fog", Register::fog},
                                       Rc10Name{"col0", Register::primary},
                                       Rc10Name{"col1", Register::secondary},
                                       Rc10Name{"spare0", Register::spare0},
                                       Rc10Name{"spare1", Register::spare1},
                                       Rc10Name{"tex0", Register::texture0},
                                       Rc10Name{"tex1", Register::texture1},
                                       Rc10Name{"tex2", Register::texture2},
                                       Rc10Name{"tex3", Register::texture3},
                                       Rc10Name{"const0", Register::constant0},
                                       Rc10Name{"const1", Register::constant1},
                                       Rc10Name{"zero", Register::zero},
                                       Rc10Name{"one", Register::zero},
                                       Rc10Name{"discard", Register::discard},
                                       Rc10Name{"color_sum", Register::spare0_plus_secondary},
                                       Rc10Name{"final_product", Register::e_times_f},
                                       Rc10Name{"color", Register::primary},
                                       Rc10Name{"color0", Register::primary},
                                       Rc10Name{"color1", Register::secondary},
                                       Rc10Name{"texture0", Register::texture0},
                                       Rc10Name{"texture1", Register::texture1},
                                       Rc10Name{"texture2", Register::texture2},
                                       Rc10Name{"texture3", Register::texture3}};

// The register of a name without suffix; empty: none.
[[nodiscard]] std::optional<Register> rc10_name(std::string_view word);

// Whether a word is the name of a register that can have a suffix: tex0, but not discard or color_sum.
[[nodiscard]] bool takes_rc10_suffix(std::string_view word);

// A lexer with one token of lookahead. An unterminated comment is a fault and ends the text; the header is skipped like
// white space.
class Rc10Lexer {
 public:
  Rc10Lexer(std::string_view text, SourceFaults& faults) : text_(text), faults_(faults), at_(mark_size(text)) {
    advance();
  }

  [[nodiscard]] const Rc10Token& peek() const { return token_; }
  Rc10Token take();
  // Whether the text ended inside a comment; that fault is already reported.
  [[nodiscard]] bool cut_short() const { return cut_short_; }

 private:
  void advance();
  [[nodiscard]] std::size_t number_length() const;
  [[nodiscard]] std::size_t word_length() const;
  [[nodiscard]] std::size_t unknown_length() const;

  std::string_view text_;
  SourceFaults& faults_;
  std::size_t at_ = 0;
  Rc10Token token_;
  bool cut_short_ = false;
};

}  // namespace ninebit::detail
