#include "src/shadow/index_order/code_embedding.h"

#include <cmath>
#include <numeric>
#include <queue>
#include <utility>

namespace ninebit {
namespace {

// A code one lattice unit farther from the expected one costs this part of a patch's placed borders, up to kFarthest
// units: it decides between codes that keep equal borders.
constexpr double kDistanceCost = 1e-3;
constexpr double kFarthest = 9.0;
// Rounds over all patches with broken borders.
constexpr int kRounds = 2;

}  // namespace

void CodeEmbedding::CodeLengths::start(std::size_t most) {
  std::size_t size = 16;
  while (size < 2 * most) size *= 2;
  if (slots_.size() < size) slots_.assign(size, {});
  ++stamp_;
  entries_.clear();
}

void CodeEmbedding::CodeLengths::add(std::uint32_t number, float length) {
  constexpr std::uint32_t kSpread = 0x9E3779B1;
  const std::size_t mask = slots_.size() - 1;
  for (std::size_t i = number * kSpread & mask;; i = (i + 1) & mask) {
    Slot& slot = slots_[i];
    if (slot.stamp != stamp_) {
      slot = {stamp_, static_cast<std::uint32_t>(entries_.size())};
      entries_.emplace_back(number, length);
      return;
    }
    if (entries_[slot.entry].first == number) {
      entries_[slot.entry].second += length;
      return;
    }
  }
}

CodeEmbedding::CodeEmbedding(const Patches& patches, const Borders& borders, ShadowRelation& relation,
                             const LostDifferences& lost, CodeLattice& lattice)
    : patches_(patches), borders_(borders), relation_(relation), lost_(lost), lattice_(lattice) {
  for (const CodeBytes& d : lost.all_always()) {
    reach_ = std::max({reach_, std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
  }
  // With a large tolerance not all differences are tried, but a grid of them.
  steps_.push_back({});
  const int stride = std::max(1, (reach_ + 1) / 3);
  for (const CodeBytes& d : lost.all_always()) {
    if (d[0] % stride == 0 && d[1] % stride == 0 && d[2] % stride == 0) steps_.push_back(d);
  }
  all_steps_ = stride == 1;
  total_.resize(patches.count());
  for (std::uint32_t p = 0; p < patches.count(); ++p) {
    for (const Border& border : borders.of(p)) total_[p] += border.length;
  }
}

bool CodeEmbedding::run() {
  if (!place_all()) return count_out();
  improve();
  return true;
}

// Returns whether all patches have a code.
bool CodeEmbedding::place_all() {
  std::vector<std::uint32_t> starts(patches_.count());
  std::iota(starts.begin(), starts.end(), 0U);
  std::stable_sort(starts.begin(), starts.end(),
                   [this](std::uint32_t a, std::uint32_t b) { return total_[a] > total_[b]; });
  std::vector<float> to_placed(patches_.count(), 0.0F);
  std::vector<bool> done(patches_.count(), false);
  std::priority_queue<std::pair<float, std::uint32_t>> next;
  bool full = false;
  order_.reserve(patches_.count());
  for (const std::uint32_t start : starts) {
    if (!done[start]) next.emplace(0.0F, start);
    while (!next.empty()) {
      const std::uint32_t patch = next.top().second;
      next.pop();
      if (done[patch]) continue;
      done[patch] = true;
      order_.push_back(patch);
      full = full || (!place_beside_neighbours(patch, 0.0F) && !place_apart(patch));
      for (const Border& border : borders_.of(patch)) {
        if (done[border.patch]) continue;
        to_placed[border.patch] += border.length;
        next.emplace(to_placed[border.patch], border.patch);
      }
    }
  }
  return !full;
}

// A patch that cannot be moved is tried again once a neighbour has moved.
void CodeEmbedding::improve() {
  std::vector<bool> worth_a_try(patches_.count(), true);
  for (int round = 0; round < kRounds; ++round) {
    bool moved = false;
    for (const std::uint32_t patch : order_) {
      if (!worth_a_try[patch]) continue;
      worth_a_try[patch] = false;
      const CodeBytes old = lattice_.code(patch);
      const float now = kept(patch, old);
      if (now >= total_[patch] * 0.999999F) continue;
      lattice_.take(patch);
      if (!place_beside_neighbours(patch, now)) {
        lattice_.put(patch, old);
        continue;
      }
      moved = true;
      for (const Border& border : borders_.of(patch)) worth_a_try[border.patch] = true;
    }
    if (!moved) return;
  }
}

bool CodeEmbedding::count_out() {
  if (order_.size() >= lattice_.capacity()) return false;
  lattice_.clear();
  const int levels = (CodeLattice::kLevels - 1) / lattice_.spacing() + 1;
  int number = 0;
  for (const std::uint32_t patch : order_) {
    ++number;
    lattice_.put(patch, {number % levels * lattice_.spacing(), number / levels % levels * lattice_.spacing(),
                         number / levels / levels * lattice_.spacing()});
  }
  return true;
}

float CodeEmbedding::kept(std::uint32_t patch, const CodeBytes& code) const {
  float sum = 0.0F;
  for (const Border& border : borders_.of(patch)) {
    if (!lattice_.has_code(border.patch)) continue;
    if (lost_.always(difference(lattice_.code(border.patch), code))) sum += border.length;
  }
  return sum;
}

bool CodeEmbedding::place_beside_neighbours(std::uint32_t patch, float least) {
  collect_candidates(patch, least);
  const auto worse = [](const Candidate& a, const Candidate& b) {
    return a.score < b.score || (a.score == b.score && a.code > b.code);
  };
  std::make_heap(candidates_.begin(), candidates_.end(), worse);
  for (auto end = candidates_.end(); end != candidates_.begin(); --end) {
    std::pop_heap(candidates_.begin(), end, worse);
    const CodeBytes& code = (end - 1)->code;
    if (!is_allowed(patch, code)) continue;
    lattice_.put(patch, code);
    return true;
  }
  return false;
}

void CodeEmbedding::collect_candidates(std::uint32_t patch, float least) {
  candidates_.clear();
  codes_.start(borders_.of(patch).size() * steps_.size());
  double placed = 0.0;
  for (const Border& border : borders_.of(patch)) {
    if (!lattice_.has_code(border.patch)) continue;
    placed += static_cast<double>(border.length);
    const CodeBytes& from = lattice_.code(border.patch);
    for (const CodeBytes& d : steps_) {
      const CodeBytes code{from[0] + d[0], from[1] + d[1], from[2] + d[2]};
      if (lattice_.usable(code)) codes_.add(code_number(code), border.length);
    }
  }
  if (codes_.entries().empty()) return;
  const glm::dvec3 expected = expected_code(patch);
  for (const auto& [number, length_of_steps] : codes_.entries()) {
    const CodeBytes code{static_cast<int>(number & 255U), static_cast<int>(number >> 8 & 255U),
                         static_cast<int>(number >> 16)};
    const float length = all_steps_ ? length_of_steps : kept(patch, code);
    if (length <= least) continue;
    double apart = 0.0;
    for (std::size_t c = 0; c < static_cast<std::size_t>(lattice_.channels()); ++c) {
      const double d = static_cast<double>(code[c]) - expected[static_cast<glm::length_t>(c)];
      apart += d * d;
    }
    const double cost = kDistanceCost * placed * std::min(kFarthest, std::sqrt(apart));
    candidates_.push_back({static_cast<float>(static_cast<double>(length) - cost), code});
  }
}

// The mean of the placed neighbours' codes, each moved in the direction in which the patch lies from it: the lattice
// then unfolds as the scene lies in space, which leaves room for patches to come.
glm::dvec3 CodeEmbedding::expected_code(std::uint32_t patch) const {
  glm::dvec3 sum(0.0);
  double weight = 0.0;
  for (const Border& border : borders_.of(patch)) {
    if (!lattice_.has_code(border.patch)) continue;
    const CodeBytes& code = lattice_.code(border.patch);
    glm::dvec3 way = patches_.center(patch) - patches_.center(border.patch);
    const double largest = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
    if (largest > 0.0) way *= reach_ / largest;
    const auto length = static_cast<double>(border.length);
    sum += length * (glm::dvec3(code[0], code[1], code[2]) + way);
    weight += length;
  }
  return sum / weight;
}

bool CodeEmbedding::is_allowed(std::uint32_t patch, const CodeBytes& code) const {
  return lattice_.in_conflict_with(code, [&](std::uint32_t other) {
    return borders_.are_neighbours(patch, other) || !relation_.may_shadow(patch, other);
  });
}

bool CodeEmbedding::place_apart(std::uint32_t patch) {
  for (std::size_t margin = 0; margin < kMargins.size(); ++margin) {
    if (place_apart(patch, margin)) return true;
  }
  return false;
}

bool CodeEmbedding::place_apart(std::uint32_t patch, std::size_t margin) {
  const int stride = kMargins[margin] * lattice_.spacing();
  const int slots = (CodeLattice::kLevels - 1) / stride + 1;
  const int channels = lattice_.channels();
  const std::size_t count = static_cast<std::size_t>(slots) * static_cast<std::size_t>(channels > 1 ? slots : 1) *
                            static_cast<std::size_t>(channels > 2 ? slots : 1);
  for (std::size_t& i = cursor_[margin]; i < count;) {
    const int slot = static_cast<int>(i++);
    // In the middle of its slot, so that neighbours have room on all sides.
    const auto coordinate = [&](int number) { return number % slots * stride + stride / 2; };
    const CodeBytes code{coordinate(slot), channels > 1 ? coordinate(slot / slots) : 0,
                         channels > 2 ? coordinate(slot / slots / slots) : 0};
    // All around it is free up to the middle between two slots.
    const int reach = std::max(stride / 2, lattice_.spacing() - 1);
    if (!lattice_.usable(code) || !lattice_.empty_around(code, reach)) continue;
    lattice_.put(patch, code);
    return true;
  }
  return false;
}

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
