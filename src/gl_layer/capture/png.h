// PNG files without a library: the layer lives in other people's programs, which may bring another libpng.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ninebit::gl_layer {

// The CRC-32 of PNG and ZIP files.
[[nodiscard]] std::uint32_t crc_of(std::string_view bytes);

// An uncompressed PNG file of `width` columns; the rows are given from above.
[[nodiscard]] std::string png_file(const std::vector<std::array<unsigned char, 4>>& pixels, std::size_t width);

}  // namespace ninebit::gl_layer
