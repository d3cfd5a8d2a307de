#include "src/tools/common/log_listing.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <vector>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/program.h"
#include "ninebit/language/explain.h"
#include "src/tools/input/printable.h"

namespace ninebit::tools {
namespace {

// The program of a set-up as it is listed.
struct SetupProgram {
  std::vector<std::string> faults{}, notes{};
  int combiners = 0;
  std::vector<int> textures{};           // that it reads
  std::vector<std::string> equations{};  // that its colour depends on
};

void add_textures(const Portion& portion, std::set<int>& into) {
  for (const CombinerInput& input : {portion.a, portion.b, portion.c, portion.d}) {
    if (is_texture(input.reg)) into.insert(texture_unit_of(input.reg));
  }
}

SetupProgram program_in(const RegisterLog& log, std::size_t index, const std::string& name,
                        const HardwareProfile& profile) {
  SetupProgram found;
  const auto state = program_of(log, index + 1, name, profile);
  for (const TextFault& fault : state.faults()) found.faults.push_back(fault.text());
  for (const TextFault& note : state.notes) found.notes.push_back(note.text());
  if (!state) return found;
  const Program program = normalize(*state, profile);
  found.combiners = program.num_general_combiners;
  std::set<int> textures;
  for (int i = 0; i < program.num_general_combiners; ++i) {
    add_textures(program.general[static_cast<std::size_t>(i)].rgb, textures);
    add_textures(program.general[static_cast<std::size_t>(i)].alpha, textures);
  }
  const FinalCombiner& f = program.final_combiner;
  for (const CombinerInput& input : {f.a, f.b, f.c, f.d, f.e, f.f, f.g}) {
    if (is_texture(input.reg)) textures.insert(texture_unit_of(input.reg));
  }
  found.textures.assign(textures.begin(), textures.end());
  for (const Equation& equation : explain(program, profile).equations) {
    if (equation.used) found.equations.push_back(equation.target + " = " + equation.expression);
  }
  return found;
}

bool is_listed(const LogSetup& setup, std::optional<std::uint32_t> frame) {
  return !frame || setup.draws > 0;
}

std::string frames_of(const LogSetup& setup) {
  if (setup.draws == 0) return "-";
  return setup.first_frame == setup.last_frame ? std::to_string(setup.first_frame)
                                               : fmt::format("{}-{}", setup.first_frame, setup.last_frame);
}

std::string plural(std::uint64_t count, const std::string& what) {
  return fmt::format("{} {}{}", count, what, count == 1 ? "" : "s");
}

Json words_json(const std::vector<RegisterWord>& words) {
  Json object = Json::object();
  for (const RegisterWord& word : words) object[word.name] = fmt::format("{:#010x}", word.value);
  return object;
}

Json draws_json(const LogSetup& setup) {
  Json draws = Json::array();
  for (const LogDraw& draw : setup.draw_calls) {
    draws.push_back({{"line", draw.line},
                     {"frame", draw.frame},
                     {"primitive", primitive_name(draw.primitive)},
                     {"vertices", draw.vertices ? Json(*draw.vertices) : Json(nullptr)}});
  }
  return draws;
}

// The frames of the draws that are kept.
std::vector<std::uint32_t> frames_in(const LogSetup& setup) {
  std::set<std::uint32_t> frames;
  for (const LogDraw& draw : setup.draw_calls) frames.insert(draw.frame);
  return {frames.begin(), frames.end()};
}

}  // namespace

std::string log_table(const RegisterLog& log, std::optional<std::uint32_t> frame, const std::string& name,
                      const HardwareProfile& profile) {
  std::string text =
      fmt::format("{}: {}, {}{}, {}\n", printable(name), plural(log.frames, "frame"), plural(log.draws, "draw"),
                  frame ? fmt::format(" in frame {}", *frame) : "", plural(log.setups.size(), "combiner set-up"));
  text += fmt::format("{:>5}  {:>8}  {:>10}  {:>9}  {:>9}  {:<10}  {}\n", "#", "draws", "first line", "frames",
                      "combiners", "textures", "first equation");
  for (std::size_t i = 0; i < log.setups.size(); ++i) {
    const LogSetup& setup = log.setups[i];
    if (!is_listed(setup, frame)) continue;
    const SetupProgram program = program_in(log, i, name, profile);
    const std::string line = setup.draws == 0 ? "-" : std::to_string(setup.first_line);
    if (!program.faults.empty()) {
      text += fmt::format("{:>5}  {:>8}  {:>10}  {:>9}  {:>9}  {:<10}  {}\n", i + 1, setup.draws, line,
                          frames_of(setup), "?", "?", printable(program.faults.front()));
      continue;
    }
    text += fmt::format("{:>5}  {:>8}  {:>10}  {:>9}  {:>9}  {:<10}  {}\n", i + 1, setup.draws, line, frames_of(setup),
                        program.combiners,
                        program.textures.empty() ? "-" : fmt::format("{}", fmt::join(program.textures, ", ")),
                        program.equations.empty() ? "" : program.equations.front());
  }
  return text;
}

Json log_json(const RegisterLog& log, std::optional<std::uint32_t> frame, const std::string& name,
              const HardwareProfile& profile, const std::string& profile_name) {
  Json rows = Json::array();
  for (std::size_t i = 0; i < log.setups.size(); ++i) {
    const LogSetup& setup = log.setups[i];
    if (!is_listed(setup, frame)) continue;
    const SetupProgram program = program_in(log, i, name, profile);
    rows.push_back({{"setup", i + 1},
                    {"draws", setup.draws},
                    {"first_line", setup.draws == 0 ? Json(nullptr) : Json(setup.first_line)},
                    {"frames", frames_in(setup)},
                    {"general_combiners", program.faults.empty() ? Json(program.combiners) : Json(nullptr)},
                    {"textures", program.textures},
                    {"equations", program.equations},
                    {"words", words_json(setup.words)},
                    {"other_words", words_json(setup.other_words)},
                    {"other_words_change", setup.other_words_change},
                    {"draw_calls", draws_json(setup)},
                    {"notes", program.notes},
                    {"faults", program.faults}});
  }
  return {{"command", "convert"},
          {"version", NINEBIT_VERSION},
          {"profile", profile_name},
          {"log", name},
          {"chip", name_of(log.chip)},
          {"frames", log.frames},
          {"frame", frame ? Json(*frame) : Json(nullptr)},
          {"draws", log.draws},
          {"setups", log.setups.size()},
          {"rows", std::move(rows)}};
}

Result<std::size_t> only_setup(const RegisterLog& log, std::uint32_t frame, const std::string& name) {
  std::vector<std::string> numbers;
  std::size_t last = 0;
  for (std::size_t i = 0; i < log.setups.size(); ++i) {
    if (log.setups[i].draws == 0) continue;
    last = i + 1;
    if (numbers.size() < 20) numbers.push_back(fmt::format("#{}", last));
  }
  if (numbers.size() == 1) return last;
  return Diagnostic{.message = numbers.empty()
                                   ? fmt::format("frame {} has no draws", frame)
                                   : fmt::format("frame {} has several combiner set-ups: {}; add one of these to the "
                                                 "log's name to pick it",
                                                 frame, fmt::join(numbers, ", ")),
                    .file = name};
}

}  // namespace ninebit::tools
