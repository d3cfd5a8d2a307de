// The tokens of an assembled pixel shader as a text has them: bytes of a file, numbers, or a C array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>
#include <vector>

#include "src/language/c_like/c_lexer.h"
#include "src/language/source/source_faults.h"

namespace ninebit::detail {

inline constexpr std::uint32_t kPixelShader = 0xffff, kVertexShader = 0xfffe;  // the upper half of a version

struct PlacedToken {
  std::uint32_t value = 0;
  std::size_t offset = 0;  // in the text
};

// hex_list: all of eight hexadecimal digits, without 0x but where it is written.
enum class TokenForm : std::uint8_t { bytes_of_file, array, list, hex_list };

// The tokens that a text begins with.
struct TokenList {
  TokenForm form = TokenForm::list;
  std::vector<PlacedToken> tokens{};  // empty: the first is not a version
  std::size_t end = 0;                // in the text, behind them
};

// Reads at most `most` tokens. Reports what is wrong with bytes.
[[nodiscard]] TokenList tokens_in(std::string_view text, std::size_t most, SourceFaults& faults);

// The text behind the tokens. The list and the faults must outlive it.
class TokensRest {
 public:
  TokensRest(std::string_view text, const TokenList& list, SourceFaults& faults);

  // Whether the list was read up to its end; reports what else stands there.
  bool is_list_closed();
  // Allows lines of the preprocessor and declarations of single numbers, such as the length that xxd -i prints.
  void check();

 private:
  [[nodiscard]] bool is_end() const { return token_.kind == code::Token::Kind::end; }
  code::Token take() { return std::exchange(token_, lexer_.next()); }

  const TokenList& list_;
  SourceFaults& faults_;
  code::Lexer lexer_;
  code::Token token_{};
};

}  // namespace ninebit::detail
