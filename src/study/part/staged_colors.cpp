#include "src/study/part/staged_colors.h"

#include <cstddef>

#include "ninebit/study/program_error.h"

namespace ninebit {
namespace {

// The program with only `count` of its general combiners, beginning at number k.
Program part_of(const Program& program, int k, int count) {
  Program part = program;
  part.num_general_combiners = count;
  for (int i = 0; i < count; ++i) {
    part.general[static_cast<std::size_t>(i)] = program.general[static_cast<std::size_t>(k + i)];
  }
  return part;
}

}  // namespace

StagedColors::StagedColors(const Program& program) {
  const int n = program.num_general_combiners;
  for (int k = 0; k < n; ++k) stage_.push_back(part_of(program, k, 1));
  for (int k = 0; k <= n; ++k) rest_.push_back(part_of(program, k, n - k));
  for (const Program& rest : rest_) exact_.emplace_back(rest);
  colors_.resize(rest_.size() + 1);
}

const std::vector<RealColor>& StagedColors::operator()(RegisterFile registers) {
  for (std::size_t k = 0; k < rest_.size(); ++k) {
    colors_[k] = exact_[k](registers);
    if (k < stage_.size()) evaluate_general(stage_[k], registers);
  }
  const Rgba9 codes = evaluate_final(rest_.back(), registers);
  for (std::size_t c = 0; c < 4; ++c) {
    colors_.back()[c] = static_cast<double>(codes[c]) / rest_.back().datapath.one;
  }
  return colors_;
}

std::vector<RealColor> colors_by_stage(const Program& program, const RegisterFile& initial) {
  return StagedColors(program)(initial);
}

}  // namespace ninebit
