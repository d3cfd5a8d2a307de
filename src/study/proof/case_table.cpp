#include "src/study/proof/case_table.h"

#include <algorithm>
#include <limits>
#include <unordered_map>
#include <utility>

#include "src/study/proof/proof_side.h"

namespace ninebit::proof {
namespace {

// Inputs of a group whose rows are found by running them: two take no time; three are tried if that saves some.
constexpr std::array<int, 2> kMostInputs{2, 3};
constexpr std::uint64_t kFewCases = std::uint64_t{1} << 28U;
constexpr std::uint64_t kMostRows = std::uint64_t{1} << 20U;  // of a group
constexpr std::size_t kMostComponents = 6;                    // of such a group: what a key of 64 bits holds
constexpr int kKeyBits = 10;                                  // of a component

// The inputs that components before general combiner `cut` depend on, by component.
std::array<ComponentMask, kComponents> inputs_at(const ProofSide& side, int cut) {
  const ComponentFlow flow = flow_through(side.program, 0, cut);
  std::array<ComponentMask, kComponents> inputs{};
  for (const int to : side.components) {
    const auto i = static_cast<std::size_t>(to);
    for (const int from : side.components) {
      const Source& source = side.start[static_cast<std::size_t>(from)];
      if (has(flow[i], from) && source.input >= 0) inputs[i] |= mask_of(source.input);
    }
  }
  return inputs;
}

// Saturates at the largest number.
std::uint64_t product(std::uint64_t a, std::uint64_t b) {
  constexpr std::uint64_t kMost = std::numeric_limits<std::uint64_t>::max();
  return b != 0 && a > kMost / b ? kMost : a * b;
}

// A group whose rows are not known yet.
struct UnfilledGroup {
  ComponentMask inputs;
  std::vector<CutComponent> components;
};

// Adds a component; groups that share an input with it become one.
void add(std::vector<UnfilledGroup>& unfilled, const ComponentMask& inputs, const CutComponent& component) {
  UnfilledGroup joined{inputs, {component}};
  for (auto group = unfilled.begin(); group != unfilled.end();) {
    if ((group->inputs & inputs).none()) {
      ++group;
      continue;
    }
    joined.inputs |= group->inputs;
    joined.components.insert(joined.components.end(), group->components.begin(), group->components.end());
    group = unfilled.erase(group);
  }
  unfilled.push_back(std::move(joined));
}

// Runs a side's general combiners before the cut.
class BeforeCut {
 public:
  BeforeCut(const ProofSide& side, int cut)
      : side_(side),
        batch_(side, cut > 0 ? std::optional(first_combiners(side.program, cut)) : std::nullopt,
               {{false, false, false, false}, true}) {}

  // Fragment k has the bytes first + k of the inputs.
  void run(const std::vector<int>& inputs, std::uint32_t first, std::size_t count) {
    for (const int i : side_.components) {
      const Source& source = side_.start[static_cast<std::size_t>(i)];
      s9* const plane = batch_.plane(i);
      const auto at = std::find(inputs.begin(), inputs.end(), source.input);
      if (source.input < 0 || at == inputs.end()) {
        std::fill_n(plane, count, source.input < 0 ? source.code : s9{0});
        continue;
      }
      const auto shift = static_cast<unsigned>(8 * (at - inputs.begin()));
      for (std::size_t k = 0; k < count; ++k) {
        plane[k] = from_byte(side_.profile, static_cast<std::uint8_t>((first + k) >> shift));
      }
    }
    batch_.run(count, out_);
  }
  [[nodiscard]] const s9* plane(int index) { return batch_.plane(index); }

 private:
  const ProofSide& side_;
  SideBatch batch_;
  OutputBatch out_{};
};

enum class Fill : std::uint8_t { done, too_many_rows, cancelled };

// Finds the rows of a group, unless they are more than `most`.
Fill fill(CaseGroup& group, std::array<BeforeCut, 2>& before, std::uint64_t most, const std::function<bool()>& go_on) {
  const std::uint32_t count = std::uint32_t{1} << static_cast<unsigned>(8 * group.inputs.size());
  std::unordered_map<std::uint64_t, std::uint32_t> rows;  // by key: the first bytes that give it
  for (std::uint32_t first = 0; first < count; first += kBatchSize) {
    const std::size_t lanes = std::min<std::size_t>(kBatchSize, count - first);
    for (BeforeCut& part : before) part.run(group.inputs, first, lanes);
    for (std::size_t k = 0; k < lanes; ++k) {
      std::uint64_t key = 0;
      for (const CutComponent& c : group.components) {
        key = (key << kKeyBits) | static_cast<std::uint64_t>(before[c.side].plane(c.index)[k] + (1 << (kKeyBits - 1)));
      }
      rows.try_emplace(key, first + static_cast<std::uint32_t>(k));
    }
    if (rows.size() > most) return Fill::too_many_rows;
    if (first % (1U << 20U) == 0 && !go_on()) return Fill::cancelled;
  }
  std::vector<std::pair<std::uint32_t, std::uint64_t>> sorted;  // the same order on every machine
  for (const auto& [key, origin] : rows) sorted.emplace_back(origin, key);
  std::sort(sorted.begin(), sorted.end());
  group.columns.resize(group.components.size());
  for (const auto& [origin, key] : sorted) {
    group.origin.push_back(origin);
    for (std::size_t i = 0; i < group.components.size(); ++i) {
      const auto shift = static_cast<unsigned>(kKeyBits) * static_cast<unsigned>(group.components.size() - 1 - i);
      const auto digit = static_cast<int>((key >> shift) & ((1U << kKeyBits) - 1));
      group.columns[i].push_back(static_cast<s9>(digit - (1 << (kKeyBits - 1))));
    }
  }
  return Fill::done;
}

// The groups of a cut without their rows, or nothing if a group has too many inputs.
std::optional<std::vector<CaseGroup>> groups_at(const std::array<ProofSide, 2>& sides, const std::array<int, 2>& cut,
                                                const ProofTarget& target, int most_inputs) {
  std::vector<UnfilledGroup> unfilled;
  for (std::size_t side = 0; side < 2; ++side) {
    const auto inputs = inputs_at(sides[side], cut[side]);
    const ComponentMask read = reads_of(sides[side].program, cut[side], target);
    for (const int i : sides[side].components) {
      const ComponentMask& of = inputs[static_cast<std::size_t>(i)];
      if (has(read, i) && of.any()) add(unfilled, of, {side, i});
    }
  }
  std::vector<CaseGroup> groups;
  for (const UnfilledGroup& found : unfilled) {
    if (found.inputs.count() > static_cast<std::size_t>(most_inputs) || found.components.size() > kMostComponents) {
      return std::nullopt;
    }
    CaseGroup group;
    for (int i = 0; i < kComponents; ++i) {
      if (has(found.inputs, i)) group.inputs.push_back(i);
    }
    group.components = found.components;
    groups.push_back(std::move(group));
  }
  return groups;
}

// Tries cuts and keeps the table with the fewest cases.
class TableSearch {
 public:
  TableSearch(const std::array<ProofSide, 2>& sides, const ProofTarget& target, const std::function<bool()>& go_on)
      : sides_(sides), target_(target), go_on_(go_on) {}

  // Groups with more inputs than `most_inputs` rule a cut out. Returns false if it was cancelled.
  bool try_cut(const std::array<int, 2>& cut, int most_inputs) {
    auto groups = groups_at(sides_, cut, target_, most_inputs);
    if (!groups) return true;
    CaseTable table{cut, std::move(*groups), {}};
    std::array<BeforeCut, 2> before{BeforeCut(sides_[0], cut[0]), BeforeCut(sides_[1], cut[1])};
    std::uint64_t cases = 1;
    for (CaseGroup& group : table.groups) {
      const Fill filled = fill(group, before, most_rows(cases), go_on_);
      if (filled == Fill::cancelled) return false;
      if (filled == Fill::too_many_rows) return true;
      cases = product(cases, group.rows());
    }
    if (best_ && best_->cases() <= cases) return true;
    for (std::size_t side = 0; side < 2; ++side) {
      before[side].run({}, 0, 1);
      for (const int i : sides_[side].components)
        table.fixed[side][static_cast<std::size_t>(i)] = *before[side].plane(i);
    }
    best_ = std::move(table);
    return true;
  }

  [[nodiscard]] bool has_few_cases() const { return best_ && best_->cases() <= kFewCases; }
  [[nodiscard]] std::optional<CaseTable> best() { return std::move(best_); }

 private:
  // A group with more rows does not make fewer cases than there are.
  [[nodiscard]] std::uint64_t most_rows(std::uint64_t cases) const {
    return best_ ? std::min(kMostRows, best_->cases() / cases) : kMostRows;
  }

  const std::array<ProofSide, 2>& sides_;
  const ProofTarget& target_;
  const std::function<bool()>& go_on_;
  std::optional<CaseTable> best_;
};

}  // namespace

std::uint64_t CaseTable::cases() const {
  std::uint64_t all = 1;
  for (const CaseGroup& group : groups) all = product(all, group.rows());
  return all;
}

std::optional<CaseTable> make_case_table(const std::array<ProofSide, 2>& sides, const ProofTarget& target,
                                         const std::function<bool()>& go_on) {
  // Registers of real numbers are no codes between two stages.
  const bool integer = sides[0].is_integer() && sides[1].is_integer();
  const auto last = [&](std::size_t side) { return integer ? sides[side].program.num_general_combiners : 0; };
  TableSearch search(sides, target, go_on);
  if (!search.try_cut({0, 0}, 1)) return std::nullopt;
  for (const int most_inputs : kMostInputs) {
    for (int a = 0; a <= last(0); ++a) {
      for (int b = 0; b <= last(1) && !search.has_few_cases(); ++b) {
        // Three inputs take a second: only cuts after or before as many general combiners on both sides.
        if (most_inputs == kMostInputs.back() && a != b && last(0) - a != last(1) - b) continue;
        if (!search.try_cut({a, b}, most_inputs)) return std::nullopt;
      }
    }
  }
  return search.best();
}

}  // namespace ninebit::proof
