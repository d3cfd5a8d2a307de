// Base64, as data URLs use it.
#pragma once

#include <string>
#include <string_view>

namespace ninebit {

// The bytes in base64 (RFC 4648), padded, without line breaks.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace ninebit
