// zlib streams.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct z_stream_s;

namespace ninebit::image_detail {

// zlib's frame about the compressed bytes, its header and checksum; pieces are those of one stream, compressed apart,
// and their user frames them.
enum class DeflateFrame : std::uint8_t { zlib, none };

// Compresses one stream after the other. Throws std::bad_alloc where memory runs out.
class Deflater {
 public:
  explicit Deflater(DeflateFrame frame = DeflateFrame::zlib);
  ~Deflater();

  // Compresses `bytes`, and appends to `out` what is finished.
  void add(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& out);
  // Appends what is left of the bytes so far, up to a whole byte: a piece that another one follows.
  void flush(std::vector<std::uint8_t>& out);
  // Appends the rest of the stream. The next bytes begin another one.
  void end(std::vector<std::uint8_t>& out);

 private:
  std::unique_ptr<z_stream_s> stream_;
};

}  // namespace ninebit::image_detail
