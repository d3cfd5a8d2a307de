// zlib streams.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct z_stream_s;

namespace ninebit::image_detail {

// Compresses one stream after the other. Throws std::bad_alloc where memory runs out.
class Deflater {
 public:
  Deflater();
  ~Deflater();

  // Compresses `bytes`, and appends to `out` what is finished.
  void add(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& out);
  // Appends the rest of the stream. The next bytes begin another one.
  void end(std::vector<std::uint8_t>& out);

 private:
  std::unique_ptr<z_stream_s> stream_;
};

}  // namespace ninebit::image_detail
