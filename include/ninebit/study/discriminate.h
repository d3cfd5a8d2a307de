// Which program tells two profiles apart?
//
// For profiles whose arithmetic is integer the steps of the arithmetic are compared first, over all codes that a
// register can hold: input mappings, outputs of general combiners, mux, final combiner, initial registers. If all
// agree, no program of any length can differ. Otherwise programs are searched, the shortest first: no general combiner,
// one, two, each with one product.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "ninebit/combiner/state.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"
#include "ninebit/study/equivalence.h"

namespace NINEBIT_PUBLIC ninebit {

// A program and an input for which two profiles give different colours. Textures and primary colour have four equal
// components; the secondary colour's alpha is 0, as OpenGL gives it. The program shows a grey.
struct Discriminator {
  std::string rc10;                     // the program's text
  CombinerState state;                  // the same
  int general_combiners = 0;            // that it needs: 0, 1 or 2. A state has at least one, which then does nothing.
  std::array<std::uint8_t, 3> bytes{};  // of texture 0, texture 1, primary colour
  std::array<bool, 4> texture_off{};    // by unit
  bool fog_off = false;                 // the fog register's alpha is what the profile says

  // Returns the byte that a profile gives in red, green and blue, by the reference.
  [[nodiscard]] int shown(const HardwareProfile& profile) const;
};

// Whether a program tells two profiles apart.
struct Discrimination {
  ProofAnswer answer = ProofAnswer::unknown;  // proved: no program tells them apart; refuted: `found` does
  bool shortest = false;                      // of `found`: proved that fewer general combiners do not suffice
  std::uint64_t cases = 0;                    // that were run, of steps and of programs
  std::optional<Discriminator> found;         // if it is refuted
  int a = 0, b = 0;                           // the bytes that the profiles show with it
  std::string reason;                         // if it is unknown: what was searched, one sentence
};

// Returns the shortest program of the search, and among these one with few mappings, scales and factors. Profiles may
// have any arithmetic; without integers nothing is proved about programs that were not searched. Fails if `go_on`,
// called now and then, returns false.
[[nodiscard]] Result<Discrimination> discriminate(const HardwareProfile& a, const HardwareProfile& b,
                                                  const std::function<bool(double done)>& go_on = {});

}  // namespace ninebit
