// An EXR file of scan lines that is written block by block, by OpenEXRCore.
#pragma once

#include <openexr.h>

#include <cstdint>
#include <span>
#include <string>

#include "ninebit/image/image_io.h"
#include "src/system/checked_file.h"

namespace ninebit::image_detail {

inline constexpr int kExrBlockRows = 16;  // of a block that is compressed as ZIP, by the file format

inline exr_attr_box2i_t window_of(int width, int height) {
  exr_attr_box2i_t window{};
  window.max.x = width - 1;
  window.max.y = height - 1;
  return window;
}

// Keeps its first error; everything after it does nothing. Throws std::bad_alloc where memory runs out.
class ExrFile {
 public:
  explicit ExrFile(posix::CheckedFile& file);
  ExrFile(const ExrFile&) = delete;
  ExrFile& operator=(const ExrFile&) = delete;
  ~ExrFile();

  // The size of the display window, which all parts share.
  void set_window(int width, int height) { window_ = window_of(width, height); }
  // Adds a part of ZIP blocks; one without a name must be the only one.
  void add_part(const std::string& name, int width, int height, std::span<const ExrChannel> channels);
  // Makes the only part an environment map, a cube.
  void mark_as_cube();
  // Ends the list of parts.
  void begin_blocks();
  // Writes the block that begins at this row, in the order of parts and rows.
  void add_block(int part, int row, std::span<const std::uint8_t> bytes);
  // Writes what is left. Empty, or what went wrong.
  [[nodiscard]] std::string finish();

 private:
  template <class Call>
  void call(const Call& function);

  posix::CheckedFile& file_;
  exr_context_t context_ = nullptr;
  exr_attr_box2i_t window_{};
  exr_result_t fault_ = EXR_ERR_SUCCESS;
};

}  // namespace ninebit::image_detail
