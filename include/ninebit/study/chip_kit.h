// Programs that an old card runs to show which values the fields of its profile have.
//
// A kit decides the fields of a profile that nobody has measured, and those that only programs of the time speak for. A
// combination has a value for each of them. Programs are added until any two combinations either show different colours
// in one of them, or no program at all can tell them apart (see discriminate.h). What a card shows then leaves the
// combinations that cannot be told apart, or none.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/combiner_fields.h"
#include "ninebit/study/discriminate.h"

namespace NINEBIT_PUBLIC ninebit {

// The programs for one family of chips.
struct ChipKit {
  HardwareProfile family;                              // its own profile
  std::vector<CombinerField> fields;                   // that it decides, in the order of HardwareProfile
  std::vector<Discriminator> programs;                 // the shortest first
  std::vector<std::vector<std::size_t>> combinations;  // all: for each field the number of a value
  std::vector<std::vector<int>> shown;                 // by combination: the byte that each program shows

  bool is_complete = true;  // proved: combinations that show the same cannot be told apart

  // Returns the family's profile with a combination's values. Their evidence is the family's.
  [[nodiscard]] HardwareProfile profile_with(const std::vector<std::size_t>& combination) const;
  // Returns the number of sets of combinations that nothing tells apart.
  [[nodiscard]] std::size_t classes() const;
};

// Returns the kit of a family, always the same one. Fails for a profile whose arithmetic is not integer, and if
// `go_on`, called now and then, returns false.
[[nodiscard]] Result<ChipKit> make_chip_kit(const HardwareProfile& family,
                                            const std::function<bool(double done)>& go_on = {});

// The answer of a card's colours about one field.
struct FieldVerdict {
  std::vector<bool> fits;                             // by value
  std::vector<std::vector<std::size_t>> excluded_by;  // by value that does not fit: programs that together exclude it
};

// The answers of a card's colours.
struct KitVerdict {
  std::vector<std::size_t> fitting;        // combinations, those with the fewest rival values first
  std::vector<std::size_t> contradiction;  // if none fits: programs whose colours no combination shows together
  std::vector<FieldVerdict> fields;        // in the order of the kit's; empty if none fits
};

// Judges the bytes that a card showed, one for each program of the kit.
[[nodiscard]] KitVerdict decide(const ChipKit& kit, const std::vector<int>& shown);

}  // namespace ninebit
