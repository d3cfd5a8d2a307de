// `ninebit convert`: the same program in another form, and the combiner set-ups of a log.
#include <fmt/format.h>

#include <memory>
#include <utility>
#include <vector>

#include "ninebit/combiner/normalize.h"
#include "src/language/source/beyond_opengl.h"
#include "src/language/xbox/stage_words.h"
#include "src/tools/common/log_listing.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/program_file.h"

namespace ninebit::tools {
namespace {

struct ConvertFlags {
  CommonFlags common;
  ProgramFlags program;
  std::string to;           // empty: list the set-ups of a log
  std::uint32_t frame = 0;  // of a log; 0: all
  std::string output;
};

// Says what has no place in the form that is written.
void say_left_out(const ConvertFlags& flags, const TextProgram& program) {
  const std::vector<RegisterWord>& other_words = program.other_words;
  const Form& form = *find_form(flags.to);
  const bool nv20 = chip_of(flags.program, profile_of(flags.common)) == ChipClass::nv20;
  const bool has_words = form.has_words || form.name == "xbox";
  if (const std::string lost = has_words ? xbox::not_in_stage_words(program.texture_shader) : "";
      !lost.empty() && !flags.common.quiet) {
    say(fmt::format("ninebit: note: {} has no place for {}\n", flags.to, lost));
  }
  if (flags.common.quiet || (form.keeps_other_words && (nv20 || !form.has_words))) return;
  std::string names;
  for (const RegisterWord& word : other_words) {
    if (word.value != 0) names += (names.empty() ? "" : ", ") + word.name;
  }
  if (!names.empty()) say(fmt::format("ninebit: note: {} has no place for {}\n", flags.to, names));
}

int write(const ConvertFlags& flags, const std::string& text) {
  if (Status written = write_output(flags.output, text); !written) return report(written.error());
  if (!flags.output.empty() && !flags.common.quiet) say_written(flags.output);
  return kDone;
}

// Lists the set-ups of a log.
int list(const ConvertFlags& flags, ProgramSource source) {
  const HardwareProfile& profile = profile_of(flags.common);
  const auto frame = flags.frame == 0 ? std::nullopt : std::optional(flags.frame);
  auto log = read_log(source, flags.program, profile, frame);
  if (!log) return report(log.error());
  if (!flags.common.quiet) say_notes(log->notes);
  if (!*log) return report(log->faults(), source.text);
  const RegisterLog& found = **log;
  if (found.chip == ChipClass::nv20 && !profile.per_stage_constants && !flags.common.quiet) {
    say(fmt::format("ninebit: note: {}\n", detail::kReadForOlderChip));
  }
  if (frame && *frame > found.frames) {
    return wrong_usage("convert", fmt::format("--frame {}: out of range; the log has {} frame{} with draws", *frame,
                                              found.frames, found.frames == 1 ? "" : "s"));
  }
  if (!flags.common.json) return write(flags, log_table(found, frame, source.name, profile));
  const Json object = log_json(found, frame, source.name, profile, flags.common.profile);
  if (flags.output.empty()) return answer(object);
  return write(flags, json_text(object));
}

// The program to convert. With --frame, it may be the only set-up of the frame.
std::optional<TextProgram> load(const ConvertFlags& flags, ProgramSource source, int& exit_code) {
  const HardwareProfile& profile = profile_of(flags.common);
  if (flags.frame == 0 || source.setup) {
    return load_text_program(std::move(source), flags.program, profile, flags.common.quiet, exit_code);
  }
  auto log = read_log(source, flags.program, profile, flags.frame);
  if (!log) {
    exit_code = report(log.error());
    return std::nullopt;
  }
  source.setup = 0;
  if (*log) {
    const auto only = only_setup(**log, flags.frame, source.name);
    if (!only) {
      exit_code = report(only.error());
      return std::nullopt;
    }
    source.setup = *only;
  }
  return load_setup(std::move(*log), std::move(source), profile, flags.common.quiet, exit_code);
}

int run(const ConvertFlags& flags) {
  auto source = open_program(flags.program);
  if (!source) return report(source.error());
  if (misuses_source_flags(flags.program, source->name, source->form)) return kWrongUsage;
  const bool is_log = source->form == ProgramForm::log;
  if (flags.frame != 0 && !is_log) {
    return wrong_usage("convert", fmt::format("--frame is for logs of register writes; {} is not one", source->name));
  }
  if (flags.to.empty()) {
    if (is_log && !source->setup) return list(flags, std::move(*source));
    return wrong_usage("convert", "--to is required; only a log's set-ups are listed without it");
  }
  int exit_code = kDone;
  const auto program = load(flags, std::move(*source), exit_code);
  if (!program) return exit_code;
  const HardwareProfile& profile = profile_of(flags.common);
  const Form& form = *find_form(flags.to);
  const auto text = form.print(*program, chip_of(flags.program, profile), profile);
  if (!text) {
    Diagnostic lacking = text.error();
    if (lacking.file.empty()) lacking.file = flags.program.file == "-" ? "standard input" : flags.program.file;
    lacking.message = fmt::format("cannot be written as {}: {}", flags.to, lacking.message);
    return report(lacking);
  }
  say_left_out(flags, *program);
  if (form.writes_values && !flags.common.quiet) {
    say_assumed_constants(flags.program.file, normalize(program->state, profile), {});
  }
  if (!flags.common.json) return write(flags, *text);
  Json row{{"form", flags.to}};
  if (flags.output.empty()) {
    row["text"] = *text;
  } else {
    if (const int code = write(flags, *text); code != kDone) return code;
    row["file"] = flags.output;
  }
  const Json out{{"command", "convert"},
                 {"version", NINEBIT_VERSION},
                 {"profile", flags.common.profile},
                 {"rows", Json::array({std::move(row)})}};
  return answer(out);
}

}  // namespace

void add_convert(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("convert", "Convert a program to another form");
  verb->footer(
      "If the form cannot express the program, the error names the unsupported features.\n"
      "Without --to, lists the combiner set-ups of a log of register writes; LOG#N is the set-up N.\n"
      "Examples:\n"
      "  ninebit convert compare.gl --to rc10\n"
      "  ninebit convert frame.log --frame 2 --profile nv2a\n"
      "  ninebit convert 'frame.log#3' --to xbox --profile nv2a\n"
      "  ninebit convert program.json --to words --chip nv20 --profile nv2a -o program.words");
  auto flags = std::make_shared<ConvertFlags>();
  add_answer_flags(*verb, flags->common);
  add_profile_flag(*verb, flags->common);
  add_program_flags(*verb, flags->program);
  add_include_flag(*verb, flags->program.allow_outside);
  verb->add_option("--to", flags->to, "Form to write; without it, list the set-ups of a log")
      ->check(CLI::IsMember(written_form_names()));
  verb->add_option("--frame", flags->frame, "Only the draws of this frame of a log, counted from 1")
      ->check(whole_in_range(1, 0xffffffff));
  verb->add_option("-o,--output", flags->output, "Write to this file instead of standard output")->type_name("FILE");
  verb->callback([flags, &exit_code] {
    flags->program.writes_words = !flags->to.empty() && find_form(flags->to)->has_words;
    exit_code = run(*flags);
  });
}

}  // namespace ninebit::tools
