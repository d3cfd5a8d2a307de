// The parts of a pack: its size, programs as words, the colours that they show, and loops over them.
#pragma once

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "ninebit/combiner/evaluate.h"
#include "ninebit/numerics/hardware_profile.h"
#include "ninebit/study/vectors.h"
#include "src/system/parallel/parallel_loop.h"

namespace ninebit::vectors {

// The names of a chip's words in the order of a pack: those that are there once, then those of stage 0, of stage 1, …
[[nodiscard]] std::vector<std::string> word_names(ChipClass chip);

// A state's words in that order.
[[nodiscard]] Result<std::vector<std::uint32_t>> words_of(const VectorPack& pack, const CombinerState& state);

// The state of words, or what is wrong with them.
[[nodiscard]] Result<CombinerState> state_of(const VectorPack& pack, const std::vector<std::uint32_t>& words);

// The results of a program's fragments with the pack's profile.
[[nodiscard]] std::vector<Bytes4> expected_colors(const VectorPack& pack, const VectorProgram& program);

// Reports numbers of programs and fragments that packs with so many groups cannot have.
[[nodiscard]] Status check_settings(const VectorSettings& settings, std::size_t groups, const HardwareProfile& profile);

// Numbers of programs by group: one each, the rest by weight. `programs` is at least the number of groups.
[[nodiscard]] std::vector<std::size_t> programs_by_group(const std::vector<int>& weights, std::size_t programs);

// Calls body(i) for 0 <= i < count on several threads, and `go_on` between blocks of them on this one. Returns false
// if `go_on` did.
template <class Body>
[[nodiscard]] bool in_blocks(std::size_t count, const VectorProgress& go_on, const Body& body) {
  constexpr std::size_t kBlock = 256, kWorthATask = 8;
  for (std::size_t begin = 0; begin < count; begin += kBlock) {
    if (go_on && !go_on(static_cast<double>(begin) / static_cast<double>(count))) return false;
    parallel_for(std::min(kBlock, count - begin), kWorthATask, [&](std::size_t i) { body(begin + i); });
  }
  return true;
}

// Adds the groups and their programs to a pack, and makes each program by `make`(pack, group, index of the program, its
// number in its group, program).
template <class Pack, class Groups, class Make>
[[nodiscard]] Status make_programs(Pack& pack, const Groups& groups, const VectorSettings& settings,
                                   const VectorProgress& go_on, const Make& make) {
  std::vector<int> weights;
  for (const auto& group : groups) weights.push_back(group.weight);
  const std::vector<std::size_t> counts = programs_by_group(weights, static_cast<std::size_t>(settings.programs));
  std::vector<std::size_t> numbers;  // by program: of it in its group
  for (std::size_t g = 0; g < groups.size(); ++g) {
    pack.groups.push_back({groups[g].name, groups[g].rules, groups[g].what});
    for (std::size_t i = 0; i < counts[g]; ++i) {
      pack.programs.emplace_back().group = g;
      numbers.push_back(i);
    }
  }
  std::vector<Status> made(pack.programs.size());
  const bool all = in_blocks(pack.programs.size(), go_on, [&](std::size_t i) {
    auto& program = pack.programs[i];
    made[i] = make(pack, groups[program.group], i, numbers[i], program);
  });
  if (!all) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  const auto fault = std::find_if(made.begin(), made.end(), [](const Status& one) { return !one; });
  return fault == made.end() ? Status{} : *fault;
}

// The registers that fragments of a pack start with.

// Rows with codes from 0 come first. NV20 class chips have as many rows with signed texels after them.
inline constexpr std::size_t kByteInputs = 512;

// Every code of every component is in the rows, the ends of the range are in each 16 of them.
[[nodiscard]] std::vector<RegisterFile> vector_inputs(const HardwareProfile& profile, std::uint64_t seed);

}  // namespace ninebit::vectors
