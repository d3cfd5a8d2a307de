#include "src/image/output/exr_file.h"

#include <algorithm>
#include <bit>
#include <cstring>
#include <new>

namespace ninebit::image_detail {

namespace {

constexpr std::size_t kShortName = 31;  // longer names are marked in the file's version

std::int64_t write(exr_const_context_t, void* file, const void* bytes, std::uint64_t size, std::uint64_t position,
                   exr_stream_error_func_ptr_t) {
  auto& output = *static_cast<posix::CheckedFile*>(file);
  if (output.tell() != position && !output.seek(position)) return -1;
  return output.write(bytes, size) ? static_cast<std::int64_t>(size) : -1;
}

void ignore(exr_const_context_t, exr_result_t, const char*) {}

exr_pixel_type_t pixel_type(const ExrChannel& channel) {
  if (std::holds_alternative<ExrFloatRow>(channel.rows)) return EXR_PIXEL_FLOAT;
  return std::holds_alternative<ExrIntegerRow>(channel.rows) ? EXR_PIXEL_UINT : EXR_PIXEL_HALF;
}

}  // namespace

template <class Call>
void ExrFile::call(const Call& function) {
  if (fault_ == EXR_ERR_SUCCESS) fault_ = function();
  if (fault_ == EXR_ERR_OUT_OF_MEMORY) throw std::bad_alloc();
}

ExrFile::ExrFile(posix::CheckedFile& file) : file_(file) {
  exr_context_initializer_t start = EXR_DEFAULT_CONTEXT_INITIALIZER;
  start.error_handler_fn = &ignore;  // the default one prints
  start.user_data = &file_;
  start.write_fn = &write;
  call([&] { return exr_start_write(&context_, file_.path().c_str(), EXR_WRITE_FILE_DIRECTLY, &start); });
}

ExrFile::~ExrFile() {
  if (context_ != nullptr) exr_finish(&context_);
}

void ExrFile::add_part(const std::string& name, int width, int height, std::span<const ExrChannel> channels) {
  int part = 0;
  const exr_attr_box2i_t data = window_of(width, height);
  constexpr exr_attr_v2f_t kCenter{};
  for (const ExrChannel& channel : channels) {
    if (channel.name.size() > kShortName) call([&] { return exr_set_longname_support(context_, 1); });
  }
  call([&] { return exr_add_part(context_, name.empty() ? nullptr : name.c_str(), EXR_STORAGE_SCANLINE, &part); });
  call([&] {
    return exr_initialize_required_attr(context_, part, &window_, &data, 1.0F, &kCenter, 1.0F,
                                        EXR_LINEORDER_INCREASING_Y, EXR_COMPRESSION_ZIP);
  });
  for (const ExrChannel& channel : channels) {
    call([&] {
      return exr_add_channel(context_, part, channel.name.c_str(), pixel_type(channel), EXR_PERCEPTUALLY_LOGARITHMIC, 1,
                             1);
    });
  }
}

void ExrFile::mark_as_cube() {
  call([&] { return exr_attr_set_envmap(context_, 0, "envmap", EXR_ENVMAP_CUBE); });
}

void ExrFile::begin_blocks() {
  call([&] { return exr_write_header(context_); });
}

void ExrFile::add_block(int part, int row, std::span<const std::uint8_t> bytes) {
  call([&] { return exr_write_scanline_chunk(context_, part, row, bytes.data(), bytes.size()); });
}

std::string ExrFile::finish() {
  call([&] { return exr_finish(&context_); });
  return fault_ == EXR_ERR_SUCCESS ? std::string() : exr_get_default_error_message(fault_);
}

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
