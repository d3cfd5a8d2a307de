// Detects a file's type from its first bytes.
#pragma once

#include <optional>
#include <string_view>

namespace ninebit {

// "a PNG picture", "a glTF file"; nothing if the bytes are those of the extension `expected` (".obj", in lower case) or
// of an unknown type.
[[nodiscard]] std::optional<std::string_view> other_kind(std::string_view content, std::string_view expected);

}  // namespace ninebit
