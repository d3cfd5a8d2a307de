// Reads packs.
#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "ninebit/combiner/normalize.h"
#include "ninebit/combiner/portion_walk.h"
#include "ninebit/combiner/program.h"
#include "ninebit/study/stage_vectors.h"
#include "ninebit/study/vectors.h"
#include "src/study/vectors/vector_format.h"
#include "src/study/vectors/vector_words.h"
#include "src/system/hashing/openssl.h"

namespace ninebit {
namespace vectors {
namespace {

class PackReader {
 public:
  PackReader(std::string_view text, const std::string& file, const HardwareProfile& profile) : lines_(text, file) {
    pack_.profile = profile;
  }

  Result<VectorPack> read() {
    if (Status status = read_title(); !status) return status.error();
    const std::string_view body = lines_.rest();
    if (Status status = read_header(); !status) return status.error();
    if (Status status = read_groups(); !status) return status.error();
    if (id_of(body) != pack_.id) {
      return Diagnostic{"the pack was changed: its first line has the hash " + pack_.id + ", the lines after it " +
                            id_of(body) + "; make it again",
                        file(), 1};
    }
    if (Status status = check_programs(); !status) return status.error();
    return std::move(pack_);
  }

 private:
  [[nodiscard]] std::string file() const { return lines_.fault("").file; }
  [[nodiscard]] Diagnostic expected(const std::string& what) const { return lines_.fault("expected " + what); }

  Status read_title() {
    if (!lines_.next() || lines_.words().substr(0, kPackTitle.size()) != kPackTitle) {
      return expected("the first line of a pack, '" + std::string(kPackTitle) + " HASH'");
    }
    (void)lines_.word();
    (void)lines_.word();
    pack_.id = lines_.word();
    if (pack_.id.size() != kIdDigits || !lines_.at_end()) return expected("a hash of 16 digits");
    return {};
  }

  // A line `key VALUE` whose value is a number in [low, high].
  template <class T>
  Status read_number(const std::string& key, T low, T high, T& value) {
    const std::string what = key + " and a whole number from " + std::to_string(low) + " to " + std::to_string(high);
    if (!lines_.next() || lines_.word() != key) return expected(what);
    const auto found = lines_.number<T>(low, high);
    if (!found || !lines_.at_end()) return expected(what);
    value = *found;
    return {};
  }

  // A line that can only be this one.
  Status read_line(const std::string& line) {
    if (!lines_.next() || lines_.words() != line) return expected("'" + line + "'");
    return {};
  }

  Status read_header() {
    const HardwareProfile& profile = pack_.profile;
    pack_.chip = profile.per_stage_constants.value ? ChipClass::nv20 : ChipClass::nv10;
    pack_.word_names = word_names(pack_.chip);
    for (const std::string& line : {"profile " + std::string(profile.name), "one " + std::to_string(profile.one.value),
                                    "chip " + std::string(name_of(pack_.chip))}) {
      if (Status status = read_line(line); !status) return status;
    }
    std::size_t most = kMostVectorPrograms, fragments = kMostVectorFragments, inputs = 0;
    if (Status status = read_number<std::uint64_t>("seed", 0, UINT64_MAX, pack_.seed); !status) return status;
    if (Status status = read_number<std::size_t>("programs", 1, most, programs_); !status) return status;
    if (Status status = read_number<std::size_t>("fragments", 1, fragments, pack_.fragments); !status) return status;
    if (Status status = read_line("words " + std::to_string(pack_.word_names.size())); !status) return status;
    for (std::size_t i = 0; i < pack_.word_names.size(); ++i) {
      if (Status status = read_line("word " + std::to_string(i) + ' ' + pack_.word_names[i]); !status) return status;
    }
    std::string registers = "registers";
    for (const Register r : kVectorRegisters) registers += ' ' + std::string(short_name(r));
    if (Status status = read_line(registers); !status) return status;
    if (Status status = read_number<std::size_t>("inputs", 1, 4096, inputs); !status) return status;
    for (std::size_t i = 0; i < inputs; ++i) {
      if (Status status = read_input(); !status) return status;
    }
    return {};
  }

  Status read_input() {
    const int low = pack_.profile.lowest, high = pack_.profile.one;
    const std::string what = "i and 36 codes from " + std::to_string(low) + " to " + std::to_string(high);
    if (!lines_.next() || lines_.word() != "i") return expected(what);
    RegisterFile& input = pack_.inputs.emplace_back();
    for (const Register r : kVectorRegisters) {
      for (s9& code : input[r]) {
        const auto value = lines_.number<int>(low, high);
        if (!value) return expected(what);
        code = static_cast<s9>(*value);
      }
    }
    return lines_.at_end() ? Status() : expected(what);
  }

  // Words as INDEX=VALUE up to the line's end.
  Status read_words(std::vector<std::uint32_t>& words) {
    while (!lines_.at_end()) {
      const std::string_view word = lines_.word();
      const std::size_t sign = std::min(word.find('='), word.size());
      const auto index = Lines::number_of<std::size_t>(word.substr(0, sign), 0, words.size() - 1);
      const auto value = sign == word.size()
                             ? std::nullopt
                             : Lines::number_of<std::uint32_t>(word.substr(sign + 1), 0, UINT32_MAX, 16);
      if (!index || !value) return expected("words as INDEX=HEX, not '" + std::string(word.substr(0, 40)) + "'");
      words[*index] = *value;
    }
    return {};
  }

  Status read_groups() {
    if (!lines_.next()) return expected("a group");
    while (lines_.words() != "end") {
      if (Status status = read_group(); !status) return status;
    }
    if (lines_.next()) return expected("nothing after 'end'");
    if (pack_.programs.size() == programs_) return {};
    return lines_.fault("the pack has " + std::to_string(pack_.programs.size()) + " programs, not " +
                        std::to_string(programs_));
  }

  // A group and its programs; then goes to the line after them.
  Status read_group() {
    if (lines_.word() != "group") return expected("'group', 'p' or 'end'");
    VectorGroup group;
    group.name = lines_.word();
    const std::string_view rules = lines_.word();
    for (const char c : rules == "-" ? std::string_view() : rules) group.rules += c == ',' ? ", " : std::string(1, c);
    group.what = lines_.words();
    if (group.name.empty() || group.what.empty()) return expected("group NAME RULES WHAT");
    pack_.groups.push_back(std::move(group));
    if (!lines_.next() || lines_.word() != "base") return expected("'base' and the words of the group");
    std::vector<std::uint32_t> base(pack_.word_names.size());
    if (Status status = read_words(base); !status) return status;
    if (!lines_.next()) return expected("a program");
    while (lines_.words().substr(0, 2) == "p ") {
      if (Status status = read_program(base); !status) return status;
    }
    return {};
  }

  Status read_program(const std::vector<std::uint32_t>& base) {
    (void)lines_.word();
    const std::size_t number = pack_.programs.size() + 1;
    if (lines_.number<std::size_t>(number, number) == std::nullopt) {
      return expected("program " + std::to_string(number));
    }
    VectorProgram program;
    program.group = pack_.groups.size() - 1;
    program.words = base;
    const std::size_t last = pack_.inputs.size() - std::min(pack_.inputs.size(), pack_.fragments);
    const auto first = lines_.number<std::size_t>(0, last);
    if (!first) return expected("the first input, from 0 to " + std::to_string(last));
    program.first_input = *first;
    if (Status status = read_words(program.words); !status) return status;
    lines_of_programs_.push_back(lines_.line());
    if (!lines_.next() || lines_.word() != "o") return expected("'o' and a colour for each fragment");
    for (std::size_t i = 0; i < pack_.fragments; ++i) {
      const auto color = lines_.color();
      if (!color) return expected(std::to_string(pack_.fragments) + " colours of 8 hexadecimal digits");
      program.expected.push_back(*color);
    }
    if (!lines_.at_end()) return expected(std::to_string(pack_.fragments) + " colours");
    pack_.programs.push_back(std::move(program));
    do {
      if (!lines_.next()) return expected("'end'");
    } while (lines_.words().substr(0, 2) == "s ");
    return {};
  }

  // The words are valid, and the colours are the profile's.
  Status check_programs() {
    std::vector<Status> checked(pack_.programs.size());
    (void)in_blocks(checked.size(), {}, [&](std::size_t i) {
      VectorProgram& program = pack_.programs[i];
      const auto fault = [&](const std::string& message) {
        checked[i] = Diagnostic{message, file(), lines_of_programs_[i]};
      };
      const auto state = state_of(pack_, program.words);
      if (!state) return fault(state.error().message);
      program.state = *state;
      if (program.first_input + pack_.fragments > pack_.inputs.size()) return fault("there are too few inputs");
      if (expected_colors(pack_, program) == program.expected) return;
      fault("profile " + std::string(pack_.profile.name) +
            " gives other colours; the pack was made with another version of it or of ninebit; make it again");
    });
    for (const Status& status : checked) {
      if (!status) return status;
    }
    return {};
  }

  Lines lines_;
  VectorPack pack_;
  std::size_t programs_ = 0;
  std::vector<int> lines_of_programs_;
};

}  // namespace
}  // namespace vectors

Result<VectorPack> read_vector_pack(std::string_view text, const std::string& file, const HardwareProfile& profile) {
  return vectors::PackReader(text, file, profile).read();
}

std::string vector_pack_profile(std::string_view text) {
  vectors::Lines lines(text, "");
  const bool is_pack = lines.next() && (lines.words().starts_with(vectors::kPackTitle) || is_stage_vector_pack(text));
  if (!is_pack) return {};
  if (!lines.next() || lines.word() != "profile") return {};
  return std::string(lines.words());
}

// Prints a pack: docs/emulators.md describes the format.

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
    for (int c = detail::first_component(name); c < detail::end_component(name); ++c) {
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

void append_code(std::string& text, int code) {
  constexpr std::string_view kDigits = "0123456789abcdefghijklmnopqrstuvwxyz";
  const auto value = static_cast<std::size_t>(code + kTraceOffset);
  text += kDigits[value / kDigits.size()];
  text += kDigits[value % kDigits.size()];
}

std::string group_line(const VectorGroup& group) {
  std::string rules;
  for (const char c : group.rules) rules += c == ' ' ? "" : std::string(1, c);
  return fmt::format("group {} {} {}\n", group.name, rules.empty() ? "-" : rules, group.what);
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
    body += fmt::format("{}base{}\n", vectors::group_line(pack.groups[g]), vectors::word_changes(bases[g], zeros));
    for (; at < programs.size() && pack.programs[at].group == g; ++at) body += programs[at];
  }
  body += "end\n";
  pack.id = vectors::id_of(body);
  return fmt::format("{} {}\n{}", vectors::kPackTitle, pack.id, body);
}

}  // namespace ninebit
