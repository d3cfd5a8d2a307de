#include <fmt/format.h>

#include <memory>
#include <system_error>
#include <unordered_map>
#include <utility>
#include <vector>

#include "ninebit/study/study_part.h"
#include "src/study/part/part_text.h"
#include "src/system/hashing/openssl.h"
#include "src/system/lines.h"
#include "src/system/stream.h"

namespace ninebit {
namespace {

bool belongs_to(const Shard& shard, std::size_t unit) {
  return unit % shard.count == shard.index - 1;
}

std::string error_in_header(const PartHeader& header) {
  if (header.units == 0 || header.units > kMaxStudyUnits) {
    return fmt::format("{} units; expected 1 to {}", header.units, kMaxStudyUnits);
  }
  const Shard& s = header.shard;
  if (s.index < 1 || s.index > s.count || s.count > header.units) {
    return fmt::format("shard {}/{} of {} units; expected 1/1 to {}/{}", s.index, s.count, header.units, header.units,
                       header.units);
  }
  return {};
}

// A part while its lines are read. Memory use depends on the lines in the file, never on numbers in them.
class Reading {
 public:
  Reading(const std::filesystem::path& file, const StudyOfPart& study_of) : study_of_(study_of) {
    state_.part.file = file;
    state_.hash = std::make_unique<Sha256>();
  }

  // Adds a complete line. Returns an error message, or an empty text.
  std::string add(std::string_view line) {
    ++number_;
    if (state_.part.complete)
      return line == last_ ? keep(line) : "follows the part's last line; expected the end of the file";
    if (number_ > 1 && is_end_line(line)) return end(line);
    const std::string wrong = number_ == 1 ? add_header(line) : line == first_ ? std::string() : add_unit(line);
    if (!wrong.empty()) return wrong;
    state_.hash->add(line);
    state_.hash->add(std::string_view("\n"));
    return keep(line);
  }

  [[nodiscard]] int line() const { return number_; }
  [[nodiscard]] PartState take() { return std::move(state_); }

 private:
  std::string keep(std::string_view line) {
    state_.whole_bytes += line.size() + 1;
    return {};
  }

  std::string add_header(std::string_view text) {
    auto header = parse_header_line(text);
    if (!header) return header.error().message;
    if (std::string why = error_in_header(*header); !why.empty()) return why;
    if (study_of_) {
      auto study = study_of_(*header);
      if (!study) return study.error().message;
      study_ = *study;
      if (study_->units() != header->units) {
        return fmt::format("{} units; expected {}, the number of units of `{}`", header->units, study_->units(),
                           quotable(header->question.command()));
      }
    }
    state_.part.header = *std::move(header);
    first_ = text;
    return {};
  }

  std::string add_unit(std::string_view text) {
    auto unit = parse_unit_line(text);
    if (!unit) return unit.error().message;
    const PartHeader& header = state_.part.header;
    if (unit->unit >= header.units)
      return fmt::format("unit {} is out of range in a study of {} units", unit->unit, header.units);
    if (!belongs_to(header.shard, unit->unit)) {
      return fmt::format("unit {} does not belong to shard {}/{}", unit->unit, header.shard.index, header.shard.count);
    }
    // Two runs of one study in one folder write the same line twice.
    const auto [found, fresh] = seen_.try_emplace(unit->unit, sha256(text));
    if (!fresh) {
      if (found->second == sha256(text)) return {};
      return fmt::format("unit {} is repeated with other rows; expected each unit once", unit->unit);
    }
    if (study_ != nullptr) {
      const std::string why = wrong_with_rows(study_->row_rules(unit->unit), unit->rows);
      if (!why.empty()) return fmt::format("unit {}: {}", unit->unit, why);
    }
    unit->line = number_;
    state_.part.units.push_back(*std::move(unit));
    return {};
  }

  std::string end(std::string_view line) {
    StudyPart& part = state_.part;
    if (part.units.size() != units_of(part.header)) {
      return fmt::format("the last line comes after {} units; expected {}", part.units.size(), units_of(part.header));
    }
    if (Status fits = check_end_line(line, part.units.size(), state_.hash->finish()); !fits) {
      return fits.error().message;
    }
    part.complete = true;
    last_ = line;
    return keep(line);
  }

  const StudyOfPart& study_of_;
  const Study* study_ = nullptr;
  PartState state_;
  int number_ = 0;
  std::string first_, last_;                           // the first and the last line
  std::unordered_map<std::size_t, std::string> seen_;  // hash of each unit's line
};

}  // namespace

std::size_t units_of(const PartHeader& header) {
  return (header.units - header.shard.index) / header.shard.count + 1;
}

Result<PartState> read_part_state(const std::filesystem::path& file, const StudyOfPart& study_of) {
  Reading reading(file, study_of);
  const auto fault = [&](std::string message, int line) {
    return Diagnostic{.message = std::move(message), .file = file.string(), .line = line};
  };
  std::error_code error;
  const posix::Stream stream(file, posix::Access::read, error);
  if (error) {
    return fault(fmt::format("cannot be read: {}; expected a part written by `ninebit study`", error.message()), 0);
  }
  LinePieces lines(kMaxPartLine);
  std::vector<char> piece(std::size_t{1} << 16);
  while (true) {
    const std::size_t count = stream.read(piece, error);
    if (error) return fault("cannot be read to the end", reading.line() + 1);
    if (count == 0) return reading.take();  // without what follows the last \n
    lines.add({piece.data(), count});
    for (auto line = lines.next(); line && !lines.too_long(); line = lines.next()) {
      if (std::string wrong = reading.add(*line); !wrong.empty()) return fault(std::move(wrong), reading.line());
    }
    if (lines.too_long()) {
      return fault(fmt::format("the line is longer than {} bytes; expected a part of a study", kMaxPartLine),
                   reading.line() + 1);
    }
  }
}

Result<StudyPart> read_part(const std::filesystem::path& file, const StudyOfPart& study_of) {
  auto state = read_part_state(file, study_of);
  if (!state) return state.error();
  if (state->whole_bytes == 0) {
    return Diagnostic{.message = "has no complete line; expected a part written by `ninebit study`",
                      .file = file.string()};
  }
  return std::move(state->part);
}

}  // namespace ninebit
