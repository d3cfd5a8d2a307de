#include "ninebit/frame/rendering.h"

namespace ninebit {

const ProbedFragment* deciding_fragment(const ProbedPass& pass) {
  const ProbedFragment* decided = nullptr;
  for (const ProbedFragment& fragment : pass.fragments) {
    const bool outranked = decided != nullptr && decided->fate == FragmentFate::written;
    const bool is_first_culled = fragment.fate == FragmentFate::culled && decided == nullptr;
    if (fragment.fate == FragmentFate::written || (fragment.depth_passes && !outranked) || is_first_culled) {
      decided = &fragment;
    }
  }
  return decided;
}

}  // namespace ninebit
