// The programs that a search for differences goes through, the simplest first.
#pragma once

#include <string>
#include <vector>

namespace ninebit::proof {

// A program, or a general combiner that writes spare0, with a number that grows with its mappings, scales and factors.
struct ProgramForm {
  std::string text;  // RC1.0: a whole program, or "{ rgb { … } }"
  int cost = 0;
  int texture_off = -1;      // the unit that is off; -1: none
  bool is_constant = false;  // it reads no byte
  bool fog_off = false;
};

// Programs without general combiners.
[[nodiscard]] std::vector<ProgramForm> programs_without_stages();

// With one: a product of two textures, each with any input mapping, with any scale and bias; or one texture alone.
[[nodiscard]] std::vector<ProgramForm> programs_of_one_stage();

// With two: the first as above, the second one with spare0 in place of the texture; and a product with the primary
// colour in the second one, if the first has a texture alone.
[[nodiscard]] std::vector<ProgramForm> programs_of_two_stages();

}  // namespace ninebit::proof
