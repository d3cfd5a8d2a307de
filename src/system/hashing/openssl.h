// By OpenSSL: SHA-256 of raw planes, so that two runs can be compared by eye, and of a study's files on disk; base64.
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>

namespace ninebit {

class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  // Adds contiguous values as their bytes in memory.
  template <class Values>
  void add(const Values& values) {
    add_bytes(std::as_bytes(std::span(values)));
  }

  // Lower-case hexadecimal; call once.
  [[nodiscard]] std::string finish();

 private:
  void add_bytes(std::span<const std::byte> bytes);

  void* context_;
};

// The hash of a whole text, in lower-case hexadecimal.
[[nodiscard]] std::string sha256(std::string_view text);

// Base64, as data URLs use it.

// The bytes in base64 (RFC 4648), padded, without line breaks.
[[nodiscard]] std::string base64(std::string_view bytes);

}  // namespace ninebit
