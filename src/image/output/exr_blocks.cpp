#include "src/image/output/exr_blocks.h"

#include <ImathBox.h>
#include <ImfChannelList.h>

#include <algorithm>
#include <type_traits>

namespace ninebit::image_detail {

void add_channels(Imf::Header& header, std::span<const ExrChannel> channels) {
  for (const ExrChannel& channel : channels) header.channels().insert(channel.name, Imf::Channel(pixel_type(channel)));
}

ExrBlocks::ExrBlocks(int width, int height, std::span<const ExrChannel> channels, Flips flips)
    : width_(width), height_(height), channels_(channels), flips_(flips), blocks_(channels.size()) {
  const std::size_t samples = static_cast<std::size_t>(width) * static_cast<std::size_t>(std::min(height, kRows));
  for (std::size_t c = 0; c < channels.size(); ++c) {
    if (pixel_type(channels[c]) == Imf::HALF) {
      blocks_[c].halves.resize(samples);
      reals_.resize(static_cast<std::size_t>(width));
    } else if (pixel_type(channels[c]) == Imf::FLOAT) {
      blocks_[c].floats.resize(samples);
    } else {
      blocks_[c].integers.resize(samples);
    }
  }
}

void ExrBlocks::fetch(const ExrIntegerRow& fill, int row, std::span<std::uint32_t> line) const {
  fill(source_row(row), line);
  if (flips_.columns) std::reverse(line.begin(), line.end());
}

void ExrBlocks::fetch(const ExrFloatRow& floats, int row, std::span<float> line) const {
  floats.fill(source_row(row), line);
  if (flips_.columns) std::reverse(line.begin(), line.end());
}

void ExrBlocks::fetch(const ExrRealRow& fill, int row, std::span<half> line) {
  fill(source_row(row), reals_);
  const auto convert = [](float sample) { return half(sample); };
  if (flips_.columns) {
    std::transform(reals_.rbegin(), reals_.rend(), line.begin(), convert);
  } else {
    std::transform(reals_.begin(), reals_.end(), line.begin(), convert);
  }
}

template <class Sample, class Fill>
Imf::Slice ExrBlocks::block_of(const Fill& fill, std::vector<Sample>& block, int row, int rows, int file_row) {
  const auto columns = static_cast<std::size_t>(width_);
  const std::span<Sample> lines = block;
  for (int r = 0; r < rows; ++r) fetch(fill, row + r, lines.subspan(static_cast<std::size_t>(r) * columns, columns));
  constexpr Imf::PixelType kType = std::is_same_v<Sample, half>    ? Imf::HALF
                                   : std::is_same_v<Sample, float> ? Imf::FLOAT
                                                                   : Imf::UINT;
  return Imf::Slice::Make(kType, block.data(), Imath::V2i(0, file_row), width_, rows, sizeof(Sample),
                          sizeof(Sample) * columns);
}

Imf::FrameBuffer ExrBlocks::frame(int row, int rows, int file_row) {
  Imf::FrameBuffer frame;
  for (std::size_t c = 0; c < channels_.size(); ++c) {
    const ExrChannel& channel = channels_[c];
    if (const auto* reals = std::get_if<ExrRealRow>(&channel.rows)) {
      frame.insert(channel.name, block_of(*reals, blocks_[c].halves, row, rows, file_row));
    } else if (const auto* floats = std::get_if<ExrFloatRow>(&channel.rows)) {
      frame.insert(channel.name, block_of(*floats, blocks_[c].floats, row, rows, file_row));
    } else {
      const auto& integers = std::get<ExrIntegerRow>(channel.rows);
      frame.insert(channel.name, block_of(integers, blocks_[c].integers, row, rows, file_row));
    }
  }
  return frame;
}

}  // namespace ninebit::image_detail
