#include "src/study/proof/case_run.h"

#include <algorithm>
#include <atomic>
#include <limits>
#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "src/study/proof/proof_side.h"
#include "src/system/hashing/splitmix.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit::proof {
namespace {

constexpr std::uint64_t kNone = std::numeric_limits<std::uint64_t>::max();

// One side's general combiners after the cut, in batches.
class AfterCut {
 public:
  AfterCut(const ProofSide& side, int cut, const ProofTarget& target, const std::array<s9, kComponents>& fixed)
      : side_(side),
        target_(target),
        fixed_(fixed),
        keeps_registers_(side.is_integer() && !target.reg),
        batch_(side, later_combiners(side.program, cut), outputs_for(target)),
        out_(std::make_unique<OutputBatch>()) {
    reset();
  }

  // Must be called before a batch is filled.
  void begin() {
    if (!keeps_registers_) reset();
  }
  [[nodiscard]] s9* plane(int index) { return batch_.plane(index); }
  [[nodiscard]] const s9* run(std::size_t count) {
    batch_.run(count, *out_);
    const auto component = static_cast<std::size_t>(target_.component);
    return target_.reg ? plane(index_of(*target_.reg, target_.component)) : out_->plane[component].data();
  }
  [[nodiscard]] int shown(s9 code) const { return side_.shown(target_, code); }

 private:
  void reset() {
    for (const int i : side_.components) std::fill_n(plane(i), kBatchSize, fixed_[static_cast<std::size_t>(i)]);
  }

  const ProofSide& side_;
  ProofTarget target_;
  std::array<s9, kComponents> fixed_;  // what components hold that no case changes
  bool keeps_registers_;
  SideBatch batch_;
  std::unique_ptr<OutputBatch> out_;
};

// Both sides after the cut, for one thread.
class AfterCuts {
 public:
  AfterCuts(const std::array<ProofSide, 2>& sides, const ProofTarget& target, const std::array<int, 2>& cut,
            const std::array<std::array<s9, kComponents>, 2>& fixed)
      : sides_{AfterCut(sides[0], cut[0], target, fixed[0]), AfterCut(sides[1], cut[1], target, fixed[1])},
        same_codes_(target.reg || sides[0].profile.byte_shift.value == sides[1].profile.byte_shift.value) {}

  AfterCut& operator[](std::size_t side) { return sides_[side]; }
  void begin() {
    for (AfterCut& side : sides_) side.begin();
  }

  // The first lane that differs; `count` if none.
  [[nodiscard]] std::size_t first_difference(std::size_t count) {
    const s9 *const a = sides_[0].run(count), *const b = sides_[1].run(count);
    if (same_codes_ && std::equal(a, a + count, b)) return count;
    for (std::size_t k = 0; k < count; ++k) {
      if (sides_[0].shown(a[k]) != sides_[1].shown(b[k])) return k;
    }
    return count;
  }

 private:
  std::array<AfterCut, 2> sides_;
  bool same_codes_;
};

// Calls body(after, i) for 0 <= i < count until it finds a difference: a case's number. Returns the smallest i with
// one, and that number.
template <class MakeTails, class Body>
std::optional<std::pair<std::uint64_t, std::size_t>> search(std::uint64_t count, const MakeTails& make_after,
                                                            const Body& body, bool& cancelled,
                                                            const std::function<bool(double)>& go_on) {
  constexpr std::uint64_t kStep = 8192;
  for (std::uint64_t begin = 0; begin < count; begin += kStep) {
    if (go_on && !go_on(static_cast<double>(begin) / static_cast<double>(count))) {
      cancelled = true;
      return std::nullopt;
    }
    const std::uint64_t length = std::min(kStep, count - begin);
    std::atomic<std::uint64_t> best = kNone;
    std::mutex guard;
    std::size_t lane = 0;
    parallel_ranges(static_cast<std::size_t>(length), 256, [&](std::size_t from, std::size_t to) {
      auto after = make_after();
      for (std::size_t i = from; i < to && begin + i < best; ++i) {
        const std::optional<std::size_t> found = body(after, begin + i);
        if (!found) continue;
        const std::scoped_lock lock(guard);
        if (begin + i >= best) break;
        best = begin + i;
        lane = *found;
        break;
      }
    });
    if (best != kNone) return std::pair(best.load(), lane);
  }
  return std::nullopt;
}

// Groups whose combinations are written out, so that their rows fill batches, and the groups around them.
struct CaseLoops {
  explicit CaseLoops(const CaseTable& table) : groups(table.groups) {
    constexpr std::size_t kEnoughRows = 8192;
    std::stable_sort(groups.begin(), groups.end(),
                     [](const CaseGroup& a, const CaseGroup& b) { return a.rows() > b.rows(); });
    while (inner < groups.size() && rows < kEnoughRows) rows *= groups[inner++].rows();
    for (std::size_t i = inner; i < groups.size(); ++i) outer *= groups[i].rows();
    std::size_t period = 1;
    for (std::size_t i = 0; i < inner; ++i) {
      const CaseGroup& group = groups[i];
      for (std::size_t c = 0; c < group.components.size(); ++c) {
        std::vector<s9> column(rows);
        for (std::size_t r = 0; r < rows; ++r) column[r] = group.columns[c][r / period % group.rows()];
        columns.emplace_back(group.components[c], std::move(column));
      }
      period *= group.rows();
    }
  }
  [[nodiscard]] std::uint64_t batches() const { return (rows + kBatchSize - 1) / kBatchSize; }

  // Bytes of the inputs of a row and of an outer combination.
  [[nodiscard]] InputBytes bytes_of(std::uint64_t combination, std::size_t row) const {
    InputBytes bytes{};
    for (std::size_t i = 0; i < groups.size(); ++i) {
      const CaseGroup& group = groups[i];
      std::uint32_t origin = 0;
      if (i < inner) {
        origin = group.origin[row % group.rows()];
        row /= group.rows();
      } else {
        origin = group.origin[combination % group.rows()];
        combination /= group.rows();
      }
      for (const int input : group.inputs) {
        bytes[static_cast<std::size_t>(input)] = static_cast<std::uint8_t>(origin);
        origin >>= 8U;
      }
    }
    return bytes;
  }

  std::vector<CaseGroup> groups;  // the largest first
  std::size_t inner = 0;          // of them are written out
  std::size_t rows = 1;           // of these
  std::uint64_t outer = 1;        // combinations of the others
  std::vector<std::pair<CutComponent, std::vector<s9>>> columns;
};

// Fills one batch of a loops.
void fill(AfterCuts& after, const CaseLoops& loops, std::uint64_t combination, std::size_t first, std::size_t count) {
  after.begin();
  for (const auto& [component, column] : loops.columns) {
    std::copy_n(column.data() + first, count, after[component.side].plane(component.index));
  }
  for (std::size_t i = loops.inner; i < loops.groups.size(); ++i) {
    const CaseGroup& group = loops.groups[i];
    const auto row = static_cast<std::size_t>(combination % group.rows());
    combination /= group.rows();
    for (std::size_t c = 0; c < group.components.size(); ++c) {
      const CutComponent& to = group.components[c];
      std::fill_n(after[to.side].plane(to.index), count, group.columns[c][row]);
    }
  }
}

// Bytes of one input for a batch. Its number decides the kind: any bytes; bytes near the ends and the middle; bytes
// that differ little from those of the other inputs.
void random_plane(std::array<std::uint8_t, kBatchSize>& bytes, std::uint64_t batch, int input) {
  constexpr std::array<std::uint8_t, 16> kCorners{0, 1, 2, 3, 63, 64, 126, 127, 128, 129, 191, 192, 252, 253, 254, 255};
  const auto kind = static_cast<unsigned>(batch % 3);
  // Constants past the registers have numbers of their own.
  const auto group = static_cast<std::uint64_t>(input / kRegisterComponents) << 48U;
  for (std::size_t k = 0; k < kBatchSize; k += 8) {
    const std::uint64_t place = batch * (kBatchSize / 8) + k / 8;
    const std::uint64_t own =
        splitmix(group + place * kRegisterComponents + static_cast<std::uint64_t>(input % kRegisterComponents));
    const std::uint64_t common = kind == 2 ? splitmix(~place) : 0;
    for (std::size_t i = 0; i < 8; ++i) {
      const auto byte = static_cast<std::uint8_t>(own >> (8 * i)),
                 shared = static_cast<std::uint8_t>(common >> (8 * i));
      bytes[k + i] = kind == 0   ? byte
                     : kind == 1 ? kCorners[byte & 15U]
                                 : static_cast<std::uint8_t>((shared & 0xFCU) | (byte & 3U));
    }
  }
}

}  // namespace

CaseRun run_all(const std::array<ProofSide, 2>& sides, const ProofTarget& target, const CaseTable& table,
                const std::function<bool(double)>& go_on) {
  const CaseLoops loops(table);
  CaseRun run;
  const std::uint64_t batches = loops.batches();
  const auto found = search(
      loops.outer * batches, [&] { return AfterCuts(sides, target, table.cut, table.fixed); },
      [&](AfterCuts& after, std::uint64_t i) -> std::optional<std::size_t> {
        const auto first = static_cast<std::size_t>(i % batches) * kBatchSize;
        const std::size_t count = std::min(kBatchSize, loops.rows - first);
        fill(after, loops, i / batches, first, count);
        const std::size_t lane = after.first_difference(count);
        if (lane == count) return std::nullopt;
        return first + lane;
      },
      run.cancelled, go_on);
  if (found) run.difference = loops.bytes_of(found->first / batches, found->second);
  return run;
}

CaseRun run_random(const std::array<ProofSide, 2>& sides, const ProofTarget& target, std::uint64_t count,
                   const std::function<bool(double)>& go_on) {
  struct Place {
    std::size_t side;
    int component, input;
  };
  std::vector<Place> places;  // that the target depends on
  std::array<std::array<s9, kComponents>, 2> fixed{};
  for (std::size_t side = 0; side < 2; ++side) {
    const ComponentMask read = reads_of(sides[side].program, 0, target);
    for (const int i : sides[side].components) {
      const Source& source = sides[side].start[static_cast<std::size_t>(i)];
      fixed[side][static_cast<std::size_t>(i)] = source.input < 0 ? source.code : s9{0};
      if (source.input >= 0 && has(read, i)) places.push_back({side, i, source.input});
    }
  }
  const auto body = [&](AfterCuts& after, std::uint64_t batch) -> std::optional<std::size_t> {
    std::array<std::uint8_t, kBatchSize> bytes{};
    after.begin();
    for (const Place& place : places) {
      random_plane(bytes, batch, place.input);
      s9* const plane = after[place.side].plane(place.component);
      for (std::size_t k = 0; k < kBatchSize; ++k) plane[k] = from_byte(sides[place.side].profile, bytes[k]);
    }
    const std::size_t lane = after.first_difference(kBatchSize);
    return lane == kBatchSize ? std::nullopt : std::optional(lane);
  };
  CaseRun run;
  const auto found = search((count + kBatchSize - 1) / kBatchSize,
                            [&] {
                              return AfterCuts(sides, target, {0, 0}, fixed);
                            },
                            body, run.cancelled, go_on);
  if (!found) return run;
  InputBytes all{};
  std::array<std::uint8_t, kBatchSize> bytes{};
  for (const Place& place : places) {
    random_plane(bytes, found->first, place.input);
    all[static_cast<std::size_t>(place.input)] = bytes[found->second];
  }
  run.difference = all;
  return run;
}

}  // namespace ninebit::proof
