// The interface between the module ninebit_pictures and the program that loads it.
#pragma once

#include "src/image/texture/texture_file.h"

namespace ninebit::image_detail {

inline constexpr const char* kPictureModuleFile = "ninebit_pictures.so";

// They exchange C++ objects, so both must be of the same build: same version, same compiler.
inline constexpr const char* kPictureModuleBuild = NINEBIT_VERSION ", " __VERSION__;

// The module's two symbols.
inline constexpr const char* kPictureBuildSymbol = "ninebit_pictures_build";  // const char* (): kPictureModuleBuild
inline constexpr const char* kPictureReadSymbol = "ninebit_pictures_read";    // PictureModuleRead
using PictureModuleRead = void (*)(const PictureSource& source, Result<FileTexture>& out);

}  // namespace ninebit::image_detail
