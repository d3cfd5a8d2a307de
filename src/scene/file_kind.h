// What a file seems to be by its first bytes.
#pragma once

#include <optional>
#include <string_view>

namespace ninebit {

// "a PNG picture", "a glTF file"; nothing where the bytes are those of `expected` (".obj", in small letters) or of no
// kind that is known here.
[[nodiscard]] std::optional<std::string_view> other_kind(std::string_view content, std::string_view expected);

}  // namespace ninebit
