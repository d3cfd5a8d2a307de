// `ninebit study depth-packing`: the errors of depths after a round trip through bytes.
#include <fmt/format.h>

#include <memory>

#include "ninebit/study/depth_packing_error.h"
#include "src/tools/study/study.h"

namespace ninebit::tools {
namespace {

struct DepthPackingFlags {
  StudyFlags study;
  std::string packings, storages, depths;
  std::uint32_t float_step = DepthPackingOptions().float_step;
};

std::vector<std::string> all_sets() {
  std::vector<std::string> names;
  names.reserve(kDepthSets.size());
  for (const DepthSet set : kDepthSets) names.emplace_back(name_of(set));
  return names;
}

std::vector<std::string> all_storages() {
  std::vector<std::string> names;
  names.reserve(storage_rules().size());
  for (const StorageRule& rule : storage_rules()) names.emplace_back(rule.name);
  return names;
}

// A line for each packing and storage.
std::string tables_in_words() {
  std::string text = "Packings:\n";
  for (const DepthPacking& packing : depth_packings()) {
    text += fmt::format("  {:<22}{}\n", packing.name, packing.source);
  }
  text += "Storages of component v, which is in [0, 1]:\n";
  for (const StorageRule& rule : storage_rules()) text += fmt::format("  {:<11}{}\n", rule.name, rule.formula);
  return text;
}

Result<std::unique_ptr<Study>> make_study(const DepthPackingFlags& flags) {
  DepthPackingOptions options = all_depth_packings();
  if (!flags.packings.empty()) options.packings = items_of(flags.packings);
  if (!flags.storages.empty()) {
    options.storages.clear();
    for (const std::string& name : items_of(flags.storages)) {
      for (const StorageRule& rule : storage_rules()) {
        if (name == rule.name) options.storages.push_back(rule.storage);
      }
    }
  }
  if (!flags.depths.empty()) {
    options.sets.clear();
    for (const std::string& name : items_of(flags.depths)) {
      for (const DepthSet set : kDepthSets) {
        if (name == name_of(set)) options.sets.push_back(set);
      }
    }
  }
  options.float_step = flags.float_step;
  return make_depth_packing_study(options);
}

}  // namespace

void add_study_depth_packing(CLI::App& verbs, StudyRequest& request) {
  CLI::App* verb = verbs.add_subcommand(
      "depth-packing", "Measure round-trip errors of depths packed into bytes, as in three.js and other engines");
  verb->footer(tables_in_words() +
               "Examples:\n"
               "  ninebit study depth-packing\n"
               "  ninebit study depth-packing --packings rgba8-fract,rgba8-mod --storages round --depths 16 --json\n"
               "  ninebit study depth-packing --depths floats --float-step 1");
  auto flags = std::make_shared<DepthPackingFlags>();
  add_study_flags(*verb, flags->study, StudyProfiles::none);
  verb->add_option("--packings", flags->packings, "Packings to measure (default: all)")
      ->type_name("LIST")
      ->check(list_of(all_depth_packings().packings));
  verb->add_option("--storages", flags->storages, "Conversions of components to bytes (default: round,truncate)")
      ->type_name("LIST")
      ->check(list_of(all_storages()));
  verb->add_option("--depths", flags->depths, "Sets of depths: 16 bits, 24 bits or floats (default: all): 16,24,floats")
      ->type_name("LIST")
      ->check(list_of(all_sets()));
  verb->add_option("--float-step", flags->float_step, "Measure every Nth float, N from 1 to 16777216; 1 takes minutes")
      ->type_name("N")
      ->capture_default_str()
      ->check(whole_in_range(1U, 1U << 24));
  verb->callback([flags, &request] {
    request.flags = &flags->study;
    request.make = [flags] { return make_study(*flags); };
  });
}

}  // namespace ninebit::tools
