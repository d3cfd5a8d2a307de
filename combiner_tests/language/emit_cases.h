// The programs and the inputs on which emitted source is held against the reference.
#pragma once

#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"

namespace ninebit::test {

struct EmitCase {
  std::string name;
  HardwareProfile profile;
  Program program;
};

// The article's comparison and GL's default state, with every integer profile.
std::vector<EmitCase> known_cases();
// Each input mapping with each legal pair of scale and bias, as product and as dot product, with every integer profile;
// positive and negative results both reach the output.
std::vector<EmitCase> row_cases();
// Case i depends on the seed and on i alone; every third one has a profile with rules replaced by their rivals.
std::vector<EmitCase> random_cases(std::uint64_t seed, int count);

// The programs of scenes/effects/programs that the profile runs, by file.
std::vector<std::pair<std::string, Program>> gallery_programs(const HardwareProfile& profile);

// Registers as an emitted function takes them: spare0's colour and spare1 are 0. Biased to edges, the extremes first.
std::vector<RegisterFile> emit_inputs(const HardwareProfile& profile, std::uint64_t seed, std::size_t count);

// The values of a comparison, so that a run without meaning fails.
class Outputs {
 public:
  void add(const Rgba9& color) {
    ++fragments_;
    if (color[0] == 0 && color[1] == 0 && color[2] == 0) ++black_;
    distinct_.push_back(color);
  }
  // For random programs: few black fragments, many colours.
  void expect_meaning(std::size_t least_fragments);
  void expect_distinct(std::size_t least_colors);

 private:
  std::size_t fragments_ = 0, black_ = 0;
  std::vector<Rgba9> distinct_;
};

std::string mismatch(const EmitCase& emitted, const RegisterFile& input, const Rgba9& expected, const Rgba9& actual);

}  // namespace ninebit::test
