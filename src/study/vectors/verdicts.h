// Reading and judging results, for packs of either half of a pixel.
#pragma once

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "ninebit/study/vectors.h"
#include "src/study/vectors/vector_format.h"
#include "src/study/vectors/vector_words.h"

namespace ninebit::vectors {

// The pack's facts that the reader of its results prints.
struct ResultsOf {
  const std::string& id;
  std::size_t programs, fragments;
  std::string values;  // of a line: "16 colours of 8 hexadecimal digits"
};

// A line of results: the program's index, and a value for each fragment.
template <class Value>
struct ResultLine {
  std::size_t program = 0;
  int line = 0;
  std::vector<Value> values;
};

// Reads the lines of results; `read(lines)` takes one value, or gives nothing. No program comes twice.
template <class Value, class Read>
Result<std::vector<ResultLine<Value>>> read_result_lines(std::string_view text, const std::string& file,
                                                         const ResultsOf& pack, const Read& read) {
  Lines lines(text, file);
  const bool has_title = lines.next() && are_vector_results(lines.words());
  if (!has_title) {
    return lines.fault("expected the first line of results, '" + std::string(kResultsTitle) + " HASH'");
  }
  (void)lines.word();
  (void)lines.word();
  const std::string id(lines.word());
  if (id != pack.id) {
    return lines.fault("these are results of pack " + id.substr(0, 40) + ", not of pack " + pack.id);
  }
  std::vector<ResultLine<Value>> found;
  std::vector<int> line_of(pack.programs);
  while (lines.next()) {
    if (lines.at_end()) continue;
    const auto number = lines.number<std::size_t>(1, pack.programs);
    if (!number) {
      return lines.fault("expected a program from 1 to " + std::to_string(pack.programs) + " and " + pack.values);
    }
    int& before = line_of[*number - 1];
    if (before != 0) {
      return lines.fault("program " + std::to_string(*number) + " is in line " + std::to_string(before) + ", too");
    }
    before = lines.line();
    ResultLine<Value> one{*number - 1, lines.line(), {}};
    for (std::size_t i = 0; i < pack.fragments; ++i) {
      const std::optional<Value> value = read(lines);
      if (!value) return lines.fault("expected " + pack.values);
      one.values.push_back(*value);
    }
    if (!lines.at_end()) return lines.fault("expected " + pack.values + ", found more");
    found.push_back(std::move(one));
  }
  if (found.empty()) return lines.fault("the results have no program");
  return found;
}

// A program with results.
template <class Value>
struct JudgedProgram {
  std::size_t program, group;
  const std::vector<Value>*given, *expected;  // by fragment
};

// The group that fails first because of a mistake; empty: the mistakes of a pack do not say it.
template <class Mistake>
std::string group_of(const Mistake& mistake) {
  if constexpr (requires { mistake.group; }) return mistake.group;
  return {};
}

// Judges programs in the pack's order. `run(mistake, program)` gives what a mistake computes, by fragment; `mistakes`
// have names and rules.
template <class Value, class Mistake, class Run>
Result<VectorVerdict> judge(const std::vector<JudgedProgram<Value>>& programs, std::size_t groups,
                            const std::vector<Mistake>& mistakes, std::size_t most, const VectorProgress& go_on,
                            const Run& run) {
  VectorVerdict verdict;
  verdict.groups.resize(groups);
  for (const auto& one : programs) {
    VectorVerdict::GroupCount& group = verdict.groups[one.group];
    for (std::size_t i = 0; i < one.given->size(); ++i) {
      ++group.fragments;
      ++verdict.fragments;
      if ((*one.given)[i] == (*one.expected)[i]) continue;
      ++group.differ;
      ++verdict.differ;
      if (verdict.first.size() < most) verdict.first.push_back({one.program, i});
    }
  }
  if (verdict.differ == 0) return verdict;
  struct Count {
    std::size_t explains = 0, agree = 0;
  };
  std::vector<std::vector<Count>> counts(programs.size(), std::vector<Count>(mistakes.size()));
  const bool all = in_blocks(programs.size(), go_on, [&](std::size_t p) {
    const auto& [program, group, given, expected] = programs[p];
    for (std::size_t m = 0; m < mistakes.size(); ++m) {
      const std::vector<Value> mistaken = run(mistakes[m], program);
      for (std::size_t i = 0; i < given->size(); ++i) {
        if (mistaken[i] != (*given)[i]) continue;
        ++counts[p][m].agree;
        if ((*given)[i] != (*expected)[i]) ++counts[p][m].explains;
      }
    }
  });
  if (!all) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  for (std::size_t m = 0; m < mistakes.size(); ++m) {
    VectorMistake one{mistakes[m].name, mistakes[m].rules, group_of(mistakes[m])};
    for (const std::vector<Count>& of : counts) {
      one.explains += of[m].explains;
      one.agree += of[m].agree;
    }
    if (one.agree > verdict.fragments - verdict.differ) verdict.mistakes.push_back(std::move(one));
  }
  std::stable_sort(verdict.mistakes.begin(), verdict.mistakes.end(),
                   [](const VectorMistake& x, const VectorMistake& y) {
                     return std::pair(x.agree, x.explains) > std::pair(y.agree, y.explains);
                   });
  return verdict;
}

// Fills the plan with the best mistake alone, if it breaks nothing: for mistakes that are not made together.
template <class Value, class Mistake, class Run>
void plan_one(const std::vector<JudgedProgram<Value>>& programs, const std::vector<Mistake>& mistakes, const Run& run,
              VectorVerdict& verdict) {
  verdict.unexplained = verdict.differ;
  if (verdict.mistakes.empty()) return;
  const VectorMistake& best = verdict.mistakes.front();
  if (best.agree - best.explains != verdict.fragments - verdict.differ) return;
  const auto mistake =
      std::find_if(mistakes.begin(), mistakes.end(), [&](const Mistake& one) { return one.name == best.name; });
  for (const auto& [program, group, given, expected] : programs) {
    const std::vector<Value> mistaken = run(*mistake, program);
    for (std::size_t i = 0; i < given->size(); ++i) {
      if (mistaken[i] != (*given)[i] || (*given)[i] == (*expected)[i]) continue;
      verdict.plan.push_back({.mistake = best, .same = {}, .program = program, .fragment = i});
      for (const VectorMistake& other : verdict.mistakes) {
        const bool is_same = other.agree == best.agree && other.explains == best.explains && other.name != best.name;
        if (is_same && best.agree == verdict.fragments) verdict.plan.back().same.push_back(other.name);
      }
      verdict.unexplained = verdict.fragments - best.agree;
      return;
    }
  }
}

}  // namespace ninebit::vectors
