// Prints a pack: docs/emulators.md describes the format.
#include <fmt/format.h>

#include <array>

#include "ninebit/combiner/portion_walk.h"
#include "ninebit/combiner/program.h"
#include "src/study/vectors/vector_format.h"
#include "src/study/vectors/vector_words.h"
#include "src/system/hashing/openssl.h"

namespace ninebit {
namespace vectors {
namespace {

constexpr std::size_t kRegisters = kVectorRegisters.size();

// The components that a stage writes: by register of kVectorRegisters, then red to alpha.
using Written = std::array<std::array<bool, 4>, kRegisters>;

Written written_by(const ProgramStage& stage) {
  Written written{};
  const auto put = [&](Register to, int component) {
    const auto at = std::find(kVectorRegisters.begin(), kVectorRegisters.end(), to) - kVectorRegisters.begin();
    written[static_cast<std::size_t>(at)][static_cast<std::size_t>(component)] = true;
  };
  for (const PortionName name : {PortionName::rgb, PortionName::alpha}) {
    const PortionOutput& out = name == PortionName::rgb ? stage.rgb.out : stage.alpha.out;
    const auto [first, end] = detail::components_of(name);
    for (int c = first; c < end; ++c) {
      for (std::size_t k = 0; k < 3; ++k) detail::for_each_write({out, k, c}, put);
    }
  }
  return written;
}

// A digit for each register: 8 red, 4 green, 2 blue, 1 alpha.
std::string mask_text(const Written& written) {
  std::string text;
  for (const auto& one : written) {
    text += fmt::format("{:x}", 8 * one[0] + 4 * one[1] + 2 * one[2] + static_cast<int>(one[3]));
  }
  return text;
}

// A code in two digits to the base of 36, with 256 added.
void append_code(std::string& text, int code) {
  constexpr std::string_view kDigits = "0123456789abcdefghijklmnopqrstuvwxyz";
  const auto value = static_cast<std::size_t>(code + kTraceOffset);
  text += kDigits[value / kDigits.size()];
  text += kDigits[value % kDigits.size()];
}

// The lines of what each stage writes.
std::string trace_lines(const VectorPack& pack, const VectorProgram& program) {
  const Program compiled = normalize(program.state, pack.profile);
  std::string text;
  for (int s = 0; s < compiled.num_general_combiners; ++s) {
    const Written written = written_by(compiled.general[static_cast<std::size_t>(s)]);
    if (written == Written{}) continue;
    text += fmt::format("s {} {}", s, mask_text(written));
    Program begin = compiled;
    begin.num_general_combiners = s + 1;
    for (std::size_t i = 0; i < pack.fragments; ++i) {
      const RegisterFile after = evaluate_fragment(begin, pack.inputs[program.first_input + i]).registers;
      text += ' ';
      for (std::size_t r = 0; r < kRegisters; ++r) {
        for (std::size_t c = 0; c < 4; ++c) {
          if (written[r][c]) append_code(text, after[kVectorRegisters[r]][c]);
        }
      }
    }
    text += '\n';
  }
  return text;
}

// " 3=04080000" for each word that differs from another program's.
std::string word_changes(const std::vector<std::uint32_t>& words, const std::vector<std::uint32_t>& from) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (words[i] != from[i]) text += fmt::format(" {}={:x}", i, words[i]);
  }
  return text;
}

// By word the value that most programs of a group have.
std::vector<std::uint32_t> usual_words(const VectorPack& pack, std::size_t group) {
  std::vector<std::map<std::uint32_t, std::size_t>> counts(pack.word_names.size());
  for (const VectorProgram& program : pack.programs) {
    if (program.group != group) continue;
    for (std::size_t i = 0; i < counts.size(); ++i) ++counts[i][program.words[i]];
  }
  std::vector<std::uint32_t> usual;
  for (const auto& values : counts) {
    const auto most = std::max_element(values.begin(), values.end(),
                                       [](const auto& x, const auto& y) { return x.second < y.second; });
    usual.push_back(values.empty() ? 0 : most->first);
  }
  return usual;
}

std::string header_text(const VectorPack& pack) {
  std::string text = fmt::format("profile {}\none {}\nchip {}\nseed {}\nprograms {}\nfragments {}\nwords {}\n",
                                 pack.profile.name, pack.profile.one.value, name_of(pack.chip), pack.seed,
                                 pack.programs.size(), pack.fragments, pack.word_names.size());
  for (std::size_t i = 0; i < pack.word_names.size(); ++i) text += fmt::format("word {} {}\n", i, pack.word_names[i]);
  text += "registers";
  for (const Register r : kVectorRegisters) text += fmt::format(" {}", short_name(r));
  text += fmt::format("\ninputs {}\n", pack.inputs.size());
  for (const RegisterFile& input : pack.inputs) {
    text += 'i';
    for (const Register r : kVectorRegisters) {
      for (const s9 code : input[r]) text += fmt::format(" {}", code);
    }
    text += '\n';
  }
  return text;
}

std::string program_text(const VectorPack& pack, std::size_t index, const std::vector<std::uint32_t>& base) {
  const VectorProgram& program = pack.programs[index];
  std::string text = fmt::format("p {} {}{}\no", index + 1, program.first_input, word_changes(program.words, base));
  for (const Bytes4& color : program.expected) text += ' ' + color_text(color);
  return text + '\n' + trace_lines(pack, program);
}

}  // namespace

std::string color_text(const Bytes4& color) {
  return fmt::format("{:02x}{:02x}{:02x}{:02x}", color[0], color[1], color[2], color[3]);
}

std::string id_of(std::string_view body) {
  return sha256(body).substr(0, kIdDigits);
}

}  // namespace vectors

std::string print_vector_pack(VectorPack& pack) {
  std::vector<std::vector<std::uint32_t>> bases;
  for (std::size_t g = 0; g < pack.groups.size(); ++g) bases.push_back(vectors::usual_words(pack, g));
  std::vector<std::string> programs(pack.programs.size());
  (void)vectors::in_blocks(programs.size(), {}, [&](std::size_t i) {
    programs[i] = vectors::program_text(pack, i, bases[pack.programs[i].group]);
  });
  std::string body = vectors::header_text(pack);
  const std::vector<std::uint32_t> zeros(pack.word_names.size());
  std::size_t at = 0;
  for (std::size_t g = 0; g < pack.groups.size(); ++g) {
    const VectorGroup& group = pack.groups[g];
    std::string rules;
    for (const char c : group.rules) rules += c == ' ' ? "" : std::string(1, c);
    body += fmt::format("group {} {} {}\nbase{}\n", group.name, rules.empty() ? "-" : rules, group.what,
                        vectors::word_changes(bases[g], zeros));
    for (; at < programs.size() && pack.programs[at].group == g; ++at) body += programs[at];
  }
  body += "end\n";
  pack.id = vectors::id_of(body);
  return fmt::format("{} {}\n{}", vectors::kPackTitle, pack.id, body);
}

}  // namespace ninebit
