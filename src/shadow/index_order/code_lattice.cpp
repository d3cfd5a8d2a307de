#include "src/shadow/index_order/code_lattice.h"

namespace ninebit {
namespace {

constexpr CodeBytes kNoCode{-1, -1, -1};

}  // namespace

CodeLattice::CodeLattice(const LostDifferences& lost, int step, std::uint32_t patches)
    : lost_(lost), step_(step), spacing_(std::max(lost.radius() + 1, step)), next_(patches, kNone) {
  // A conflict then reaches into two cubes per channel at most.
  while ((1 << cube_bits_) < 2 * spacing_ - 1) ++cube_bits_;
  cubes_ = kLevels >> cube_bits_;
  const auto n = static_cast<std::size_t>(cubes_);
  head_.assign(lost.channels() == 3 ? n * n * n : lost.channels() == 2 ? n * n : n, kNone);
  code_.assign(patches, kNoCode);
}

std::size_t CodeLattice::capacity() const {
  const auto levels = static_cast<std::size_t>((kLevels - 1) / spacing_ + 1);
  return lost_.channels() == 3 ? levels * levels * levels : lost_.channels() == 2 ? levels * levels : levels;
}

bool CodeLattice::usable(const CodeBytes& code) const {
  for (std::size_t c = 0; c < 3; ++c) {
    const int levels = static_cast<int>(c) < lost_.channels() ? kLevels : 1;
    if (code[c] < 0 || code[c] >= levels) return false;
  }
  return !conflict(code);
}

void CodeLattice::put(std::uint32_t patch, const CodeBytes& code) {
  std::uint32_t& head = head_[cube_of(code)];
  code_[patch] = code;
  next_[patch] = head;
  head = patch;
}

void CodeLattice::take(std::uint32_t patch) {
  std::uint32_t* link = &head_[cube_of(code_[patch])];
  while (*link != patch) link = &next_[*link];
  *link = next_[patch];
  code_[patch] = kNoCode;
}

void CodeLattice::clear() {
  std::fill(head_.begin(), head_.end(), kNone);
  std::fill(code_.begin(), code_.end(), kNoCode);
}

}  // namespace ninebit
