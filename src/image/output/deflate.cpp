#include "src/image/output/deflate.h"

#include <isa-l/igzip_lib.h>

#include <algorithm>
#include <limits>

namespace ninebit::image_detail {

namespace {

// Lets ISA-L write behind what `out` holds. It fails only for a wrong level or buffer, which are constants here.
void run(isal_zstream& stream, std::vector<std::uint8_t>& out) {
  constexpr std::size_t kRoom = std::size_t{1} << 16;
  const std::size_t before = out.size();
  out.resize(before + kRoom);
  stream.next_out = out.data() + before;
  stream.avail_out = kRoom;
  (void)isal_deflate(&stream);
  out.resize(before + kRoom - stream.avail_out);
}

}  // namespace

Deflater::Deflater() : level_(ISAL_DEF_LVL1_DEFAULT), stream_(std::make_unique<isal_zstream>()) {
  begin();
}

Deflater::Deflater(Deflater&&) noexcept = default;

Deflater::~Deflater() = default;

void Deflater::begin() {
  isal_deflate_init(stream_.get());
  // Level 0 has only fixed codes; level 2 is no smaller on flat pictures, level 3 as slow as zlib.
  stream_->level = 1;
  stream_->level_buf = level_.data();
  stream_->level_buf_size = static_cast<std::uint32_t>(level_.size());
  stream_->gzip_flag = IGZIP_ZLIB;  // ISA-L changes it once the header is written
}

void Deflater::add(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& out) {
  while (!bytes.empty()) {
    const std::size_t size = std::min<std::size_t>(bytes.size(), std::numeric_limits<std::uint32_t>::max());
    stream_->next_in = const_cast<std::uint8_t*>(bytes.data());  // ISA-L only reads it
    stream_->avail_in = static_cast<std::uint32_t>(size);
    while (stream_->avail_in > 0) run(*stream_, out);
    bytes = bytes.subspan(size);
  }
}

void Deflater::end(std::vector<std::uint8_t>& out) {
  stream_->end_of_stream = 1;
  while (stream_->internal_state.state != ZSTATE_END) run(*stream_, out);
  begin();
}

}  // namespace ninebit::image_detail
