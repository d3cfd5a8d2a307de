// Packs of test vectors: combiner programs as register words, register codes as inputs, and the colours that a profile
// computes. An emulator runs them, and its results name the rule that it breaks.
//
// The programs stand in groups. The first groups test one thing each, the later ones combinations of them, so that the
// first group that fails names the fault.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/combiner/initial_registers.h"
#include "ninebit/combiner/state.h"
#include "ninebit/language/register_words.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/numerics/result.h"
#include "ninebit/numerics/visibility.h"

namespace NINEBIT_PUBLIC ninebit {

// The registers that a vector's inputs and traces list, in this order, each as red, green, blue, alpha.
inline constexpr std::array kVectorRegisters{Register::fog,      Register::primary,  Register::secondary,
                                             Register::spare0,   Register::spare1,   Register::texture0,
                                             Register::texture1, Register::texture2, Register::texture3};

// Limits of a pack: programs, fragments of each, fragments of all together.
inline constexpr int kMostVectorPrograms = 100'000, kMostVectorFragments = 256, kMostVectorColors = 1 << 23;

// Programs of a small pack, for engines that take long for each. Every group and every pattern of the words occurs.
inline constexpr int kQuickVectorPrograms = 2000;

// The parameters of a pack.
struct VectorSettings {
  int programs = 10000;    // from least_vector_programs() to kMostVectorPrograms
  int fragments = 16;      // of each program: 1 to kMostVectorFragments
  std::uint64_t seed = 1;  // of the random inputs and programs
};

// Programs that test one thing.
struct VectorGroup {
  std::string name;   // "mux-threshold"
  std::string rules;  // of docs/numerics.md that the group depends on: "11, 22"; empty: none has a number
  std::string what;   // for people: "the mux by spare0's alpha of at least one half"
};

// A program and what it shows.
struct VectorProgram {
  std::size_t group = 0;             // index of its group
  CombinerState state;               // valid for the pack's profile
  std::vector<std::uint32_t> words;  // by VectorPack::word_names; words that the program does not need are 0
  std::size_t first_input = 0;       // its fragment i starts with VectorPack::inputs[first_input + i]
  std::vector<Bytes4> expected;      // by fragment
};

// Programs with inputs and expected colours.
struct VectorPack {
  HardwareProfile profile;              // whose results are expected
  ChipClass chip = ChipClass::nv20;     // whose words the programs are
  std::uint64_t seed = 0;               // VectorSettings::seed
  std::size_t fragments = 0;            // of each program
  std::vector<std::string> word_names;  // "RC_IN_RGB[0]"
  std::vector<RegisterFile> inputs;     // as a chip may hold them before the first general combiner
  std::vector<VectorGroup> groups;      // in the order of the pack
  std::vector<VectorProgram> programs;  // by group
  std::string id;                       // 16 hexadecimal digits of the hash of its text
};

// Called now and then with the share that is done; the work ends if it returns false.
using VectorProgress = std::function<bool(double done)>;

// Returns the number of a profile's groups: a pack has a program of each.
[[nodiscard]] int least_vector_programs(const HardwareProfile& profile);

// Makes a pack, the same one for the same profile and settings. Without an `id`: print_vector_pack() returns it. Fails
// with Fault::cancelled if `go_on` ends the work.
[[nodiscard]] Result<VectorPack> make_vector_pack(const HardwareProfile& profile, const VectorSettings& settings,
                                                  const VectorProgress& go_on = {});

// Returns the pack as text in the format of docs/emulators.md, with the registers after each stage. Sets pack.id.
[[nodiscard]] std::string print_vector_pack(VectorPack& pack);

// Reads a pack. `profile` must have the name that the text says. Reports the first line that is wrong, a text that was
// changed, and expected colours that are not the profile's.
[[nodiscard]] Result<VectorPack> read_vector_pack(std::string_view text, const std::string& file,
                                                  const HardwareProfile& profile);

// Returns the name of the profile that a pack's text says; empty: it is not the text of a pack.
[[nodiscard]] std::string vector_pack_profile(std::string_view text);

// An emulator's results for a pack.
struct VectorResults {
  std::string id;  // of the pack
  // The colours of one program.
  struct Colors {
    int line = 0;                // in its file
    std::vector<Bytes4> colors;  // by fragment
  };
  std::map<std::size_t, Colors> programs;  // by index of the program; not all need be there
};

// Whether a text begins as results do.
[[nodiscard]] bool are_vector_results(std::string_view text);

// Reads results of a pack. Reports the first line that is wrong and results of another pack.
[[nodiscard]] Result<VectorResults> read_vector_results(std::string_view text, const std::string& file,
                                                        const VectorPack& pack);

// A wrong model of the combiners that may explain why results differ.
struct VectorMistake {
  std::string name;          // "general_narrowing = toward-zero", "bias after the scale"
  std::string rules;         // of docs/numerics.md that it breaks; empty: none has a number
  std::string group;         // the first of a pack's groups that fails because of it; empty: not known
  std::size_t explains = 0;  // differing fragments that it gives as they are
  std::size_t agree = 0;     // fragments of all that it gives as they are
};

// The verdict on an emulator's results.
struct VectorVerdict {
  // One mistake of a plan.
  struct Step {
    VectorMistake mistake;          // `explains`: fragments that it adds; `agree`: with the mistakes before it
    std::size_t breaks = 0;         // fragments that agreed with the mistakes before it and no longer do
    std::vector<std::string> same;  // other mistakes that give the same for every fragment
    std::size_t program = 0;        // index of the smallest program that it explains
    std::size_t fragment = 0;       // index of the first fragment of that program that it explains
  };
  // A fragment.
  struct Place {
    std::size_t program = 0;   // index in the pack
    std::size_t fragment = 0;  // index in the program
  };
  // The fragments of a group.
  struct GroupCount {
    std::size_t fragments = 0;  // that were compared
    std::size_t differ = 0;     // from what is expected
  };
  std::size_t fragments = 0;            // that were compared
  std::size_t differ = 0;               // from what is expected
  std::vector<GroupCount> groups;       // by group
  std::vector<Place> first;             // that differ, in the pack's order: at most as many as were asked for
  std::vector<VectorMistake> mistakes;  // that explain more fragments than they break; the best first
  // Mistakes that are made together, in the order in which to mend them: each explains most of what those before it
  // leave, and breaks at most one fragment for each eight that it explains. If that leaves more than a tenth of the
  // fragments that differ, a mistake may break more at its place in the order, but not once all are made.
  std::vector<Step> plan;
  std::size_t unexplained = 0;  // fragments that differ from what the mistakes of the plan give
};

// Compares results with the pack and, if any differ, with every mistake. Fails with Fault::cancelled if `go_on` ends
// the work.
[[nodiscard]] Result<VectorVerdict> judge_vectors(const VectorPack& pack, const VectorResults& results,
                                                  std::size_t most, const VectorProgress& go_on = {});

// Returns the names of all mistakes that results of a profile's packs are compared with, in their order.
[[nodiscard]] std::vector<VectorMistake> vector_mistakes(const HardwareProfile& profile);

// Returns what an emulator with some of these mistakes shows: colours by program and fragment. `mistakes` has indices
// of vector_mistakes(pack.profile).
[[nodiscard]] std::vector<std::vector<Bytes4>> mistaken_colors(const VectorPack& pack,
                                                               const std::vector<std::size_t>& mistakes);

}  // namespace ninebit
