// Lays the patches of a scene into the lattice of codes.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "src/shadow/index_order/borders.h"
#include "src/shadow/index_order/lost_differences.h"
#include "src/shadow/index_order/patches.h"

namespace ninebit {

// The lattice of index codes, and the patches that have one.

// Each code holds at most one patch. Patches are kept in cubes of codes, so that those near a code are found at once.
class CodeLattice {
 public:
  // `step`: the smallest distance, in one channel, between codes that must differ. `lost` must outlive the lattice.
  CodeLattice(const LostDifferences& lost, int step, std::uint32_t patches);

  static constexpr int kLevels = 256;  // bytes per channel

  // Codes that differ by this much in one channel never conflict.
  [[nodiscard]] int spacing() const { return spacing_; }
  // The number of codes that are a multiple of the spacing in each channel, with the cleared map's.
  [[nodiscard]] std::size_t capacity() const;
  [[nodiscard]] int channels() const { return lost_.channels(); }
  // Whether two codes with this difference are too near to each other for patches that must differ.
  [[nodiscard]] bool conflict(const CodeBytes& d) const {
    return !lost_.never(d) || std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) < step_;
  }
  // Whether a code exists and is far enough from that of the cleared map, which is 0.
  [[nodiscard]] bool usable(const CodeBytes& code) const;

  [[nodiscard]] bool has_code(std::uint32_t patch) const { return code_[patch][0] >= 0; }
  [[nodiscard]] const CodeBytes& code(std::uint32_t patch) const { return code_[patch]; }
  void put(std::uint32_t patch, const CodeBytes& code);
  void take(std::uint32_t patch);
  void clear();

  // Calls each(patch) for patches whose code conflicts with this code, until it returns false. Returns whether no call
  // returned false.
  template <class Each>
  bool in_conflict_with(const CodeBytes& code, const Each& each) const {
    return near(code, spacing_ - 1,
                [&](std::uint32_t patch) { return !conflict(difference(code_[patch], code)) || each(patch); });
  }
  // Whether no patch's code differs by `reach` or less in all channels.
  [[nodiscard]] bool empty_around(const CodeBytes& code, int reach) const {
    return near(code, reach, [&](std::uint32_t patch) {
      const CodeBytes d = difference(code_[patch], code);
      return std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])}) > reach;
    });
  }

 private:
  static constexpr std::uint32_t kNone = ~0U;

  [[nodiscard]] std::size_t cube(int x, int y, int z) const {
    return static_cast<std::size_t>((z * cubes_ + y) * cubes_ + x);
  }
  [[nodiscard]] std::size_t cube_of(const CodeBytes& code) const {
    return cube(code[0] >> cube_bits_, code[1] >> cube_bits_, code[2] >> cube_bits_);
  }

  // Calls each(patch) for at least all patches within `reach`, until it returns false.
  template <class Each>
  bool near(const CodeBytes& code, int reach, const Each& each) const {
    std::array<int, 3> first{}, last{};
    for (std::size_t c = 0; c < 3; ++c) {
      first[c] = std::max(0, code[c] - reach) >> cube_bits_;
      last[c] = std::min(kLevels - 1, code[c] + reach) >> cube_bits_;
      if (static_cast<int>(c) >= lost_.channels()) last[c] = 0;
    }
    for (int z = first[2]; z <= last[2]; ++z) {
      for (int y = first[1]; y <= last[1]; ++y) {
        for (int x = first[0]; x <= last[0]; ++x) {
          for (std::uint32_t patch = head_[cube(x, y, z)]; patch != kNone; patch = next_[patch]) {
            if (!each(patch)) return false;
          }
        }
      }
    }
    return true;
  }

  const LostDifferences& lost_;
  int step_, spacing_, cube_bits_ = 0, cubes_ = 1;
  std::vector<std::uint32_t> head_, next_;  // the first patch of each cube, and of each patch the next one
  std::vector<CodeBytes> code_;             // of each patch; the first is negative: none
};

// Gives each patch a code. Neighbours get the same code, or codes whose difference is always lost, as far as possible;
// patches that may shadow one another and are not neighbours get codes without conflict, always. A border that cannot
// be kept is broken; the longer it is, the later.
class CodeEmbedding {
 public:
  // All must outlive the embedding.
  CodeEmbedding(const Patches& patches, const Borders& borders, ShadowRelation& relation, const LostDifferences& lost,
                CodeLattice& lattice);

  // Places patch by patch, each next to those of its neighbours that have a code already; then moves single patches
  // while that mends borders. If the lattice is too full for this, codes are counted out at the lattice's spacing.
  // Returns false if these are too few.
  [[nodiscard]] bool run();

 private:
  struct Candidate {
    float score;
    CodeBytes code;
  };

  // Numbers of codes, each with the sum of the lengths that were added to it.
  class CodeLengths {
   public:
    void start(std::size_t most);  // empties it; `most` calls of add() may follow
    void add(std::uint32_t number, float length);
    [[nodiscard]] const std::vector<std::pair<std::uint32_t, float>>& entries() const { return entries_; }

   private:
    struct Slot {
      std::uint32_t stamp = 0, entry = 0;
    };
    std::vector<Slot> slots_;  // a hash table; only slots with the latest stamp are filled
    std::uint32_t stamp_ = 0;
    std::vector<std::pair<std::uint32_t, float>> entries_;
  };

  // The patches in the order of placement: always the one with the longest border to those before.
  bool place_all();
  void improve();
  bool count_out();

  // The length of the patch's borders that are kept with this code.
  [[nodiscard]] float kept(std::uint32_t patch, const CodeBytes& code) const;
  // Places a patch beside its neighbours where more than `least` of its borders is kept. Returns whether it could.
  bool place_beside_neighbours(std::uint32_t patch, float least);
  // Places a patch far from all others. Returns whether there is such a code.
  bool place_apart(std::uint32_t patch);
  bool place_apart(std::uint32_t patch, std::size_t margin);
  void collect_candidates(std::uint32_t patch, float least);
  [[nodiscard]] glm::dvec3 expected_code(std::uint32_t patch) const;
  [[nodiscard]] bool is_allowed(std::uint32_t patch, const CodeBytes& code) const;

  const Patches& patches_;
  const Borders& borders_;
  ShadowRelation& relation_;
  const LostDifferences& lost_;
  CodeLattice& lattice_;
  std::vector<CodeBytes> steps_;  // from a neighbour's code to the codes that are tried
  bool all_steps_ = true;         // whether steps_ holds all differences that are always lost
  int reach_ = 0;                 // the largest step in one channel
  std::vector<float> total_;      // the length of each patch's borders
  std::vector<Candidate> candidates_;
  CodeLengths codes_;                                  // scratch
  static constexpr std::array kMargins{8, 4, 2, 1};    // of a patch apart, in units of the spacing
  std::array<std::size_t, kMargins.size()> cursor_{};  // the first slot of each margin that was not tried
  std::vector<std::uint32_t> order_;                   // of placement
};

}  // namespace ninebit
