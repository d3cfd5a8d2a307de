#include "src/image/output/exr_blocks.h"

#include <algorithm>
#include <bit>
#include <cstring>

namespace ninebit::image_detail {

namespace {

static_assert(std::endian::native == std::endian::little, "blocks hold the samples as this machine does");

std::size_t sample_bytes(const ExrChannel& channel) {
  const bool is_half =
      std::holds_alternative<ExrRealRow>(channel.rows) || std::holds_alternative<ExrHalfRow>(channel.rows);
  return is_half ? sizeof(Half) : sizeof(std::uint32_t);
}

// The bytes at even places, then those at odd ones, each as the difference from the one before plus 128: OpenEXR's
// preparation for ZIP. `to` and `split` are as long as `from`, an even number of bytes.
void prepare(std::span<const std::uint8_t> from, std::span<std::uint8_t> split, std::span<std::uint8_t> to) {
  const std::size_t half = from.size() / 2;
  for (std::size_t i = 0; i < half; ++i) {
    split[i] = from[2 * i];
    split[half + i] = from[2 * i + 1];
  }
  to[0] = split[0];
  for (std::size_t i = 1; i < to.size(); ++i) to[i] = static_cast<std::uint8_t>(split[i] - split[i - 1] + 128);
}

}  // namespace

ExrRows::ExrRows(int width, int height, std::span<const ExrChannel> channels, Flips flips)
    : height_(height),
      flips_(flips),
      integers_(static_cast<std::size_t>(width)),
      floats_(integers_.size()),
      halves_(integers_.size()) {
  for (const ExrChannel& channel : channels) {
    channels_.push_back(&channel);
    row_bytes_ += integers_.size() * sample_bytes(channel);
  }
  std::sort(channels_.begin(), channels_.end(), [](const auto* a, const auto* b) { return a->name < b->name; });
}

template <class Sample, class Fill>
void ExrRows::fill(const Fill& rows, int row, std::vector<Sample>& line) const {
  rows(flips_.rows ? height_ - 1 - row : row, std::span(line));
  if (flips_.columns) std::reverse(line.begin(), line.end());
}

std::uint8_t* ExrRows::store(const ExrChannel& channel, int row, std::uint8_t* to) {
  const auto copy = [&](const auto& line) {
    std::memcpy(to, line.data(), line.size() * sizeof line[0]);
    return to + line.size() * sizeof line[0];
  };
  if (const auto* integers = std::get_if<ExrIntegerRow>(&channel.rows)) {
    fill(*integers, row, integers_);
    return copy(integers_);
  }
  if (const auto* floats = std::get_if<ExrFloatRow>(&channel.rows)) {
    fill(floats->fill, row, floats_);
    return copy(floats_);
  }
  if (const auto* halves = std::get_if<ExrHalfRow>(&channel.rows)) {
    fill(halves->fill, row, halves_);
  } else {
    fill(std::get<ExrRealRow>(channel.rows), row, floats_);
    std::uint32_t last = 0;  // many samples are equal to the one before
    Half half{};
    std::transform(floats_.begin(), floats_.end(), halves_.begin(), [&](float real) {
      const auto bits = std::bit_cast<std::uint32_t>(real);
      if (bits != last) half = half_of(real);
      last = bits;
      return half;
    });
  }
  return copy(halves_);
}

void ExrRows::fetch(int row, std::uint8_t* to) {
  for (const ExrChannel* channel : channels_) to = store(*channel, row, to);
}

void ExrBlock::compress() {
  split_.resize(2 * rows_.size());
  const std::span<std::uint8_t> split(split_.data(), rows_.size()), prepared(split.data() + split.size(), split.size());
  prepare(rows_, split, prepared);
  packed_.clear();
  deflater_.add(prepared, packed_);
  deflater_.end(packed_);
}

std::span<const std::uint8_t> ExrBlock::stored() const {
  return packed_.size() < rows_.size() ? packed_ : rows_;
}

}  // namespace ninebit::image_detail
