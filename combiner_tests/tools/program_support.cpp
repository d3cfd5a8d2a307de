#include "combiner_tests/tools/program_support.h"

#include <stdexcept>

#include "ninebit/language/gl_calls.h"
#include "ninebit/language/json.h"
#include "ninebit/numerics/hardware_profile.h"

namespace tools_test {

using namespace ninebit;  // NOLINT(google-build-using-namespace): states are spelled in its words

std::string article_calls() {
  return read_bytes(kArticle);
}

CombinerState article_state() {
  const std::string text = article_calls();
  const auto parsed = parse_gl_calls({text, kArticle}, profiles::geforce2);
  if (!parsed) throw std::runtime_error(parsed.faults().front().text());
  return *parsed;
}

std::string write_program(const TempFolder& folder, const std::string& name, const CombinerState& state) {
  return write_bytes(folder / name, print_json_program(state));
}

}  // namespace tools_test
