#include "src/tools/vectors/packed_text.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <limits>
#include <new>

namespace ninebit::tools {

std::string packed_text(std::string_view text) {
  constexpr int kGzip = 16, kWindowBits = 15, kMemoryLevel = 9;
  z_stream stream{};
  if (deflateInit2(&stream, Z_BEST_COMPRESSION, Z_DEFLATED, kWindowBits + kGzip, kMemoryLevel, Z_DEFAULT_STRATEGY) !=
      Z_OK) {
    throw std::bad_alloc();
  }
  std::string packed;
  std::array<unsigned char, 1 << 16> piece{};
  int state = Z_OK;
  do {
    // zlib takes at most what its own integers count.
    if (stream.avail_in == 0) {
      const std::size_t size = std::min<std::size_t>(text.size(), std::numeric_limits<uInt>::max());
      stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(text.data()));  // zlib does not write there
      stream.avail_in = static_cast<uInt>(size);
      text.remove_prefix(size);
    }
    stream.next_out = piece.data();
    stream.avail_out = static_cast<uInt>(piece.size());
    state = deflate(&stream, text.empty() ? Z_FINISH : Z_NO_FLUSH);
    packed.append(reinterpret_cast<const char*>(piece.data()), piece.size() - stream.avail_out);
  } while (state == Z_OK || state == Z_BUF_ERROR);
  deflateEnd(&stream);
  return packed;
}

}  // namespace ninebit::tools
