// zlib streams, compressed by ISA-L.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

struct isal_zstream;

namespace ninebit::image_detail {

// Compresses one stream after the other. ISA-L has code for several instruction sets, so the bytes of a stream may
// differ between processors; what they decompress to does not.
class Deflater {
 public:
  Deflater();
  Deflater(Deflater&&) noexcept;
  ~Deflater();

  // Compresses `bytes`, and appends to `out` what is finished.
  void add(std::span<const std::uint8_t> bytes, std::vector<std::uint8_t>& out);
  // Appends the rest of the stream. The next bytes begin another one.
  void end(std::vector<std::uint8_t>& out);

 private:
  void begin();

  std::vector<std::uint8_t> level_;  // ISA-L's buffer
  std::unique_ptr<isal_zstream> stream_;
};

}  // namespace ninebit::image_detail
