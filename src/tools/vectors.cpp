// `ninebit vectors`: writes a pack of programs, inputs and expected outputs for emulators.
#include "ninebit/study/vectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <memory>

#include "ninebit/image/staged_files.h"
#include "ninebit/language/json.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/scene_flags.h"
#include "src/tools/input/host.h"
#include "src/tools/vectors/packed_text.h"

namespace ninebit::tools {
namespace {

struct VectorsFlags {
  CommonFlags common;
  VectorSettings settings;
  std::string folder;
};

struct WrittenPack {
  VectorPack pack;
  std::vector<std::filesystem::path> files;
};

// The canonical JSON form on one line.
std::string program_line(const CombinerState& state) {
  const std::string text = print_json_program(state);
  std::string line;
  for (std::size_t begin = 0; begin < text.size();) {
    const std::size_t end = std::min(text.find('\n', begin), text.size());
    line.append(text, begin, end - begin);
    begin = std::min(text.find_first_not_of("\n ", end), text.size());
  }
  return line;
}

// Line N is program N of vectors.txt.
Result<std::string> program_lines(const VectorPack& pack, ProgressLine& progress) {
  std::string text;
  for (std::size_t i = 0; i < pack.programs.size(); ++i) {
    constexpr std::size_t kLinesPerStep = 256;
    const bool goes_on = i % kLinesPerStep != 0 ||
                         progress.step("JSON", static_cast<double>(i) / static_cast<double>(pack.programs.size()));
    if (!goes_on) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    text += program_line(pack.programs[i].state) + '\n';
  }
  return text;
}

Result<WrittenPack> write_pack(const VectorsFlags& flags) {
  ProgressLine progress(flags.common.quiet || flags.common.json);
  // Before the work: a folder that cannot be written into is reported at once.
  auto opened = open_folder(flags.folder);
  if (!opened) return opened.error();
  std::optional<StagedFiles>& files = *opened;
  auto pack = make_vector_pack(profile_of(flags.common), flags.settings,
                               [&](double done) { return progress.step("programs", done); });
  if (!pack) return pack.error();
  const auto lines = program_lines(*pack, progress);
  if (!lines) return lines.error();
  const std::string text = print_vector_pack(*pack);
  if (ProgressLine::stopped()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  if (host() != nullptr) {
    host()->give("vectors", text);
    host()->give("programs", *lines);
  }
  if (!files) return WrittenPack{std::move(*pack), {}};
  const std::string packed = packed_text(*lines);
  if (ProgressLine::stopped()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  if (Status written = write_staged(*files, "vectors.txt", text); !written) return written.error();
  if (Status written = write_staged(*files, "programs.jsonl.gz", packed); !written) return written.error();
  if (Status written = write_staged(*files, "runner.c", kRunnerText); !written) return written.error();
  if (Status committed = files->commit(); !committed) return committed.error();
  return WrittenPack{std::move(*pack), files->files()};
}

// By group.
std::vector<std::size_t> counts_of(const VectorPack& pack) {
  std::vector<std::size_t> counts(pack.groups.size());
  for (const VectorProgram& program : pack.programs) ++counts[program.group];
  return counts;
}

Json json_of(const WrittenPack& written, const VectorsFlags& flags) {
  const VectorPack& pack = written.pack;
  const std::vector<std::size_t> counts = counts_of(pack);
  Json rows = Json::array(), files = Json::array();
  for (std::size_t g = 0; g < pack.groups.size(); ++g) {
    const VectorGroup& group = pack.groups[g];
    rows.push_back({{"group", group.name}, {"rules", group.rules}, {"what", group.what}, {"programs", counts[g]}});
  }
  for (const auto& file : written.files) files.push_back(file.string());
  return {{"command", "vectors"},
          {"version", NINEBIT_VERSION},
          {"profile", flags.common.profile},
          {"chip", name_of(pack.chip)},
          {"seed", pack.seed},
          {"programs", pack.programs.size()},
          {"fragments", pack.fragments},
          {"id", pack.id},
          {"rows", std::move(rows)},
          {"files", std::move(files)}};
}

std::string text_of(const VectorPack& pack) {
  const std::vector<std::size_t> counts = counts_of(pack);
  std::string text = fmt::format("pack {} of profile {}: {} programs, {} fragments each, seed {}\n", pack.id,
                                 pack.profile.name, pack.programs.size(), pack.fragments, pack.seed);
  text += fmt::format("{:<27}{:>9}  {:<8} {}\n", "group", "programs", "rules", "what");
  for (std::size_t g = 0; g < pack.groups.size(); ++g) {
    const VectorGroup& group = pack.groups[g];
    text += fmt::format("  {:<25}{:>9}  {:<8} {}\n", group.name, counts[g], group.rules, group.what);
  }
  return text;
}

// The fault of a seed; empty: none. CLI11's own check takes a larger number as the largest.
std::string wrong_seed(const std::string& text) {
  std::uint64_t seed = 0;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, seed);
  if (error == std::errc() && stop == end) return {};
  return fmt::format("{} is not a valid seed; expected a whole number from 0 to {}", text,
                     std::numeric_limits<std::uint64_t>::max());
}

int run(const VectorsFlags& flags) {
  const int least = least_vector_programs(profile_of(flags.common));
  if (flags.settings.programs < least) {
    throw CLI::ValidationError("--programs",
                               fmt::format("{} is too few; expected at least {}, one for each group of profile {}",
                                           flags.settings.programs, least, flags.common.profile));
  }
  if (flags.settings.programs > kMostVectorColors / flags.settings.fragments) {
    throw CLI::ValidationError("--programs",
                               fmt::format("{} of {} fragments are too many; expected at most {} fragments",
                                           flags.settings.programs, flags.settings.fragments, kMostVectorColors));
  }
  const ThreadLimit limit(flags.common.threads);
  const auto written = write_pack(flags);
  if (!written) return report(written.error());
  if (flags.common.json) return answer(json_of(*written, flags));
  if (!flags.common.quiet) {
    for (const auto& file : written->files) say_written(file);
  }
  return answer_exactly(text_of(written->pack));
}

}  // namespace

void add_vectors(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand(
      "vectors", "Write a pack of programs, inputs and expected outputs that checks an emulator's combiners");
  verb->footer(
      "The folder gets vectors.txt, the pack in lines that a few lines of C read; programs.jsonl.gz, whose line N\n"
      "is program N as JSON; and runner.c, a C99 file that calls the emulator's combiners and prints the first group\n"
      "that fails. It writes results for `ninebit verify`, which names the rule that is broken.\n"
      "The same flags write the same vectors.txt, on any number of threads.\n"
      "Examples:\n"
      "  ninebit vectors --profile nv2a -o pack\n"
      "  cc -std=c99 pack/runner.c emulator.c -o check && ./check pack/vectors.txt --results results.txt\n"
      "  ninebit verify results.txt --vectors pack");
  auto flags = std::make_shared<VectorsFlags>();
  add_common_flags(*verb, flags->common);
  verb->add_option("-o,--output", flags->folder, "Write the files to this folder")
      ->required(host() == nullptr)
      ->type_name("DIR");
  verb->add_option("--programs", flags->settings.programs, "Number of programs")
      ->capture_default_str()
      ->check(CLI::Range(1, kMostVectorPrograms));
  verb->add_option("--fragments", flags->settings.fragments, "Number of fragments of each program")
      ->capture_default_str()
      ->check(CLI::Range(1, kMostVectorFragments));
  verb->add_option("--seed", flags->settings.seed, "Seed of the random programs and inputs")
      ->capture_default_str()
      ->check(CLI::Validator(wrong_seed, ""));
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools
