// Pictures for the program, which does not link OpenImageIO.
#pragma once

#include <filesystem>

#include "src/image/texture/texture_file.h"

namespace ninebit::image_detail {

// read_picture() out of the module ninebit_pictures, which is loaded when the first picture is asked for: from the
// program's folder or, where it is not there, from ../lib/ninebit beside that. Reports, besides what read_picture
// reports, a module that is missing, cannot be loaded or belongs to another build of the program, with its path.
[[nodiscard]] Result<FileTexture> load_picture(const std::filesystem::path& file);

// Loads the module alone.
[[nodiscard]] Status load_picture_module(const std::filesystem::path& file);

inline constexpr PictureReader kPictureModule{.read = &load_picture, .prepare = &load_picture_module};

}  // namespace ninebit::image_detail
