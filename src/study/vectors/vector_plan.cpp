// How a plan is made. A model starts without mistakes. Each round adds the mistake that makes most fragments agree
// with the results and breaks next to none of those that agree. Then mistakes that others have made needless are
// dropped. Rounds look at a sample of each group, with programs that differ and programs that agree; what is accepted
// is counted over all fragments.
//
// Where two mistakes touch the same programs, the first of them alone breaks much: a mux that takes AB for CD, and
// takes the threshold where the lowest bit should count, agrees by chance in half of the fragments with the lowest bit.
// A lesser mistake that breaks nothing then bars the way. So, if much is left unexplained, a second plan is made in
// which a mistake may break any number of fragments fewer than it explains. At its end each mistake must again break
// next to none of the fragments that agree with all the others. The plan that explains more is kept.
#include "src/study/vectors/vector_plan.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <numeric>
#include <optional>
#include <tuple>

namespace ninebit::vectors {
namespace {

constexpr std::size_t kMostSteps = 24;
constexpr std::size_t kSampleOfAGroup = 20;  // programs that differ, and as many that agree
// A mistake that is made may break fragments that agree only because two faults cancel there: one for each
// kGainOfABreak that it explains.
constexpr std::size_t kGainOfABreak = 8;
// A second plan is made if the first leaves more than 1 / kMuchLeft of the fragments that differ.
constexpr std::size_t kMuchLeft = 10;

using Given = std::vector<JudgedProgram<Bytes4>>;
using Agreement = std::vector<std::vector<bool>>;  // by program of the results, then fragment

class Planner {
 public:
  Planner(const VectorPack& pack, const Given& given, const std::vector<Mistake>& mistakes, const VectorProgress& go_on)
      : pack_(pack), given_(given), mistakes_(mistakes), go_on_(go_on) {
    for (const auto& one : given) programs_.push_back(one.program);
    all_.resize(given.size());
    std::iota(all_.begin(), all_.end(), std::size_t{0});
    promising_.resize(mistakes.size());
    std::iota(promising_.begin(), promising_.end(), std::size_t{0});
  }

  [[nodiscard]] bool plan(VectorVerdict& verdict) {
    std::vector<std::size_t> accepted = grown(kGainOfABreak);
    const std::size_t agree = agreeing(accepted, all_);
    if (kMuchLeft * (verdict.fragments - agree) > verdict.differ) {
      auto rivals = std::move(rivals_);
      std::vector<std::size_t> second = grown(1);
      drop_breaking(second);
      if (agreeing(second, all_) > agree) {
        accepted = std::move(second);
      } else {
        rivals_ = std::move(rivals);
      }
    }
    if (stopped_) return false;
    tell(accepted, verdict);
    return !stopped_;
  }

 private:
  struct Count {
    std::size_t gains = 0, breaks = 0;
    friend bool operator==(const Count&, const Count&) = default;
  };

  // Mistakes that are added as long as one explains fragments. `gain_of_a_break`: how many for each that it breaks.
  std::vector<std::size_t> grown(std::size_t gain_of_a_break) {
    std::vector<std::size_t> accepted;
    rivals_.assign(mistakes_.size(), {});
    for (std::size_t round = 0; round < kMostSteps; ++round) {
      const std::optional<std::size_t> next = best_after(accepted, gain_of_a_break);
      if (!next) break;
      accepted.push_back(*next);
      drop_needless(accepted);
    }
    return accepted;
  }

  [[nodiscard]] Model model_of(const std::vector<std::size_t>& accepted) const {
    return Model(pack_.profile, mistakes_, accepted);
  }

  // Which fragments of some programs a model gives as the results have them. `asked`: by program of the results.
  Agreement agreement(const Model& model, const std::vector<std::size_t>& programs,
                      std::vector<AskedRules>* asked = nullptr) {
    const ModelColors colors(pack_, model, programs_);
    Agreement agree(given_.size());
    find_agreement(colors, programs, agree, asked);
    return agree;
  }

  void find_agreement(const ModelColors& colors, const std::vector<std::size_t>& programs, Agreement& agree,
                      std::vector<AskedRules>* asked = nullptr) {
    const bool all = in_blocks(programs.size(), go_on_, [&](std::size_t i) {
      const std::size_t p = programs[i];
      const std::vector<Bytes4> shown = colors(given_[p].program, asked == nullptr ? nullptr : &(*asked)[p]);
      for (std::size_t f = 0; f < shown.size(); ++f) agree[p].push_back(shown[f] == (*given_[p].given)[f]);
    });
    if (!all) stopped_ = true;
  }

  // Programs of the sample that a mistake may change. `asked`: what the model without it asks for.
  [[nodiscard]] std::vector<std::size_t> changed_by(std::size_t m, const Model& without, const Model& model,
                                                    const std::vector<AskedRules>& asked) const {
    if (without.keeps_registers()) return sample_;  // a program also changes those after it
    std::vector<std::size_t> changed;
    std::copy_if(sample_.begin(), sample_.end(), std::back_inserter(changed), [&](std::size_t p) {
      const CombinerState& state = pack_.programs[given_[p].program].state;
      return mistakes_[m].edit != nullptr ? model.program_of(state) != without.program_of(state)
                                          : may_change(mistakes_[m], asked[p]);
    });
    return changed;
  }

  // What one mistake more gains and breaks in the sample. Zeros once a count in which every remaining fragment that
  // disagrees is gained is not `useful`.
  template <class Useful>
  Count count_with(const std::vector<std::size_t>& accepted, std::size_t m, const Agreement& before,
                   const std::vector<AskedRules>& asked, const Useful& useful) {
    std::vector<std::size_t> more = accepted;
    more.push_back(m);
    const Model model = model_of(more);
    const std::vector<std::size_t> changed = changed_by(m, model_of(accepted), model, asked);
    const ModelColors colors(pack_, model, programs_);
    std::size_t left = 0;
    for (const std::size_t p : changed) left += disagreeing(before[p]);
    Count count;
    Agreement after(given_.size());
    constexpr std::ptrdiff_t kBlock = 64;
    for (auto first = changed.begin(); first != changed.end();) {
      if (stopped_ || !useful({count.gains + left, count.breaks})) return {};
      const auto last = first + std::min(kBlock, changed.end() - first);
      const std::vector<std::size_t> block(first, last);
      find_agreement(colors, block, after);
      for (const std::size_t p : block) {
        add(before[p], after[p], count);
        left -= disagreeing(before[p]);
      }
      first = last;
    }
    return useful(count) ? count : Count{};
  }

  static void add(const std::vector<bool>& before, const std::vector<bool>& after, Count& count) {
    for (std::size_t f = 0; f < after.size(); ++f) {
      if (after[f] && !before[f]) ++count.gains;
      if (!after[f] && before[f]) ++count.breaks;
    }
  }

  Count compare(const Agreement& before, const Agreement& after) const {
    Count count;
    for (std::size_t p = 0; p < after.size(); ++p) add(before[p], after[p], count);
    return count;
  }

  static std::size_t disagreeing(const std::vector<bool>& agree) {
    return static_cast<std::size_t>(std::count(agree.begin(), agree.end(), false));
  }

  static bool differs(const std::vector<bool>& agree) { return disagreeing(agree) != 0; }

  // Programs that differ come first, as they alone can gain.
  void take_sample(const Agreement& agree) {
    std::vector<std::array<std::size_t, 2>> taken(pack_.groups.size());
    sample_.clear();
    for (const std::size_t p : all_) {
      std::size_t& count = taken[given_[p].group][differs(agree[p]) ? 1 : 0];
      if (count == kSampleOfAGroup) continue;
      ++count;
      sample_.push_back(p);
    }
    std::stable_partition(sample_.begin(), sample_.end(), [&](std::size_t p) { return differs(agree[p]); });
  }

  // The group of the first fragment that differs.
  std::string first_group(const Agreement& agree) const {
    for (std::size_t p = 0; p < agree.size(); ++p) {
      if (differs(agree[p])) return pack_.groups[given_[p].group].name;
    }
    return {};
  }

  std::optional<std::size_t> best_after(const std::vector<std::size_t>& accepted, std::size_t gain_of_a_break) {
    std::vector<AskedRules> asked(given_.size());
    const Agreement before = agreement(model_of(accepted), all_, &asked);
    take_sample(before);
    const std::string first = first_group(before);
    std::optional<std::size_t> best;
    Count best_count;
    const auto useful = [&](const Count& count) {
      if (count.gains <= count.breaks || count.breaks * gain_of_a_break > count.gains) return false;
      return !best || count.gains - count.breaks >= best_count.gains - best_count.breaks;
    };
    std::vector<Count> counts(mistakes_.size());
    for (const std::size_t m : promising_) {
      if (stopped_ || first.empty()) break;
      if (std::find(accepted.begin(), accepted.end(), m) != accepted.end()) continue;
      const Count& count = counts[m] = count_with(accepted, m, before, asked, useful);
      if (count.gains == 0) continue;
      const auto value = [&](std::size_t mistake, const Count& of) {  // of two that are equal, the first is better
        return std::tuple(of.gains - of.breaks, mistakes_[mistake].group == first, mistakes_.size() - mistake);
      };
      if (best && value(*best, best_count) >= value(m, count)) continue;
      best = m;
      best_count = count;
    }
    if (stopped_ || !best) return std::nullopt;
    rivals_[*best].clear();  // of an earlier round
    for (std::size_t m = 0; m < counts.size(); ++m) {
      if (m != *best && counts[m] == best_count) rivals_[*best].push_back(m);
    }
    std::stable_sort(promising_.begin(), promising_.end(),
                     [&](std::size_t x, std::size_t y) { return counts[x].gains > counts[y].gains; });
    return best;
  }

  std::size_t agreeing(const std::vector<std::size_t>& accepted, const std::vector<std::size_t>& programs) {
    std::size_t count = 0;
    for (const auto& one : agreement(model_of(accepted), programs)) {
      count += static_cast<std::size_t>(std::count(one.begin(), one.end(), true));
    }
    return count;
  }

  static std::vector<std::size_t> without(const std::vector<std::size_t>& accepted, std::size_t i) {
    std::vector<std::size_t> fewer = accepted;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    return fewer;
  }

  void drop_needless(std::vector<std::size_t>& accepted) {
    std::size_t best = agreeing(accepted, sample_);
    for (std::size_t i = 0; i + 1 < accepted.size();) {
      std::vector<std::size_t> fewer = without(accepted, i);
      const std::size_t count = agreeing(fewer, sample_);
      if (count < best || stopped_) {
        ++i;
        continue;
      }
      accepted = std::move(fewer);
      best = count;
    }
  }

  // Drops mistakes that explain nothing beside all the others, or break too many of the fragments that agree with
  // those.
  void drop_breaking(std::vector<std::size_t>& accepted) {
    for (std::size_t i = 0; i < accepted.size();) {
      std::vector<std::size_t> fewer = without(accepted, i);
      const Agreement before = agreement(model_of(fewer), all_), after = agreement(model_of(accepted), all_);
      if (stopped_) return;
      const Count count = compare(before, after);
      if (count.gains > 0 && count.breaks * kGainOfABreak <= count.gains) {
        ++i;
        continue;
      }
      accepted = std::move(fewer);
      i = 0;
    }
  }

  [[nodiscard]] std::size_t size_of(std::size_t p) const {
    const auto& words = pack_.programs[given_[p].program].words;
    return words.size() - static_cast<std::size_t>(std::count(words.begin(), words.end(), 0U));
  }

  // The plan in words: each mistake counted over all fragments.
  void tell(const std::vector<std::size_t>& accepted, VectorVerdict& verdict) {
    std::vector<std::size_t> so_far;
    Agreement before = agreement(model_of(so_far), all_);
    verdict.unexplained = verdict.differ;
    for (const std::size_t m : accepted) {
      so_far.push_back(m);
      const Agreement after = agreement(model_of(so_far), all_);
      if (stopped_) return;
      const Count count = compare(before, after);
      VectorVerdict::Step step{
          {mistakes_[m].name, mistakes_[m].rules, mistakes_[m].group, count.gains, 0}, count.breaks, {}, 0, 0};
      std::optional<std::size_t> smallest;
      for (std::size_t p = 0; p < after.size(); ++p) {
        for (std::size_t f = 0; f < after[p].size(); ++f) {
          step.mistake.agree += after[p][f] ? 1U : 0U;
          const bool is_smaller = after[p][f] && !before[p][f] && (!smallest || size_of(p) < size_of(*smallest));
          if (!is_smaller) continue;
          smallest = p;
          step.program = given_[p].program;
          step.fragment = f;
        }
      }
      if (!smallest) {  // what it explained, a later one explains, too
        so_far.pop_back();
        continue;
      }
      verdict.unexplained = verdict.fragments - step.mistake.agree;
      verdict.plan.push_back(std::move(step));
      before = after;
    }
    name_same(so_far, before, verdict);
  }

  // Mistakes that give the same in place of one of the plan.
  void name_same(const std::vector<std::size_t>& accepted, const Agreement& all, VectorVerdict& verdict) {
    for (std::size_t i = 0; i < accepted.size(); ++i) {
      for (const std::size_t m : rivals_[accepted[i]]) {
        if (std::find(accepted.begin(), accepted.end(), m) != accepted.end()) continue;
        std::vector<std::size_t> other = accepted;
        other[i] = m;
        const Agreement of_sample = agreement(model_of(other), sample_);
        if (stopped_) return;
        if (compare(all, of_sample) != Count{}) continue;
        const Agreement of_all = agreement(model_of(other), all_);
        if (stopped_) return;
        if (compare(all, of_all) == Count{}) verdict.plan[i].same.push_back(mistakes_[m].name);
      }
    }
  }

  const VectorPack& pack_;
  const Given& given_;
  const std::vector<Mistake>& mistakes_;
  const VectorProgress& go_on_;
  std::vector<std::size_t> programs_{};             // of the pack, by program of the results
  std::vector<std::size_t> sample_{}, all_{};       // programs of the results
  std::vector<std::size_t> promising_{};            // all mistakes, those that explained most in the last round first
  std::vector<std::vector<std::size_t>> rivals_{};  // by mistake: others that explained as much when it was accepted
  bool stopped_ = false;
};

}  // namespace

Status make_plan(const VectorPack& pack, const std::vector<JudgedProgram<Bytes4>>& given,
                 const std::vector<Mistake>& mistakes, const VectorProgress& go_on, VectorVerdict& verdict) {
  if (!Planner(pack, given, mistakes, go_on).plan(verdict)) {
    return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  }
  return {};
}

}  // namespace ninebit::vectors
