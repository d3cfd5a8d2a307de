// Diagnostics of the image files.
#pragma once

#include <filesystem>
#include <string>
#include <utility>

#include "ninebit/numerics/result.h"
#include "src/system/files.h"

namespace ninebit::image_detail {

inline constexpr int kLargestSide = 16384;  // of a picture, a part or a cube face

inline Diagnostic cannot_write(const std::filesystem::path& file, std::string message) {
  return {std::move(message), file.string(), 0, Fault::cannot_write};
}

// Closes an output file; reports whatever went wrong since it was opened.
[[nodiscard]] inline Status close_written(posix::CheckedFile& file) {
  if (const std::error_code error = file.close()) {
    return cannot_write(file.path(), "could not be written: " + error.message());
  }
  return {};
}

inline Diagnostic invalid_input(const std::filesystem::path& file, std::string message) {
  return {std::move(message), file.string(), 0, Fault::invalid_input};
}

// Empty if both sides are in range, else the complaint.
inline std::string complain_about_size(int width, int height) {
  if (width >= 1 && height >= 1 && width <= kLargestSide && height <= kLargestSide) return {};
  return "is " + std::to_string(width) + " x " + std::to_string(height) + " in size; each side must be 1 to " +
         std::to_string(kLargestSide);
}

}  // namespace ninebit::image_detail
