#include "src/tools/common/build_facts.h"

#include "ninebit/combiner/batch_program.h"

namespace ninebit::tools {

std::vector<std::pair<std::string, std::string>> build_facts() {
#ifdef __clang__
  const std::string compiler = "Clang " __clang_version__;
#else
  const std::string compiler = "GCC " __VERSION__;
#endif
  return {{"compiler", compiler},
          {"build", NINEBIT_BUILD_TYPE},
          {"processor", NINEBIT_PROCESSOR},
          {"SIMD target", simd_target()}};
}

std::string version_text() {
  std::string text = "ninebit " NINEBIT_VERSION;
  for (const auto& [name, value] : build_facts()) text += '\n' + name + ": " + value;
  return text;
}

}  // namespace ninebit::tools
