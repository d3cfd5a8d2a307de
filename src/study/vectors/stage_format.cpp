// Prints and reads packs of texture-shader stages and their results: docs/emulators.md describes the formats.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>

#include "ninebit/study/stage_vectors.h"
#include "src/study/vectors/stage_mistakes.h"
#include "src/study/vectors/vector_format.h"
#include "src/study/vectors/verdicts.h"

namespace ninebit {
namespace vectors {
namespace {

constexpr std::string_view kCulled = "culled";
constexpr std::size_t kOutputDigits = std::size_t{2} * 4 * kTextureStages;

std::string_view kind_name(StageTarget target) {
  constexpr std::array<std::string_view, 6> kNames{"", "1d", "2d", "rect", "3d", "cube"};
  return kNames[static_cast<std::size_t>(target)];
}

std::string stage_header_text(const StageVectorPack& pack) {
  std::string text =
      fmt::format("profile {}\none {}\nseed {}\nprograms {}\nfragments {}\nwords {}\n", pack.profile.name,
                  pack.profile.one.value, pack.seed, pack.programs.size(), pack.fragments, pack.word_names.size());
  for (std::size_t i = 0; i < pack.word_names.size(); ++i) text += fmt::format("word {} {}\n", i, pack.word_names[i]);
  for (std::size_t i = 0; i < pack.pictures.size(); ++i) {
    const StagePicture& picture = pack.pictures[i];
    text += fmt::format("texture {} {} {} {} {}\n", i, kind_name(picture.target), picture.width, picture.height,
                        picture.depth);
    for (std::size_t n = 0; n < picture.texels.size(); ++n) {
      const std::size_t x = n % static_cast<std::size_t>(picture.width);
      text += fmt::format("{}{}", x == 0 ? "x " : " ", color_text(picture.texels[n]));
      if (x + 1 == static_cast<std::size_t>(picture.width)) text += '\n';
    }
  }
  return text;
}

std::string stage_program_text(const StageVectorPack& pack, std::size_t index) {
  const StageVectorProgram& program = pack.programs[index];
  std::string text = fmt::format("p {}", index + 1);
  for (const auto& picture : program.picture) text += picture ? fmt::format(" {}", *picture) : " -";
  for (std::size_t i = 0; i < program.words.size(); ++i) {
    if (program.words[i] != 0) text += fmt::format(" {}={:x}", i, program.words[i]);
  }
  text += '\n';
  for (std::size_t i = 0; i < program.at.size(); ++i) {
    text += 'i';
    for (const auto& unit : program.at[i]) text += fmt::format(" {}", fmt::join(unit, " "));
    text += fmt::format("\no {}\n", stage_output_text(program.expected[i]));
  }
  return text;
}

// A result as stage_output_text() writes it.
std::optional<StageOutput> parsed_stage_output(std::string_view word) {
  StageOutput output;
  if (word == kCulled) {
    output.is_culled = true;
    return output;
  }
  if (word.size() < kOutputDigits) return std::nullopt;
  for (std::size_t i = 0; i < kOutputDigits / 2; ++i) {
    const auto code = Lines::number_of<int>(word.substr(2 * i, 2), 0, 36 * 36 - 1, 36);
    if (!code) return std::nullopt;
    output.texture[i / 4][i % 4] = static_cast<s9>(*code - kTraceOffset);
  }
  word.remove_prefix(kOutputDigits);
  if (word.empty()) return output;
  const auto depth = Lines::number_of<std::uint32_t>(word.substr(1), 0, UINT32_MAX);
  if (word.front() != '/' || !depth) return std::nullopt;
  output.depth = *depth;
  return output;
}

}  // namespace
}  // namespace vectors

std::string stage_output_text(const StageOutput& output) {
  if (output.is_culled) return std::string(vectors::kCulled);
  std::string text;
  for (const Rgba9& unit : output.texture) {
    for (const s9 code : unit) vectors::append_code(text, code);
  }
  return output.depth ? fmt::format("{}/{}", text, *output.depth) : text;
}

std::string print_stage_vector_pack(StageVectorPack& pack) {
  std::string body = vectors::stage_header_text(pack);
  std::size_t at = 0;
  for (std::size_t g = 0; g < pack.groups.size(); ++g) {
    body += vectors::group_line(pack.groups[g]);
    for (; at < pack.programs.size() && pack.programs[at].group == g; ++at)
      body += vectors::stage_program_text(pack, at);
  }
  body += "end\n";
  pack.id = vectors::id_of(body);
  return fmt::format("{} {}\n{}", vectors::kStagePackTitle, pack.id, body);
}

bool is_stage_vector_pack(std::string_view text) {
  return text.starts_with(vectors::kStagePackTitle);
}

Result<StageVectorPack> read_stage_vector_pack(std::string_view text, const std::string& file,
                                               const HardwareProfile& profile) {
  vectors::Lines lines(text, file);
  const auto expected = [&](const std::string& what) { return lines.fault("expected " + what); };
  if (!lines.next() || !is_stage_vector_pack(text)) {
    return expected("the first line of a pack, '" + std::string(vectors::kStagePackTitle) + " HASH'");
  }
  VectorSettings settings;
  const auto number = [&](std::string_view key, auto most, auto& to) {
    const auto value = lines.next() && lines.word() == key ? lines.number(decltype(most){0}, most) : std::nullopt;
    to = value.value_or(0);
    return value.has_value();
  };
  if (!lines.next() || lines.words() != "profile " + std::string(profile.name)) {
    return expected("'profile " + std::string(profile.name) + "'");
  }
  (void)lines.next();  // one: the comparison of all lines finds another number
  if (!number("seed", UINT64_MAX, settings.seed)) return expected("seed and a whole number");
  if (!number("programs", kMostVectorPrograms, settings.programs)) return expected("programs and their number");
  if (!number("fragments", kMostVectorFragments, settings.fragments)) return expected("fragments and their number");
  auto pack = make_stage_vector_pack(profile, settings);
  if (!pack) return lines.fault(pack.error().message);
  const std::string own = print_stage_vector_pack(*pack);
  if (text == own) return pack;
  // The first line has the hash of the others, so it differs with any of them.
  vectors::Lines of_file(text, file), of_pack(own, file);
  bool more = true;
  do {
    more = of_file.next();
    more = of_pack.next() && more;
  } while (more && (of_file.words() == of_pack.words() || of_file.line() == 1));
  return of_file.fault(
      "the pack differs from what profile " + std::string(profile.name) +
      " gives: it was changed, or made with another version of the profile or of ninebit; make it again");
}

Result<StageVectorResults> read_stage_vector_results(std::string_view text, const std::string& file,
                                                     const StageVectorPack& pack) {
  auto lines = vectors::read_result_lines<StageOutput>(
      text, file,
      {pack.id, pack.programs.size(), pack.fragments,
       std::to_string(pack.fragments) + " results: culled, or 32 digits and perhaps /DEPTH"},
      [](vectors::Lines& line) { return vectors::parsed_stage_output(line.word()); });
  if (!lines) return lines.error();
  StageVectorResults results;
  for (auto& line : *lines) results.programs[line.program] = {line.line, std::move(line.values)};
  return results;
}

Result<VectorVerdict> judge_stage_vectors(const StageVectorPack& pack, const StageVectorResults& results,
                                          std::size_t most, const VectorProgress& go_on) {
  std::vector<vectors::JudgedProgram<StageOutput>> given;
  for (const auto& [index, fragments] : results.programs) {
    const StageVectorProgram& program = pack.programs[index];
    given.push_back({index, program.group, &fragments.outputs, &program.expected});
  }
  const std::vector<vectors::StageMistake> mistakes = vectors::stage_mistakes_of(pack.profile);
  const auto run = [&](const vectors::StageMistake& mistake, std::size_t program) {
    return vectors::run_stage_mistake(mistake, pack, pack.programs[program]);
  };
  auto verdict = vectors::judge(given, pack.groups.size(), mistakes, most, go_on, run);
  if (verdict) vectors::plan_one(given, mistakes, run, *verdict);
  return verdict;
}

}  // namespace ninebit
