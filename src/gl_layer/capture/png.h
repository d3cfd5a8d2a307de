// PNG files without a library: the layer lives in other people's programs, which may bring another libpng.
#pragma once

#include <array>
#include <string>
#include <vector>

namespace ninebit::gl_layer {

// An uncompressed PNG file of `width` columns; the rows are given from above.
[[nodiscard]] std::string png_file(const std::vector<std::array<unsigned char, 4>>& pixels, std::size_t width);

}  // namespace ninebit::gl_layer
