// The scan-line blocks of an EXR file: rows from the caller, as the format stores and compresses them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/image/image_io.h"
#include "src/image/output/deflate.h"

namespace ninebit::image_detail {

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
