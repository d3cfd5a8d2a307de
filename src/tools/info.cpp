// `ninebit info`: the build, and the SIMD target that it uses here.
#include <fmt/ranges.h>

#include <memory>

#include "ninebit/combiner/batch_program.h"
#include "ninebit/shadow/technique.h"
#include "src/system/parallel/parallel_loop.h"
#include "src/tools/common/build_facts.h"
#include "src/tools/input/program.h"

namespace ninebit::tools {
namespace {

int print_info(const CommonFlags& flags) {
  const HardwareProfile& profile = profile_of(flags);
  const int threads = flags.threads > 0 ? flags.threads : static_cast<int>(max_threads());
  std::vector<std::string> names;
  for (const Technique& technique : techniques()) names.emplace_back(technique.name);
  const Json out{{"command", "info"},
                 {"version", NINEBIT_VERSION},
                 {"profile", flags.profile},
                 {"rows", Json::array({{{"compiler", __VERSION__},
                                        {"build", NINEBIT_BUILD_TYPE},
                                        {"processor", NINEBIT_PROCESSOR},
                                        {"simd_target", simd_target()},
                                        {"batch", kBatchSize},
                                        {"threads", threads},
                                        {"chip", profile.chip},
                                        {"general_combiners", profile.general_combiners.value},
                                        {"texture_units", profile.texture_units.value},
                                        {"techniques", names}}})}};
  if (flags.json) return answer(out);
  return answer(
      fmt::format("{}\nthreads: {}\nprofile: {} ({}), {} general combiners, {} texture units\ntechniques: {}\n",
                  version_text(), threads, profile.name, profile.chip, profile.general_combiners.value,
                  profile.texture_units.value, fmt::join(names, ", ")));
}

}  // namespace

void add_info(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("info", "Show the build and the SIMD target that it uses here");
  verb->footer("Example: ninebit info --json");
  auto flags = std::make_shared<CommonFlags>();
  add_common_flags(*verb, *flags);
  verb->callback([flags, &exit_code] { exit_code = print_info(*flags); });
}

}  // namespace ninebit::tools
