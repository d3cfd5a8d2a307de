#include "ninebit/study/chip_kit.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "ninebit/numerics/profile_fields.h"

namespace ninebit {
namespace {

using Combination = std::vector<std::size_t>;

std::vector<CombinerField> fields_to_decide(const HardwareProfile& family) {
  std::vector<CombinerField> fields;
  for (const auto& table : {arithmetic_fields(family), register_fields(family)}) {
    for (const CombinerField& field : table) {
      if (field.is_open() || field.evidence == Evidence::seed) fields.push_back(field);
    }
  }
  return fields;
}

// All of them. The profile's own is the first; the first field changes fastest.
std::vector<Combination> combinations_of(const std::vector<CombinerField>& fields) {
  std::vector<Combination> all{Combination(fields.size(), 0)};
  for (std::size_t i = 0; i < fields.size(); ++i) {
    const std::size_t before = all.size();
    for (std::size_t value = 1; value < fields[i].values.size(); ++value) {
      for (std::size_t j = 0; j < before; ++j) {
        Combination next = all[j];
        next[i] = value;
        all.push_back(std::move(next));
      }
    }
  }
  return all;
}

std::ptrdiff_t rivals_in(const Combination& combination) {
  return std::count_if(combination.begin(), combination.end(), [](std::size_t value) { return value != 0; });
}

bool have_same_start(const HardwareProfile& a, const HardwareProfile& b) {
  const auto fields = profile_fields();
  return std::all_of(fields.begin(), fields.end(), [&](const ProfileField& field) {
    return field.group != FieldGroup::start_registers || field.get(a).value == field.get(b).value;
  });
}

// Adds programs to a kit until no two combinations that show the same can be told apart.
class Refinement {
 public:
  Refinement(ChipKit& kit, const std::function<bool(double)>& go_on) : kit_(kit), go_on_(go_on) {}

  Status refine() {
    for (std::size_t i = 1; i < kit_.combinations.size(); ++i) {
      while (true) {
        if (go_on_ && !go_on_(static_cast<double>(i) / static_cast<double>(kit_.combinations.size()))) {
          return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
        }
        // The first combination that shows the same stands for all that nothing tells apart from it.
        const auto same =
            std::find(kit_.shown.begin(), kit_.shown.begin() + static_cast<std::ptrdiff_t>(i), kit_.shown[i]);
        const auto first = static_cast<std::size_t>(same - kit_.shown.begin());
        if (first == i) break;
        const HardwareProfile a = kit_.profile_with(kit_.combinations[first]),
                              b = kit_.profile_with(kit_.combinations[i]);
        if (is_known_same(a, b)) break;
        const auto told = discriminate(a, b);
        if (!told) return told.error();
        if (!told->found) {
          if (told->answer != ProofAnswer::proved) kit_.is_complete = false;
          if (have_same_start(a, b)) same_.emplace_back(datapath_of(a), datapath_of(b));
          break;
        }
        add(*told->found);
      }
    }
    return {};
  }

  // Leaves programs out, the longest first, as long as the same combinations are told apart.
  void shorten() {
    std::stable_sort(kit_.programs.begin(), kit_.programs.end(), [](const Discriminator& a, const Discriminator& b) {
      return a.general_combiners < b.general_combiners;
    });
    show_all();
    const std::size_t classes = kit_.classes();
    for (std::size_t i = kit_.programs.size(); i-- > 0;) {
      const ChipKit whole = kit_;
      kit_.programs.erase(kit_.programs.begin() + static_cast<std::ptrdiff_t>(i));
      for (auto& shown : kit_.shown) shown.erase(shown.begin() + static_cast<std::ptrdiff_t>(i));
      if (kit_.classes() != classes) kit_ = whole;
    }
  }

 private:
  void add(const Discriminator& program) {
    kit_.programs.push_back(program);
    for (std::size_t i = 0; i < kit_.combinations.size(); ++i) {
      kit_.shown[i].push_back(program.shown(kit_.profile_with(kit_.combinations[i])));
    }
  }
  void show_all() {
    for (auto& shown : kit_.shown) shown.clear();
    const auto programs = std::move(kit_.programs);
    kit_.programs.clear();
    for (const Discriminator& program : programs) add(program);
  }

  // Pairs of arithmetics that agree are compared once: registers that hold the same at the start do not matter then.
  [[nodiscard]] bool is_known_same(const HardwareProfile& a, const HardwareProfile& b) const {
    const std::pair pair{datapath_of(a), datapath_of(b)};
    return have_same_start(a, b) && std::find(same_.begin(), same_.end(), pair) != same_.end();
  }

  ChipKit& kit_;
  const std::function<bool(double)>& go_on_;
  std::vector<std::pair<Datapath, Datapath>> same_;
};

// A set of programs, as small as leaving out one after another makes it, of which one at least speaks against each of
// the combinations.
std::vector<std::size_t> excluding(const ChipKit& kit, const std::vector<int>& shown,
                                   const std::vector<std::size_t>& combinations) {
  std::vector<std::size_t> programs(kit.programs.size());
  for (std::size_t i = 0; i < programs.size(); ++i) programs[i] = i;
  const auto excludes_all = [&](const std::vector<std::size_t>& by) {
    return std::all_of(combinations.begin(), combinations.end(), [&](std::size_t combination) {
      return std::any_of(by.begin(), by.end(),
                         [&](std::size_t program) { return kit.shown[combination][program] != shown[program]; });
    });
  };
  for (std::size_t i = programs.size(); i-- > 0;) {
    auto fewer = programs;
    fewer.erase(fewer.begin() + static_cast<std::ptrdiff_t>(i));
    if (excludes_all(fewer)) programs = std::move(fewer);
  }
  return programs;
}

}  // namespace

HardwareProfile ChipKit::profile_with(const std::vector<std::size_t>& combination) const {
  HardwareProfile profile = family;
  for (std::size_t i = 0; i < fields.size(); ++i) fields[i].values[combination[i]].set(profile);
  return profile;
}

std::size_t ChipKit::classes() const {
  return std::set<std::vector<int>>(shown.begin(), shown.end()).size();
}

Result<ChipKit> make_chip_kit(const HardwareProfile& family, const std::function<bool(double done)>& go_on) {
  if (family.arithmetic != Arithmetic::integer) {
    return Diagnostic{.message =
                          fmt::format("the arithmetic of profile {} is not integer: no card has it", family.name)};
  }
  ChipKit kit{family, fields_to_decide(family), {}, {}, {}, true};
  kit.combinations = combinations_of(kit.fields);
  kit.shown.resize(kit.combinations.size());
  Refinement refinement(kit, go_on);
  if (auto status = refinement.refine(); !status) return status.error();
  refinement.shorten();
  return kit;
}

KitVerdict decide(const ChipKit& kit, const std::vector<int>& shown) {
  KitVerdict verdict;
  std::vector<std::size_t> all(kit.combinations.size());
  for (std::size_t i = 0; i < all.size(); ++i) {
    all[i] = i;
    if (kit.shown[i] == shown) verdict.fitting.push_back(i);
  }
  if (verdict.fitting.empty()) {
    verdict.contradiction = excluding(kit, shown, all);
    return verdict;
  }
  std::stable_sort(verdict.fitting.begin(), verdict.fitting.end(), [&](std::size_t a, std::size_t b) {
    return rivals_in(kit.combinations[a]) < rivals_in(kit.combinations[b]);
  });
  for (std::size_t field = 0; field < kit.fields.size(); ++field) {
    FieldVerdict& of_field = verdict.fields.emplace_back();
    for (std::size_t value = 0; value < kit.fields[field].values.size(); ++value) {
      const auto has_value = [&](std::size_t combination) { return kit.combinations[combination][field] == value; };
      const bool fits = std::any_of(verdict.fitting.begin(), verdict.fitting.end(), has_value);
      of_field.fits.push_back(fits);
      auto& by = of_field.excluded_by.emplace_back();
      if (fits) continue;
      std::vector<std::size_t> with_value;
      std::copy_if(all.begin(), all.end(), std::back_inserter(with_value), has_value);
      by = excluding(kit, shown, with_value);
    }
  }
  return verdict;
}

}  // namespace ninebit
