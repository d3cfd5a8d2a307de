// ZIP archives without a library: the layer needs the C library alone.
#pragma once

#include <filesystem>
#include <vector>

namespace ninebit::gl_layer {

// Writes an archive of files, uncompressed and under their names without folders. Where it returns false, a line in the
// log says why, and what was at that path is still there.
[[nodiscard]] bool write_zip(const std::filesystem::path& archive, const std::vector<std::filesystem::path>& files);

}  // namespace ninebit::gl_layer
