// The 60 words of a pixel shader definition, written in every shape that people paste.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "combiner_tests/support/random.h"
#include "ninebit/combiner/state.h"

namespace ninebit::test {

using Words = std::array<std::uint32_t, 60>;

// A member of the struct, the first of its words, and its name among NV20's register words ("": combiners do not read
// it).
struct Member {
  const char* name;
  std::size_t first, count;
  const char* word;
};
inline constexpr std::array<Member, 18> kMembers{{{"PSAlphaInputs", 0, 8, "RC_IN_ALPHA"},
                                                  {"PSFinalCombinerInputsABCD", 8, 1, "RC_FINAL0"},
                                                  {"PSFinalCombinerInputsEFG", 9, 1, "RC_FINAL1"},
                                                  {"PSConstant0", 10, 8, "RC_CONSTANT_COLOR0"},
                                                  {"PSConstant1", 18, 8, "RC_CONSTANT_COLOR1"},
                                                  {"PSAlphaOutputs", 26, 8, "RC_OUT_ALPHA"},
                                                  {"PSRGBInputs", 34, 8, "RC_IN_RGB"},
                                                  {"PSCompareMode", 42, 1, ""},
                                                  {"PSFinalCombinerConstant0", 43, 1, "RC_COLOR0"},
                                                  {"PSFinalCombinerConstant1", 44, 1, "RC_COLOR1"},
                                                  {"PSRGBOutputs", 45, 8, "RC_OUT_RGB"},
                                                  {"PSCombinerCount", 53, 1, "RC_ENABLE"},
                                                  {"PSTextureModes", 54, 1, ""},
                                                  {"PSDotMapping", 55, 1, ""},
                                                  {"PSInputTexture", 56, 1, ""},
                                                  {"PSC0Mapping", 57, 1, ""},
                                                  {"PSC1Mapping", 58, 1, ""},
                                                  {"PSFinalCombinerConstants", 59, 1, ""}}};

// "0x0000000c"; with other digits and letters: "C", "0000000C".
std::string hex(std::uint32_t word, const char* format = "0x%08x");

// The words of a random program of the NV2A, and words that combiners do not read.
Words random_words(Random& random);

// A shape with its name for messages.
struct Shape {
  const char* name;
  std::function<std::string(const Words&)> text;
};
// All shapes; each gives all of the words.
std::vector<Shape> all_shapes();

// The same words as `NAME = 0x…` lines of NV20, without those that combiners do not read.
std::string as_register_words(const Words& words);

// The bytes, little endian.
std::string as_bytes(const Words& words);

}  // namespace ninebit::test
