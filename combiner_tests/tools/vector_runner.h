// The runners of packs of vectors, compiled with right and wrong emulators.
#pragma once

#include <string>

namespace tools_test {

// A pack's runner with an emulator: its program, what it printed, its exit status, and its file of results.
struct Checked {
  std::string program, text, results;
  int status = -1;
};

// The runner of the pack in the folder with the emulator in this C file, compiled with these flags; once for each.
const Checked& check_emulator(const std::string& pack, const std::string& emulator, const std::string& flags);

}  // namespace tools_test
