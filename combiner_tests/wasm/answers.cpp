// The engine of the playground on a command line: reads requests, a line each, and prints the answers and the hash of
// their bytes. A line "buffer N" fills the buffer for the next "put" with N bytes. answers.mjs does the same with the
// page's engine.
#include <cstdint>
#include <cstdio>
#include <iostream>
#include <string>

#include "src/playground/engine.h"

namespace {

constexpr std::string_view kBufferLine = "buffer ";

// FNV-1a.
std::uint32_t hash_of_answer(std::span<const std::uint8_t> bytes) {
  std::uint32_t hash = 0x811c9dc5U;
  for (const std::uint8_t byte : bytes) hash = (hash ^ byte) * 0x01000193U;
  return hash;
}

}  // namespace

int main() {
  ninebit::playground::Engine engine;
  for (std::string line; std::getline(std::cin, line);) {
    if (line.starts_with(kBufferLine)) {
      const auto buffer = engine.buffer(std::stoul(line.substr(kBufferLine.size())));
      for (std::size_t i = 0; i < buffer.size(); ++i) buffer[i] = static_cast<std::uint8_t>(i * 7);
      continue;
    }
    const std::string answer = engine.answer(line);
    std::printf("%s %08x\n", answer.c_str(), static_cast<unsigned>(hash_of_answer(engine.bytes())));
  }
}
