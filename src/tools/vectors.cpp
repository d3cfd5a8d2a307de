// `ninebit vectors`: writes a pack of programs, inputs and expected outputs for emulators.
#include "ninebit/study/vectors.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <limits>
#include <memory>

#include "ninebit/image/staged_files.h"
#include "ninebit/language/json.h"
#include "ninebit/study/stage_vectors.h"
#include "ninebit/texture_shader/validate_stages.h"
#include "src/system/lines.h"
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
  bool texture_shader = false;  // a pack of texture-shader stages
  bool quick = false;           // a small pack of combiners
};

// A pack of either half of a pixel.
struct MadePack {
  std::string id, chip;
  std::vector<VectorGroup> groups;
  std::vector<std::size_t> counts;  // of programs, by group
  std::string text;                 // vectors.txt
  std::string programs;             // a program in JSON a line
  std::string_view runner;
  std::vector<std::filesystem::path> files{};
};

// A text of JSON on one line.
std::string one_line(std::string_view text) {
  std::string line(take_line(text));
  while (!text.empty()) line += trimmed(take_line(text), " ");
  return line;
}

// Line N is program N of vectors.txt.
template <class Programs, class Print>
Result<std::string> program_lines(const Programs& programs, const Print& print, ProgressLine& progress) {
  std::string text;
  for (std::size_t i = 0; i < programs.size(); ++i) {
    constexpr std::size_t kLinesPerStep = 256;
    const bool goes_on =
        i % kLinesPerStep != 0 || progress.step("JSON", static_cast<double>(i) / static_cast<double>(programs.size()));
    if (!goes_on) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
    text += one_line(print(programs[i].state)) + '\n';
  }
  return text;
}

// `print_pack` sets the pack's id.
template <class Pack, class PrintPack, class PrintProgram>
Result<MadePack> texts_of(Result<Pack> pack, ChipClass chip, std::string_view runner, const PrintPack& print_pack,
                          const PrintProgram& print_program, ProgressLine& progress) {
  if (!pack) return pack.error();
  auto lines = program_lines(pack->programs, print_program, progress);
  if (!lines) return lines.error();
  MadePack made;
  made.text = print_pack(*pack);
  made.id = pack->id;
  made.chip = name_of(chip);
  made.groups = pack->groups;
  made.counts.resize(pack->groups.size());
  for (const auto& program : pack->programs) ++made.counts[program.group];
  made.programs = *std::move(lines);
  made.runner = runner;
  return made;
}

Result<MadePack> make_pack(const VectorsFlags& flags, ProgressLine& progress) {
  const HardwareProfile& profile = profile_of(flags.common);
  const auto go_on = [&](double done) { return progress.step("programs", done); };
  if (flags.texture_shader) {
    return texts_of(
        make_stage_vector_pack(profile, flags.settings, go_on), ChipClass::nv20, kStageRunnerText,
        print_stage_vector_pack, [](const TextureShaderState& state) { return print_json_program({}, {}, state); },
        progress);
  }
  const ChipClass chip = profile.per_stage_constants.value ? ChipClass::nv20 : ChipClass::nv10;
  return texts_of(
      make_vector_pack(profile, flags.settings, go_on), chip, kRunnerText, print_vector_pack,
      [](const CombinerState& state) { return print_json_program(state); }, progress);
}

Result<MadePack> write_pack(const VectorsFlags& flags) {
  ProgressLine progress(flags.common.quiet || flags.common.json);
  // Before the work: a folder that cannot be written into is reported at once.
  auto opened = open_folder(flags.folder);
  if (!opened) return opened.error();
  std::optional<StagedFiles>& files = *opened;
  auto made = make_pack(flags, progress);
  if (!made) return made;
  if (ProgressLine::stopped()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  if (host() != nullptr) {
    host()->give("vectors", made->text);
    host()->give("programs", made->programs);
  }
  if (!files) return made;
  const std::string packed = packed_text(made->programs);
  if (ProgressLine::stopped()) return Diagnostic{.message = "interrupted", .fault = Fault::cancelled};
  if (Status written = write_staged(*files, "vectors.txt", made->text); !written) return written.error();
  if (Status written = write_staged(*files, "programs.jsonl.gz", packed); !written) return written.error();
  if (Status written = write_staged(*files, "runner.c", made->runner); !written) return written.error();
  if (Status committed = files->commit(); !committed) return committed.error();
  made->files = files->files();
  return made;
}

Json json_of(const MadePack& pack, const VectorsFlags& flags) {
  Json rows = Json::array(), files = Json::array();
  for (std::size_t g = 0; g < pack.groups.size(); ++g) {
    const VectorGroup& group = pack.groups[g];
    rows.push_back({{"group", group.name}, {"rules", group.rules}, {"what", group.what}, {"programs", pack.counts[g]}});
  }
  for (const auto& file : pack.files) files.push_back(file.string());
  return {{"command", "vectors"},
          {"version", NINEBIT_VERSION},
          {"profile", flags.common.profile},
          {"chip", pack.chip},
          {"seed", flags.settings.seed},
          {"programs", flags.settings.programs},
          {"fragments", flags.settings.fragments},
          {"id", pack.id},
          {"rows", std::move(rows)},
          {"files", std::move(files)}};
}

std::string text_of(const MadePack& pack, const VectorsFlags& flags) {
  const VectorSettings& settings = flags.settings;
  std::string text = fmt::format("pack {} of profile {}: {} programs, {} fragments each, seed {}\n", pack.id,
                                 profile_of(flags.common).name, settings.programs, settings.fragments, settings.seed);
  std::size_t widest = 25;
  for (const VectorGroup& group : pack.groups) widest = std::max(widest, group.name.size());
  text += fmt::format("{:<{}}{:>9}  {:<8} {}\n", "group", widest + 2, "programs", "rules", "what");
  for (std::size_t g = 0; g < pack.groups.size(); ++g) {
    const VectorGroup& group = pack.groups[g];
    text += fmt::format("  {:<{}}{:>9}  {:<8} {}\n", group.name, widest, pack.counts[g], group.rules, group.what);
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
  if (flags.texture_shader && !profile_of(flags.common).texture_shaders) {
    throw CLI::ValidationError("--texture-shader", no_texture_shaders(profile_of(flags.common)));
  }
  const int least =
      flags.texture_shader ? least_stage_vector_programs() : least_vector_programs(profile_of(flags.common));
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
  return answer_exactly(text_of(*written, flags));
}

}  // namespace

void add_vectors(CLI::App& app, int& exit_code) {
  CLI::App* verb =
      app.add_subcommand("vectors", "Write a pack of programs, inputs and expected outputs that checks an emulator");
  verb->footer(
      "The folder gets vectors.txt, the pack in lines that a few lines of C read; programs.jsonl.gz, whose line N\n"
      "is program N as JSON; and runner.c, a C99 file that calls the emulator's combiners and prints the first group\n"
      "that fails. It writes results for `ninebit verify`, which names the rule that is broken.\n"
      "The same flags write the same vectors.txt, on any number of threads.\n"
      "With --texture-shader, the pack is of the half of a pixel before the combiners: texture-shader stages with\n"
      "small textures and coordinates; the profile must have texture shaders, as nv2a has.\n"
      "Examples:\n"
      "  ninebit vectors --profile nv2a -o pack\n"
      "  cc -std=c99 pack/runner.c emulator.c -o check && ./check pack/vectors.txt --results results.txt\n"
      "  ninebit verify results.txt --vectors pack\n"
      "  ninebit vectors --profile nv2a --texture-shader -o pack");
  auto flags = std::make_shared<VectorsFlags>();
  add_common_flags(*verb, flags->common);
  verb->add_option("-o,--output", flags->folder, "Write the files to this folder")
      ->required(host() == nullptr)
      ->type_name("DIR");
  verb->add_flag("--texture-shader", flags->texture_shader,
                 "Check texture-shader stages instead of combiners (1000 programs by default)");
  CLI::Option* const programs = verb->add_option("--programs", flags->settings.programs, "Number of programs")
                                    ->capture_default_str()
                                    ->check(whole_in_range(1, kMostVectorPrograms));
  verb->add_flag("--quick", flags->quick, "Write 2000 programs, for engines that take long for each")
      ->excludes(programs);
  verb->add_option("--fragments", flags->settings.fragments, "Number of fragments of each program")
      ->capture_default_str()
      ->check(whole_in_range(1, kMostVectorFragments));
  verb->add_option("--seed", flags->settings.seed, "Seed of the random programs and inputs")
      ->capture_default_str()
      ->check(CLI::Validator(wrong_seed, ""));
  verb->callback([flags, verb, &exit_code] {
    if (flags->texture_shader && flags->quick) {
      throw CLI::ValidationError("--quick", "packs of --texture-shader have 1000 programs; choose with --programs");
    }
    if (flags->texture_shader && verb->count("--programs") == 0) flags->settings.programs = kStageVectorPrograms;
    if (flags->quick) flags->settings.programs = kQuickVectorPrograms;
    exit_code = run(*flags);
  });
}

}  // namespace ninebit::tools
