// An EXR file of scan lines that is written block by block, by OpenEXRCore.
#pragma once

#include <openexr.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "ninebit/image/image_io.h"
#include "src/image/output/deflate.h"
#include "src/system/files.h"

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

// The scan-line blocks of an EXR file: rows from the caller, as the format stores and compresses them.

// The axes along which a picture is flipped when it is written.
struct Flips {
  bool columns = false;
  bool rows = false;
};

// The rows of one picture. The channels must outlive it.
class ExrRows {
 public:
  ExrRows(int width, int height, std::span<const ExrChannel> channels, Flips flips);

  // Bytes of a row of all channels.
  [[nodiscard]] std::size_t row_bytes() const { return row_bytes_; }
  // Stores a row as a block holds it: channel by channel, in the order of their names.
  void fetch(int row, std::uint8_t* to);

 private:
  template <class Sample, class Fill>
  void fill(const Fill& rows, int row, std::vector<Sample>& line) const;
  // Stores the samples of one row; returns the place behind them.
  std::uint8_t* store(const ExrChannel& channel, int row, std::uint8_t* to);

  int height_;
  Flips flips_;
  std::size_t row_bytes_ = 0;
  std::vector<const ExrChannel*> channels_;  // by name
  std::vector<std::uint32_t> integers_;      // one row
  std::vector<float> floats_;                // one row
  std::vector<Half> halves_;                 // one row
};

// A block: its rows, and what is made of them. Blocks can be compressed at the same time.
class ExrBlock {
 public:
  // The rows, to be filled.
  [[nodiscard]] std::vector<std::uint8_t>& rows() { return rows_; }
  // ZIP compresses the rows.
  void compress();
  // The stored bytes: the compressed rows, or the rows themselves if they are no larger.
  [[nodiscard]] std::span<const std::uint8_t> stored() const;

 private:
  std::vector<std::uint8_t> rows_, split_, packed_;
  Deflater deflater_;
};

}  // namespace ninebit::image_detail
