// A part as a run finds it on the disk: what it holds, and where to go on.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>

#include "ninebit/numerics/result.h"
#include "ninebit/study/study_part.h"
#include "src/study/sha256.h"

namespace ninebit {

struct PartState {
  StudyPart part;                  // without a header where no line is whole
  std::uintmax_t whole_bytes = 0;  // where the last whole line ends
  std::unique_ptr<Sha256> hash;    // of the whole lines
};

// Reads a part, which may end in a line that is not whole.
[[nodiscard]] Result<PartState> read_part_state(const std::filesystem::path& file);

// How many units a part holds when it is complete.
[[nodiscard]] std::size_t units_of(const PartHeader& header);

}  // namespace ninebit
