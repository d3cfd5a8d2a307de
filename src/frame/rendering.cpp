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

void IndexMapFace::read_numbers(const IndexCodes& codes, std::size_t begin, std::span<std::uint32_t> out) const {
  ColorBytes last{};  // most texels have the code of the one before, and a number takes three divisions
  std::uint32_t number = codes.number(last);
  for (std::size_t i = 0; i < out.size(); ++i) {
    const ColorBytes code = texel(begin + i);
    if (code != last) number = codes.number(last = code);
    out[i] = number;
  }
}

}  // namespace ninebit
