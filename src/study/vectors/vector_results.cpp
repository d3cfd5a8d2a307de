// Reads results, and judges them.
#include <algorithm>

#include "ninebit/study/vectors.h"
#include "src/study/vectors/vector_format.h"
#include "src/study/vectors/vector_mistakes.h"
#include "src/study/vectors/vector_plan.h"
#include "src/study/vectors/vector_words.h"
#include "src/study/vectors/verdicts.h"

namespace ninebit {
namespace {

// The result of one mistake.
struct Alone {
  std::string name, rules, group;
  const vectors::Mistake& mistake;
  vectors::ModelColors colors;
};

// The rules that the programs with results depend on, by program of the pack.
std::vector<vectors::AskedRules> asked_rules(const VectorPack& pack, const std::vector<std::size_t>& programs) {
  const vectors::Model right(pack.profile, {}, {});
  const vectors::ModelColors colors(pack, right, programs);
  std::vector<vectors::AskedRules> asked(pack.programs.size());
  (void)vectors::in_blocks(programs.size(), {}, [&](std::size_t i) { (void)colors(programs[i], &asked[programs[i]]); });
  return asked;
}

}  // namespace

bool are_vector_results(std::string_view text) {
  return text.starts_with(vectors::kResultsTitle);
}

Result<VectorResults> read_vector_results(std::string_view text, const std::string& file, const VectorPack& pack) {
  auto lines = vectors::read_result_lines<Bytes4>(text, file,
                                                  {pack.id, pack.programs.size(), pack.fragments,
                                                   std::to_string(pack.fragments) + " colours of 8 hexadecimal digits"},
                                                  [](vectors::Lines& line) { return line.color(); });
  if (!lines) return lines.error();
  VectorResults results;
  results.id = pack.id;
  for (auto& line : *lines) results.programs[line.program] = {line.line, std::move(line.values)};
  return results;
}

Result<VectorVerdict> judge_vectors(const VectorPack& pack, const VectorResults& results, std::size_t most,
                                    const VectorProgress& go_on) {
  std::vector<vectors::JudgedProgram<Bytes4>> given;
  std::vector<std::size_t> programs;
  for (const auto& [index, colors] : results.programs) {
    const VectorProgram& program = pack.programs[index];
    given.push_back({index, program.group, &colors.colors, &program.expected});
    programs.push_back(index);
  }
  const std::vector<vectors::Mistake> mistakes = vectors::mistakes_of(pack.profile);
  std::vector<vectors::Model> models;
  for (std::size_t m = 0; m < mistakes.size(); ++m) models.emplace_back(pack.profile, mistakes, std::vector{m});
  std::vector<Alone> alone;
  for (std::size_t m = 0; m < mistakes.size(); ++m) {
    alone.push_back({mistakes[m].name, mistakes[m].rules, mistakes[m].group, mistakes[m], {pack, models[m], programs}});
  }
  const bool all_agree =
      std::all_of(given.begin(), given.end(), [](const auto& one) { return *one.given == *one.expected; });
  const auto asked = all_agree ? std::vector<vectors::AskedRules>{} : asked_rules(pack, programs);
  auto verdict =
      vectors::judge(given, pack.groups.size(), alone, most, go_on, [&](const Alone& one, std::size_t program) {
        return vectors::may_change(one.mistake, asked[program]) ? one.colors(program) : pack.programs[program].expected;
      });
  if (!verdict || verdict->differ == 0) return verdict;
  if (Status planned = vectors::make_plan(pack, given, mistakes, go_on, *verdict); !planned) return planned.error();
  return verdict;
}

}  // namespace ninebit
