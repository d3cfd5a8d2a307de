// Lays the patches of a scene into the lattice of codes.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "src/shadow/index_order/borders.h"
#include "src/shadow/index_order/code_lattice.h"
#include "src/shadow/index_order/patches.h"
#include "src/shadow/index_order/shadow_relation.h"

namespace ninebit {

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
