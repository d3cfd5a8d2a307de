// The state of a part on disk: its contents, and the place where a run resumes it.
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
  StudyPart part;                  // without a header if no line is complete
  std::uintmax_t whole_bytes = 0;  // offset of the end of the last complete line
  std::unique_ptr<Sha256> hash;    // of the complete lines
};

// Reads a part, which may end in an incomplete line. `study_of` as in read_part.
[[nodiscard]] Result<PartState> read_part_state(const std::filesystem::path& file, const StudyOfPart& study_of);

// The reason why a part does not belong to the study of `expected`; empty if it does. Shard indices are not compared.
[[nodiscard]] std::string why_foreign(const PartHeader& part, const PartHeader& expected);

// The number of units in a complete part.
[[nodiscard]] std::size_t units_of(const PartHeader& header);

}  // namespace ninebit
