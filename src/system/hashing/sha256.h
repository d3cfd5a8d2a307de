// SHA-256: of raw planes, so that two runs can be compared by eye, and of what a study leaves on the disk.
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

  // Values that lie side by side, with the bytes that they have in memory.
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

// Of a whole text.
[[nodiscard]] std::string sha256(std::string_view text);

}  // namespace ninebit
