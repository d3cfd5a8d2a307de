// Reads results, and judges them.
#include "ninebit/study/vectors.h"
#include "src/study/vectors/vector_format.h"
#include "src/study/vectors/vector_mistakes.h"
#include "src/study/vectors/vector_words.h"
#include "src/study/vectors/verdicts.h"

namespace ninebit {
namespace {

using vectors::Mistake;

// What a mistake computes for a program's fragments.
std::vector<Bytes4> mistaken_colors(const VectorPack& pack, const VectorProgram& program, const Mistake& mistake) {
  const Program compiled = vectors::mistaken_program(mistake, program.state);
  // An edit that changes nothing gives what the pack expects.
  const bool is_right =
      mistake.broken == vectors::BrokenRule::none && compiled == normalize(program.state, pack.profile);
  if (is_right) return program.expected;
  std::vector<Bytes4> colors;
  for (std::size_t i = 0; i < program.expected.size(); ++i) {
    colors.push_back(vectors::bytes_of(pack.profile,
                                       vectors::run_mistaken(mistake, compiled, pack.inputs[program.first_input + i])));
  }
  return colors;
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
  for (const auto& [index, colors] : results.programs) {
    const VectorProgram& program = pack.programs[index];
    given.push_back({index, program.group, &colors.colors, &program.expected});
  }
  return vectors::judge(given, pack.groups.size(), vectors::mistakes_of(pack.profile), most, go_on,
                        [&](const Mistake& mistake, std::size_t program) {
                          return mistaken_colors(pack, pack.programs[program], mistake);
                        });
}

}  // namespace ninebit
