#include "src/image/exr_blocks.h"

#include <ImathBox.h>
#include <ImfChannelList.h>

#include <algorithm>

namespace ninebit::image_detail {

namespace {

// Rows [first, first + rows) of the turned picture, converted to what the file holds.
template <class From, class To>
void copy_rows(std::span<const From> plane, int width, int height, Flips flips, int first, int rows,
               std::vector<To>& block) {
  const auto columns = static_cast<std::size_t>(width);
  block.resize(columns * static_cast<std::size_t>(rows));
  auto out = block.begin();
  for (int row = first; row < first + rows; ++row) {
    const int source = flips.rows ? height - 1 - row : row;
    const std::span<const From> line = plane.subspan(static_cast<std::size_t>(source) * columns, columns);
    const auto convert = [](From sample) { return static_cast<To>(sample); };
    out = flips.columns ? std::transform(line.rbegin(), line.rend(), out, convert)
                        : std::transform(line.begin(), line.end(), out, convert);
  }
}

template <class Sample>
Imf::Slice slice(Imf::PixelType type, const Sample* samples, int top, int width, int rows) {
  return Imf::Slice::Make(type, samples, Imath::V2i(0, top), width, rows, sizeof(Sample),
                          sizeof(Sample) * static_cast<std::size_t>(width));
}

}  // namespace

void add_channels(Imf::Header& header, std::span<const ExrChannel> channels) {
  for (const ExrChannel& channel : channels) header.channels().insert(channel.name, Imf::Channel(pixel_type(channel)));
}

ExrBlocks::ExrBlocks(int width, int height, std::span<const ExrChannel> channels, Flips flips)
    : width_(width),
      height_(height),
      channels_(channels),
      flips_(flips),
      halves_(channels.size()),
      turned_(channels.size()) {}

Imf::FrameBuffer ExrBlocks::frame(int row, int rows, int file_row) {
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const ExrChannel& channel = channels_[c];
    if (const auto* reals = std::get_if<std::span<const float>>(&channel.samples)) {
      copy_rows(*reals, width_, height_, flips_, row, rows, halves_[c]);
      frame.insert(channel.name, slice(Imf::HALF, halves_[c].data(), file_row, width_, rows));
      continue;
    }
    const auto& integers = std::get<std::span<const std::uint32_t>>(channel.samples);
    const std::uint32_t* samples = integers.data() + static_cast<std::size_t>(row) * static_cast<std::size_t>(width_);
    if (flips_.columns || flips_.rows) {
      copy_rows(integers, width_, height_, flips_, row, rows, turned_[c]);
      samples = turned_[c].data();
    }
    frame.insert(channel.name, slice(Imf::UINT, samples, file_row, width_, rows));
  }
  return frame;
}

}  // namespace ninebit::image_detail
