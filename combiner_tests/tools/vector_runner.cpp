#include "combiner_tests/tools/vector_runner.h"

#include <gtest/gtest.h>

#include <map>
#include <tuple>

#include "combiner_tests/tools/support.h"

namespace tools_test {

const Checked& check_emulator(const std::string& pack, const std::string& emulator, const std::string& flags) {
  static const TempFolder made;
  static std::map<std::string, Checked> known;
  const auto [found, is_new] = known.try_emplace(pack + ' ' + flags);
  Checked& one = found->second;
  if (!is_new) return one;
  one.program = made / std::to_string(known.size());
  one.results = one.program + ".txt";
  const auto [messages, status] = shell("cc -std=c99 -O1 -ffp-contract=off -pedantic -Wall -Wextra -Werror " + flags +
                                        " '" + pack + "/runner.c' '" + emulator + "' -lm -o '" + one.program + "'");
  EXPECT_EQ(status, 0) << messages;
  std::tie(one.text, one.status) =
      shell("'" + one.program + "' '" + pack + "/vectors.txt' --results '" + one.results + "'");
  return one;
}

}  // namespace tools_test
