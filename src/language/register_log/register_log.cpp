#include "ninebit/language/register_log.h"

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "ninebit/numerics/hardware_profile.h"
#include "src/language/register_log/log_layout.h"
#include "src/language/register_log/log_methods.h"
#include "src/language/register_log/log_tracker.h"
#include "src/language/source/beyond_opengl.h"
#include "src/language/source/source_faults.h"
#include "src/system/find_row.h"
#include "src/system/lines.h"
#include "src/system/nearest_name.h"

namespace ninebit {
namespace reglog {
namespace {

constexpr std::size_t kLongestLine = std::size_t{1} << 16;  // in bytes; longer ones are skipped
constexpr std::size_t kSampleLines = 1000, kSampleBytes = std::size_t{1} << 18;
constexpr std::size_t kMostNames = 4096;  // names whose methods are remembered

// Lines of one kind that were passed over.
struct Skipped {
  std::uint64_t lines = 0, first = 0;
  void add(std::uint64_t line) {
    if (lines++ == 0) first = line;
  }
};

std::string count_of_lines(const Skipped& skipped, const std::string& what) {
  return std::to_string(skipped.lines) + (skipped.lines == 1 ? " line " : " lines ") + what + "; the first is line " +
         std::to_string(skipped.first);
}

int line_of(std::uint64_t line) {
  return static_cast<int>(std::min<std::uint64_t>(line, 0x7fffffff));
}

}  // namespace
}  // namespace reglog

class RegisterLogReader::Impl {
 public:
  Impl(std::string file, const RegisterLogOptions& options)
      : file_(std::move(file)), options_(options), faults_(file_) {}

  void read(std::string_view piece) {
    pieces_.add(piece);
    while (const auto line = pieces_.next()) take(*line);
  }

  Parsed<RegisterLog> finish() {
    if (const auto line = pieces_.last()) take(*line);
    if (!layout_) decide();
    if (!layout_) {
      faults_.add({}, "no register writes in " + std::to_string(lines_) + (lines_ == 1 ? " line" : " lines") +
                          "; expected lines with a method and its data, such as 'method,data' and below it "
                          "'0x0ac0,0x08040000', or those of a tracer of the NV2A");
      return faults_.take();
    }
    if (!tracker_) tracker_.emplace(options_.chip.value_or(options_.fallback), options_.frame);
    RegisterLog log = tracker_->finish();
    log.lines = lines_;
    log.writes = writes_;
    if (!faults_.empty()) return faults_.take();
    return {std::move(log), notes()};
  }

 private:
  void take(std::string_view line) {
    lines_ = pieces_.number();
    if (pieces_.too_long()) return long_lines_.add(lines_);
    line = without_return(line);
    if (layout_) return follow(line, lines_);
    sample_bytes_ += line.size();
    sample_.emplace_back(line, lines_);
    if (sample_.size() >= reglog::kSampleLines || sample_bytes_ >= reglog::kSampleBytes) decide();
  }

  // Chooses the layout by the lines so far, and reads them. Where none of them is a write, they are passed over, and
  // the next ones decide.
  void decide() {
    std::vector<std::string_view> lines;
    for (const auto& [text, number] : sample_) {
      if (!text.empty()) lines.push_back(text);
    }
    layout_ = reglog::LogLayout::choose(lines, options_.chip.value_or(options_.fallback));
    const auto sample = std::exchange(sample_, {});
    sample_bytes_ = 0;
    std::size_t header = 0;
    for (const auto& [text, number] : sample) {
      if (text.empty()) continue;
      if (!layout_) {
        other_lines_.add(number);
      } else if (!layout_->has_header() || header++ > layout_->header_line()) {
        follow(text, number);
      }
    }
    if (layout_ && !layout_->guess().empty()) guessed_line_ = sample.empty() ? 1 : sample.front().second;
  }

  void follow(std::string_view line, std::uint64_t number) {
    if (line.empty() || (tracker_ && tracker_->overflowed())) return;
    const std::optional<reglog::LogWrite> write = layout_->read(line);
    if (!write) {
      const auto& [message, column] = layout_->wrong();
      if (!message.empty()) {
        faults_.add({reglog::line_of(number), column}, message);
      } else {
        other_lines_.add(number);
      }
      return;
    }
    ++writes_;
    if (!choose_chip(*write)) return foreign_.add(number);
    follow(*write, number);
  }

  void follow(const reglog::LogWrite& write, std::uint64_t number) {
    std::uint32_t method = write.method;
    if (!write.name.empty()) {
      const std::optional<std::uint32_t> found = by_name(write, number);
      if (!found) return;
      method = *found;
    }
    if (write.frame) tracker_->set_frame(*write.frame);
    const reglog::Method& known = tracker_->method(method);
    if (known.kind == reglog::MethodKind::none) return;
    if (const auto& [message, column] = layout_->wrong(); !message.empty()) {
      faults_.add({reglog::line_of(number), column}, message);
      return;
    }
    if (!write.data) without_data_.add(number);
    tracker_->write(known, write.data, write.count, number);
    if (tracker_->overflowed()) {
      faults_.add({reglog::line_of(number), write.column},
                  "more than " + std::to_string(kMaxLogSetups) + " different combiner set-ups");
    }
  }

  // Whether a write is of the 3D object of the log's chip, which the first such object decides.
  bool choose_chip(const reglog::LogWrite& write) {
    std::optional<ChipClass> chip;
    if (write.object_class) {
      chip = write.foreign ? std::nullopt : reglog::chip_of_class(*write.object_class);
      if (!chip) return false;
    }
    if (!tracker_) {
      tracker_.emplace(options_.chip ? *options_.chip : chip.value_or(options_.fallback), options_.frame);
    }
    return !chip || *chip == tracker_->chip();
  }

  // The number of a method's name. A name that nearly is one of the combiners' gets a note.
  std::optional<std::uint32_t> by_name(const reglog::LogWrite& write, std::uint64_t number) {
    const std::string name(write.name.substr(0, 100));
    if (const auto known = names_.find(name); known != names_.end()) return known->second;
    const auto found = reglog::number_of(name, tracker_->chip());
    if (names_.size() < reglog::kMostNames) {
      names_.emplace(name, found);
      if (!found) note_misspelled(write, name, number);
    }
    return found;
  }

  void note_misspelled(const reglog::LogWrite& write, const std::string& name, std::uint64_t number) {
    constexpr std::string_view kNames[] = {
        "NV097_SET_COMBINER_COLOR_ICW",        "NV097_SET_COMBINER_COLOR_OCW", "NV097_SET_COMBINER_ALPHA_ICW",
        "NV097_SET_COMBINER_ALPHA_OCW",        "NV097_SET_COMBINER_CONTROL",   "NV097_SET_COMBINER_SPECULAR_FOG_CW0",
        "NV097_SET_COMBINER_SPECULAR_FOG_CW1", "NV097_SET_BEGIN_END",          "NV097_SET_SHADER_STAGE_PROGRAM"};
    const std::string bare = name.substr(0, name.find('['));
    const auto nearest = nearest_name(bare, kNames);
    if (!nearest || *nearest == bare || name_notes_.size() >= kMaxTextFaults) return;
    name_notes_.push_back({file_, reglog::line_of(number), write.column,
                           "the method " + detail::quoted(name) + " is unknown; did you mean '" + *nearest + "'?"});
  }

  [[nodiscard]] std::vector<TextFault> notes() const {
    std::vector<TextFault> notes;
    const auto add = [&](std::uint64_t line, std::string message) {
      notes.push_back({file_, reglog::line_of(std::max<std::uint64_t>(line, 1)), 1, std::move(message)});
    };
    if (!layout_->guess().empty()) {
      add(guessed_line_,
          "read as: " + layout_->guess() +
              "; a first line with the names of the columns (method, data, class, frame) says otherwise");
    }
    if (other_lines_.lines > 0) {
      add(other_lines_.first,
          reglog::count_of_lines(other_lines_,
                                 other_lines_.lines == 1 ? "is not a register write" : "are not register writes"));
    }
    if (long_lines_.lines > 0) {
      add(long_lines_.first, reglog::count_of_lines(long_lines_, "of more than 65536 bytes skipped"));
    }
    if (foreign_.lines > 0) {
      add(foreign_.first, reglog::count_of_lines(foreign_, "with writes to other objects skipped"));
    }
    if (without_data_.lines > 0) {
      add(without_data_.first, reglog::count_of_lines(without_data_, "with writes without data"));
    }
    if (tracker_->unended_line() > 0) add(tracker_->unended_line(), "the draw that begins here has no end");
    if (tracker_->unkept_draws() > 0) {
      add(1, std::to_string(tracker_->unkept_draws()) + " draws are counted, but not listed; the limit is " +
                 std::to_string(kMaxLogDraws));
    }
    notes.insert(notes.end(), name_notes_.begin(), name_notes_.end());
    return notes;
  }

  std::string file_;
  RegisterLogOptions options_;
  TextFaults faults_;
  LinePieces pieces_{reglog::kLongestLine};
  std::uint64_t lines_ = 0, writes_ = 0, guessed_line_ = 1;
  std::vector<std::pair<std::string, std::uint64_t>> sample_;  // the lines that decide the layout
  std::size_t sample_bytes_ = 0;
  std::optional<reglog::LogLayout> layout_;
  std::optional<reglog::LogTracker> tracker_;
  std::unordered_map<std::string, std::optional<std::uint32_t>> names_;
  reglog::Skipped other_lines_, long_lines_, foreign_, without_data_;
  std::vector<TextFault> name_notes_;
};

RegisterLogReader::RegisterLogReader(std::string file, const RegisterLogOptions& options)
    : impl_(std::make_unique<Impl>(std::move(file), options)) {}
RegisterLogReader::~RegisterLogReader() = default;
RegisterLogReader::RegisterLogReader(RegisterLogReader&&) noexcept = default;
RegisterLogReader& RegisterLogReader::operator=(RegisterLogReader&&) noexcept = default;

void RegisterLogReader::read(std::string_view piece) {
  impl_->read(piece);
}

Parsed<RegisterLog> RegisterLogReader::finish() {
  return impl_->finish();
}

Parsed<RegisterLog> parse_register_log(const SourceText& source, const RegisterLogOptions& options) {
  RegisterLogReader reader(std::string(source.file), options);
  reader.read(source.text);
  return reader.finish();
}

// Reads logs: whether a text is one, and the programs of its set-ups.
namespace reglog {
namespace {

// "A, B and 3 more".
std::string listed_names(const std::vector<std::string>& names) {
  constexpr std::size_t kShown = 4;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kShown); ++i) text += (i == 0 ? "" : ", ") + names[i];
  return names.size() <= kShown ? text : text + " and " + std::to_string(names.size() - kShown) + " more";
}

}  // namespace
}  // namespace reglog

std::string primitive_name(std::uint32_t primitive) {
  constexpr std::string_view kNames[] = {"points",         "lines",        "line loop", "line strip", "triangles",
                                         "triangle strip", "triangle fan", "quads",     "quad strip", "polygon"};
  if (primitive >= 1 && primitive <= std::size(kNames)) return std::string(kNames[primitive - 1]);
  return "primitive " + std::to_string(primitive);
}

bool is_register_log(std::string_view beginning) {
  constexpr std::size_t kLooked = std::size_t{1} << 16, kLines = 400;
  beginning = beginning.substr(0, kLooked);
  if (beginning.find('\0') != std::string_view::npos) return false;
  std::vector<std::string_view> lines;
  while (!beginning.empty() && lines.size() < kLines) {
    if (const std::string_view line = take_line(beginning); !line.empty()) lines.push_back(line);
  }
  auto layout = reglog::LogLayout::choose(lines, ChipClass::nv20);
  if (!layout) return false;
  // Tables and guessed columns must have a method that matters in them, and few lines of something else.
  std::size_t writes = 0, needed = 0;
  for (const std::string_view line : lines) {
    const auto write = layout->read(line);
    if (!write) continue;
    ++writes;
    bool matters = false;
    for (const ChipClass chip : {ChipClass::nv20, ChipClass::nv10}) {
      const auto number = write->name.empty() ? std::optional(write->method) : reglog::number_of(write->name, chip);
      matters = matters || (number && reglog::method_of(*number, chip).kind != reglog::MethodKind::none);
    }
    needed += matters ? 1 : 0;
  }
  if (layout->guess().empty() && !layout->has_header()) return writes > 0;
  return needed > 0 && (layout->has_header() || 2 * writes >= lines.size());
}

Parsed<CombinerState> program_of(const RegisterLog& log, std::size_t number, std::string_view file,
                                 const HardwareProfile& profile, std::vector<RegisterWord>* other_words) {
  TextFaults faults(file);
  const std::size_t count = log.setups.size();
  const std::string has =
      "the log has " + std::to_string(count) + (count == 1 ? " combiner set-up" : " combiner set-ups");
  if (number > count || (number == 0 && count != 1)) {
    faults.add({}, has + (number == 0 ? "; pick one with #1 to #" + std::to_string(count) + " behind the file's name"
                                      : "; expected a number from 1 to " + std::to_string(count)));
    return faults.take();
  }
  const LogSetup& setup = log.setups[number == 0 ? 0 : number - 1];
  const int line = static_cast<int>(std::min<std::uint64_t>(std::max<std::uint64_t>(setup.first_line, 1), 0x7fffffff));
  for (const std::string& name : setup.unknown) {
    faults.add(find_row(setup.words, &RegisterWord::name, name)->place,
               "the log has no data for " + name + ", which set-up " + std::to_string(number == 0 ? 1 : number) +
                   " depends on");
  }
  const std::string control = log.chip == ChipClass::nv10 ? "RC_OUT_RGB[1]" : "RC_ENABLE";
  if (std::find(setup.unwritten.begin(), setup.unwritten.end(), control) != setup.unwritten.end()) {
    faults.add({line, 1}, "the log does not write " + control +
                              " before this draw, so the number of general combiners is unknown");
  }
  std::vector<TextFault> notes;
  if (!setup.unwritten.empty()) {
    notes.push_back(
        {std::string(file), line, 1,
         "words that the log does not write before this draw count as 0: " + reglog::listed_names(setup.unwritten)});
  }
  if (log.chip == ChipClass::nv20 && !profile.per_stage_constants) {
    notes.push_back({std::string(file), line, 1, std::string(detail::kReadForOlderChip)});
  }
  if (setup.other_words_change) {
    notes.push_back(
        {std::string(file), line, 1,
         "texture modes and the like change between the draws of this set-up; those of the first draw are kept"});
  }
  if (!faults.empty()) return {faults.take(), std::move(notes)};
  Parsed<CombinerState> decoded = decode_register_words(setup.words, file, log.chip, profile);
  decoded.notes = std::move(notes);
  if (decoded && other_words != nullptr) *other_words = setup.other_words;
  return decoded;
}

}  // namespace ninebit
