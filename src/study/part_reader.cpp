#include <fmt/format.h>

#include <array>
#include <fstream>
#include <memory>
#include <system_error>
#include <utility>

#include "ninebit/study/study_part.h"
#include "src/study/part_state.h"
#include "src/study/part_text.h"
#include "src/study/sha256.h"

namespace ninebit {
namespace {

// Whole lines of a file, with their newline; what stands after the last newline is left out.
class Lines {
 public:
  enum class Next { line, none, too_long, unreadable };

  explicit Lines(const std::filesystem::path& file) : stream_(file, std::ios::binary) {}

  [[nodiscard]] bool open() const { return stream_.is_open(); }

  Next next(std::string& line) {
    while (true) {
      if (const std::size_t end = text_.find('\n', searched_); end != std::string::npos) {
        line.assign(text_, 0, end + 1);
        text_.erase(0, end + 1);
        searched_ = 0;
        return Next::line;
      }
      searched_ = text_.size();
      if (text_.size() > kMaxPartLine) return Next::too_long;
      std::array<char, 1 << 16> piece;
      stream_.read(piece.data(), piece.size());
      if (stream_.bad()) return Next::unreadable;
      if (stream_.gcount() == 0) return Next::none;
      text_.append(piece.data(), static_cast<std::size_t>(stream_.gcount()));
    }
  }

 private:
  std::ifstream stream_;
  std::string text_;
  std::size_t searched_ = 0;
};

bool belongs_to(const Shard& shard, std::size_t unit) {
  return unit % shard.count == shard.index - 1;
}

// What is wrong with a unit's place among the others; empty if nothing is.
std::string misplaced(const PartHeader& header, const std::vector<bool>& seen, std::size_t unit) {
  if (unit >= header.units) return fmt::format("unit {} of a study of {} units", unit, header.units);
  if (!belongs_to(header.shard, unit)) {
    return fmt::format("unit {} does not belong to shard {}/{}", unit, header.shard.index, header.shard.count);
  }
  return seen[unit] ? fmt::format("unit {} for the second time", unit) : std::string();
}

// More units than any study has: what a first line says must not decide how much memory is taken.
constexpr std::size_t kMaxUnits = std::size_t{1} << 24;

std::string senseless(const PartHeader& header) {
  if (header.units == 0 || header.units > kMaxUnits) {
    return fmt::format("{} units; expected 1 to {}", header.units, kMaxUnits);
  }
  const Shard& s = header.shard;
  if (s.index < 1 || s.index > s.count || s.count > header.units) {
    return fmt::format("shard {}/{} of {} units", s.index, s.count, header.units);
  }
  return {};
}

}  // namespace

std::size_t units_of(const PartHeader& header) {
  return (header.units - header.shard.index) / header.shard.count + 1;
}

Result<PartState> read_part_state(const std::filesystem::path& file) {
  int number = 0;
  const auto fault = [&](std::string message) {
    return Diagnostic{.message = std::move(message), .file = file.string(), .line = number};
  };
  Lines lines(file);
  std::error_code error;
  if (!lines.open() || std::filesystem::is_directory(file, error)) {
    return fault("cannot be read; expected a part that `ninebit study` has written");
  }
  PartState state;
  state.part.file = file;
  state.hash = std::make_unique<Sha256>();
  std::vector<bool> seen;
  std::string line;
  while (true) {
    const Lines::Next next = lines.next(line);
    if (next == Lines::Next::none) break;
    ++number;
    if (next == Lines::Next::unreadable) return fault("cannot be read to its end");
    if (next == Lines::Next::too_long) {
      return fault(fmt::format("the line is longer than {} bytes; expected a part of a study", kMaxPartLine));
    }
    const std::string_view text = std::string_view(line).substr(0, line.size() - 1);
    StudyPart& part = state.part;
    if (part.complete) return fault("stands behind the part's last line; expected nothing");
    if (number == 1) {
      auto header = parse_header_line(text);
      if (!header) return fault(header.error().message);
      if (const std::string why = senseless(*header); !why.empty()) return fault(why);
      part.header = *std::move(header);
      seen.resize(part.header.units);
    } else if (is_end_line(text)) {
      if (part.units.size() != units_of(part.header)) {
        return fault(
            fmt::format("the last line comes after {} units; expected {}", part.units.size(), units_of(part.header)));
      }
      if (Status fits = check_end_line(text, part.units.size(), state.hash->finish()); !fits) {
        return fault(fits.error().message);
      }
      part.complete = true;
      state.whole_bytes += line.size();
      continue;
    } else {
      auto unit = parse_unit_line(text);
      if (!unit) return fault(unit.error().message);
      if (const std::string why = misplaced(part.header, seen, unit->unit); !why.empty()) return fault(why);
      seen[unit->unit] = true;
      part.units.push_back(*std::move(unit));
    }
    state.hash->add(line);
    state.whole_bytes += line.size();
  }
  return state;
}

Result<StudyPart> read_part(const std::filesystem::path& file) {
  auto state = read_part_state(file);
  if (!state) return state.error();
  if (state->whole_bytes == 0) {
    return Diagnostic{.message = "has no whole line; expected a part that `ninebit study` has written",
                      .file = file.string()};
  }
  return std::move(state->part);
}

}  // namespace ninebit
