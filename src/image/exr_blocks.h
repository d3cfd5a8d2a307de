// Hands planes to OpenEXR a block of rows at a time.
#pragma once

#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <half.h>

#include <cstdint>
#include <span>
#include <vector>

#include "ninebit/image/image_io.h"

namespace ninebit::image_detail {

// Which way planes are turned on their way into the file.
struct Flips {
  bool columns = false;
  bool rows = false;
};

[[nodiscard]] inline Imf::PixelType pixel_type(const ExrChannel& channel) {
  return std::holds_alternative<std::span<const float>>(channel.samples) ? Imf::HALF : Imf::UINT;
}

void add_channels(Imf::Header& header, std::span<const ExrChannel> channels);

// The channels of one picture of width x height samples, which are borrowed.
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
  // Some of OpenEXR's 16-row ZIP blocks, so that its threads, if the program gave it any, have work.
  static constexpr int kRows = 64;

  Imf::FrameBuffer frame(int row, int rows, int file_row);

  int width_;
  int height_;
  std::span<const ExrChannel> channels_;
  Flips flips_;
  std::vector<std::vector<half>> halves_;           // a block of each float channel
  std::vector<std::vector<std::uint32_t>> turned_;  // a block of each UINT channel, where it cannot be used in place
};

}  // namespace ninebit::image_detail
