// ZIP archives without a library: the layer needs the C library alone.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace ninebit::gl_layer {

// An archive of uncompressed files, given as names and contents: less than 65,536 files, less than 4 GiB together.
[[nodiscard]] std::string zip_file(const std::vector<std::pair<std::string, std::string>>& files);

}  // namespace ninebit::gl_layer
