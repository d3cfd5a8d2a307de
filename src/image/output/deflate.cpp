#include "src/image/output/deflate.h"

#include <zlib.h>

#include <algorithm>
#include <limits>
#include <new>

namespace ninebit::image_detail {

namespace {

// Pictures here are mostly flat: higher levels take longer, and make them hardly smaller.
constexpr int kLevel = 2;

// Lets zlib write behind what `out` holds.
int run(z_stream& stream, int flush, std::vector<std::uint8_t>& out) {
  constexpr std::size_t kRoom = std::size_t{1} << 16;
  const std::size_t before = out.size();
  out.resize(before + kRoom);
  stream.next_out = out.data() + before;
  stream.avail_out = kRoom;
  const int status = deflate(&stream, flush);
  out.resize(before + kRoom - stream.avail_out);
  return status;
}

}  // namespace

Deflater::Deflater(DeflateFrame frame) : stream_(std::make_unique<z_stream>()) {
  constexpr int kWindowBits = 15, kMemoryLevel = 8;  // deflateInit's
  const int bits = frame == DeflateFrame::zlib ? kWindowBits : -kWindowBits;
  if (deflateInit2(stream_.get(), kLevel, Z_DEFLATED, bits, kMemoryLevel, Z_DEFAULT_STRATEGY) != Z_OK) {
    throw std::bad_alloc();
  }
}

Deflater::~Deflater() {
  deflateEnd(stream_.get());
}

void Deflater::add(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& out) {
  while (!bytes.empty()) {
    const std::size_t size = std::min<std::size_t>(bytes.size(), std::numeric_limits<uInt>::max());
    stream_->next_in = const_cast<std::uint8_t*>(bytes.data());  // zlib only reads it
    stream_->avail_in = static_cast<uInt>(size);
    while (stream_->avail_in > 0) run(*stream_, Z_NO_FLUSH, out);
    bytes = bytes.subspan(size);
  }
}

void Deflater::flush(std::vector<std::uint8_t>& out) {
  do run(*stream_, Z_SYNC_FLUSH, out);
  while (stream_->avail_out == 0);
}

void Deflater::end(std::vector<std::uint8_t>& out) {
  while (run(*stream_, Z_FINISH, out) != Z_STREAM_END) {
  }
  deflateReset(stream_.get());
}

}  // namespace ninebit::image_detail
