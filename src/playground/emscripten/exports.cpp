// The functions that the page calls.
#include <cstddef>
#include <cstdint>
#include <string>

#include "src/playground/engine.h"

namespace ninebit::playground {
namespace {

Engine& page_engine() {
  static Engine engine;
  return engine;
}

}  // namespace
}  // namespace ninebit::playground

extern "C" {

// The answer as JSON, ended by a zero byte; valid until the next call.
const char* ninebit_answer(const char* request) {
  static std::string answer;
  answer = ninebit::playground::page_engine().answer(request);
  return answer.c_str();
}

// Memory for the next "put"; nullptr for more than it takes, and for none.
std::uint8_t* ninebit_buffer(std::size_t bytes) {
  const auto buffer = ninebit::playground::page_engine().buffer(bytes);
  return buffer.empty() ? nullptr : buffer.data();
}

// The bytes of the last answer; valid until the next call.
const std::uint8_t* ninebit_bytes() {
  return ninebit::playground::page_engine().bytes().data();
}
}
