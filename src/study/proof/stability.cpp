#include "ninebit/study/stability.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "src/study/proof/proof_side.h"

namespace ninebit {
namespace {

// Each field has two values or more; a combination is one number of a value for each.
using Combination = std::vector<std::size_t>;

// The components of registers at the start that the program's colours depend on.
proof::ComponentMask reads_of_colors(const CombinerState& state, const HardwareProfile& profile) {
  const Program program = normalize(state, profile);
  proof::ComponentMask read;
  for (int c = 0; c < 4; ++c) read |= proof::reads_of(program, 0, {std::nullopt, c});
  return read;
}

bool reads(const proof::ComponentMask& read, Register r, int component) {
  return proof::has(read, proof::index_of(r, component));
}

// Units and fog that are off, if any.
struct Off {
  int texture = -1;  // a unit
  bool fog = false;
};

// The program with all texture units and fog on, or with one off.
class Setting {
 public:
  Setting(const CombinerState& state, const HardwareProfile& profile, const Off& off, std::vector<CombinerField> fields,
          EquivalenceOptions& options)
      : state_(state), profile_(profile), off_(off), fields_(std::move(fields)), options_(options) {}

  // Finds the combinations that give the same colours. Returns what made it impossible.
  Status classify() {
    Combination combination(fields_.size(), 0);
    do {
      combinations_.push_back(combination);
    } while (advance(combination));
    for (std::size_t i = 0; i < combinations_.size(); ++i) {
      auto found = class_of(combinations_[i]);
      if (!found) return found.error();
      if (*found == representatives_.size()) representatives_.push_back(i);
      class_.push_back(*found);
    }
    return {};
  }

  // The effect of field number `at`.
  Result<FieldEffect> effect_of(std::size_t at) {
    FieldEffect effect{fields_[at], ProofAnswer::proved, 0, {}, off_.texture, off_.fog, std::nullopt};
    std::vector<std::pair<std::size_t, std::size_t>> pairs;  // combinations that differ in this field alone
    for (std::size_t i = 0; i < combinations_.size(); ++i) {
      if (combinations_[i][at] != 0) continue;
      for (std::size_t value = 1; value < fields_[at].values.size(); ++value) {
        Combination other = combinations_[i];
        other[at] = value;
        const auto j = static_cast<std::size_t>(
            std::lower_bound(combinations_.begin(), combinations_.end(), other, is_before) - combinations_.begin());
        if (class_[i] != class_[j]) pairs.emplace_back(i, j);
      }
    }
    // The example that needs the fewest other fields.
    std::stable_sort(pairs.begin(), pairs.end(), [&](const auto& a, const auto& b) {
      return rivals_in(combinations_[a.first]) < rivals_in(combinations_[b.first]);
    });
    for (const auto& [i, j] : pairs) {
      auto answer = compare(combinations_[i], combinations_[j]);
      if (!answer) return answer.error();
      if (answer->answer == ProofAnswer::proved) continue;  // both were compared with a third in vain
      effect.answer = answer->answer;
      if (answer->answer == ProofAnswer::unknown) continue;
      effect.rival = combinations_[j][at];
      effect.others = others_of(combinations_[i]);
      effect.example = std::move(answer->counterexample);
      break;
    }
    return effect;
  }

  [[nodiscard]] const std::vector<CombinerField>& fields() const { return fields_; }
  void add_to(StabilityAnswer& all) const {
    all.cases += cases_;
    all.combinations += combinations_.size();
    if (by_formulas_) all.method = ProofMethod::smt;
    if (all.reason.empty()) all.reason = reason_;
  }

 private:
  // The first field changes fastest.
  bool advance(Combination& combination) const {
    for (std::size_t i = 0; i < combination.size(); ++i) {
      if (++combination[i] < fields_[i].values.size()) return true;
      combination[i] = 0;
    }
    return false;
  }
  static bool is_before(const Combination& a, const Combination& b) {
    return std::lexicographical_compare(a.rbegin(), a.rend(), b.rbegin(), b.rend());
  }
  static std::ptrdiff_t rivals_in(const Combination& combination) {
    return std::count_if(combination.begin(), combination.end(), [](std::size_t value) { return value != 0; });
  }
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> others_of(const Combination& combination) const {
    std::vector<std::pair<std::string, std::string>> others;
    for (std::size_t i = 0; i < combination.size(); ++i) {
      if (combination[i] != 0) others.emplace_back(fields_[i].name, fields_[i].values[combination[i]].word);
    }
    return others;
  }

  Result<EquivalenceAnswer> compare(const Combination& a, const Combination& b) {
    const auto subject = [&](const Combination& combination) {
      ProofSubject made{state_, profile_, {}, off_.fog};
      for (std::size_t i = 0; i < combination.size(); ++i) fields_[i].values[combination[i]].set(made.profile);
      if (off_.texture >= 0) made.texture_off[static_cast<std::size_t>(off_.texture)] = true;
      return made;
    };
    const auto begin = std::chrono::steady_clock::now();
    auto answer = prove_equivalent(subject(a), subject(b), options_);
    if (!answer) return answer;
    const std::chrono::duration<double> passed = std::chrono::steady_clock::now() - begin;
    if (answer->method == ProofMethod::smt && answer->cases > 0) {
      options_.timeout_s = std::max(options_.timeout_s - passed.count(), 0.0);
    }
    cases_ += answer->cases;
    by_formulas_ = by_formulas_ || (answer->cases > 0 && answer->method == ProofMethod::smt);
    if (answer->answer == ProofAnswer::unknown) reason_ = answer->reason;
    return answer;
  }

  // The class of a combination; the number of classes if it is a new one.
  Result<std::size_t> class_of(const Combination& combination) {
    for (std::size_t i = 0; i < representatives_.size(); ++i) {
      const auto answer = compare(combinations_[representatives_[i]], combination);
      if (!answer) return answer.error();
      if (answer->answer == ProofAnswer::proved) return i;
    }
    return representatives_.size();
  }

  const CombinerState& state_;
  const HardwareProfile& profile_;
  Off off_;
  std::vector<CombinerField> fields_;
  EquivalenceOptions& options_;  // the solver's time is what is left
  std::vector<Combination> combinations_;
  std::vector<std::size_t> class_;            // by combination
  std::vector<std::size_t> representatives_;  // a combination of each class
  std::uint64_t cases_ = 0;
  bool by_formulas_ = false;
  std::string reason_;
};

// The open fields that can have a say with this off.
std::vector<CombinerField> fields_for(const HardwareProfile& profile, const proof::ComponentMask& read,
                                      const Off& off) {
  std::vector<CombinerField> fields;
  for (CombinerField& field : arithmetic_fields(profile)) {
    if (field.is_open()) fields.push_back(std::move(field));
  }
  for (CombinerField& field : register_fields(profile)) {
    const bool matters = field.name == "secondary_alpha" ? reads(read, Register::secondary, kAlpha)
                         : field.name == "disabled_texture_alpha"
                             ? off.texture >= 0 && reads(read, texture_register(off.texture), kAlpha)
                         : field.name == "fog_alpha_without_fog"
                             ? off.fog && reads(read, Register::fog, kAlpha)
                             : off.texture == 0 && reads(read, Register::spare0, kAlpha);
    if (field.is_open() && matters) fields.push_back(std::move(field));
  }
  return fields;
}

// Adds what a setting found. A field that matters in one setting matters.
void add(std::vector<FieldEffect>& all, FieldEffect effect) {
  for (FieldEffect& known : all) {
    if (known.field.name != effect.field.name) continue;
    const bool stronger = effect.answer == ProofAnswer::refuted ||
                          (effect.answer == ProofAnswer::unknown && known.answer == ProofAnswer::proved);
    if (known.answer != ProofAnswer::refuted && stronger) known = std::move(effect);
    return;
  }
  all.push_back(std::move(effect));
}

}  // namespace

Result<StabilityAnswer> prove_stable(const CombinerState& state, const HardwareProfile& profile,
                                     const EquivalenceOptions& options) {
  if (const auto program = compile(state, profile); !program) return program.error();
  if (profile.arithmetic != Arithmetic::integer) {
    return Diagnostic{.message = fmt::format("the arithmetic of profile {} is not integer: none of its fields is open",
                                             profile.name)};
  }
  const proof::ComponentMask read = reads_of_colors(state, profile);
  std::vector<Off> settings{{}};
  for (int unit = 0; unit < profile.texture_units; ++unit) {
    const Register r = texture_register(unit);
    bool is_read = unit == 0 && reads(read, Register::spare0, kAlpha);
    for (int c = 0; c < 4; ++c) is_read = is_read || reads(read, r, c);
    if (is_read) settings.push_back({.texture = unit, .fog = false});
  }
  // The other fields have their say with fog on, where its alpha is any byte.
  const bool fog_is_open = profile.fog_alpha_without_fog.evidence == Evidence::assumed ||
                           profile.fog_alpha_without_fog.evidence == Evidence::inferred;
  if (fog_is_open && reads(read, Register::fog, kAlpha)) settings.push_back({.texture = -1, .fog = true});
  EquivalenceOptions colors = options;
  colors.targets.clear();
  StabilityAnswer all;
  for (const auto& table : {arithmetic_fields(profile), register_fields(profile)}) {
    for (const CombinerField& field : table) {
      if (field.is_open()) all.fields.push_back({field, ProofAnswer::proved, 0, {}, -1, false, std::nullopt});
    }
  }
  for (const Off& off : settings) {
    Setting setting(state, profile, off, fields_for(profile, read, off), colors);
    if (auto status = setting.classify(); !status) return status.error();
    for (std::size_t field = 0; field < setting.fields().size(); ++field) {
      auto effect = setting.effect_of(field);
      if (!effect) return effect.error();
      add(all.fields, std::move(*effect));
    }
    setting.add_to(all);
  }
  for (const FieldEffect& effect : all.fields) {
    if (effect.answer == ProofAnswer::refuted) all.answer = ProofAnswer::refuted;
    if (effect.answer == ProofAnswer::unknown && all.answer == ProofAnswer::proved) all.answer = ProofAnswer::unknown;
  }
  if (all.cases == 0) all.method = ProofMethod::smt;
  if (all.answer != ProofAnswer::unknown) all.reason.clear();
  return all;
}

}  // namespace ninebit
