// `ninebit verify --decide`: which values the open fields of a card's profile have, by what it showed.
#pragma once

#include <string>

namespace ninebit::tools {

struct DecideFlags {
  bool json = false, quiet = false;
  std::string results;  // the table that the kit's program wrote
  std::string family = "geforce2";
  std::string output;  // the profile; empty: none is written
};

// Prints the verdict and writes the profile. Returns the exit code.
[[nodiscard]] int decide_fields(const DecideFlags& flags);

}  // namespace ninebit::tools
