#include "ninebit/study/study_part.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <fstream>
#include <iterator>
#include <map>
#include <system_error>
#include <utility>

#include "src/study/part/part_text.h"
#include "src/system/file_lock.h"

namespace ninebit {
namespace {

namespace fs = std::filesystem;

Diagnostic cannot_write(const fs::path& file, const std::string& why) {
  return {.message = "could not be written: " + why, .file = file.string(), .fault = Fault::cannot_write};
}

// The contents of a file without a complete line.
std::string beginning_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), {}};
}

// Appends lines to a part. append() flushes each line before it returns.
class PartWriter {
 public:
  PartWriter(fs::path file, PartState& state) : file_(std::move(file)), state_(state) {}

  // Drops an incomplete last line. Writes the header if the part has no line.
  Status open(const PartHeader& header) {
    std::error_code error;
    fs::resize_file(file_, state_.whole_bytes, error);
    if (error) return cannot_write(file_, error.message());
    errno = 0;
    stream_.open(file_, std::ios::binary | std::ios::app);
    if (!stream_) return failed();
    size_ = state_.whole_bytes;
    if (size_ != 0) return {};
    state_.part.file = file_;
    state_.part.header = header;
    state_.hash = std::make_unique<Sha256>();
    return append(header_line(header));
  }

  Status append(FinishedUnit unit) {
    if (Status written = append(unit_line(unit)); !written) return written;
    state_.part.units.push_back(std::move(unit));
    return {};
  }

  Status end() {
    if (Status written = write(end_line(state_.part.units.size(), state_.hash->finish())); !written) return written;
    state_.part.complete = true;
    stream_.close();
    return stream_ ? Status() : failed();
  }

 private:
  Status append(const std::string& line) {
    if (line.size() > kMaxPartLine) {
      return cannot_write(file_, fmt::format("a line of {} bytes; expected at most {}", line.size(), kMaxPartLine));
    }
    state_.hash->add(line);
    return write(line);
  }

  Status write(const std::string& line) {
    errno = 0;
    stream_.write(line.data(), static_cast<std::streamsize>(line.size()));
    stream_.flush();
    if (!stream_) return failed();
    size_ += line.size();
    // Writes to a file that was removed or replaced meanwhile succeed but are lost.
    std::error_code error;
    const std::uintmax_t found = fs::file_size(file_, error);
    if (error) return cannot_write(file_, "was removed while it was written: " + error.message());
    if (found == size_) return {};
    return cannot_write(file_,
                        fmt::format("was altered while it was written: it has {} bytes; expected {}", found, size_));
  }

  [[nodiscard]] Status failed() const {
    return cannot_write(file_, errno != 0 ? std::generic_category().message(errno) : "unknown reason");
  }

  fs::path file_;
  PartState& state_;
  std::ofstream stream_;
  std::uintmax_t size_ = 0;
};

// The part that a run finds in its folder and may resume. It is empty at first.
Result<PartState> find_part(const fs::path& file, const PartHeader& header, const Study& study) {
  const auto study_of = [&](const PartHeader& found) -> Result<const Study*> {
    // Compared as text: characters that a line cannot hold, such as a name that is not UTF-8, must not differ.
    if (header_line(found) == header_line(header)) return &study;
    return Diagnostic{.message = why_foreign(found, header) + ", or another folder"};
  };
  auto state = read_part_state(file, study_of);
  if (!state || state->whole_bytes != 0 || header_line(header).starts_with(beginning_of(file))) return state;
  return Diagnostic{.message = "is not a part of a study; expected a part, or no file", .file = file.string()};
}

}  // namespace

std::string why_foreign(const PartHeader& part, const PartHeader& expected) {
  if (part.question != expected.question) {
    const std::string asked = part.question.command(), wanted = expected.question.command();
    return fmt::format("answers another question, `{}`{}; expected `{}`", quotable(asked),
                       asked == wanted ? " about other files" : "", quotable(wanted));
  }
  if (part.build != expected.build) {
    return fmt::format("comes from another build of the program, {}; expected {}", quotable(part.build),
                       quotable(expected.build));
  }
  if (part.units != expected.units || part.shard.count != expected.shard.count) {
    return fmt::format("is one of {} shards of {} units; expected {} shards of {} units", part.shard.count, part.units,
                       expected.shard.count, expected.units);
  }
  return {};
}

std::string part_file_name(const Shard& shard) {
  return fmt::format("part-{}-of-{}.jsonl", shard.index, shard.count);
}

Result<StudyPart> run_part(const Study& study, std::string_view build, const Shard& shard, const fs::path& folder,
                           const PartLimits& limits, const StudyProgress& progress) {
  using Clock = std::chrono::steady_clock;
  const auto begin = Clock::now();
  const PartHeader header{study.question(), std::string(build), study.units(), shard};
  if (shard.index < 1 || shard.index > shard.count || shard.count > header.units) {
    return Diagnostic{.message = fmt::format("shard {}/{} of {} units; expected 1/1 to {}/{}", shard.index, shard.count,
                                             header.units, header.units, header.units)};
  }
  std::error_code error;
  fs::create_directories(folder, error);
  if (error) return cannot_write(folder, error.message());
  const fs::path file = folder / part_file_name(shard);
  const posix::FileLock lock(file);
  if (lock.outcome() == posix::FileLock::Outcome::taken) {
    return Diagnostic{.message = "another run is writing this part; wait for its end, or use another folder",
                      .file = file.string(),
                      .fault = Fault::cannot_write};
  }
  if (lock.outcome() == posix::FileLock::Outcome::failed) return cannot_write(file, lock.error().message());
  auto state = find_part(file, header, study);
  if (!state) return state.error();
  if (state->part.complete) return std::move(state->part);

  std::vector<bool> done(header.units);
  for (const FinishedUnit& unit : state->part.units) done[unit.unit] = true;
  PartWriter writer(file, *state);
  if (Status opened = writer.open(header); !opened) return opened.error();
  double all_weight = 0.0, done_weight = 0.0;
  for (std::size_t unit = shard.index - 1; unit < header.units; unit += shard.count) {
    all_weight += study.weight(unit);
    if (done[unit]) done_weight += study.weight(unit);
  }
  for (std::size_t unit = shard.index - 1; unit < header.units; unit += shard.count) {
    if (done[unit]) continue;
    const std::chrono::duration<double> spent = Clock::now() - begin;
    if (limits.seconds && spent.count() >= *limits.seconds) return std::move(state->part);
    if (progress && !progress(study.unit_name(unit), done_weight / all_weight)) {
      return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    }
    auto rows = study.run(unit, limits.go_on);
    if (!rows) return rows.error();
    if (Status written = writer.append({unit, *std::move(rows)}); !written) return written.error();
    done_weight += study.weight(unit);
  }
  if (Status ended = writer.end(); !ended) return ended.error();
  return std::move(state->part);
}

std::vector<StudyRow> rows_of(const StudyPart& part) {
  std::vector<const FinishedUnit*> units;
  for (const FinishedUnit& unit : part.units) units.push_back(&unit);
  std::sort(units.begin(), units.end(), [](const auto* a, const auto* b) { return a->unit < b->unit; });
  std::vector<StudyRow> rows;
  for (const FinishedUnit* unit : units) rows.insert(rows.end(), unit->rows.begin(), unit->rows.end());
  return rows;
}

Result<std::vector<StudyRow>> join_parts(std::span<const StudyPart> parts) {
  if (parts.empty()) return Diagnostic{.message = "no part is given; expected all parts of a study"};
  const PartHeader& first = parts.front().header;
  std::vector<const FinishedUnit*> units;
  std::map<std::size_t, const StudyPart*> by_shard;
  for (const StudyPart& part : parts) {
    const auto fault = [&](std::string why) {
      return Diagnostic{.message = std::move(why), .file = part.file.string()};
    };
    const Shard& shard = part.header.shard;
    if (const std::string why = why_foreign(part.header, first); !why.empty()) return fault(why);
    if (!part.complete) {
      return fault(fmt::format("is not complete: it holds {} of {} units; resume its run before merging",
                               part.units.size(), units_of(part.header)));
    }
    if (!by_shard.emplace(shard.index, &part).second) {
      return fault(fmt::format("repeats shard {}/{}; expected each part once", shard.index, shard.count));
    }
    for (const FinishedUnit& unit : part.units) units.push_back(&unit);
  }
  if (by_shard.size() < first.shard.count) {
    std::size_t missing = 1;
    while (by_shard.contains(missing)) ++missing;
    return Diagnostic{.message = fmt::format("the part of shard {}/{} is missing", missing, first.shard.count)};
  }
  // The complete parts of all shards hold each unit exactly once.
  std::sort(units.begin(), units.end(), [](const auto* a, const auto* b) { return a->unit < b->unit; });
  std::vector<StudyRow> rows;
  for (const FinishedUnit* unit : units) rows.insert(rows.end(), unit->rows.begin(), unit->rows.end());
  return rows;
}

}  // namespace ninebit
