// SHA-256 of raw planes, so that two runs can be compared by eye.
#pragma once

#include <span>
#include <string>

namespace ninebit::tools {

class Sha256 {
 public:
  Sha256();
  ~Sha256();
  Sha256(const Sha256&) = delete;
  Sha256& operator=(const Sha256&) = delete;

  void add(std::span<const unsigned char> bytes);

  // Lower-case hexadecimal; call once.
  [[nodiscard]] std::string finish();

 private:
  void* context_;
};

}  // namespace ninebit::tools
