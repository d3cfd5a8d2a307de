// What reads and writes pictures by OpenImageIO, in a library of its own: with it a test program takes 0.2 s to start,
// as 220 libraries come along.
#pragma once

#include <filesystem>

#include "ninebit/image/image_io.h"

namespace ninebit::test {

// The symbol ninebit_picture_functions. They throw as those of stored_pictures.h do.
struct PictureFunctions {
  Image8 (*read_png)(const std::filesystem::path& file);
  Image16 (*read_png16)(const std::filesystem::path& file);
  void (*write_as)(const std::filesystem::path& file, const Image8& image);
};

}  // namespace ninebit::test
