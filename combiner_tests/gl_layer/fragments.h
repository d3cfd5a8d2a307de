// 256 fragments with inputs of their own, drawn by OpenGL and computed by the library.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <string>
#include <vector>

#include "combiner_tests/gl_layer/pictures.h"
#include "combiner_tests/support/random.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/program.h"

namespace ninebit::test {

inline constexpr std::size_t kFragments = kPictureSize * kPictureSize;

// Inputs of each fragment: the textures of the first `units` units; the fog factor if `fog`. One fog colour for all.
struct Fragments {
  bool fog = false;
  std::size_t units = 0;
  std::array<FragmentInputs, kFragments> inputs{};
};

// What a parametrized test is called under a profile.
std::string name_of_case(const ::testing::TestParamInfo<HardwareProfile>& profile);

// A state that OpenGL can set.
CombinerState random_gl_state(Random& random, const HardwareProfile& profile);

// Inputs that lean towards 0, 127, 128 and 255.
Fragments random_fragments(Random& random, const HardwareProfile& profile);

// Draws them as points, one a pixel, with nearest textures; returns the picture, red, green, blue, alpha, by rows from
// below.
std::vector<Pixel> draw(const Fragments& fragments, const HardwareProfile& profile);

// The same as the library computes it.
std::vector<Pixel> compute(const Program& program, const HardwareProfile& profile, const Fragments& fragments);

}  // namespace ninebit::test
