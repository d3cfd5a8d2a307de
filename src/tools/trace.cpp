// `ninebit trace`: every step of one fragment, as codes, as the numbers they represent, and in exact arithmetic.
#include "ninebit/combiner/trace.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <memory>
#include <optional>

#include "ninebit/combiner/normalize.h"
#include "src/combiner/given_registers.h"
#include "src/effect/traced_pixel.h"
#include "src/system/process.h"
#include "src/system/stream.h"
#include "src/tools/common/flag_values.h"
#include "src/tools/common/output_file.h"
#include "src/tools/common/program_file.h"
#include "src/tools/common/technique_flags.h"
#include "src/tools/draw/draw_flags.h"
#include "src/tools/input/host.h"
#include "src/tools/input/printable.h"
#include "src/tools/input/register_settings.h"
#include "src/tools/trace/trace_page.h"
#include "src/tools/trace/trace_pixel.h"
#include "src/tools/trace/trace_svg.h"
#include "src/tools/trace/trace_text.h"

namespace ninebit::tools {
namespace {

struct TraceFlags {
  CommonFlags common;
  ProgramFlags program;
  std::vector<std::string> set;
  SceneFlags scene;
  std::string effect;
  EffectMoment moment;
  std::vector<CLI::Option*> moment_options;
  std::string pixel;
  std::string pass;
  bool ground_truth = false;
  std::string output;
  CLI::Option* profile = nullptr;  // --profile; whether it was given
  CLI::Option* threads = nullptr;  // the same for --threads
};

// The traced fragment: a pixel, and the profile that it was drawn with.
struct Drawn {
  const TracedPixel* pixel = nullptr;
  const HardwareProfile* profile = nullptr;
  const JudgedPixel* truth = nullptr;           // of --ground-truth
  const TextureShaderResult* stages = nullptr;  // of a fragment from --set, if its stages ran
};

// The answer as a picture for slides.
std::string picture_of(const TraceFacts& facts, const Program* program, const Trace* traced) {
  return trace_svg(facts_text(facts, program, traced, {.colors = true}),
                   traced != nullptr ? std::optional(traced->bytes) : std::nullopt);
}

// The answer for people, for programs, and as a page or picture.
int print(const TraceFlags& flags, const Drawn& drawn, const Program* program, const RegisterFile& registers) {
  // A profile file may give another name to the profile than the command line.
  const bool named_by_flag = drawn.profile == &profile_of(flags.common);
  const std::string profile = named_by_flag ? flags.common.profile : std::string(drawn.profile->name);
  std::optional<Trace> traced;
  if (program != nullptr) traced = trace(*program, *drawn.profile, registers);
  const Trace* const shown = traced ? &*traced : nullptr;
  const TraceFacts facts{.program = flags.program.file,
                         .profile = profile,
                         .pixel = drawn.pixel,
                         .truth = drawn.truth,
                         .hardware = drawn.profile,
                         .given = flags.program.file.empty() ? nullptr : program,
                         .registers = registers,
                         .stages = drawn.stages};
  const TraceHeading heading{
      .profile = profile, .program = flags.program.file, .pixel = drawn.pixel, .stages = drawn.stages};
  Json object = trace_answer(heading, program, shown);
  if (drawn.truth != nullptr) object["truth"] = truth_json(*drawn.truth);
  if (!flags.output.empty() || host() != nullptr) {
    DiagramPage page = trace_page(facts);
    page.text = facts_text(facts, program, shown, {});
    if (host() != nullptr) host()->give("page", diagram_page(page));
    if (host() != nullptr) host()->give("text", page.text);
    if (flags.output.empty()) return answer(object);
    const bool is_picture = std::filesystem::path(flags.output).extension() == ".svg";
    const Status written =
        is_picture ? write_output(flags.output, picture_of(facts, program, shown)) : write_page(flags.output, page);
    if (!written) return report(written.error());
    if (!flags.common.quiet) say_written(flags.output);
    object["files"] = Json::array({flags.output});
  }
  if (flags.common.json) return answer(object);
  if (!flags.output.empty()) return kDone;
  const TraceLayout layout{.colors = wants_colors(posix::kStandardOutput),
                           .columns = terminal_columns(posix::kStandardOutput)};
  return answer_exactly(facts_text(facts, program, shown, layout));
}

void note_stages(const TraceFlags& flags, const std::string& note) {
  if (!flags.common.quiet) say(fmt::format("ninebit: note: {}: {}\n", printable(flags.program.file), note));
}

int trace_set(const TraceFlags& flags, const TextProgram& text) {
  const HardwareProfile& profile = profile_of(flags.common);
  std::vector<std::string> set = flags.set;
  const auto given = take_stage_settings(set);
  if (!given) return wrong_usage("trace", given.error().message);
  auto inputs = parse_register_settings(set, profile);
  if (!inputs) return wrong_usage("trace", inputs.error().message);
  const TextureShaderState& state = text.texture_shader;
  const auto texture = std::find_if(inputs->set.begin(), inputs->set.end(),
                                    [](const EvalColumn& column) { return is_texture(column.reg); });
  const bool gives_components = !given->set.empty(), gives_textures = texture != inputs->set.end();
  if (gives_components && !state.enabled) {
    return wrong_usage("trace",
                       fmt::format("--set {}: the program has no texture-shader stages", name_of(given->set[0])));
  }
  if (gives_components && gives_textures) {
    return wrong_usage("trace",
                       fmt::format("--set {}: the texture-shader stages give it, as --set {} runs them; expected "
                                   "texels, such as texel0",
                                   texture->name(), name_of(given->set[0])));
  }
  std::optional<TextureShaderResult> stages;
  if (runs_stages(state, gives_components, gives_textures)) {
    const auto compiled = compile_for_given(state, profile);
    if (!compiled) return report(compiled.error());
    for (const std::string& warning : compiled->warnings()) note_stages(flags, warning);
    const bool gives_spare0_alpha =
        std::find(inputs->set.begin(), inputs->set.end(), EvalColumn{Register::spare0, kAlpha}) != inputs->set.end();
    stages = evaluate_given(*compiled, profile, given->fragment, gives_spare0_alpha, inputs->registers);
  } else if (!only_reads_textures(state)) {
    note_stages(flags, fmt::format("the texture-shader stages are not run, as --set {} gives what they would",
                                   texture->name()));
  }
  Program program = normalize(text.state, profile);
  std::vector<EvalColumn> constants;
  for (const auto& [column, code] : inputs->constants) constants.push_back(column);
  if (!flags.common.quiet) say_assumed_constants(flags.program.file, program, constants);
  for (const auto& [column, code] : inputs->constants) replace_constant(program, column.reg, column.component, code);
  return print(flags, {.profile = &profile, .stages = stages ? &*stages : nullptr}, &program, inputs->registers);
}

int trace_pixel(const TraceFlags& flags, const std::optional<Program>& program) {
  const RenderSettings settings = settings_of(flags.scene, flags.common);
  const auto at = window_pixel("--pixel", flags.pixel, settings);
  if (!at) return wrong_usage("trace", at.error().message);
  auto rendered = load_pixel(flags.scene, flags.common, flags.ground_truth, *at, program.has_value());
  if (!rendered) return report(rendered.error());
  TracedPixel* const pixel = &rendered->traced;
  if (!flags.pass.empty()) {
    if (Status chosen = choose_pass_named(flags.pass, program.has_value(), *pixel); !chosen) {
      return wrong_usage("trace", chosen.error().message);
    }
  }
  warn_of_unused_order(settings, pixel->index_order);
  const Drawn drawn{pixel, &profile_of(flags.common), rendered->truth ? &*rendered->truth : nullptr};
  if (!pixel->fragment) return print(flags, drawn, nullptr, {});
  const ProbedPass& pass = pixel->passes[*pixel->pass];
  return print(flags, drawn, program ? &*program : &*pass.program, pass.fragments[*pixel->fragment].registers);
}

int trace_effect(const TraceFlags& flags) {
  const HardwareProfile* const given = flags.profile->count() != 0 ? &profile_of(flags.common) : nullptr;
  auto traced =
      draw_pixel(flags.effect, flags.pixel, {.allow_outside = flags.scene.allow_outside, .moment = flags.moment},
                 flags.common, given, flags.program.defines);
  if (!traced) return report(traced.error());
  for (const std::string& warning : unused_moment(flags.moment_options, traced->moves, flags.effect))
    say_warning(warning);
  TracedPixel& pixel = traced->pixel;
  if (!flags.pass.empty()) {
    if (Status chosen = choose_pass_named(flags.pass, false, pixel); !chosen) {
      return wrong_usage("trace", chosen.error().message);
    }
  }
  const Drawn drawn{&pixel, traced->profile};
  if (!pixel.fragment) return print(flags, drawn, nullptr, {});
  const ProbedPass& pass = pixel.passes[*pixel.pass];
  return print(flags, drawn, &*pass.program, pass.fragments[*pixel.fragment].registers);
}

int run(const TraceFlags& flags) {
  const HardwareProfile& profile = profile_of(flags.common);
  if (!flags.effect.empty()) {
    if (!flags.program.file.empty())
      return wrong_usage("trace", "--effect traces the effect's own programs, not PROGRAM");
    return flags.pixel.empty() ? wrong_usage("trace", "--effect requires --pixel X,Y") : trace_effect(flags);
  }
  if (flags.scene.file.empty() && !flags.pass.empty())
    return wrong_usage("trace", "--pass requires --scene or --effect");
  if (flags.program.file.empty() && flags.scene.file.empty()) {
    return wrong_usage("trace", "PROGRAM, --scene or --effect is required");
  }
  if (!flags.program.defines.empty() && flags.program.file.empty()) {
    return wrong_usage("trace", "--define requires PROGRAM or --effect");
  }
  if (flags.scene.file.empty() && flags.threads->count() != 0) {
    return wrong_usage("trace", "--threads requires --scene or --effect: a trace of given registers has one thread");
  }
  if (flags.scene.file.empty() && !flags.pixel.empty())
    return wrong_usage("trace", "--pixel requires --scene or --effect");
  if (!flags.scene.file.empty() && flags.pixel.empty()) return wrong_usage("trace", "--scene requires --pixel X,Y");
  std::optional<Program> program;
  if (!flags.program.file.empty()) {
    int exit_code = kDone;
    ProgramFlags named = flags.program;
    named.allow_outside = flags.scene.allow_outside;
    const auto text = load_text_program(named, profile, flags.common.quiet, exit_code);
    if (!text) return exit_code;
    if (flags.scene.file.empty()) return trace_set(flags, *text);
    if (!only_reads_textures(text->texture_shader)) {
      note_stages(flags, "the texture-shader stages are not run here; tex0 to tex3 are inputs");
    }
    program = normalize(text->state, profile);
  }
  return trace_pixel(flags, program);
}

}  // namespace

void add_trace(CLI::App& app, int& exit_code) {
  CLI::App* verb = app.add_subcommand("trace", "Print every value at every step of one fragment");
  verb->footer(
      "--set gives the registers of the fragment; --scene or --effect, and --pixel, take them from a picture. "
      "Registers that\n"
      "are not set have the defaults of `ninebit eval` (see its --help). Texture-shader stages of PROGRAM run first, "
      "on\n"
      "coordinates and texels that --set gives, as in at1.s=0.5 and texel0=128,64,0,255. With --scene, the program of\n"
      "the pass that decided the pixel's shadow is traced; a PROGRAM given with it is traced instead.\n"
      "Examples:\n"
      "  ninebit trace compare.gl --set primary=102,0,0,0 --set tex0=100,0,0,255\n"
      "  ninebit trace compare.gl --set primary.r=102 --set tex0.r=101 --profile nv2a --json\n"
      "  ninebit trace --scene scenes/index_room.gltf --pixel 400,300 --map-size 256\n"
      "  ninebit trace --scene scenes/index_room.gltf --pixel 400,300 --map-size 256 --ground-truth\n"
      "  ninebit trace --effect scenes/effects/dot3_specular.json --pixel 128,80\n"
      "  ninebit trace bumps.ts --profile nv2a --set texel0=0,64,192,255 --set at1=0.25,0.75\n"
      "  ninebit trace compare.gl --set primary.r=102 --set tex0.r=101 -o compare.html\n"
      "  ninebit trace compare.gl --set primary.r=102 --set tex0.r=101 -o compare.svg");
  auto flags = std::make_shared<TraceFlags>();
  add_common_flags(*verb, flags->common);
  flags->profile = verb->get_option("--profile");
  add_program_flags(*verb, flags->program);
  verb->get_option("program")->required(false);
  CLI::Option* const set =
      verb->add_option(
              "--set", flags->set,
              "Set a register, a unit's coordinates at0 to at3, its texel texel0 to texel3, or one component as in "
              "tex0.a=12; repeatable")
          ->type_name("REGISTER=R,G,B,A")
          ->allow_extra_args(false);
  CLI::Option* const scene = add_scene_file(*verb, "--scene", flags->scene)->excludes(set);
  verb->add_option("--effect", flags->effect, "Effect file, or a ZIP archive with one, whose picture has the pixel")
      ->type_name("FILE")
      ->excludes(set)
      ->excludes(scene);
  flags->moment_options = add_moment_flags(*verb, flags->moment);
  for (CLI::Option* const option : flags->moment_options) option->needs("--effect");
  add_pixel_flag(*verb, "--pixel", flags->pixel, "Pixel to trace, counted from the top left of the picture");
  verb->add_option("--pass", flags->pass,
                   "Pass to trace, by its name (default: the one that decided the shadow; of an effect, the last that "
                   "drew the pixel by a program)")
      ->type_name("NAME");
  verb->add_flag("--ground-truth", flags->ground_truth,
                 "Also say by ray casting whether the pixel is right, and why not (default: off)")
      ->needs(scene);
  add_page_flag(*verb, flags->output)
      ->type_name("FILE")
      ->description(
          "Write a page with a diagram to this file, or a picture for slides if its name ends in .svg, instead "
          "of text to standard output");
  for (CLI::Option* const option : add_scene_flags(*verb, flags->scene)) option->needs(scene);
  verb->get_option("--allow-outside")
      ->description("Also read files that the program, scene or effect names outside of its folder");
  verb->get_option("--up")->needs(scene);
  for (const char* flag : {"--from", "--chip", "--function"}) {
    verb->get_option(flag)->needs(verb->get_option("program"));
  }
  flags->threads = verb->get_option("--threads");
  verb->callback([flags, &exit_code] { exit_code = run(*flags); });
}

}  // namespace ninebit::tools
