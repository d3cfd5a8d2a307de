// The words of a chip in the C99 files, by their names.
#pragma once

#include <cstddef>
#include <string>

#include "ninebit/language/register_words.h"
#include "src/combiner/c99/ninebit_combiner.h"

namespace ninebit::test {

// Calls visit(name, word) for each word that the chip has.
template <class Visit>
void for_each_word(nbc_words& words, ChipClass chip, const Visit& visit) {
  const bool is_nv20 = chip == ChipClass::nv20;
  for (std::size_t i = 0; i < (is_nv20 ? 8 : 2); ++i) {
    const std::string index = '[' + std::to_string(i) + ']';
    visit("RC_IN_RGB" + index, words.in_rgb[i]);
    visit("RC_IN_ALPHA" + index, words.in_alpha[i]);
    visit("RC_OUT_RGB" + index, words.out_rgb[i]);
    visit("RC_OUT_ALPHA" + index, words.out_alpha[i]);
    if (!is_nv20) continue;
    visit("RC_CONSTANT_COLOR0" + index, words.stage_color0[i]);
    visit("RC_CONSTANT_COLOR1" + index, words.stage_color1[i]);
  }
  visit(is_nv20 ? "RC_COLOR0" : "RC_COLOR[0]", words.color[0]);
  visit(is_nv20 ? "RC_COLOR1" : "RC_COLOR[1]", words.color[1]);
  visit("RC_FINAL0", words.final0);
  visit("RC_FINAL1", words.final1);
  if (is_nv20) visit("RC_ENABLE", words.enable);
}

}  // namespace ninebit::test
