#include "src/playground/shadow_answer.h"

namespace ninebit::playground {

Reply shadow_answer(Request&, std::vector<std::uint8_t>&) {
  return refusal("index shadows are not there yet");
}

}  // namespace ninebit::playground
