// The tokens of an assembled pixel shader as a text has them: bytes of a file, numbers, or a C array.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
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

// Whether a list was read up to its end, behind which `rest` goes on then; reports what else stands there.
[[nodiscard]] bool is_list_closed(code::TokenReader& rest, TokenForm form, SourceFaults& faults);
// Reports what stands behind the list but lines of the preprocessor and declarations of single numbers, such as the
// length that xxd -i prints.
void check_behind_list(code::TokenReader& rest, SourceFaults& faults);

}  // namespace ninebit::detail
