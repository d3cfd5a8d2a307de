#include "ninebit/shadow/index_codes.h"

#include <fmt/format.h>

namespace ninebit {

Status check_index_codes(int step, IndexScope scope, std::uint64_t used, std::uint64_t objects) {
  if (step < 1 || step > kMaxIndexStep) {
    return Diagnostic{.message = fmt::format("index step {} is out of range; expected 1 to {}", step, kMaxIndexStep)};
  }
  const auto fits = [](int s, std::uint64_t count) { return count + 1 <= IndexCodes(s).capacity(); };
  if (fits(step, used)) return {};

  std::string remedy;
  for (int smaller = step - 1; smaller >= 1; --smaller) {
    if (!fits(smaller, used)) continue;
    remedy = fmt::format("index step {} would do ({} codes)", smaller, IndexCodes(smaller).capacity());
    break;
  }
  if (scope == IndexScope::polygon && fits(step, objects)) {
    if (!remedy.empty()) remedy += ", or ";
    remedy += fmt::format("index scope object ({} objects)", objects);
  }
  if (remedy.empty()) remedy = "no step or scope would do";
  return Diagnostic{
      .message = fmt::format("too many {}: {} of them and the cleared map need {} codes, index step {} has {}; {}",
                             scope == IndexScope::polygon ? "polygons" : "objects", used, used + 1, step,
                             IndexCodes(step).capacity(), remedy)};
}

}  // namespace ninebit
