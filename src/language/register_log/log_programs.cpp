// Reads logs: whether a text is one, and the programs of its set-ups.
#include <algorithm>

#include "ninebit/language/register_log.h"
#include "src/language/register_log/log_layout.h"
#include "src/language/register_log/log_methods.h"
#include "src/language/register_words/register_words_faults.h"
#include "src/language/source/beyond_opengl.h"

namespace ninebit {
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
    const std::size_t end = std::min(beginning.find('\n'), beginning.size());
    std::string_view line = beginning.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    if (!line.empty()) lines.push_back(line);
    beginning.remove_prefix(std::min(end + 1, beginning.size()));
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
    const auto word =
        std::find_if(setup.words.begin(), setup.words.end(), [&](const RegisterWord& one) { return one.name == name; });
    faults.add(word->place, "the log has no data for " + name + ", which set-up " +
                                std::to_string(number == 0 ? 1 : number) + " depends on");
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
