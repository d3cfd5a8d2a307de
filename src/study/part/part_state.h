// A part as a run finds it on the disk: what it holds, and where to go on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "ninebit/numerics/result.h"
#include "ninebit/study/study_part.h"
#include "src/system/hashing/sha256.h"

namespace ninebit {

struct PartState {
  StudyPart part;                  // without a header where no line is whole
  std::uintmax_t whole_bytes = 0;  // where the last whole line ends
  std::unique_ptr<Sha256> hash;    // of the whole lines
};

// Reads a part, which may end in a line that is not whole. `study_of` as in read_part.
[[nodiscard]] Result<PartState> read_part_state(const std::filesystem::path& file, const StudyOfPart& study_of);

// Why a part does not belong to what another, or a run, says of itself; empty if it does. Shards are not compared.
[[nodiscard]] std::string why_foreign(const PartHeader& part, const PartHeader& expected);

// How many units a part holds when it is complete.
[[nodiscard]] std::size_t units_of(const PartHeader& header);

}  // namespace ninebit
