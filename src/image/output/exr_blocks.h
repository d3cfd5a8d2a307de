// Fetches rows from the caller and passes them to OpenEXR in blocks.
#pragma once

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <half.h>

#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/image/image_io.h"

namespace ninebit::image_detail {

// The axes along which a picture is flipped when it is written.
struct Flips {
  bool columns = false;
  bool rows = false;
};

[[nodiscard]] inline Imf::PixelType pixel_type(const ExrChannel& channel) {
  if (std::holds_alternative<ExrFloatRow>(channel.rows)) return Imf::FLOAT;
  return std::holds_alternative<ExrRealRow>(channel.rows) ? Imf::HALF : Imf::UINT;
}

void add_channels(Imf::Header& header, std::span<const ExrChannel> channels);

// Writes one picture of width x height samples per channel. The channels must outlive the object.
class ExrBlocks {
 public:
  ExrBlocks(int width, int height, std::span<const ExrChannel> channels, Flips flips);

  // Writes the whole picture at the output's current scan line, which is row `top` of the file. Output is
  // Imf::OutputPart or Imf::OutputFile.
  template <class Output>
  void write(Output& output, int top) {
    for (int row = 0; row < height_; row += kRows) {
      const int rows = height_ - row < kRows ? height_ - row : kRows;
      output.setFrameBuffer(frame(row, rows, top + row));
      output.writePixels(rows);
    }
  }

 private:
  // Several of OpenEXR's 16-row ZIP blocks, so that its threads, if it has any, have work.
  static constexpr int kRows = 64;

  struct Block {
    std::vector<half> halves;             // of a HALF channel
    std::vector<float> floats;            // of a FLOAT channel
    std::vector<std::uint32_t> integers;  // of a UINT channel
  };

  [[nodiscard]] int source_row(int row) const { return flips_.rows ? height_ - 1 - row : row; }
  // One row of the flipped picture, in the type of the file.
  void fetch(const ExrIntegerRow& fill, int row, std::span<std::uint32_t> line) const;
  void fetch(const ExrFloatRow& floats, int row, std::span<float> line) const;
  void fetch(const ExrRealRow& fill, int row, std::span<half> line);
  template <class Sample, class Fill>
  Imf::Slice block_of(const Fill& fill, std::vector<Sample>& block, int row, int rows, int file_row);
  Imf::FrameBuffer frame(int row, int rows, int file_row);

  int width_;
  int height_;
  std::span<const ExrChannel> channels_;
  Flips flips_;
  std::vector<Block> blocks_;  // one per channel
  std::vector<float> reals_;   // a row of a HALF channel before conversion to half
};

}  // namespace ninebit::image_detail
