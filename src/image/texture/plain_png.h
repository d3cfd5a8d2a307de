// Plain PNG files, read by libpng alone.
#pragma once

#include "src/image/texture/texture_file.h"

namespace ninebit::image_detail {

// Whether the source begins as a PNG file of 8 bits a sample without a palette does.
[[nodiscard]] bool is_plain_png(const PictureSource& source);

// Reads such a file to the texture that read_picture() gives. A file that it refuses may be one for read_picture(),
// which also says what is wrong with a damaged one.
[[nodiscard]] Result<FileTexture> read_plain_png(const PictureSource& source);

}  // namespace ninebit::image_detail
