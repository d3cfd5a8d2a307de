// Reads results, and judges them.
#include <algorithm>

#include "ninebit/study/vectors.h"
#include "src/study/vectors/vector_format.h"
#include "src/study/vectors/vector_mistakes.h"
#include "src/study/vectors/vector_words.h"

namespace ninebit {
namespace {

using vectors::Lines;
using vectors::Mistake;

// Counts of one program.
struct ProgramVerdict {
  std::vector<std::size_t> differ;           // fragments
  std::vector<std::size_t> explains, agree;  // by mistake
};

std::vector<std::size_t> differing(const VectorProgram& program, const std::vector<Bytes4>& colors) {
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < colors.size(); ++i) {
    if (colors[i] != program.expected[i]) found.push_back(i);
  }
  return found;
}

// How many of a program's fragments each mistake gives as they are.
void judge_mistakes(const VectorPack& pack, const VectorProgram& program, const std::vector<Bytes4>& colors,
                    const std::vector<Mistake>& mistakes, ProgramVerdict& verdict) {
  verdict.explains.resize(mistakes.size());
  verdict.agree.resize(mistakes.size());
  const Program right = normalize(program.state, pack.profile);
  for (std::size_t m = 0; m < mistakes.size(); ++m) {
    const Mistake& mistake = mistakes[m];
    const Program compiled = vectors::mistaken_program(mistake, program.state);
    // An edit that changes nothing gives what the pack expects.
    const bool is_right = mistake.broken == vectors::BrokenRule::none && compiled == right;
    for (std::size_t i = 0; i < colors.size(); ++i) {
      const Bytes4 color =
          is_right ? program.expected[i]
                   : vectors::bytes_of(pack.profile,
                                       vectors::run_mistaken(mistake, compiled, pack.inputs[program.first_input + i]));
      if (color != colors[i]) continue;
      ++verdict.agree[m];
      if (colors[i] != program.expected[i]) ++verdict.explains[m];
    }
  }
}

// The mistakes under which more than `agree` fragments agree, most first.
std::vector<VectorMistake> explaining(const std::vector<Mistake>& mistakes, const std::vector<ProgramVerdict>& judged,
                                      std::size_t agree) {
  std::vector<VectorMistake> found;
  for (std::size_t m = 0; m < mistakes.size(); ++m) {
    VectorMistake one{mistakes[m].name, mistakes[m].rules};
    for (const ProgramVerdict& verdict : judged) {
      one.explains += verdict.explains[m];
      one.agree += verdict.agree[m];
    }
    if (one.agree > agree) found.push_back(std::move(one));
  }
  std::stable_sort(found.begin(), found.end(), [](const VectorMistake& x, const VectorMistake& y) {
    return std::pair(x.agree, x.explains) > std::pair(y.agree, y.explains);
  });
  return found;
}

}  // namespace

bool are_vector_results(std::string_view text) {
  return text.starts_with(vectors::kResultsTitle);
}

Result<VectorResults> read_vector_results(std::string_view text, const std::string& file, const VectorPack& pack) {
  Lines lines(text, file);
  const bool has_title = lines.next() && are_vector_results(lines.words());
  if (!has_title)
    return lines.fault("expected the first line of results, '" + std::string(vectors::kResultsTitle) + " HASH'");
  (void)lines.word();
  (void)lines.word();
  VectorResults results;
  results.id = lines.word();
  if (results.id != pack.id) {
    return lines.fault("these are results of pack " + results.id.substr(0, 40) + ", not of pack " + pack.id);
  }
  const std::string colors = std::to_string(pack.fragments) + " colours of 8 hexadecimal digits";
  while (lines.next()) {
    if (lines.at_end()) continue;
    const auto number = lines.number<std::size_t>(1, pack.programs.size());
    if (!number)
      return lines.fault("expected a program from 1 to " + std::to_string(pack.programs.size()) + " and " + colors);
    const auto [place, is_new] = results.programs.try_emplace(*number - 1);
    if (!is_new) {
      return lines.fault("program " + std::to_string(*number) + " is in line " + std::to_string(place->second.line) +
                         ", too");
    }
    place->second.line = lines.line();
    for (std::size_t i = 0; i < pack.fragments; ++i) {
      const auto color = lines.color();
      if (!color) return lines.fault("expected " + colors);
      place->second.colors.push_back(*color);
    }
    if (!lines.at_end()) return lines.fault("expected " + colors + ", found more");
  }
  if (results.programs.empty()) return lines.fault("the results have no program");
  return results;
}

Result<VectorVerdict> judge_vectors(const VectorPack& pack, const VectorResults& results, std::size_t most,
                                    const VectorProgress& go_on) {
  VectorVerdict verdict;
  verdict.groups.resize(pack.groups.size());
  std::vector<std::pair<std::size_t, const std::vector<Bytes4>*>> given;
  for (const auto& [program, colors] : results.programs) given.emplace_back(program, &colors.colors);
  std::vector<ProgramVerdict> judged(given.size());
  for (std::size_t i = 0; i < given.size(); ++i) {
    const VectorProgram& program = pack.programs[given[i].first];
    judged[i].differ = differing(program, *given[i].second);
    for (const std::size_t fragment : judged[i].differ) {
      if (verdict.first.size() < most) verdict.first.push_back({given[i].first, fragment});
    }
    verdict.fragments += pack.fragments;
    verdict.differ += judged[i].differ.size();
    verdict.groups[program.group].fragments += pack.fragments;
    verdict.groups[program.group].differ += judged[i].differ.size();
  }
  if (verdict.differ == 0) return verdict;
  const std::vector<Mistake> mistakes = vectors::mistakes_of(pack.profile);
  const bool all = vectors::in_blocks(given.size(), go_on, [&](std::size_t i) {
    judge_mistakes(pack, pack.programs[given[i].first], *given[i].second, mistakes, judged[i]);
  });
  if (!all) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  verdict.mistakes = explaining(mistakes, judged, verdict.fragments - verdict.differ);
  return verdict;
}

}  // namespace ninebit
