// SHA-256 (FIPS 180-4) of planes, as `ninebit draw --json` prints it. The room system/hashing takes it from OpenSSL,
// which does not run in a browser.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string>

namespace ninebit::playground {

class PlaneHash {
 public:
  void add(std::span<const std::uint8_t> bytes);
  // Lower-case hexadecimal; call once.
  [[nodiscard]] std::string finish();

 private:
  void add_block(const std::uint8_t* block);

  std::array<std::uint32_t, 8> state_{0x6a09e667, 0xbb67ae85, 0x3c6ef372, 0xa54ff53a,
                                      0x510e527f, 0x9b05688c, 0x1f83d9ab, 0x5be0cd19};
  std::array<std::uint8_t, 64> rest_{};  // bytes that do not fill a block yet
  std::size_t in_rest_ = 0;
  std::uint64_t total_ = 0;
};

}  // namespace ninebit::playground
