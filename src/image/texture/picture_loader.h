// Reads pictures for the program, which does not link OpenImageIO.
#pragma once

#include <filesystem>

#include "src/image/texture/texture_file.h"

namespace ninebit::image_detail {

// Calls read_picture() of the module ninebit_pictures, which is loaded for the first picture: from the program's folder
// or, if it is not there, from ../lib/ninebit relative to that folder. Reports what read_picture reports, and a module
// that is missing, cannot be loaded or belongs to another build of the program, with its path.
[[nodiscard]] Result<FileTexture> load_picture(const PictureSource& source);

// Looks for the module in this folder alone: for a process that is not the program. Call it before the first picture.
void set_picture_folder(std::filesystem::path folder);

// Only loads the module.
[[nodiscard]] Result<std::shared_ptr<void>> load_picture_module(const std::filesystem::path& file);

inline constexpr PictureReader kPictureModule{.read = &load_picture, .prepare = &load_picture_module};

}  // namespace ninebit::image_detail
